#pragma once

#include <array>

#include <ssphh/gi/lookup.h>

namespace ssphh::gi {

/// What both lookups need of a set, laid out for one call per pixel sample.
class ProbeTable {
 public:
  ProbeTable(const ProbeSet& set, const LookupParams& params);

  const std::vector<vec3>& positions() const { return positions_; }
  const vec3& position(int probe) const { return positions_[static_cast<std::size_t>(probe)]; }
  /// L(ω), not negative. `basis` holds Y_k(ω), perhaps scaled by band.
  vec3 radiance(int probe, const float* basis) const {
    return dot(radiance_, probe, basis, radiance_degree_);
  }
  /// E(n), not negative.
  vec3 irradiance(int probe, const float* basis) const {
    return dot(irradiance_, probe, basis, irradiance_degree_);
  }

  /// Y_k(n) for irradiance(), Y_k(ω) for radiance(), and the same for a glossy lobe.
  using Basis = std::array<float, sh::max_coefficient_count>;
  void irradiance_basis(const vec3& n, Basis& basis) const;
  void radiance_basis(const vec3& direction, Basis& basis) const;
  void glossy_basis(const vec3& direction, float roughness, Basis& basis) const;

 private:
  static vec3 dot(const std::vector<vec3>& functions, int probe, const float* basis, int degree);

  std::vector<vec3> positions_;
  std::vector<vec3> radiance_, irradiance_;  ///< coefficients, probe after probe
  int radiance_degree_, irradiance_degree_;
};

}  // namespace ssphh::gi
