#pragma once
/// Directional albedo of the specular lobes, tabulated once per process. With Schlick's Fresnel it is linear
/// in f0 and f90: E(μ) = f0 A(μ, roughness) + f90 B(μ, roughness) (Karis, Real Shading in Unreal Engine 4,
/// 2013).

#include <array>

#include <ssphh/shading/bsdf.h>

namespace ssphh::shading {

class AlbedoTable {
 public:
  static constexpr int size = albedo_table_size;

  explicit AlbedoTable(bool phong);

  /// (A, B) for view cosine `mu` and perceptual roughness, both 0..1.
  vec2 directional(float mu, float roughness) const {
    const Place r = place(roughness), m = place(mu);
    const auto row = [&](int i) {
      const vec2* v = &values_[i][m.index];
      return v[0] + m.fraction * (v[1] - v[0]);
    };
    const vec2 a = row(r.index), b = row(r.index + 1);
    return a + r.fraction * (b - a);
  }
  /// Cosine-weighted mean over the hemisphere, exactly that of the interpolated `directional`.
  vec2 mean(float roughness) const {
    const Place r = place(roughness);
    const vec2* v = &means_[r.index];
    return v[0] + r.fraction * (v[1] - v[0]);
  }

 private:
  struct Place {
    int index;
    float fraction;
  };
  static Place place(float x) {
    const float s = glm::clamp(x, 0.0f, 1.0f) * static_cast<float>(size - 1);
    const int i = glm::min(static_cast<int>(s), size - 2);
    return {i, s - static_cast<float>(i)};
  }

  std::array<std::array<vec2, size>, size> values_;  ///< [roughness][μ]
  std::array<vec2, size> means_;
};

/// The table of GGX or of Blinn–Phong, made at first use.
const AlbedoTable& albedo_table(bool phong);

}  // namespace ssphh::shading
