#include "read_light_modes.h"

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

}  // namespace ssphh::scene_io
