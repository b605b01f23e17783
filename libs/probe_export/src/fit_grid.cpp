#include <algorithm>
#include <cmath>

#include <fmt/format.h>

#include <ssphh/core/error.h>
#include <ssphh/probe_export/light_grid.h>

namespace ssphh::probe_export {
namespace {

constexpr double usual_points = 8192;
constexpr int lines_across = 24, most_hits = 64, more_cells = 4, begins = 32;

scene::Bounds box_of(const probes::ProbeSet& set, const scene::Bounds& surfaces) {
  scene::Bounds probes;
  std::vector<vec3> positions;
  for (const probes::Probe& probe : set.probes)
    positions.push_back(probe.position), probes.add(positions.back());
  const float spacing = probes::median_spacing(positions);
  if (surfaces.empty()) return probes;
  if (!std::isfinite(spacing)) return surfaces;
  scene::Bounds box{glm::max(surfaces.min, probes.min - 2 * spacing),
                    glm::min(surfaces.max, probes.max + 2 * spacing)};
  for (const vec3& p : positions) box.add(p);
  return box;
}

double points_of(const vec3& size, double spacing) {
  const glm::dvec3 cells = glm::ceil(glm::dvec3(size) / spacing) + 1.0;
  return cells.x * cells.y * cells.z;
}

/// The least spacing, about, that gives at most so many points and cells along an axis.
double spacing_for(const vec3& size, double points, double cells) {
  double low = 1e-6, high = 1e6;
  for (int i = 0; i < 80; ++i) {
    const double middle = std::sqrt(low * high);
    const bool fits = points_of(size, middle) <= points && double{max_component(size)} / middle + 1 <= cells;
    (fits ? high : low) = middle;
  }
  return high;
}

/// Where one line along an axis meets surfaces, ascending; without the first and the last where no probe
/// sees what lies beyond.
std::vector<float> crossings(const FreeLight& light, const scene::Bounds& box, int axis, vec3 start) {
  const float length = box.max[axis] - box.min[axis], step = 1e-4f * length;
  vec3 direction(0);
  direction[axis] = 1;
  start[axis] = box.min[axis] - step;
  std::vector<float> found;
  for (float from = start[axis]; static_cast<int>(found.size()) < most_hits;) {
    start[axis] = from;
    const rays::RayQuery ray{start, direction, box.max[axis] + step - from};
    rays::RayHit hit;
    light.world().intersect({&ray, 1}, {&hit, 1});
    if (hit.escaped()) break;
    found.push_back(from + hit.distance);
    from = found.back() + step;
  }
  const auto open = [&](float at) {
    vec3 place = start;
    place[axis] = at;
    bool seen = false;
    light.irradiance(place, direction, seen);
    return seen;
  };
  if (!found.empty() && !open(found.back() + 2 * step)) found.pop_back();
  if (!found.empty() && !open(found.front() - 2 * step)) found.erase(found.begin());
  return found;
}

/// Share of light from behind walls, summed over lines: between two points of the grid that a surface parts,
/// what lies before it looks half a cell away from it, and should find the point on its own side alone.
double leak_of(const std::vector<std::vector<float>>& lines, double low, double cell) {
  double sum = 0;
  for (const std::vector<float>& line : lines) {
    for (std::size_t i = 0; i < line.size();) {
      const double point = std::floor((line[i] - low) / cell - 0.5);
      const double before = low + (point + 0.5) * cell;
      std::size_t last = i;
      while (last + 1 < line.size() && line[last + 1] < before + cell) ++last;
      sum +=
          std::max(0.0, (line[i] - before) / cell - 0.5) + std::max(0.0, 0.5 - (line[last] - before) / cell);
      i = last + 1;
    }
  }
  return sum;
}

}  // namespace

glm::ivec3 GridShape::place(std::size_t i) const {
  const auto x = static_cast<std::size_t>(size.x), y = static_cast<std::size_t>(size.y);
  return {static_cast<int>(i % x), static_cast<int>(i / x % y), static_cast<int>(i / x / y)};
}

GridShape fit_grid(const probes::ProbeSet& set, const FreeLight& light, const GridParams& params) {
  const scene::Bounds box = box_of(set, light.world().bounds());
  const vec3 size = box.max - box.min;
  if (!(params.spacing >= 0) || !std::isfinite(params.spacing))
    throw Error("grid", "the spacing must be a length in metres");
  const double least = spacing_for(size, static_cast<double>(params.most), params.most_cells - more_cells);
  double spacing = params.spacing;
  if (spacing == 0) spacing = std::max(least, spacing_for(size, usual_points, params.most_cells));
  if (spacing < least) {
    throw Error(
        "grid",
        fmt::format("{:g} m make {:.3g} points of {:.3g} x {:.3g} x {:.3g} m, over {} or over {} along "
                    "an edge",
                    spacing, points_of(size, spacing), size.x, size.y, size.z, params.most,
                    params.most_cells),
        fmt::format("{:.3g} m would fit", 1.01 * least));
  }
  GridShape shape;
  for (int axis = 0; axis < 3; ++axis) {
    std::vector<std::vector<float>> lines;
    for (int i = 0; i < lines_across * lines_across; ++i) {
      const vec2 t = (vec2(i % lines_across, i / lines_across) + 0.5f) / float{lines_across};
      vec3 start = box.min;
      start[(axis + 1) % 3] += t.x * size[(axis + 1) % 3];
      start[(axis + 2) % 3] += t.y * size[(axis + 2) % 3];
      lines.push_back(crossings(light, box, axis, start));
    }
    // Half a cell more on either side, so that what looks before a surface on the box stays within.
    const double length = size[axis];
    const int fewest = static_cast<int>(std::ceil(length / spacing)) + 1;
    double best = std::numeric_limits<double>::infinity();
    for (int count = fewest; count < fewest + more_cells; ++count) {
      const double widest = std::min(spacing, length / (count - 1));
      const double cell = length > 0 ? widest : spacing;
      const double room = cell * count - length;
      for (int begin = 0; begin < begins; ++begin) {
        const double low = double{box.min[axis]} - room * (begin + 0.5) / begins;
        const double leak = leak_of(lines, low, cell);
        if (leak >= best - 1e-3) continue;
        best = leak;
        shape.low[axis] = static_cast<float>(low);
        shape.cell[axis] = static_cast<float>(cell);
        shape.size[axis] = count;
      }
    }
  }
  return shape;
}

}  // namespace ssphh::probe_export
