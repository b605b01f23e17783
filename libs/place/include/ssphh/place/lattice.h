#pragma once
/// The coarse grid, and which of several offsets suits a scene.

#include <ssphh/place/place.h>
#include <ssphh/place/site.h>

namespace ssphh::place {

/// Places origin + spacing · (i, j, k), those inside `box`.
struct Lattice {
  scene::Bounds box;
  vec3 origin{0};  ///< within one spacing of box.min
  float spacing = 1;
  glm::ivec3 size{0};  ///< number of places along each axis
};

/// The box; an axis along which it is thinner than `spacing` (a bare floor) is widened to it, upward for y.
scene::Bounds widened(scene::Bounds box, float spacing);

/// The bounds of part 0, widened. Throws Error when part 0 has no surface.
scene::Bounds lattice_box(const rays::TransportSource& source, float spacing);

/// Place `i` of those that fill the unit cube evenly (Roberts 2018, R3: powers of the plastic constant's
/// sibling for three dimensions).
inline vec3 spread_in_cube(int i) {
  return glm::fract(static_cast<float>(i) * vec3(0.8191725f, 0.6710436f, 0.5497005f) + 0.5f);
}

/// Number of places that a lattice of this spacing has, about; infinite where it overflows.
double lattice_places(const scene::Bounds& box, float spacing);

/// Throws Error for a spacing of 0 or less, no number, or of more than 2^28 places.
Lattice make_lattice(const scene::Bounds& box, float spacing, const vec3& offset);

/// Of the box, widened: centred, and at eight offsets that fill the cell evenly. Each counts its valid
/// places, less those nearer than a quarter of the spacing to a surface in proportion: a column of probes
/// that falls into a wall hides what the wall's sides are lit by. A place over the box itself counts a
/// hundredth: of flat scenes the rooms are meant, not the air above their roofs. The best one; ties go to the
/// first.
Lattice choose_lattice(const rays::TransportSource& source, const scene::Bounds& box, float spacing,
                       const SiteRules& rules, const Control& control);

inline vec3 lattice_point(const Lattice& lattice, const glm::ivec3& index) {
  return lattice.origin + lattice.spacing * vec3(index);
}
std::vector<vec3> lattice_points(const Lattice& lattice);

}  // namespace ssphh::place
