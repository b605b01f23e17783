#pragma once

#include <ssphh/realtime/renderer.h>

namespace ssphh::test {

/// Sets what the renderer was set to last, changed by `change`.
template <class Change>
void change_lighting(realtime::Renderer& renderer, const Change& change) {
  scene::LightingState state = renderer.lighting();
  change(state);
  renderer.set(state);
}

}  // namespace ssphh::test
