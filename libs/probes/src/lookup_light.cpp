#include "packed_probes.h"
#include "probe_sight.h"

namespace ssphh::probes {

struct LightLookup::Data {
  PackedProbes probes;
  std::shared_ptr<const ProbeSight> sight;
  SeesProbe sees;
  std::vector<std::string> direct_groups;

  /// The nearest probe that the point sees and that stands above its horizon; else the nearest, with `lights`
  /// false.
  struct Chosen {
    int probe;
    vec3 direction;  ///< ω, from x to the probe
    bool lights;
  };
  Chosen choose(const rays::SurfacePoint& at) const {
    const vec3 &x = at.position, &n = at.normal;
    ProbeSight::NearList near;
    const int count = sight->nearest(x, near);
    for (int i = 0; i < count; ++i) {
      const geometry::Near& candidate = near[i];
      if (!(candidate.distance2 > 0)) continue;
      const vec3 direction = (probes.position(candidate.index) - x) / std::sqrt(candidate.distance2);
      if (glm::dot(n, direction) > 0 && sight->sees(candidate, at, sees))
        return {candidate.index, direction, true};
    }
    return {count > 0 ? near[0].index : 0, n, false};  // none is near a point that is no number
  }
};

LightLookup::LightLookup(const ProbeSet& set, const rays::RadianceSource& source,
                         const LookupParams& params) {
  PackedProbes packed(set, params);
  auto sight = std::make_shared<const ProbeSight>(packed.positions(), params.weights);
  const auto sees = [&source](const vec3& a, const vec3& b) { return source.visible(a, b); };
  data_ = std::unique_ptr<Data>(new Data{std::move(packed), std::move(sight), sees, baked_groups(set)});
}
LightLookup::~LightLookup() = default;
LightLookup::LightLookup(LightLookup&&) noexcept = default;
LightLookup& LightLookup::operator=(LightLookup&&) noexcept = default;
LightLookup::LightLookup(const LightLookup& other) : data_(std::make_unique<Data>(*other.data_)) {}

void LightLookup::swap_light(const ProbeSet& set) {
  Data& d = *data_;
  d.probes.swap_light(set);
  std::size_t baked = 0;
  bool same = true;
  for (const LightGroup& group : set.light_groups) {
    if (group.mode != scene::LightMode::baked) continue;
    same = same && baked < d.direct_groups.size() && d.direct_groups[baked] == group.name;
    ++baked;
  }
  if (!same || baked != d.direct_groups.size()) d.direct_groups = baked_groups(set);
}

vec3 LightLookup::irradiance(const rays::SurfacePoint& at) const {
  const vec3& n = at.normal;
  const Data::Chosen chosen = data_->choose(at);
  PackedProbes::Basis basis;
  if (!chosen.lights) {
    data_->probes.irradiance_basis(n, basis);
    return data_->probes.irradiance(chosen.probe, basis.data());
  }
  data_->probes.radiance_basis(chosen.direction, basis);
  return pi * data_->probes.radiance(chosen.probe, basis.data());
}

std::vector<std::string> LightLookup::direct_groups() const {
  return data_->direct_groups;
}

vec3 LightLookup::glossy(const rays::SurfacePoint& at, const vec3& r, float roughness) const {
  PackedProbes::Basis basis;
  data_->probes.glossy_basis(r, roughness, basis);
  return data_->probes.radiance(data_->choose(at).probe, basis.data());
}

}  // namespace ssphh::probes
