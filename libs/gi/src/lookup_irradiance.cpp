#include <algorithm>

#include <ssphh/gi/fitted_weights.h>

#include "probe_table.h"

namespace ssphh::gi {

struct IrradianceLookup::Data {
  ProbeTable table;
  std::unique_ptr<LookupWeights> weights;

  /// Σ_j v_j value(j), not negative.
  template <class Value>
  vec3 blend(const vec3& x, const vec3& n, const Value& value) const {
    const ProbeWeights at = weights->at(x, n);
    vec3 sum(0);
    for (int i = 0; i < at.count; ++i) {
      const ProbeWeight& probe = at.entries[static_cast<std::size_t>(i)];
      sum += probe.weight * value(probe.probe);
    }
    return glm::max(sum, vec3(0));
  }
};

IrradianceLookup::IrradianceLookup(const ProbeSet& set, const scene::RadianceSource& source,
                                   const LookupParams& params)
    : data_(new Data{ProbeTable(set, params), nullptr}) {
  data_->weights = make_weights(
      data_->table.positions(), [&source](const vec3& a, const vec3& b) { return source.visible(a, b); },
      params.weights);
}
IrradianceLookup::IrradianceLookup(const ProbeSet& set, std::unique_ptr<LookupWeights> weights,
                                   const LookupParams& params)
    : data_(new Data{ProbeTable(set, params), std::move(weights)}) {}
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

std::unique_ptr<scene::IndirectLight> make_irradiance_lookup(const ProbeSet& set,
                                                             const scene::RadianceSource& source,
                                                             const std::string& weights,
                                                             LookupParams params) {
  if (weights == "fitted" || (weights.empty() && set.fitted)) {
    if (!set.fitted) throw Error("weights fitted", "the probes have none");
    return std::make_unique<FittedLookup>(set, *set.fitted, source, params);
  }
  if (!weights.empty()) {
    const auto method = parse_weight_method(weights);
    if (!method) throw Error("weights " + weights, "is none of distance, trilinear, mls, fitted");
    params.weights.method = *method;
  }
  return std::make_unique<IrradianceLookup>(set, source, params);
}

std::unique_ptr<scene::IndirectLight> make_lookup(LookupMethod method, const ProbeSet& set,
                                                  const scene::RadianceSource& source,
                                                  const LookupParams& params) {
  if (method == LookupMethod::light) return std::make_unique<LightLookup>(set, source, params);
  return std::make_unique<IrradianceLookup>(set, source, params);
}

}  // namespace ssphh::gi
