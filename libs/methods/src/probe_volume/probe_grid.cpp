#include "probe_grid.h"

#include <algorithm>
#include <cmath>

#include <fmt/format.h>

#include <ssphh/core/error.h>

namespace ssphh::methods::probe_volume {
namespace {

glm::ivec3 cells_of(const place::Lattice& lattice) {
  return glm::max(lattice.size - 1, glm::ivec3(1));
}

std::size_t index_of(const glm::ivec3& size, const glm::ivec3& place) {
  return static_cast<std::size_t>((place.z * size.y + place.y) * size.x + place.x);
}

/// By bisection: the number of places of a centred grid falls with the spacing.
float spacing_for(const rays::TransportSource& source, int places) {
  const scene::Bounds box = place::lattice_box(source, 0);
  float low = 1e-4f * box.radius(), high = 4 * box.radius();
  for (int i = 0; i < 40; ++i) {
    const float middle = std::sqrt(low * high);
    const glm::dvec3 along = glm::max(glm::round(glm::dvec3(box.max - box.min) / double{middle}), 1.0);
    (along.x * along.y * along.z > places ? low : high) = middle;
  }
  return high;
}

}  // namespace

ProbeGrid make_probe_grid(const rays::TransportSource& source, const ProbeGridParams& params,
                          const Control& control) {
  const float spacing = params.spacing > 0 ? params.spacing : spacing_for(source, params.places);
  const scene::Bounds box = place::lattice_box(source, spacing);
  if (const double places = place::lattice_places(box, spacing); places > params.most) {
    throw Error("probe grid",
                fmt::format("a spacing of {:g} m makes {:.0f} places, over {}", spacing, places, params.most),
                "give a larger spacing");
  }
  place::SiteRules rules;
  rules.clearance = std::min(rules.clearance, 0.1f * spacing);
  rules.back_limit = place::calibrated_back_limit(source, params.interest);
  ProbeGrid grid;
  grid.lattice = place::choose_lattice(source, source.part_bounds(0), spacing, rules, control);
  const std::vector<vec3> points = place::lattice_points(grid.lattice);
  const std::vector<place::Site> sites = place::look_around(source, points, place::fan_size, control);
  for (std::size_t i = 0; i < points.size(); ++i) {
    const bool free = place::valid(sites[i], rules);
    grid.probe.push_back(free ? static_cast<std::int32_t>(grid.positions.size()) : -1);
    if (free) grid.positions.push_back(points[i]);
  }
  if (grid.positions.empty())
    throw Error("probe grid", "all its places are within bodies", "give a smaller spacing, or places=auto");
  return grid;
}

GridWeights::GridWeights(const ProbeGrid& grid) : lattice_(grid.lattice), probe_(grid.probe) {
  const glm::ivec3 cells = cells_of(lattice_);
  for (int z = 0; z < cells.z; ++z) {
    for (int y = 0; y < cells.y; ++y) {
      for (int x = 0; x < cells.x; ++x) {
        bool any = false;
        for (int k = 0; k < 8; ++k) any |= probe_at({x + (k & 1), y + (k >> 1 & 1), z + (k >> 2)}) >= 0;
        std::int32_t nearest = -1;
        if (!any) {
          const vec3 middle = lattice_.origin + lattice_.spacing * (vec3(x, y, z) + 0.5f);
          float least = std::numeric_limits<float>::infinity();
          for (std::size_t i = 0; i < grid.positions.size(); ++i) {
            const vec3 to = grid.positions[i] - middle;
            if (glm::dot(to, to) < least) least = glm::dot(to, to), nearest = static_cast<std::int32_t>(i);
          }
        }
        nearest_.push_back(nearest);
      }
    }
  }
}

std::int32_t GridWeights::probe_at(const glm::ivec3& place) const {
  return probe_[index_of(lattice_.size, glm::min(place, lattice_.size - 1))];
}

probes::ProbeWeights GridWeights::at(const vec3& position) const {
  const vec3 last = vec3(lattice_.size - 1);
  const vec3 place = glm::clamp((position - lattice_.origin) / lattice_.spacing, vec3(0), last);
  const glm::ivec3 cells = cells_of(lattice_);
  const glm::ivec3 cell = glm::min(glm::ivec3(place), cells - 1);
  const vec3 t = place - vec3(cell);
  probes::ProbeWeights out;
  float sum = 0;
  for (int k = 0; k < 8; ++k) {
    const glm::ivec3 step(k & 1, k >> 1 & 1, k >> 2);
    const vec3 share = glm::mix(1.0f - t, t, glm::bvec3(step));
    const float weight = share.x * share.y * share.z;
    const std::int32_t probe = probe_at(cell + step);
    if (probe < 0 || !(weight > 0)) continue;
    out.add(probe, weight);
    sum += weight;
  }
  if (sum > 0) {
    for (probes::ProbeWeight& entry : out.used()) entry.weight /= sum;
    return out;
  }
  // Corners exist but have no weight here, or there are none.
  std::int32_t chosen = nearest_[index_of(cells, cell)];
  for (int k = 0; k < 8 && chosen < 0; ++k) chosen = probe_at(cell + glm::ivec3(k & 1, k >> 1 & 1, k >> 2));
  out.add(chosen, 1);
  return out;
}

std::size_t GridWeights::bytes() const {
  return (probe_.size() + nearest_.size()) * sizeof(std::int32_t);
}

}  // namespace ssphh::methods::probe_volume
