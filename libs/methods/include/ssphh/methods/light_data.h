#pragma once
/// What a method's light is made of, as plain data, for renderers that look it up by themselves: those that
/// cannot ask a rays::IndirectLight at every pixel, as OpenGL.

#include <span>
#include <variant>

#include <ssphh/methods/vct/cone_light.h>
#include <ssphh/methods/vpl/virtual_lights.h>

namespace ssphh::methods {

/// What vct::ConeLight reads. Points into the method.
struct VoxelCones {
  const vct::Pyramid* voxels = nullptr;
  vct::ConeParams cones;
};

/// All lights of method vpl, whatever its clusters. Points into the method.
struct VirtualLights {
  std::span<const vpl::Vpl> lights;
  vpl::VplParams params;
};

/// monostate: only the method itself can look its light up.
using LightData = std::variant<std::monostate, VoxelCones, VirtualLights>;

}  // namespace ssphh::methods
