#pragma once
/// Where patches gather what others reflect: neighbours that face the same way share a place.

#include <span>
#include <vector>

#include "patches.h"

namespace ssphh::methods::vct {

struct GatherPoints {
  std::vector<rays::SurfacePoint> points;
  std::vector<std::uint32_t> of_still, of_moving;  ///< index of each patch's point
};

/// One point for all patches of the same main direction in eight voxels that form a cube: indirect light is
/// smooth, and a quarter of the cones does. It lies at their mean place and has their mean normal, weighted
/// by covered area.
GatherPoints gather_points(std::span<const Patch> still, std::span<const Patch> moving);

/// Side of the axis along which the normal is longest.
int main_side(const vec3& normal);

}  // namespace ssphh::methods::vct
