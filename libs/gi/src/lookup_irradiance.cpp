#include <algorithm>
#include <cmath>

#include "probe_table.h"

namespace ssphh::gi {

struct IrradianceLookup::Data {
  ProbeTable table;

  /// Inverse squared distance, relative to the nearest so that nothing overflows, times a wrapped cosine
  /// (Majercik et al., Dynamic Diffuse Global Illumination with Ray-Traced Irradiance Fields, JCGT 2019): a
  /// probe behind the surface sees the light of other surfaces. Measured in docs/methods/ssphh.md.
  float weight_of(const ProbeTable::Near& probe, float nearest2, const vec3& x, const vec3& n) const {
    if (!(probe.distance2 > 0)) return 1;
    const float cosine = glm::dot(n, table.position(probe.probe) - x) / std::sqrt(probe.distance2);
    const float wrapped = 0.5f * (1 + cosine);
    constexpr float floor = 0.05f;
    return nearest2 / probe.distance2 * (wrapped * wrapped + floor);
  }

  /// Weighted mean of value(probe) over the probes that see the point, or over the nearest ones if none does.
  template <class Value>
  vec3 blend(const vec3& x, const vec3& n, const Value& value) const {
    // Look farther than the blend when near probes are hidden.
    ProbeTable::NearList near;
    const int count = table.nearest(x, ProbeTable::max_near, near);
    int visible = 0;
    for (int i = 0; i < count && visible < table.blend_count(); ++i) {
      const ProbeTable::Near candidate = near[static_cast<std::size_t>(i)];
      if (!table.sees(candidate, x, n)) continue;
      // Seen ones move to the front; those they replace were all hidden.
      std::swap(near[static_cast<std::size_t>(visible++)], near[static_cast<std::size_t>(i)]);
    }
    if (visible == 0) visible = std::min(count, table.blend_count());

    float nearest2 = near[0].distance2;
    for (int i = 1; i < visible; ++i)
      nearest2 = std::min(nearest2, near[static_cast<std::size_t>(i)].distance2);
    vec3 sum(0);
    float weight_sum = 0;
    for (int i = 0; i < visible; ++i) {
      const ProbeTable::Near& probe = near[static_cast<std::size_t>(i)];
      const float weight = weight_of(probe, nearest2, x, n);
      if (weight == 0) continue;
      sum += weight * value(probe.probe);
      weight_sum += weight;
    }
    return sum / weight_sum;
  }
};

IrradianceLookup::IrradianceLookup(const ProbeSet& set, const scene::RadianceSource& source,
                                   const LookupParams& params)
    : data_(new Data{ProbeTable(set, source, params)}) {}
IrradianceLookup::~IrradianceLookup() = default;

vec3 IrradianceLookup::irradiance(const vec3& x, const vec3& n) const {
  ProbeTable::Basis basis;
  data_->table.irradiance_basis(n, basis);
  return data_->blend(x, n, [&](int probe) { return data_->table.irradiance(probe, basis.data()); });
}

vec3 IrradianceLookup::glossy(const vec3& x, const vec3& n, const vec3& r, float roughness) const {
  ProbeTable::Basis basis;
  data_->table.glossy_basis(r, roughness, basis);
  return data_->blend(x, n, [&](int probe) { return data_->table.radiance(probe, basis.data()); });
}

std::unique_ptr<scene::IndirectLight> make_lookup(LookupMethod method, const ProbeSet& set,
                                                  const scene::RadianceSource& source,
                                                  const LookupParams& params) {
  if (method == LookupMethod::light) return std::make_unique<LightLookup>(set, source, params);
  return std::make_unique<IrradianceLookup>(set, source, params);
}

}  // namespace ssphh::gi
