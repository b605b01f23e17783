#pragma once
/// The project's vector vocabulary: GLM's float types, and the few constants that everybody needs.
/// World space is right-handed, y up, in metres (docs/conventions.md).

#include <glm/glm.hpp>
#include <glm/gtc/quaternion.hpp>

#include <ssphh/core/vectors.h>

namespace ssphh {

inline constexpr float pi = 3.14159265358979323846f;
inline constexpr double pi_d = 3.14159265358979323846;

/// Rec.709 luminance of a linear colour.
inline float luminance(const vec3& rgb) {
  return 0.2126f * rgb.x + 0.7152f * rgb.y + 0.0722f * rgb.z;
}

inline float max_component(const vec3& v) {
  return glm::max(v.x, glm::max(v.y, v.z));
}

/// Whether all three components are neither infinite nor NaN.
inline bool is_finite(const vec3& v) {
  return std::isfinite(v.x) && std::isfinite(v.y) && std::isfinite(v.z);
}

/// Orthonormal basis around a unit normal (Duff et al., Building an Orthonormal Basis, Revisited, JCGT 2017).
/// The local z axis is the normal.
struct Frame {
  vec3 x, y, z;

  static Frame around(const vec3& n) {
    const float sign = std::copysign(1.0f, n.z);
    const float a = -1.0f / (sign + n.z);
    const float b = n.x * n.y * a;
    return {{1.0f + sign * n.x * n.x * a, sign * b, -sign * n.x}, {b, sign + n.y * n.y * a, -n.y}, n};
  }
  vec3 to_local(const vec3& v) const { return {glm::dot(v, x), glm::dot(v, y), glm::dot(v, z)}; }
  vec3 to_world(const vec3& v) const { return v.x * x + v.y * y + v.z * z; }
};

}  // namespace ssphh
