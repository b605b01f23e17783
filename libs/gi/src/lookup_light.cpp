#include "probe_table.h"

namespace ssphh::gi {

struct LightLookup::Data {
  ProbeTable table;

  /// The nearest probe that the point sees and that stands above its horizon; else the nearest, with `lights`
  /// false.
  struct Chosen {
    int probe;
    vec3 direction;  ///< ω, from x to the probe
    float cosine;    ///< N·ω
    bool lights;
  };
  Chosen choose(const vec3& x, const vec3& n) const {
    ProbeTable::NearList near;
    const int count = table.nearest(x, ProbeTable::max_near, near);
    for (int i = 0; i < count; ++i) {
      const ProbeTable::Near& candidate = near[static_cast<std::size_t>(i)];
      if (!(candidate.distance2 > 0)) continue;
      const vec3 direction = (table.position(candidate.probe) - x) / std::sqrt(candidate.distance2);
      const float cosine = glm::dot(n, direction);
      if (cosine > 0 && table.sees(candidate, x, n)) return {candidate.probe, direction, cosine, true};
    }
    return {near[0].probe, n, 1, false};
  }
};

LightLookup::LightLookup(const ProbeSet& set, const scene::RadianceSource& source, const LookupParams& params)
    : data_(new Data{ProbeTable(set, source, params)}) {}
LightLookup::~LightLookup() = default;

vec3 LightLookup::irradiance(const vec3& x, const vec3& n) const {
  const Data::Chosen chosen = data_->choose(x, n);
  ProbeTable::Basis basis;
  if (!chosen.lights) {
    data_->table.irradiance_basis(n, basis);
    return data_->table.irradiance(chosen.probe, basis.data());
  }
  data_->table.radiance_basis(chosen.direction, basis);
  return data_->table.radiance(chosen.probe, basis.data()) / std::max(chosen.cosine, smallest_cosine);
}

vec3 LightLookup::glossy(const vec3& x, const vec3& n, const vec3& r, float roughness) const {
  ProbeTable::Basis basis;
  data_->table.glossy_basis(r, roughness, basis);
  return data_->table.radiance(data_->choose(x, n).probe, basis.data());
}

}  // namespace ssphh::gi
