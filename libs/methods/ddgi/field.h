#pragma once
/// Irradiance around the probes of a grid, and how far they see: what a lookup of the ddgi method reads.

#include <cstdint>
#include <span>
#include <vector>

#include <ssphh/rays/radiance_source.h>

#include "grid.h"

namespace ssphh::methods::ddgi {

struct DdgiField {
  static constexpr int irradiance_size = 8, moment_size = 16;  ///< texels along an edge of a probe's maps
  static constexpr int irradiance_texels = irradiance_size * irradiance_size;
  static constexpr int moment_texels = moment_size * moment_size;

  explicit DdgiField(const ProbeGrid& grid);

  /// Indirect irradiance [W/m²] for the normal `facing`, at a surface that faces `normal` and is seen from
  /// the unit direction `wo`. Zero where none of the eight probes around is active.
  vec3 irradiance(const vec3& position, const vec3& normal, const vec3& wo, const vec3& facing) const;

  std::span<vec3> irradiance_of(int probe) {
    return {&irradiance_texel[static_cast<std::size_t>(probe) * irradiance_texels], irradiance_texels};
  }
  std::span<vec2> moments_of(int probe) {
    return {&moment_texel[static_cast<std::size_t>(probe) * moment_texels], moment_texels};
  }
  std::size_t bytes() const;

  ProbeGrid grid;
  std::vector<vec3> position;          ///< of the probes, relocated [m]
  std::vector<std::uint8_t> active;    ///< 0: stands inside of a body
  std::vector<vec3> irradiance_texel;  ///< octahedral, 8×8 per probe [W/m²]
  std::vector<vec2> moment_texel;      ///< mean distance [m] and its square, 16×16 per probe
  float bias = 0.3f;       ///< shift of looked-up points off their surface, in ¾ of the least spacing
  bool visibility = true;  ///< weigh probes by what they see

 private:
  float seen(int probe, const vec3& from_probe, float distance) const;
};

/// The field as the renderer asks for it.
class DdgiLight final : public rays::IndirectLight {
 public:
  explicit DdgiLight(const DdgiField& field) : field_(field) {}
  vec3 irradiance(const rays::SurfacePoint& at) const override {
    return field_.irradiance(at.position, at.normal, at.normal, at.normal);
  }
  /// Blurred as a diffuse surface that faces r would, whatever the roughness.
  vec3 glossy(const rays::SurfacePoint& at, const vec3& r, float) const override {
    return field_.irradiance(at.position, at.normal, at.normal, r) / pi;
  }

 private:
  const DdgiField& field_;
};

}  // namespace ssphh::methods::ddgi
