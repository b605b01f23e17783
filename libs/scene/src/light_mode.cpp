#include <algorithm>

#include <fmt/format.h>
#include <fmt/ranges.h>

#include <ssphh/core/error.h>
#include <ssphh/scene/light_mode.h>
#include <ssphh/scene/query.h>

namespace ssphh::scene {

std::optional<LightMode> asked_light_mode(const Scene& scene, const std::string& group) {
  const auto found = std::ranges::find(scene.light_modes, group, &GroupMode::group);
  if (found == scene.light_modes.end()) return std::nullopt;
  return found->mode;
}

std::vector<LightMode> light_modes(const Scene& scene) {
  std::vector<LightMode> modes;
  for (const std::string& group : light_groups(scene))
    modes.push_back(asked_light_mode(scene, group).value_or(LightMode::realtime));
  return modes;
}

void set_light_mode(Scene& scene, const std::string& group, LightMode mode) {
  const std::vector<std::string> groups = light_groups(scene);
  if (std::ranges::find(groups, group) == groups.end())
    throw Error(fmt::format("light mode of \"{}\"", group), "the scene has no light group of that name",
                groups.empty() ? "it has no lights" : fmt::format("its groups: {}", fmt::join(groups, ", ")));
  const auto found = std::ranges::find(scene.light_modes, group, &GroupMode::group);
  if (found == scene.light_modes.end()) {
    scene.light_modes.push_back({group, mode});
  } else {
    found->mode = mode;
  }
}

std::vector<std::string> drop_unused_light_modes(Scene& scene) {
  const std::vector<std::string> groups = light_groups(scene);
  std::vector<std::string> dropped;
  std::erase_if(scene.light_modes, [&](const GroupMode& asked) {
    const bool unused = std::ranges::find(groups, asked.group) == groups.end();
    if (unused) dropped.push_back(asked.group);
    return unused;
  });
  return dropped;
}

}  // namespace ssphh::scene
