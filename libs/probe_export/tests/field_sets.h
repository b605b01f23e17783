#pragma once
/// Probe sets whose light is known in closed form.

#include <ssphh/core/bytes.h>
#include <ssphh/probe_export/target.h>

#include "ray_source.h"

namespace ssphh::probe_export {

inline const test::RaySource open_space([](const vec3&, const vec3&) { return rays::RayHit{}; });

/// Coefficient k of the field, each of another colour, slope and size; the mean outweighs the rest, so that
/// irradiance is nowhere negative.
inline vec3 field(int k, const vec3& at, bool linear) {
  const auto n = static_cast<float>(k);
  const vec3 value = (k == 0 ? 10.0f : 0.5f) * vec3(1 + 0.1f * n, 0.8f - 0.05f * n, 1.2f - 0.2f * n);
  if (!linear) return value;
  return value * (1.0f + 0.3f * at.x - 0.2f * at.y + 0.1f * at.z + 0.02f * n * at.x);
}

/// Probes half a metre apart over the box from −1 to 1, lit by one lamp of scale 2.
inline probes::ProbeSet field_set(bool linear, int degree = 2) {
  probes::ProbeSet set;
  set.degree = degree;
  set.light_groups = {{"lamp", vec3(2)}};
  for (int i = 0; i < 125; ++i) {
    probes::Probe probe;
    probe.name = "p" + std::to_string(i);
    probe.position = 0.5f * vec3(i % 5, i / 5 % 5, i / 25) - 1.0f;
    probes::GroupLight& light = probe.groups.emplace_back();
    light.reflected = sh::RadianceSh(degree);
    for (int k = 0; k < 9; ++k) light.reflected[k] = 0.5f * field(k, probe.position, linear);
    set.probes.push_back(probe);
  }
  probes::merge_groups(set);
  return set;
}

/// E(n) of the field (docs/conventions.md).
inline vec3 field_irradiance(const vec3& at, const vec3& n, bool linear) {
  const float y[9] = {0.282095f,
                      0.488603f * n.y,
                      0.488603f * n.z,
                      0.488603f * n.x,
                      1.092548f * n.x * n.y,
                      1.092548f * n.y * n.z,
                      0.315392f * (3 * n.z * n.z - 1),
                      1.092548f * n.x * n.z,
                      0.546274f * (n.x * n.x - n.y * n.y)};
  vec3 sum(0);
  for (int k = 0; k < 9; ++k) {
    const float a = k == 0 ? pi : k < 4 ? 2 * pi / 3 : pi / 4;
    sum += a * y[k] * field(k, at, linear);
  }
  return sum;
}

/// Half float to float, by its definition.
inline float half(std::uint16_t bits) {
  const int exponent = bits >> 10 & 31, mantissa = bits & 1023;
  const float size = exponent == 0 ? std::ldexp(static_cast<float>(mantissa), -24)
                                   : std::ldexp(static_cast<float>(1024 + mantissa), exponent - 25);
  return bits & 0x8000 ? -size : size;
}

/// A 3-D texture of RGBA half floats with linear filtering, clamped at its border.
struct Texture3 {
  glm::ivec3 size;
  std::vector<std::uint16_t> values;

  vec4 texel(glm::ivec3 at) const {
    at = glm::clamp(at, glm::ivec3(0), size - 1);
    const auto i = 4 * (static_cast<std::size_t>(at.z * size.y + at.y) * static_cast<std::size_t>(size.x) +
                        static_cast<std::size_t>(at.x));
    return {half(values[i]), half(values[i + 1]), half(values[i + 2]), half(values[i + 3])};
  }
  vec4 sample(const vec3& uvw) const {
    const vec3 place = uvw * vec3(size) - 0.5f, low = glm::floor(place), t = place - low;
    vec4 sum(0);
    for (int k = 0; k < 8; ++k) {
      const glm::ivec3 step(k & 1, k >> 1 & 1, k >> 2);
      const vec3 share = glm::mix(1.0f - t, t, glm::bvec3(step));
      sum += share.x * share.y * share.z * texel(glm::ivec3(low) + step);
    }
    return sum;
  }
};

inline Texture3 texture(const glm::ivec3& size, std::span<const std::byte> bytes) {
  Texture3 result{size, std::vector<std::uint16_t>(bytes.size() / 2)};
  std::memcpy(result.values.data(), bytes.data(), bytes.size());
  return result;
}

inline std::string_view text_of(const ExportFile& file) {
  return {reinterpret_cast<const char*>(file.data.data()), file.data.size()};
}

}  // namespace ssphh::probe_export
