#include "grid.h"

#include <fmt/format.h>

#include <ssphh/core/error.h>

namespace ssphh::methods::ddgi {
namespace {

/// Flat scenes have cells too [m].
constexpr float least_extent = 1e-3f;

/// A thousandth of a cell more is rounding, and no reason for another one.
glm::dvec3 cells(const vec3& extent, double spacing) {
  return glm::max(glm::ceil(glm::dvec3(extent) / spacing - 1e-3), glm::dvec3(1));
}

double total(const glm::dvec3& count) {
  return count.x * count.y * count.z;
}

}  // namespace

ProbeGrid make_grid(const scene::Bounds& bounds, float spacing, int probes, int most) {
  const vec3 extent = glm::max(bounds.max - bounds.min, vec3(least_extent));
  double edge = static_cast<double>(spacing);
  if (!(spacing > 0)) {
    // The largest edge that gives as many: the count falls as the edge grows.
    double low = 1e-6 * static_cast<double>(glm::length(extent));
    double high = 2 * static_cast<double>(max_component(extent));
    for (int step = 0; step < 60; ++step) {
      edge = 0.5 * (low + high);
      (total(cells(extent, edge)) >= probes ? low : high) = edge;
    }
    edge = low;
  }
  const glm::dvec3 count = cells(extent, edge);
  if (!(total(count) <= most)) {
    throw Error("method ddgi", fmt::format("{:.3g} probes are more than {}", total(count), most),
                "let them stand farther apart: spacing=METRES");
  }
  ProbeGrid grid;
  grid.count = glm::ivec3(count);
  grid.spacing = extent / vec3(grid.count);
  grid.first = bounds.min + 0.5f * grid.spacing;
  return grid;
}

}  // namespace ssphh::methods::ddgi
