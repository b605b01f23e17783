#include <algorithm>
#include <cmath>

#include <fmt/format.h>

#include <ssphh/core/error.h>
#include <ssphh/core/parallel.h>
#include <ssphh/core/require.h>
#include <ssphh/place/site.h>
#include <ssphh/probe_export/light_grid.h>
#include <ssphh/scene/probe_place.h>

namespace ssphh::probe_export {
namespace {

constexpr std::size_t most_points = std::size_t{1} << 28;

struct Neighbour {
  std::size_t index;
  float distance;  ///< from the point to the wall's side that faces the neighbour; 0: nothing is between
};

/// Neighbours along the axes that are good.
std::vector<Neighbour> good_neighbours(const GridShape& shape, const std::vector<std::uint8_t>& good,
                                       std::size_t i, const rays::PosedWorld& world) {
  std::vector<Neighbour> found;
  for (int axis = 0; axis < 3; ++axis) {
    for (const int step : {-1, 1}) {
      glm::ivec3 at = shape.place(i);
      at[axis] += step;
      if (at[axis] < 0 || at[axis] >= shape.size[axis] || !good[shape.index(at)]) continue;
      const vec3 from = shape.point(at), way = shape.point(shape.place(i)) - from;
      const rays::RayQuery ray{from, way, 1};
      rays::RayHit hit;
      world.intersect({&ray, 1}, {&hit, 1});
      const float share = hit.escaped() ? 0 : std::max(0.0f, 1 - hit.distance);
      found.push_back({shape.index(at), share * glm::length(way)});
    }
  }
  return found;
}

std::vector<std::size_t> nearest_of(const std::vector<Neighbour>& neighbours, float tolerance) {
  const float least = std::ranges::min_element(neighbours, {}, &Neighbour::distance)->distance;
  std::vector<std::size_t> nearest;
  for (const Neighbour& n : neighbours)
    if (n.distance <= least + tolerance) nearest.push_back(n.index);
  return nearest;
}

sh::RadianceSh mean_of(const std::vector<sh::RadianceSh>& light, const std::vector<std::size_t>& some) {
  sh::RadianceSh sum(2);
  for (const std::size_t i : some) sum += light[i];
  sum *= vec3(1.0f / static_cast<float>(some.size()));
  return sum;
}

}  // namespace

LightGrid resample(const probes::ProbeSet& set, const FreeLight& light, const rays::TransportSource& source,
                   const GridShape& shape, const Control& control) {
  require(glm::all(glm::greaterThan(shape.size, glm::ivec3(0))) &&
              glm::all(glm::lessThanEqual(shape.size, glm::ivec3(1 << 20))) && shape.count() <= most_points,
          "grid", "it must have a point along each axis, and no more than 2^28 in all");
  LightGrid grid{shape, std::vector<sh::RadianceSh>(shape.count()), {}};
  std::vector<std::uint8_t> good(shape.count(), 0);
  const std::vector<vec3> positions = scene::positions_of(set.probes);
  place::SiteRules rules;
  rules.back_limit = place::calibrated_back_limit(source, positions);
  {
    ProgressStage stage(control, "resample the probes' light", shape.count(), "points");
    parallel_for(
        shape.count(), 16,
        [&](std::size_t i) {
          const vec3 place = shape.point(shape.place(i));
          LightAt found = light.at(place);
          stage.advance(1);
          if (!found.seen ||
              place::inside_body(place::look_around(source, place, place::coarse_fan_size), rules))
            return;
          grid.light[i] = std::move(found.light);
          good[i] = 1;
        },
        control);
  }
  std::vector<std::size_t> left;
  for (std::size_t i = 0; i < good.size(); ++i)
    if (!good[i]) left.push_back(i);
  if (left.size() == shape.count())
    throw Error("grid", "no point of it sees a probe", "give a smaller spacing");
  const float tolerance = 0.01f * max_component(shape.cell);
  while (!left.empty()) {
    control.check();
    std::vector<std::size_t> done, later;
    for (const std::size_t i : left) {
      const std::vector<Neighbour> neighbours = good_neighbours(shape, good, i, light.world());
      if (neighbours.empty()) {
        later.push_back(i);
        continue;
      }
      grid.filled.push_back({i, nearest_of(neighbours, tolerance)});
      grid.light[i] = mean_of(grid.light, grid.filled.back().from);
      done.push_back(i);
    }
    for (const std::size_t i : done) good[i] = 1;  // after the round: no direction comes first
    left = std::move(later);
  }
  return grid;
}

}  // namespace ssphh::probe_export
