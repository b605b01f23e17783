#include "texel_sampler.h"

#include <algorithm>
#include <cmath>

#include <ssphh/core/sphere.h>

namespace ssphh::trace {

TexelSampler::TexelSampler(int face, int x, int y, int size)
    : face_(face),
      x0_(2.0 * x / size - 1),
      x1_(2.0 * (x + 1) / size - 1),
      y0_(2.0 * y / size - 1),
      y1_(2.0 * (y + 1) / size - 1) {
  // Normals of the planes through the rectangle's edges, and the angles between them.
  using dvec3 = glm::dvec3;
  const dvec3 v00(x0_, y0_, -1), v10(x1_, y0_, -1), v01(x0_, y1_, -1), v11(x1_, y1_, -1);
  const auto plane = [](const dvec3& a, const dvec3& b) { return glm::normalize(glm::cross(a, b)); };
  const dvec3 n0 = plane(v00, v10), n1 = plane(v10, v11), n2 = plane(v11, v01), n3 = plane(v01, v00);
  const auto angle = [](const dvec3& a, const dvec3& b) {
    return std::acos(std::clamp(-glm::dot(a, b), -1.0, 1.0));
  };
  b0_ = n0.z, b1_ = n2.z;
  k_ = 2 * pi_d - angle(n2, n3) - angle(n3, n0);
  solid_angle_ = angle(n0, n1) + angle(n1, n2) - k_;
}

vec3 TexelSampler::direction(const vec2& u) const {
  // Find the column whose part of the solid angle is u.x.
  const double azimuth = static_cast<double>(u.x) * solid_angle_ + k_;
  const double f = (std::cos(azimuth) * b0_ - b1_) / std::sin(azimuth);
  const double c = std::clamp(std::copysign(1 / std::sqrt(f * f + b0_ * b0_), f), -1.0, 1.0);
  const double x = std::clamp(c / std::sqrt(1 - c * c), x0_, x1_);
  // The height in it is uniform in the projected height.
  const double d = std::sqrt(x * x + 1);
  const double h0 = y0_ / std::sqrt(d * d + y0_ * y0_), h1 = y1_ / std::sqrt(d * d + y1_ * y1_);
  const double h = h0 + static_cast<double>(u.y) * (h1 - h0);
  const double y = std::clamp(h * d / std::sqrt(std::max(1 - h * h, 1e-300)), y0_, y1_);
  return cube_direction({face_, static_cast<float>(0.5 * (x + 1)), static_cast<float>(0.5 * (y + 1))});
}

}  // namespace ssphh::trace
