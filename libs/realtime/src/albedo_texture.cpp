#include "albedo_texture.h"

#include <vector>

#include <ssphh/shading/bsdf.h>

namespace ssphh::realtime {
namespace {

constexpr int table_size = shading::albedo_table_size;  // so that both interpolate the same numbers

/// A and B follow from two materials, for E is linear in f0 and f90: the second has the least f0 with f90
/// = 1.
vec2 albedo_entry(float mu, float roughness) {
  constexpr float low = 0.02f;
  shading::BsdfParams params;
  params.diffuse = vec3(0);
  params.specular_roughness = roughness;
  params.f0 = vec3(1);
  const float whole = shading::directional_albedo(params, mu).x;
  params.f0 = vec3(low);
  const float little = shading::directional_albedo(params, mu).x;
  const float a = (whole - little) / (1 - low);
  return {a, whole - a};
}

}  // namespace

gl::Texture make_albedo_table() {
  gl::Texture texture(gl::Format::rgba32f, table_size, table_size, 2);
  const float step = 1.0f / (table_size - 1);
  for (int layer = 0; layer < 2; ++layer) {
    std::vector<vec4> texels;
    for (int r = 0; r < table_size; ++r) {
      const float magnitude = static_cast<float>(r) * step;
      // A roughness of exactly 0 has no sign
      const float roughness = layer == 1 ? -std::max(magnitude, 1e-6f) : magnitude;
      std::vector<vec2> row;
      for (int m = 0; m < table_size; ++m)
        row.push_back(albedo_entry(static_cast<float>(m) * step, roughness));
      // 2 ∫ E μ dμ of the piecewise linear E
      vec2 mean(0);
      for (int m = 0; m + 1 < table_size; ++m) {
        const auto i = static_cast<std::size_t>(m);
        const float mu = static_cast<float>(m) * step;
        mean += 2 * step * (row[i] * (mu + step / 2) + (row[i + 1] - row[i]) * (mu / 2 + step / 3));
      }
      for (const vec2& entry : row) texels.emplace_back(entry, mean);
    }
    texture.upload(std::as_bytes(std::span(texels)), layer);
  }
  texture.set_filter(true);
  return texture;
}

}  // namespace ssphh::realtime
