#include "regions.h"

#include <algorithm>
#include <array>
#include <functional>
#include <map>
#include <set>

#include "draft.h"
#include "rooms.h"

namespace ssphh::place {
namespace {

constexpr float finest_voxels = 128, most_voxels = 32, least_voxels = 8;  ///< along the longest side
constexpr double alike_length = 0.9;  ///< of the mean of normals that are alike, at least
constexpr double points_per_voxel = 4;
constexpr double few_points = 0.1;     ///< of those in detail: the walls of a hall, a sign on a plain
constexpr double least_saving = 0.25;  ///< of a box's volume, at most, is worth to be found in it
constexpr std::size_t most_regions = 64;
constexpr double least_structure = 0.1;  ///< of the largest one's volume
constexpr int most_rounds = 4;           ///< each finds what is a thirty-second as large
constexpr int rest_places = 256;
constexpr float sky_share = 0.4f;      ///< of the rays of a place in the open, at least
constexpr double open_share = 0.95;    ///< of the places around regions in the open
constexpr double street_share = 0.85;  ///< of those between houses: of the places in one 0.78
constexpr float hall_size =
    4;  ///< median of the harmonic mean distances in a wide hall, in sides of the largest box

using Voxel = std::array<int, 3>;

struct Normals {
  glm::dvec3 sum{0};
  double count = 0;

  void add(const Normals& other) { sum += other.sum, count += other.count; }
  bool alike() const { return glm::length(sum) >= alike_length * count; }
};

/// Voxels of `size` from `origin` on in which normals differ; none where the points are too few to tell, or
/// where those in all other voxels differ from each other and are no few.
std::set<Voxel> detailed_voxels(const std::vector<rays::PartPoint>& points, const vec3& origin, float size) {
  std::map<Voxel, Normals> voxels;
  for (const rays::PartPoint& p : points) {
    const glm::ivec3 at(glm::floor((p.point.position - origin) / size));
    voxels[{at.x, at.y, at.z}].add({glm::dvec3(p.point.normal), 1});
  }
  std::set<Voxel> detailed;
  Normals in_detail, rest;
  for (const auto& [voxel, normals] : voxels) {
    if (!normals.alike()) detailed.insert(voxel);
    (normals.alike() ? rest : in_detail).add(normals);
  }
  const bool dense = in_detail.count >= points_per_voxel * static_cast<double>(detailed.size());
  if (!dense || (!rest.alike() && rest.count > few_points * in_detail.count)) return {};
  return detailed;
}

/// Boxes of voxels that touch each other, grown together where these overlap.
std::vector<scene::Bounds> boxes_of(std::set<Voxel> left, const vec3& origin, float size) {
  std::vector<scene::Bounds> boxes;
  while (!left.empty()) {
    std::vector<Voxel> component{*left.begin()};
    left.erase(left.begin());
    scene::Bounds box;
    for (std::size_t i = 0; i < component.size(); ++i) {
      const Voxel v = component[i];
      const vec3 corner = origin + size * vec3(v[0], v[1], v[2]);
      box.add(corner);
      box.add(corner + size);
      for (int n = 0; n < 27; ++n) {
        const auto neighbour = left.find({v[0] + n % 3 - 1, v[1] + n / 3 % 3 - 1, v[2] + n / 9 - 1});
        if (neighbour != left.end()) component.push_back(left.extract(neighbour).value());
      }
    }
    boxes.push_back(box);
  }
  return merged(std::move(boxes));
}

enum class Around { narrow, hall, open };

/// What the places in `bounds` but in none of the boxes see: most of them nothing near, or a share of
/// `enough_open` of them the sky.
Around look_outside(const rays::TransportSource& source, const scene::Bounds& bounds,
                    const std::vector<scene::Bounds>& boxes, double enough_open, const Control& control) {
  const std::vector<vec3> places = places_in(bounds, rest_places, [&](const vec3& place) {
    return std::ranges::none_of(boxes, [&](const scene::Bounds& box) { return inside(box, place); });
  });
  if (places.empty()) return Around::narrow;
  const std::vector<Site> sites = look_around(source, places, coarse_fan_size, control);
  const auto share = [&](const auto& is_so) {
    return static_cast<double>(std::ranges::count_if(sites, is_so)) / static_cast<double>(sites.size());
  };
  if (share([](const Site& site) { return site.escaped > sky_share; }) >= enough_open) return Around::open;
  float largest = 0;
  for (const scene::Bounds& box : boxes) largest = std::max(largest, max_component(box.max - box.min));
  const bool wide = share([&](const Site& site) { return site.harmonic > hall_size * largest; }) >= 0.5;
  return wide ? Around::hall : Around::narrow;
}

std::vector<rays::PartPoint> points_in(const std::vector<rays::PartPoint>& points,
                                       const scene::Bounds& bounds) {
  std::vector<rays::PartPoint> here;
  std::ranges::copy_if(points, std::back_inserter(here),
                       [&](const rays::PartPoint& p) { return inside(bounds, p.point.position); });
  return here;
}

/// Boxes around the detail of the points in `bounds`, which voxels of `size` tell; none where there is
/// nothing else.
std::vector<scene::Bounds> boxes_by_voxels(const std::vector<rays::PartPoint>& here,
                                           const scene::Bounds& bounds, float size) {
  const vec3 origin = bounds.min - 0.25f * size;
  std::vector<scene::Bounds> boxes = boxes_of(detailed_voxels(here, origin, size), origin, size);
  for (scene::Bounds& box : boxes) {
    // A quarter of a voxel more: triangles reach farther than their points.
    box.min = glm::max(box.min - 0.25f * size, bounds.min);
    box.max = glm::min(box.max + 0.25f * size, bounds.max);
  }
  return boxes;
}

std::vector<scene::Bounds> detail_boxes(const std::vector<rays::PartPoint>& points,
                                        const scene::Bounds& bounds) {
  const float extent = max_component(bounds.max - bounds.min);
  const std::vector<rays::PartPoint> here = points_in(points, bounds);
  std::vector<scene::Bounds> boxes;
  for (float voxels = most_voxels; voxels >= least_voxels && boxes.empty(); voxels /= 2)
    boxes = boxes_by_voxels(here, bounds, extent / voxels);
  return boxes;
}

/// Adds boxes around what stands apart in `bounds`, with nothing but the open between: houses of a town,
/// whether or not streets are wide enough to be worth grids of their own. `bounds` itself where nothing does.
void add_structures(const rays::TransportSource& source, const std::vector<rays::PartPoint>& points,
                    const scene::Bounds& bounds, int rounds, std::vector<scene::Bounds>& structures,
                    const Control& control) {
  const float extent = max_component(bounds.max - bounds.min);
  const std::vector<rays::PartPoint> here = points_in(points, bounds);
  for (float voxels = finest_voxels; rounds > 0 && voxels >= least_voxels; voxels /= 2) {
    const std::vector<scene::Bounds> boxes = boxes_by_voxels(here, bounds, extent / voxels);
    if (boxes.size() < 2 || look_outside(source, bounds, boxes, street_share, control) != Around::open)
      continue;
    for (const scene::Bounds& box : boxes) add_structures(source, here, box, rounds - 1, structures, control);
    return;
  }
  structures.push_back(bounds);
}

/// Whether probes gain by keeping to the boxes.
bool worth_it(const std::vector<scene::Bounds>& boxes, const scene::Bounds& bounds) {
  if (boxes.empty() || boxes.size() > most_regions) return false;
  double sum = 0;
  for (const scene::Bounds& box : boxes) sum += volume_of(box);
  return sum <= least_saving * volume_of(bounds);
}

/// Boxes around the detail in `bounds`, or else around its rooms; none where they are not worth it. Sets
/// `in_hall` where it is no sky that the rest sees.
std::vector<scene::Bounds> divide(const rays::TransportSource& source,
                                  const std::vector<rays::PartPoint>& points, const scene::Bounds& bounds,
                                  bool whole, bool& in_hall, const Control& control) {
  if (!(max_component(bounds.max - bounds.min) > 0)) return {};
  for (const bool rooms : {false, true}) {
    if (rooms && !whole) return {};
    const std::vector<scene::Bounds> boxes =
        rooms ? room_boxes(source, bounds, control) : detail_boxes(points, bounds);
    if (!worth_it(boxes, bounds)) continue;
    const Around around = look_outside(source, bounds, boxes, open_share, control);
    if (around == Around::narrow) continue;
    in_hall = in_hall || around == Around::hall;
    return boxes;
  }
  return {};
}

/// In all boxes, but for what is a mere lamp post beside the largest.
std::size_t count_structures(const rays::TransportSource& source, const std::vector<rays::PartPoint>& points,
                             const std::vector<scene::Bounds>& boxes, const Control& control) {
  std::vector<scene::Bounds> structures;
  for (const scene::Bounds& box : boxes)
    add_structures(source, points, box, most_rounds, structures, control);
  double largest = 0;
  for (const scene::Bounds& box : structures) largest = std::max(largest, volume_of(box));
  return static_cast<std::size_t>(std::ranges::count_if(
      structures, [&](const scene::Bounds& box) { return volume_of(box) >= least_structure * largest; }));
}

}  // namespace

Regions detail_regions(const rays::TransportSource& source, const Control& control) {
  scene::Bounds bounds = source.part_bounds(0);
  if (bounds.empty()) return {};
  // What lies on the border is inside.
  const vec3 margin(1e-3f * max_component(bounds.max - bounds.min));
  const std::vector<rays::PartPoint> points = source.sample_part(0, 0);
  Regions regions;
  bool in_hall = false;
  std::vector<scene::Bounds> left{{bounds.min - margin, bounds.max + margin}};
  for (int round = 0; round < most_rounds && !left.empty(); ++round) {
    std::vector<scene::Bounds> next;
    for (const scene::Bounds& box : left) {
      const std::vector<scene::Bounds> parts = divide(source, points, box, round == 0, in_hall, control);
      if (parts.empty()) regions.boxes.push_back(box);
      std::ranges::copy(parts, std::back_inserter(next));
    }
    left = std::move(next);
  }
  std::ranges::copy(left, std::back_inserter(regions.boxes));
  const bool undivided = regions.boxes.size() == 1 && regions.boxes[0].min == bounds.min - margin;
  // In a hall something fine may be a body: it takes no probes from the hall.
  const bool bodies = in_hall && !std::ranges::all_of(regions.boxes, [&](const scene::Bounds& box) {
                        return has_rooms(source, box);
                      });
  if (undivided || bodies || regions.boxes.size() > most_regions) {
    regions.boxes = {bounds};
  } else {
    std::ranges::stable_sort(regions.boxes, std::greater<>(), volume_of);
    regions.open_rest = true;
  }
  regions.structures = count_structures(source, points, regions.boxes, control);
  return regions;
}

}  // namespace ssphh::place
