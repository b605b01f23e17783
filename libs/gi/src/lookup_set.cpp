#include <fmt/format.h>

#include <ssphh/core/require.h>
#include <ssphh/gi/relight_session.h>

namespace ssphh::gi {

ProbeSet lookup_set(const std::vector<ProbePlace>& places, const std::vector<sh::RadianceSh>& reflected) {
  require(!places.empty(), "lookup set", "there are no probes");
  if (reflected.size() != places.size())
    throw Error("lookup set",
                fmt::format("there are {} functions for {} probes", reflected.size(), places.size()),
                "a session has light after its first update()");
  ProbeSet set;
  set.degree = reflected.front().degree();
  set.light_groups.push_back({"all"});
  for (std::size_t i = 0; i < places.size(); ++i) {
    Probe probe;
    probe.name = places[i].name;
    probe.position = places[i].position;
    probe.radius = places[i].radius;
    probe.groups.push_back({{}, reflected[i]});
    set.probes.push_back(std::move(probe));
  }
  merge_groups(set);
  return set;
}

}  // namespace ssphh::gi
