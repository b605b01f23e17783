#pragma once
/// Which part of a scene's bounds deserves probes: a house, not the plain that it stands on.

#include <vector>

#include <ssphh/place/site.h>

namespace ssphh::place {

struct Regions {
  std::vector<scene::Bounds> boxes;  ///< the largest first; each takes a grid
  bool open_rest = false;            ///< what lies outside is open: it takes a sparse grid of its own
  /// What stands apart in them with the open between, as houses of a town do; mere lamp posts do not count.
  std::size_t structures = 1;
};

/// Of an axis-aligned box [m³].
inline double volume_of(const scene::Bounds& box) {
  const glm::dvec3 side(box.max - box.min);
  return side.x * side.y * side.z;
}

/// Boxes around what has detail, in which triangles of different directions lie side by side; the whole
/// bounds where that is not much less, or where the rest is not wide: nearly all of its places see the sky,
/// or, where the boxes are rooms, nothing within four times their size.
Regions detail_regions(const rays::TransportSource& source, const Control& control);

}  // namespace ssphh::place
