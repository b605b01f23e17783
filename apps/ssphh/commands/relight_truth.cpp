#include "commands/relight_truth.h"

namespace ssphh::app {

gi::ProbeSet bake_of(const gi::RelightSession& session, const scene::TransportSource& source,
                     const std::vector<vec3>& scales, gi::GeneratorInfo generator, const Control& control) {
  const std::vector<std::vector<sh::RadianceSh>> reflected = session.reflected_by_group(control);
  const std::vector<std::vector<sh::RadianceSh>> emitted = session.emitted_by_group();
  gi::ProbeSet set;
  set.degree = session.reflected().front().degree();
  set.generator = std::move(generator);
  const std::vector<std::string>& groups = source.light_groups();
  for (std::size_t g = 0; g < groups.size(); ++g) set.light_groups.push_back({groups[g], scales[g]});
  for (std::size_t i = 0; i < session.places().size(); ++i) {
    const gi::ProbePlace& place = session.places()[i];
    gi::Probe probe;
    probe.name = place.name;
    probe.position = place.position;
    probe.radius = place.radius;
    for (std::size_t g = 0; g < groups.size(); ++g) probe.groups.push_back({emitted[g][i], reflected[g][i]});
    set.probes.push_back(std::move(probe));
  }
  gi::merge_groups(set);
  return set;
}

}  // namespace ssphh::app
