#include <algorithm>

#include <fmt/format.h>

#include <ssphh/core/require.h>
#include <ssphh/core/require_named.h>
#include <ssphh/transport/network.h>
#include <ssphh/transport/session_sets.h>
#include <ssphh/transport/surface_gather.h>

namespace ssphh::transport {
namespace {

std::vector<probes::Probe> dark_probes(const std::vector<scene::ProbePlace>& places) {
  std::vector<probes::Probe> probes(places.size());
  for (std::size_t i = 0; i < places.size(); ++i) {
    probes[i].name = places[i].name;
    probes[i].position = places[i].position;
    probes[i].radius = places[i].radius;
  }
  return probes;
}

bool is_dark(const sh::RadianceSh& light) {
  return std::ranges::all_of(light.values, [](const vec3& v) { return v == vec3(0); });
}

/// A name that no light group has.
std::string name_of_all(const std::vector<std::string>& groups) {
  std::string name = "all";
  while (std::ranges::find(groups, name) != groups.end()) name += '\'';
  return name;
}

}  // namespace

probes::ProbeSet lookup_set(const RelightSession& session) {
  probes::ProbeSet set = lookup_set(session.places(), session.reflected());
  if (!session.gather()) return set;
  const std::size_t count = session.gather()->points().size();
  const std::vector<probes::PackedRecordLight> dark(count);
  set.surface = {session.gather()->points(), {dark}};
  set.surface->light.resize(count);
  set.light_groups[0].name = name_of_all(session.light_groups());
  for (std::size_t k = 0; k < session.kept_direct_count(); ++k) {
    const KeptDirect kept = session.kept_direct(k);
    set.light_groups.push_back({session.light_groups()[kept.group]});
    set.surface->groups.push_back(dark);
    set.surface->direct.resize(set.light_groups.size());
    set.surface->direct.back() = dark;
    for (std::size_t i = 0; i < set.probes.size(); ++i)
      set.probes[i].groups.push_back({session.arriving(kept.group, static_cast<int>(i)), {}});
  }
  refresh(set, session);
  return set;
}

void refresh(probes::ProbeSet& set, const RelightSession& session) {
  const std::vector<sh::RadianceSh>& reflected = session.reflected();
  require(reflected.size() == set.probes.size(), "lookup set", "it is not of this session");
  for (std::size_t i = 0; i < reflected.size(); ++i) {
    probes::Probe& probe = set.probes[i];
    probe.groups[0].reflected = reflected[i];
    probe.reflected = reflected[i];
    probe.self = reflected[i];
  }
  if (!set.surface) return;
  probes::SurfaceRecords& records = *set.surface;
  const std::size_t kept_count = session.kept_direct_count();
  require(records.groups.size() == 1 + kept_count && set.light_groups.size() == records.groups.size() &&
              records.light.size() == session.record_light().size(),
          "lookup set", "its records are not of this session");
  for (std::size_t i = 0; i < records.light.size(); ++i) {
    const vec3& normal = records.points[i].normal;
    records.groups[0][i] = probes::pack(session.record_light()[i], normal);
    records.light[i] = probes::unpack(records.groups[0][i], normal);
  }
  for (std::size_t k = 0; k < kept_count; ++k) {
    const KeptDirect kept = session.kept_direct(k);
    probes::LightGroup& group = set.light_groups[1 + k];
    group.mode = kept.holds ? scene::LightMode::diffuse : scene::LightMode::realtime;
    group.scale = session.shown().group_scales[kept.group];
    for (std::size_t i = 0; i < records.light.size(); ++i) {
      const vec3& normal = records.points[i].normal;
      probes::PackedRecordLight& packed = records.direct[1 + k][i];
      packed = probes::pack(kept.light[i], normal);
      if (!kept.holds) continue;
      const probes::RecordLight light = probes::unpack(packed, normal);
      for (glm::length_t c = 0; c < 4; ++c) records.light[i][c] += group.scale * light[c];
    }
  }
}

probes::ProbeSet lookup_set(const std::vector<scene::ProbePlace>& places,
                            const std::vector<sh::RadianceSh>& reflected) {
  require(!places.empty(), "lookup set", "there are no probes");
  if (reflected.size() != places.size())
    throw Error("lookup set",
                fmt::format("there are {} functions for {} probes", reflected.size(), places.size()),
                "a session has light after its first update()");
  probes::ProbeSet set;
  set.degree = reflected.front().degree();
  set.light_groups.push_back({"all"});
  set.probes = dark_probes(places);
  for (std::size_t i = 0; i < places.size(); ++i) set.probes[i].groups.push_back({{}, reflected[i]});
  probes::merge_groups(set);
  return set;
}

void store_groups(probes::ProbeSet& set, std::vector<std::vector<sh::RadianceSh>> reflected,
                  std::vector<std::vector<sh::RadianceSh>> emitted) {
  for (const auto* light : {&reflected, &emitted})
    require(light->size() == set.light_groups.size() &&
                std::ranges::all_of(
                    *light, [&](const auto& of_probes) { return of_probes.size() == set.probes.size(); }),
            "light groups", "there is not the light of each group at each probe");
  for (std::size_t i = 0; i < set.probes.size(); ++i) {
    probes::Probe& probe = set.probes[i];
    probe.groups.clear();
    for (std::size_t g = 0; g < set.light_groups.size(); ++g) {
      probes::GroupLight& light = probe.groups.emplace_back();
      light.reflected = std::move(reflected[g][i]);
      if (!is_dark(emitted[g][i])) light.emitted = std::move(emitted[g][i]);
    }
  }
  probes::merge_groups(set);
}

probes::ProbeSet baked_set(const RelightSession& session, const std::vector<std::string>& groups,
                           probes::GeneratorInfo generator, const Control& control) {
  const std::vector<vec3>& scales = session.lighting().group_scales;
  require(groups.size() == scales.size(), "baked set", "there is not one name for each light group");
  require_named("light operator", generator.op);
  const TransportParams& transport = session.network().params();
  probes::ProbeSet set;
  set.generator = std::move(generator);
  set.generator.directions = transport.directions;
  set.generator.surfel_size = transport.surfel_size;
  set.generator.link_rays = transport.link_rays;
  set.generator.time = session.lighting().time;
  std::vector<std::vector<sh::RadianceSh>> reflected = session.reflected_by_group(control);
  set.degree = session.reflected().front().degree();
  for (std::size_t g = 0; g < groups.size(); ++g) set.light_groups.push_back({groups[g], scales[g]});
  set.probes = dark_probes(session.places());
  if (session.gather()) set.surface = session.records_by_group(control);
  bool any = false;
  for (std::size_t k = 0; k < session.kept_direct_count(); ++k) {
    const KeptDirect kept = session.kept_direct(k);
    const auto g = static_cast<std::size_t>(kept.group);
    if (kept.holds) {
      set.light_groups[g].mode = scene::LightMode::diffuse;
    } else {
      set.surface->direct[g].clear();
    }
    any |= kept.holds;
  }
  if (set.surface && !any) set.surface->direct.clear();
  store_groups(set, std::move(reflected), session.emitted_by_group());
  return set;
}

}  // namespace ssphh::transport
