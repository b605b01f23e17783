#include "other_places.h"

#include <algorithm>

#include <ssphh/core/parallel.h>
#include <ssphh/probes/surface_interpolation.h>

namespace ssphh::cook {
namespace {

using probes::SurfaceRecords, probes::SurfaceShare;

/// What makes up the light of a place: its own record, those around it, or the nearest where none reaches it.
std::vector<SurfaceShare> shares_at(const rays::SurfacePoint& at, const SurfaceRecords& records,
                                    const probes::SurfaceInterpolation& between) {
  const auto distance2 = [&](std::size_t i) {
    const vec3 d = records.points[i].position - at.position;
    return glm::dot(d, d);
  };
  probes::SurfaceShares storage;
  const std::span<const SurfaceShare> found = between.at(at, storage);
  for (const SurfaceShare& share : found) {
    if (distance2(share.point) == 0 && records.points[share.point].normal == at.normal)
      return {{share.point, 1}};
  }
  if (!found.empty()) return {found.begin(), found.end()};
  std::uint32_t nearest = 0;
  for (std::uint32_t i = 1; i < records.points.size(); ++i)
    if (distance2(i) < distance2(nearest)) nearest = i;
  return {{nearest, 1}};
}

SurfaceRecords records_at(const std::vector<rays::SurfacePoint>& places, const SurfaceRecords& records,
                          const probes::SeesProbe& sees, const Control& control) {
  const probes::SurfaceInterpolation between(records.points, sees);
  SurfaceRecords out;
  out.points = places;
  out.groups.assign(records.groups.size(), std::vector<probes::PackedRecordLight>(places.size()));
  out.direct.resize(records.direct.size());
  for (std::size_t g = 0; g < records.direct.size(); ++g)
    if (records.keeps_direct(g)) out.direct[g].resize(places.size());
  parallel_for(
      places.size(), 64,
      [&](std::size_t i) {
        const std::vector<SurfaceShare> shares = shares_at(places[i], records, between);
        const auto at_place = [&](const std::vector<probes::PackedRecordLight>& light) {
          probes::RecordLight sum(0);
          for (const auto& [point, weight] : shares)
            sum += weight * probes::unpack(light[point], records.points[point].normal);
          return probes::pack(sum, places[i].normal);
        };
        for (std::size_t g = 0; g < records.groups.size(); ++g)
          out.groups[g][i] = at_place(records.groups[g]);
        for (std::size_t g = 0; g < records.direct.size(); ++g)
          if (records.keeps_direct(g)) out.direct[g][i] = at_place(records.direct[g]);
      },
      control);
  return out;
}

}  // namespace

probes::ProbeSet at_places_of(const probes::ProbeSet& places, probes::ProbeSet set,
                              const probes::SeesProbe& sees, const Control& control) {
  const auto same_place = [](const probes::Probe& a, const probes::Probe& b) {
    return a.position == b.position;
  };
  if (!std::ranges::equal(places.probes, set.probes, same_place) || places.degree != set.degree)
    throw Error("cook", "the light is of other probes than the places",
                "bake both from one scene, with the same probes and degree");
  const auto count = [](const auto& points) { return points ? points->points.size() : 0; };
  if ((count(places.surface) > 0) != (count(set.surface) > 0))
    throw Error("cook", "only one of the two files has surface records", "bake both with the same --records");
  if (count(places.surface) > 0) {
    probes::require_whole(*set.surface, set.light_groups.size());
    set.surface = records_at(places.surface->points, *set.surface, sees, control);
  }
  set.fitted = places.fitted;
  probes::merge_groups(set);
  return set;
}

}  // namespace ssphh::cook
