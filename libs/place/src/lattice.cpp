#include <algorithm>
#include <cmath>

#include <ssphh/core/require.h>
#include <ssphh/place/lattice.h>

namespace ssphh::place {
namespace {

constexpr int offset_count = 8;
constexpr double most_places = 1 << 28;
constexpr double share_beyond = 0.01;  ///< that a place outside of the box counts

/// Offset, in spacings from box.min, that leaves as much room on both sides.
vec3 centred_offset(const scene::Bounds& box, float spacing) {
  vec3 offset;
  for (int axis = 0; axis < 3; ++axis) {
    const float cells = (box.max[axis] - box.min[axis]) / spacing;
    const float places = std::max(1.0f, std::round(cells));
    offset[axis] = 0.5f * (cells - (places - 1));
  }
  return offset;
}

double score(const std::vector<vec3>& places, const std::vector<Site>& sites, const scene::Bounds& box,
             float spacing, const SiteRules& rules) {
  double sum = 0;
  for (std::size_t i = 0; i < places.size(); ++i) {
    if (!valid(sites[i], rules)) continue;
    const bool within = glm::all(glm::greaterThanEqual(places[i], box.min)) &&
                        glm::all(glm::lessThanEqual(places[i], box.max));
    sum += (within ? 1 : share_beyond) * double{std::min(1.0f, sites[i].nearest / (0.25f * spacing))};
  }
  return sum;
}

}  // namespace

scene::Bounds widened(scene::Bounds box, float spacing) {
  for (int axis = 0; axis < 3; ++axis) {
    const float missing = spacing - (box.max[axis] - box.min[axis]);
    if (missing <= 0) continue;
    box.max[axis] += axis == 1 ? missing : 0.5f * missing;
    if (axis != 1) box.min[axis] -= 0.5f * missing;
  }
  return box;
}

scene::Bounds lattice_box(const rays::TransportSource& source, float spacing) {
  const scene::Bounds box = source.part_bounds(0);
  if (box.empty()) {
    throw Error("probe placement",
                "the scene has no surface that stands still, so there is no place to look for",
                "give the scene SPHLs and use --probes scene");
  }
  return widened(box, spacing);
}

double lattice_places(const scene::Bounds& box, float spacing) {
  const glm::dvec3 cells = glm::dvec3(box.max - box.min) / double{spacing} + 1.0;
  return cells.x * cells.y * cells.z;
}

Lattice make_lattice(const scene::Bounds& box, float spacing, const vec3& offset) {
  require(spacing > 0 && lattice_places(box, spacing) <= most_places, "lattice",
          "the spacing must be over 0, and such that there are no more than 2^28 places");
  Lattice lattice;
  lattice.box = box;
  lattice.spacing = spacing;
  lattice.origin = box.min + spacing * offset;
  lattice.size = glm::ivec3(glm::floor((box.max - lattice.origin) / spacing)) + 1;
  lattice.size = glm::max(lattice.size, glm::ivec3(0));
  return lattice;
}

std::vector<vec3> lattice_points(const Lattice& lattice) {
  std::vector<vec3> points;
  for (int z = 0; z < lattice.size.z; ++z) {
    for (int y = 0; y < lattice.size.y; ++y) {
      for (int x = 0; x < lattice.size.x; ++x) points.push_back(lattice_point(lattice, {x, y, z}));
    }
  }
  return points;
}

Lattice choose_lattice(const rays::TransportSource& source, const scene::Bounds& box, float spacing,
                       const SiteRules& rules, const Control& control) {
  const scene::Bounds wide = widened(box, spacing);
  std::vector<vec3> offsets{centred_offset(wide, spacing)};
  for (int i = 1; i <= offset_count; ++i) offsets.push_back(spread_in_cube(i));
  // Where the box is thinner than the spacing, most of these lie beside it
  const vec3 start = (box.min - wide.min) / spacing, thickness = (box.max - box.min) / spacing;
  if (std::min({thickness.x, thickness.y, thickness.z}) < 1) {
    for (int i = 1; i <= offset_count; ++i)
      offsets.push_back(start + glm::min(thickness, vec3(1)) * spread_in_cube(i));
  }
  Lattice best;
  double best_score = -1;
  for (const vec3& offset : offsets) {
    const Lattice lattice = make_lattice(wide, spacing, offset);
    const std::vector<vec3> places = lattice_points(lattice);
    const double s =
        score(places, look_around(source, places, coarse_fan_size, control), box, spacing, rules);
    if (s > best_score) best = lattice, best_score = s;
  }
  return best;
}

}  // namespace ssphh::place
