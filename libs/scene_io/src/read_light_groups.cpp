#include "read_light_groups.h"

#include <algorithm>

#include <fmt/format.h>
#include <fmt/ranges.h>

#include <ssphh/scene/query.h>

namespace ssphh::scene_io {

void read_light_modes(scene::Scene& scene, const json::Cursor& modes) {
  for (const auto& [group, value] : modes.entries()) {
    const json::Cursor at = modes[group.c_str()];
    const auto mode = at.named<scene::LightMode>();
    try {
      scene::set_light_mode(scene, group, mode);
    } catch (const Error& e) {
      at.fail(e.problem(), e.hint());
    }
  }
}

void read_dark_groups(scene::Scene& scene, const json::Cursor& groups) {
  const std::vector<std::string> all = scene::light_groups(scene);
  // A surface that emits nothing was written dark: it is of a group because of this list alone.
  const auto stands = [&](const std::string& group) {
    return std::ranges::find(all, group) != all.end() ||
           std::ranges::any_of(scene.instances, [&](const scene::Instance& instance) {
             return scene::light_group(scene, instance) == group;
           });
  };
  for (const json::Cursor& name : json::elements(groups)) {
    if (!stands(name.text()))
      name.fail("the scene has no light group of that name",
                fmt::format("its groups: {}", fmt::join(all, ", ")));
    if (!scene::is_dark(scene, name.text())) scene.dark_groups.push_back(name.text());
  }
}

}  // namespace ssphh::scene_io
