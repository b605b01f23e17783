#pragma once
/// What a method's light is made of, as plain data, for renderers that look it up by themselves: those that
/// cannot ask a rays::IndirectLight at every pixel, as OpenGL.

#include <memory>
#include <span>
#include <variant>

#include <ssphh/methods/vct/cone_light.h>
#include <ssphh/methods/vpl/virtual_lights.h>
#include <ssphh/probes/probe_set.h>

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

/// SPHLs, with records of surfaces or fitted weights where the method has any. Does not change with the
/// method.
struct ProbeLight {
  std::shared_ptr<const probes::ProbeSet> set;
};

/// monostate: only the method itself can look its light up.
using LightData = std::variant<std::monostate, VoxelCones, VirtualLights, ProbeLight>;

}  // namespace ssphh::methods
