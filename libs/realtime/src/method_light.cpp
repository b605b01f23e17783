#include "method_light.h"

#include <ssphh/core/error.h>

#include "virtual_light_maps.h"
#include "voxel_light.h"

namespace ssphh::realtime {

std::unique_ptr<MethodLight> make_method_light(const methods::LightData& data, const RendererParams& params,
                                               const scene::Bounds& bounds, FrameCounters& counters) {
  if (const auto* cones = std::get_if<methods::VoxelCones>(&data))
    return std::make_unique<VoxelLight>(*cones, params.voxel_bytes, counters);
  if (const auto* lights = std::get_if<methods::VirtualLights>(&data))
    return std::make_unique<VirtualLightMaps>(*lights, params.virtual_light_map_bytes, bounds, counters);
  throw Error("method", "only the CPU can look its light up", "take --backend cpu, or method vct or vpl");
}

}  // namespace ssphh::realtime
