#include "rooms.h"

#include <algorithm>
#include <cmath>
#include <functional>

#include <ssphh/core/sphere.h>
#include <ssphh/geometry/near_grid.h>

#include "regions.h"

namespace ssphh::place {
namespace {

constexpr int inside_places = 256;
constexpr float walled_share = 0.8f, room_share = 0.03f;  ///< of a place's rays; of a box's places
constexpr int flood_places = 4096;
constexpr std::size_t least_places = 16;  ///< of a room that counts
constexpr float flood_reach = 6;          ///< between neighbours, in mean distances of the places

/// Groups of places that see each other from neighbour to neighbour, at most `reach` apart.
std::vector<std::vector<vec3>> groups_of(const rays::TransportSource& source, const std::vector<vec3>& places,
                                         float reach) {
  geometry::NearGrid grid(reach);
  for (const vec3& place : places) grid.add(place);
  std::vector<bool> taken(places.size(), false);
  std::vector<std::vector<vec3>> groups;
  for (std::size_t first = 0; first < places.size(); ++first) {
    if (taken[first]) continue;
    taken[first] = true;
    std::vector<vec3> group{places[first]};
    for (std::size_t i = 0; i < group.size(); ++i) {
      const vec3 from = group[i];
      for (const std::uint32_t k : grid.near(from, reach)) {
        if (taken[k] || !sees(source, from, places[k])) continue;
        taken[k] = true;
        group.push_back(places[k]);
      }
    }
    groups.push_back(std::move(group));
  }
  return groups;
}

bool overlap(const scene::Bounds& a, const scene::Bounds& b) {
  return glm::all(glm::lessThan(a.min, b.max)) && glm::all(glm::lessThan(b.min, a.max));
}

}  // namespace

std::vector<scene::Bounds> merged(std::vector<scene::Bounds> boxes) {
  for (bool changed = true; changed;) {
    changed = false;
    for (std::size_t i = 0; i < boxes.size() && !changed; ++i) {
      for (std::size_t j = i + 1; j < boxes.size() && !changed; ++j) {
        if (!overlap(boxes[i], boxes[j])) continue;
        boxes[i].add(boxes[j].min);
        boxes[i].add(boxes[j].max);
        boxes.erase(boxes.begin() + static_cast<std::ptrdiff_t>(j));
        changed = true;
      }
    }
  }
  std::ranges::sort(boxes, std::greater<>(), volume_of);
  return boxes;
}

bool has_rooms(const rays::TransportSource& source, const scene::Bounds& box) {
  const std::vector<vec3> places = places_in(box, inside_places, [](const vec3&) { return true; });
  std::vector<rays::RayQuery> rays;
  for (const vec3& place : places) {
    for (int i = 0; i < coarse_fan_size; ++i)
      rays.push_back({place, spherical_fibonacci(i, coarse_fan_size), glm::distance(box.min, box.max)});
  }
  std::vector<rays::RayHit> hits(rays.size());
  source.intersect(0, rays, hits);
  int walled = 0;
  for (std::size_t p = 0; p < places.size(); ++p) {
    const auto first = hits.begin() + static_cast<std::ptrdiff_t>(p * coarse_fan_size);
    walled += std::count_if(first, first + coarse_fan_size, [](const rays::RayHit& hit) {
                return !hit.escaped() && !hit.back;
              }) > walled_share * coarse_fan_size;
  }
  return walled > room_share * static_cast<float>(places.size());
}

std::vector<scene::Bounds> room_boxes(const rays::TransportSource& source, const scene::Bounds& bounds,
                                      const Control& control) {
  const std::vector<vec3> all = places_in(bounds, flood_places, [](const vec3&) { return true; });
  const std::vector<Site> sites = look_around(source, all, coarse_fan_size, control);
  std::vector<vec3> within;
  for (std::size_t i = 0; i < all.size(); ++i) {
    if ((1 - sites[i].escaped) * (1 - sites[i].back) > walled_share) within.push_back(all[i]);
  }
  const auto apart = static_cast<float>(std::cbrt(volume_of(bounds) / flood_places));
  std::vector<scene::Bounds> boxes;
  for (const std::vector<vec3>& group : groups_of(source, within, flood_reach * apart)) {
    if (group.size() < least_places) continue;
    scene::Bounds& box = boxes.emplace_back();
    for (const vec3& place : group) box.add(place);
    // The walls stand about that much farther.
    box.min = glm::max(box.min - 0.25f * apart, bounds.min);
    box.max = glm::min(box.max + 0.25f * apart, bounds.max);
  }
  return merged(std::move(boxes));
}

}  // namespace ssphh::place
