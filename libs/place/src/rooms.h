#pragma once
/// What is walled in: rooms, halls, tunnels, whatever they look like from outside.

#include <vector>

#include <ssphh/place/lattice.h>
#include <ssphh/place/site.h>

namespace ssphh::place {

/// Boxes that overlap grown together; the largest first.
std::vector<scene::Bounds> merged(std::vector<scene::Bounds> boxes);

/// Places spread over a box, `count` of those that `wanted` takes, or fewer.
template <class Wanted>
std::vector<vec3> places_in(const scene::Bounds& box, int count, const Wanted& wanted) {
  std::vector<vec3> places;
  for (int i = 0; i < 8 * count && static_cast<int>(places.size()) < count; ++i) {
    const vec3 place = box.min + spread_in_cube(i) * (box.max - box.min);
    if (wanted(place)) places.push_back(place);
  }
  return places;
}

/// Whether a good share of the places in a box is walled in by what is in the box: rooms, not a body.
bool has_rooms(const rays::TransportSource& source, const scene::Bounds& box);

/// Boxes around the places in `bounds` that are walled in, one for those that see each other from neighbour
/// to neighbour: of 4096 places, rooms that hold 16 or more of them.
std::vector<scene::Bounds> room_boxes(const rays::TransportSource& source, const scene::Bounds& bounds,
                                      const Control& control);

}  // namespace ssphh::place
