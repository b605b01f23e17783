#pragma once
/// How the light of a light group reaches pictures that are drawn with probes (docs/light-modes.md).

#include <optional>
#include <string>
#include <vector>

#include <ssphh/core/enum_names.h>

namespace ssphh::scene {

struct Scene;
struct Environment;

/// `realtime`: direct and indirect light follow the lamp. `mixed`: direct light follows it, indirect light is
/// as baked. `baked`: both are as baked, shadows included: they stand in the probes and in the records of
/// surfaces, and nothing of the group is sampled while a picture is drawn. `diffuse`: as `baked` where a
/// picture is drawn by records, but that glossy surfaces mirror the environment itself; as `realtime` where
/// it is not.
enum class LightMode { realtime, mixed, baked, diffuse };
constexpr auto enum_table(LightMode) {
  using enum LightMode;
  return std::to_array<EnumName<LightMode>>(
      {{realtime, "realtime"}, {mixed, "mixed"}, {baked, "baked"}, {diffuse, "diffuse"}});
}

/// Whether records keep direct light of groups of this mode.
constexpr bool keeps_direct(LightMode mode) {
  return mode == LightMode::baked || mode == LightMode::diffuse;
}

/// What a scene asks for one of its light groups.
struct GroupMode {
  std::string group;
  LightMode mode = LightMode::realtime;

  friend bool operator==(const GroupMode&, const GroupMode&) = default;
};

/// The mode that the scene asks for; none: it says nothing of the group.
std::optional<LightMode> asked_light_mode(const Scene& scene, const std::string& group);

/// What suits a group of which nothing is asked: `diffuse` for that of an environment that shines alone in it
/// and casts no sharp shadows, `realtime` for all others.
LightMode usual_light_mode(const Scene& scene, const std::string& group);

/// Whether a tenth of the light or more comes from less than 0.02 sr (the sun in a photograph of the sky, a
/// lamp): such light has shadows whose edges are seen.
bool casts_sharp_shadows(const Environment& environment);

/// The mode of each light group, asked for or usual, in the order of light_groups().
std::vector<LightMode> light_modes(const Scene& scene);

/// Asks for a mode, in place of what was asked before. Throws Error that lists the groups where the scene has
/// none of that name.
void set_light_mode(Scene& scene, const std::string& group, LightMode mode);

/// Forgets what is asked for groups that the scene does not have any more; returns their names.
std::vector<std::string> drop_unused_light_modes(Scene& scene);

}  // namespace ssphh::scene
