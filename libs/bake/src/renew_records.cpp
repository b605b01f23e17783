#include "renew_records.h"

#include <limits>

#include <ssphh/core/math.h>
#include <ssphh/core/parallel.h>
#include <ssphh/core/require.h>

namespace ssphh::bake {
namespace {

/// Appends those of `from` that are marked.
void append_marked(const probes::SurfaceRecords& from, const std::vector<std::uint8_t>& mark, bool marked,
                   probes::SurfaceRecords& to) {
  to.groups.resize(from.groups.size());
  to.direct.resize(from.direct.size());
  for (std::size_t p = 0; p < from.points.size(); ++p) {
    if ((mark[p] != 0) != marked) continue;
    to.points.push_back(from.points[p]);
    for (std::size_t g = 0; g < from.groups.size(); ++g) to.groups[g].push_back(from.groups[g][p]);
    for (std::size_t g = 0; g < from.direct.size(); ++g)
      if (from.keeps_direct(g)) to.direct[g].push_back(from.direct[g][p]);
  }
}

}  // namespace

std::vector<std::uint8_t> near_probes(std::span<const rays::SurfacePoint> points, const probes::ProbeSet& set,
                                      const LightScope& scope) {
  std::vector<std::uint8_t> result(points.size(), 1);
  if (!scope.probes) return result;
  parallel_for(points.size(), 256, [&](std::size_t p) {
    float least = std::numeric_limits<float>::infinity();
    std::size_t nearest = set.probes.size();
    for (std::size_t i = 0; i < set.probes.size(); ++i) {
      const vec3 way = set.probes[i].position - points[p].position;
      if (glm::dot(way, way) >= least) continue;
      least = glm::dot(way, way);
      nearest = i;
    }
    result[p] = scope.has_probe(nearest);
  });
  return result;
}

void renew_records(transport::RelightSession& session, probes::ProbeSet& set,
                   const transport::GatherParams& params, const LightScope& scope, const Control& control) {
  if (!scope.groups || !set.surface) {
    transport::GatherParams of_one_pose = params;
    of_one_pose.poses = 1;
    session.keep_records(of_one_pose, control);
    probes::SurfaceRecords now = session.records_by_group(control);
    if (scope.probes && set.surface) {
      require(set.surface->groups.size() == now.groups.size(), "surface records",
              "the set is of other light groups than the session");
      for (std::size_t g = 0; g < now.groups.size(); ++g)
        require(set.surface->keeps_direct(g) == now.keeps_direct(g), "surface records",
                "the set keeps direct light of other light groups than the session");
      probes::SurfaceRecords both;
      append_marked(*set.surface, near_probes(set.surface->points, set, scope), false, both);
      append_marked(now, near_probes(now.points, set, scope), true, both);
      now = std::move(both);
    }
    set.surface = std::move(now);
    return;
  }

  std::vector<std::size_t> which;
  std::vector<rays::SurfacePoint> points;
  const std::vector<std::uint8_t> mark = near_probes(set.surface->points, set, scope);
  for (std::size_t p = 0; p < mark.size(); ++p) {
    if (mark[p] == 0) continue;
    which.push_back(p);
    points.push_back(set.surface->points[p]);
  }
  session.keep_records_at(std::move(points), params, control);
  const probes::SurfaceRecords now = session.records_by_group(control);
  for (const std::uint32_t g : *scope.groups) {
    require(g < now.groups.size() && g < set.surface->groups.size(), "surface records",
            "there is no light group of that index");
    for (std::size_t k = 0; k < which.size(); ++k) {
      set.surface->groups[g][which[k]] = now.groups[g][k];
      if (set.surface->keeps_direct(g) && now.keeps_direct(g))
        set.surface->direct[g][which[k]] = now.direct[g][k];
    }
  }
}

}  // namespace ssphh::bake
