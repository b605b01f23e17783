#pragma once
/// The materials that every reflection test goes through, and integrals over the hemisphere.

#include <cmath>
#include <string>
#include <vector>

#include <ssphh/shading/bsdf.h>

namespace ssphh::shading::test {

struct NamedBsdf {
  std::string name;
  BsdfParams params;
};

/// Every model alone and combined, at roughnesses that midpoint quadrature can resolve.
inline std::vector<NamedBsdf> bsdf_models() {
  const vec3 white(1), dielectric(0.04f), none(0);
  return {
      {"Lambert", {white, none, 0, 1}},
      {"Oren–Nayar 0.3", {white, none, -0.3f, 1}},
      {"Oren–Nayar 1", {white, none, -1, 1}},
      {"Disney diffuse 0.3", {white, none, 0.3f, 1}},
      {"Disney diffuse 1", {white, none, 1, 1}},
      {"GGX 0.35", {none, white, 0, 0.35f}},
      {"GGX 0.6", {none, vec3(0.9f, 0.5f, 0.1f), 0, 0.6f}},
      {"GGX 1", {none, white, 0, 1}},
      {"Blinn–Phong 0.35", {none, white, 0, -0.35f}},
      {"Blinn–Phong 0.6", {none, vec3(0.9f, 0.5f, 0.1f), 0, -0.6f}},
      {"Blinn–Phong 1", {none, white, 0, -1}},
      {"Lambert under GGX 0.5", {vec3(0.8f, 0.4f, 0.2f), dielectric, 0, 0.5f}},
      {"Oren–Nayar 0.5 under Blinn–Phong 0.5", {vec3(0.9f), dielectric, -0.5f, -0.5f}},
      {"Disney diffuse 0.7 under GGX 0.9", {white, dielectric, 0.7f, 0.9f}},
      {"half metal", {vec3(0.4f), vec3(0.5f), 0, 0.4f}},
  };
}

inline vec3 direction(float cos_theta, float azimuth = 0) {
  const float r = std::sqrt(1 - cos_theta * cos_theta);
  return {r * std::cos(azimuth), r * std::sin(azimuth), cos_theta};
}

/// ∫ f(ω) dω over z > 0 by midpoints in (cos θ, φ).
template <class F>
auto integrate_hemisphere(const F& f, int polar = 400, int azimuth = 400) {
  using Value = decltype(f(vec3()));
  Value sum(0);
  for (int i = 0; i < polar; ++i) {
    Value row(0);
    for (int j = 0; j < azimuth; ++j) {
      row += f(direction((static_cast<float>(i) + 0.5f) / static_cast<float>(polar),
                         2 * pi * (static_cast<float>(j) + 0.5f) / static_cast<float>(azimuth)));
    }
    sum += row;
  }
  return sum * (2 * pi / static_cast<float>(polar * azimuth));
}

}  // namespace ssphh::shading::test
