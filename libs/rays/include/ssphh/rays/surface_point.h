#pragma once
/// Places on surfaces and the irradiance there: what data that holds them needs to know of rays.

#include <glm/mat4x3.hpp>

#include <ssphh/core/vectors.h>

namespace ssphh::rays {

/// A point on a surface with its geometric unit normal, on the side that is lit or seen.
struct SurfacePoint {
  vec3 position{0};
  vec3 normal{0, 1, 0};
  bool moves = false;  ///< on a body that an animation moves
};

/// RGB irradiance [W/m²] at a surface point by the unit normal n near the point's own: E(n) = light · (n, 1).
/// The part that is linear in n lies in the tangent plane; the last column is E of the point's own normal.
using IrradianceByNormal = glm::mat4x3;

}  // namespace ssphh::rays
