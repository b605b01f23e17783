#pragma once
/// How the light of a light group reaches pictures that are drawn with probes (docs/light-modes.md).

#include <optional>
#include <string>
#include <vector>

#include <ssphh/core/enum_names.h>

namespace ssphh::scene {

struct Scene;

/// `realtime`: direct and indirect light follow the lamp. `mixed`: direct light follows it, indirect light is
/// as baked. `baked`: both are as baked, shadows included: they stand in the probes and in the records of
/// surfaces, and nothing of the group is sampled while a picture is drawn.
enum class LightMode { realtime, mixed, baked };
constexpr auto enum_table(LightMode) {
  using enum LightMode;
  return std::to_array<EnumName<LightMode>>({{realtime, "realtime"}, {mixed, "mixed"}, {baked, "baked"}});
}

/// What a scene asks for one of its light groups.
struct GroupMode {
  std::string group;
  LightMode mode = LightMode::realtime;

  friend bool operator==(const GroupMode&, const GroupMode&) = default;
};

/// The mode that the scene asks for; none: it says nothing of the group, which is realtime then.
std::optional<LightMode> asked_light_mode(const Scene& scene, const std::string& group);

/// The mode of each light group, in the order of light_groups().
std::vector<LightMode> light_modes(const Scene& scene);

/// Asks for a mode, in place of what was asked before. Throws Error that lists the groups where the scene has
/// none of that name.
void set_light_mode(Scene& scene, const std::string& group, LightMode mode);

/// Forgets what is asked for groups that the scene does not have any more; returns their names.
std::vector<std::string> drop_unused_light_modes(Scene& scene);

}  // namespace ssphh::scene
