#include <algorithm>
#include <cmath>

#include <ssphh/core/parallel.h>
#include <ssphh/core/sphere.h>
#include <ssphh/probes/candidate_grid.h>

#include "parts.h"

namespace ssphh::cook {
namespace {

/// Distances along the axes of the faces of a cube around a place, in 65535ths of `reach`.
std::vector<std::uint16_t> sight_of(const rays::PosedWorld& world, const vec3& place, float reach, int size) {
  std::vector<rays::RayQuery> rays;
  for (int face = 0; face < 6; ++face) {
    for (int y = 0; y < size; ++y) {
      for (int x = 0; x < size; ++x) {
        const auto middle = [size](int i) {
          return (static_cast<float>(i) + 0.5f) / static_cast<float>(size);
        };
        // 1 along the face's axis: distances are along that
        rays.push_back({place, cube_direction_unnormalized({face, middle(x), middle(y)}), reach});
      }
    }
  }
  std::vector<rays::RayHit> hits(rays.size());
  world.intersect(rays, hits);
  std::vector<std::uint16_t> sight;
  for (const rays::RayHit& hit : hits) {
    const float share = std::min(hit.distance / reach, 1.0f);
    sight.push_back(static_cast<std::uint16_t>(std::lround(65535 * share)));
  }
  return sight;
}

}  // namespace

void add_probes(Sections& out, const probes::ProbeSet& set, const rays::PosedWorld* world,
                const CookParams& params, const Control& control) {
  std::vector<vec3> places;
  scene::Bounds bounds;
  for (const probes::Probe& probe : set.probes) {
    places.push_back(probe.position);
    bounds.add(probe.position);
  }
  const float spacing = probes::median_spacing(places);
  if (world) {
    bounds.add(world->bounds().min), bounds.add(world->bounds().max);
  } else if (std::isfinite(spacing)) {
    bounds = {bounds.min - spacing, bounds.max + spacing};
  }
  const probes::CandidateGrid grid = probes::make_candidate_grid(places, bounds, spacing);
  ssphh_cooked_header& h = out.header;
  h.probe_count = static_cast<std::uint32_t>(places.size());
  h.probe_list_length = static_cast<std::uint32_t>(grid.length);
  h.probe_spacing = std::isfinite(spacing) ? spacing : 0;
  h.probe_cell_size = grid.cell_size;
  for (glm::length_t c = 0; c < 3; ++c) {
    h.probe_origin[c] = grid.origin[c];
    h.probe_cells[c] = static_cast<std::uint32_t>(grid.cells[c]);
  }
  static_assert(static_cast<std::uint16_t>(-1) == SSPHH_COOKED_NO_PROBE);
  for (const int probe : grid.lists) out.append(SSPHH_COOKED_PROBE_CELLS, static_cast<std::uint16_t>(probe));

  // Sight is asked from a little off the place
  std::vector<float> reach = probes::probe_reach(grid, places);
  for (std::size_t i = 0; i < places.size(); ++i) {
    reach[i] = std::max(1.05f * reach[i], grid.cell_size);
    out.append(SSPHH_COOKED_PROBES, ssphh_cooked_probe{{places[i].x, places[i].y, places[i].z}, reach[i]});
  }
  if (!world || params.sight_size == 0) return;
  h.sight_size = static_cast<std::uint32_t>(params.sight_size);
  std::vector<std::vector<std::uint16_t>> sight(places.size());
  parallel_for(
      places.size(), 1,
      [&](std::size_t i) { sight[i] = sight_of(*world, places[i], reach[i], params.sight_size); }, control);
  for (const std::vector<std::uint16_t>& faces : sight)
    out.append(SSPHH_COOKED_SIGHT, std::span<const std::uint16_t>(faces));
}

}  // namespace ssphh::cook
