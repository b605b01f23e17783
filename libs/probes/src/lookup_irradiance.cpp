#include <algorithm>

#include <ssphh/core/require_named.h>

#include "packed_probes.h"

namespace ssphh::probes {
namespace {

/// The same sum of those above 0 alone: what a fit takes away from one probe's even light is another's narrow
/// lobe, and leaves black.
ProbeWeights without_negative(ProbeWeights weights) {
  float sum = 0, positive = 0;
  for (ProbeWeight& entry : weights.used()) {
    sum += entry.weight;
    entry.weight = std::max(entry.weight, 0.0f);
    positive += entry.weight;
  }
  for (ProbeWeight& entry : weights.used()) entry.weight *= positive > sum ? sum / positive : 1;
  return weights;
}

}  // namespace

struct IrradianceLookup::Data {
  PackedProbes probes;
  std::shared_ptr<const LookupWeights> weights;
  std::shared_ptr<const SurfaceInterpolation> places;  ///< of the records; none: weights alone
  std::vector<RecordLight> light;                      ///< of each place
  std::vector<std::string> direct_groups, mirrored_groups;
  std::vector<std::pair<scene::LightMode, bool>> kinds;  ///< of the set's groups, by which they were named
  std::vector<sh::RadianceSh> more;                      ///< scratch

  /// Σ_j v_j value(j), not negative.
  template <class Value>
  vec3 blend(const ProbeWeights& found, const Value& value) const {
    vec3 sum(0);
    for (const ProbeWeight& entry : found.used()) {
      require(entry.probe >= 0 && entry.probe < probes.count(), "lookup weights",
              "they name a probe that is not there");
      sum += entry.weight * value(entry.probe);
    }
    return glm::max(sum, vec3(0));
  }

  void take(const SurfaceRecords& records, std::shared_ptr<const SurfaceInterpolation> points) {
    check(records, *points);
    places = std::move(points);
    light = records.light;
  }
  static void check(const SurfaceRecords& records, const SurfaceInterpolation& points) {
    require(records.light.size() == points.count(), "probe lookup",
            "the records' groups were not merged: call merge_groups");
  }

  /// Of probes, perhaps beside records.
  Data(const ProbeSet& set, const LookupParams& params, bool records)
      : probes(set, params, records ? light_beside_records(set) : std::vector<sh::RadianceSh>()) {
    name_groups(set, records);
  }

  void swap_light(const ProbeSet& set) {
    if (places) {
      require(set.surface && set.surface->points.size() == places->count(), "probe lookup",
              "the new light has other records");
      check(*set.surface, *places);
    }
    more.clear();
    if (places) light_beside_records(set, more);
    probes.swap_light(set, more);
    if (places) light = set.surface->light;
    name_groups(set, places != nullptr);
  }

  /// Takes no memory while the groups' modes stay.
  void name_groups(const ProbeSet& set, bool records) {
    const auto kind = [&](std::size_t g) {
      return std::pair(set.light_groups[g].mode, records && set.surface->keeps_direct(g));
    };
    bool same = kinds.size() == set.light_groups.size();
    for (std::size_t g = 0; same && g < kinds.size(); ++g) same = kinds[g] == kind(g);
    if (same) return;
    kinds.clear();
    for (std::size_t g = 0; g < set.light_groups.size(); ++g) kinds.push_back(kind(g));
    direct_groups = baked_groups(set);
    mirrored_groups = records ? probes::mirrored_groups(set) : std::vector<std::string>();
    direct_groups.insert(direct_groups.end(), mirrored_groups.begin(), mirrored_groups.end());
  }
};

bool has_records(const ProbeSet& set, const LookupParams& params) {
  const ProbeLayer layer = params.layer.value_or(set.hierarchy ? ProbeLayer::sum : ProbeLayer::self);
  return set.surface && !set.surface->points.empty() && layer == ProbeLayer::self &&
         params.light == ProbeLight::reflected;
}

WeightMethod chosen_weights(const ProbeSet& set, const LookupParams& params) {
  return params.weights.chosen(set.fitted.has_value(), has_records(set, params));
}

IrradianceLookup::IrradianceLookup(const ProbeSet& set, const rays::RadianceSource& source,
                                   const LookupParams& params)
    : data_(std::make_unique<Data>(set, params, chosen_weights(set, params) == WeightMethod::surface)) {
  const auto sees = [&source](const vec3& a, const vec3& b) { return source.visible(a, b); };
  data_->weights =
      make_weights(data_->probes.positions(), sees, params.weights, set.fitted ? &*set.fitted : nullptr);
  if (chosen_weights(set, params) != WeightMethod::surface) return;
  if (!has_records(set, params))
    throw Error("probe lookup", "there are no surface records of that light",
                "bake some, leave out the hierarchy, or choose other weights");
  const auto joined = [&source](const vec3& a, const vec3& b) { return source.joined(a, b); };
  data_->take(*set.surface, std::make_shared<const SurfaceInterpolation>(set.surface->points, joined));
}
IrradianceLookup::IrradianceLookup(const ProbeSet& set, std::shared_ptr<const LookupWeights> weights,
                                   const LookupParams& params,
                                   std::shared_ptr<const SurfaceInterpolation> places)
    : data_(std::make_unique<Data>(set, params, places != nullptr)) {
  data_->weights = std::move(weights);
  require(data_->weights != nullptr, "probe lookup", "there are no weights");
  if (!places) return;
  require(has_records(set, params), "probe lookup", "there are no surface records of that light");
  data_->take(*set.surface, std::move(places));
}
IrradianceLookup::~IrradianceLookup() = default;
IrradianceLookup::IrradianceLookup(IrradianceLookup&&) noexcept = default;
IrradianceLookup& IrradianceLookup::operator=(IrradianceLookup&&) noexcept = default;
IrradianceLookup::IrradianceLookup(const IrradianceLookup& other)
    : data_(std::make_unique<Data>(*other.data_)) {}

void IrradianceLookup::swap_light(const ProbeSet& set) {
  data_->swap_light(set);
}

vec3 IrradianceLookup::irradiance(const rays::SurfacePoint& at) const {
  if (const std::optional<vec3> found = recorded_irradiance(at)) return *found;
  vec3 beside;
  if (data_->places && data_->places->irradiance_beside(at, data_->light, beside)) return beside;
  return irradiance(at, data_->weights->at(at));
}

std::optional<vec3> IrradianceLookup::recorded_irradiance(const rays::SurfacePoint& at) const {
  vec3 found;
  if (!data_->places || !data_->places->irradiance(at, data_->light, found)) return std::nullopt;
  return found;
}

vec3 IrradianceLookup::irradiance(const rays::SurfacePoint& at, const ProbeWeights& weights) const {
  PackedProbes::Basis basis;
  data_->probes.irradiance_basis(at.normal, basis);
  return data_->blend(weights,
                      [&](int probe) { return data_->probes.irradiance(probe, basis.data(), at.moves); });
}

std::vector<std::string> IrradianceLookup::direct_groups() const {
  return data_->direct_groups;
}

std::vector<std::string> IrradianceLookup::mirrored_groups() const {
  return data_->mirrored_groups;
}

vec3 IrradianceLookup::glossy(const rays::SurfacePoint& at, const vec3& r, float roughness) const {
  PackedProbes::Basis basis;
  data_->probes.glossy_basis(r, roughness, basis);
  return data_->blend(without_negative(data_->weights->at(at)),
                      [&](int probe) { return data_->probes.radiance(probe, basis.data()); });
}

LookupParams lookup_params(const LookupSpec& spec, const ProbeSet& set) {
  LookupParams params;
  params.layer = set.hierarchy ? spec.layer : ProbeLayer::self;
  params.weights.method = spec.weights;
  return params;
}

std::unique_ptr<rays::IndirectLight> make_lookup(const LookupSpec& spec, const ProbeSet& set,
                                                 const rays::RadianceSource& source) {
  return make_lookup(spec.method, set, source, lookup_params(spec, set));
}

std::unique_ptr<rays::IndirectLight> make_lookup(LookupMethod method, const ProbeSet& set,
                                                 const rays::RadianceSource& source,
                                                 const LookupParams& params) {
  require_named("lookup method", method);
  if (method == LookupMethod::light) return std::make_unique<LightLookup>(set, source, params);
  return std::make_unique<IrradianceLookup>(set, source, params);
}

}  // namespace ssphh::probes
