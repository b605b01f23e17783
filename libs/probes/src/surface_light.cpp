#include <algorithm>

#include <fmt/format.h>

#include <ssphh/probes/lookup.h>

namespace ssphh::probes {
namespace {

/// Checks that hold for every function which lights surfaces.
class Checked {
 public:
  explicit Checked(int degree) : count_(static_cast<std::size_t>(sh::coefficient_count(degree))) {}

  const sh::RadianceSh& operator()(const sh::RadianceSh& f, std::size_t probe, const char* hint = "") const {
    if (f.values.size() != count_)
      throw Error(fmt::format("probe {}", probe),
                  fmt::format("has {} RGB coefficients; the set's degree has {}", f.values.size(), count_),
                  hint);
    if (!std::ranges::all_of(f.values, is_finite))
      throw Error(fmt::format("probe {}", probe), "its light is not finite");
    return f;
  }

 private:
  std::size_t count_;
};

}  // namespace

std::vector<sh::RadianceSh> surface_light(const ProbeSet& set, const LookupParams& params) {
  std::vector<sh::RadianceSh> light;
  surface_light(set, params, light);
  return light;
}

void surface_light(const ProbeSet& set, const LookupParams& params, std::vector<sh::RadianceSh>& light) {
  sh::require_degree(set.degree, "probe set");
  if (set.probes.empty()) throw Error("probe lookup", "the probe set is empty", "bake a scene with SPHLs");
  const ProbeLayer layer = params.layer.value_or(set.hierarchy ? ProbeLayer::sum : ProbeLayer::self);
  if (layer != ProbeLayer::self && !set.hierarchy)
    throw Error("probe lookup", "the probe set has no hierarchy", "run `ssphh hier` on the file first");
  if (layer != ProbeLayer::self && set.hierarchy->neighbor.size() != set.probes.size())
    throw Error("probe lookup", "the hierarchy is not of this set's probes", "compute it anew");

  const Checked checked(set.degree);
  light.resize(set.probes.size());
  for (std::size_t i = 0; i < set.probes.size(); ++i) {
    const Probe& probe = set.probes[i];
    if (!is_finite(probe.position)) throw Error(fmt::format("probe {}", i), "its position is not finite");
    if (layer == ProbeLayer::neighbor) {
      light[i] = checked(set.hierarchy->neighbor[i], i);
      continue;
    }
    const sh::RadianceSh& own = params.light == ProbeLight::reflected ? probe.reflected : probe.self;
    light[i] = checked(own, i, own.empty() ? "its groups were not merged: call merge_groups" : "");
    if (layer == ProbeLayer::sum) light[i] += checked(set.hierarchy->neighbor[i], i);
  }
}

}  // namespace ssphh::probes
