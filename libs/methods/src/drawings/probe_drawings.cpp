#include <algorithm>
#include <cmath>
#include <map>
#include <set>

#include <ssphh/methods/drawing.h>
#include <ssphh/probes/hier.h>
#include <ssphh/probes/lookup_weights.h>

namespace ssphh::methods {
namespace {

float ball_radius(std::span<const vec3> positions) {
  constexpr float alone = 0.12f, share = 0.1f;
  return positions.size() < 2 ? alone : share * probes::median_spacing(positions);
}

}  // namespace

sketch::Sketch hierarchy_drawing(const probes::ProbeSet& set) {
  std::vector<vec3> positions;
  for (const probes::Probe& probe : set.probes) positions.push_back(probe.position);
  sketch::Sketch marks;
  for (std::size_t i = 0; i < positions.size(); ++i) {
    marks.balls.push_back({.center = positions[i],
                           .radius = ball_radius(positions),
                           .light = set.hierarchy ? set.hierarchy->sum[i] : set.probes[i].self});
  }
  probes::HierParams params;
  if (set.hierarchy) params = {set.hierarchy->op, set.hierarchy->neighbors, set.hierarchy->threshold};
  std::map<std::pair<int, int>, float> strength;  // of each pair, the stronger way
  float strongest = 0;
  for (std::size_t i = 0; i < set.probes.size(); ++i) {
    for (const int e : probes::select_neighbors(set.probes[i], params)) {
      const probes::Edge& edge = set.probes[i].edges[e];
      float& known = strength[std::minmax(edge.from, static_cast<int>(i))];
      known = std::max(known, edge.transfer);
      strongest = std::max(strongest, edge.transfer);
    }
  }
  for (const auto& [pair, transfer] : strength) {
    const float share = std::clamp(1 + std::log10(transfer / strongest) / 3, 0.0f, 1.0f);
    marks.lines.push_back({positions[pair.first], positions[pair.second],
                           glm::mix(vec3(0.02f, 0.1f, 0.8f), vec3(1, 0.75f, 0.05f), share), 1 + 3 * share});
  }
  return marks;
}

sketch::Sketch tetrahedra_drawing(const geometry::Tetrahedra& tetrahedra, std::span<const vec3> points) {
  std::set<std::pair<std::int32_t, std::int32_t>> edges;
  for (const geometry::Tetrahedron& cell : tetrahedra.cells()) {
    const std::array<std::int32_t, 4> corner = tetrahedra.corners(cell);
    for (std::size_t a = 0; a < 4; ++a) {
      for (std::size_t b = a + 1; b < 4; ++b) edges.insert(std::minmax(corner[a], corner[b]));
    }
  }
  sketch::Sketch marks;
  for (const auto& [a, b] : edges) {
    marks.lines.push_back({points[a], points[b], vec3(0.1f, 0.7f, 0.9f), 1.2f});
  }
  const float radius = 0.5f * ball_radius(points);
  for (const vec3& point : points) marks.balls.push_back({point, radius, vec3(1, 0.6f, 0.1f)});
  return marks;
}

}  // namespace ssphh::methods
