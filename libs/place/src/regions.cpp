#include "regions.h"

#include <algorithm>
#include <map>
#include <tuple>

#include "draft.h"

namespace ssphh::place {
namespace {

constexpr float most_voxels = 32, least_voxels = 8;  ///< along the longest side
constexpr double alike_length = 0.9;  ///< of the mean of normals that are alike, at least
constexpr double points_per_voxel = 4;
constexpr double least_saving = 0.25;  ///< of a box's volume, at most, is worth to be found in it
constexpr std::size_t most_regions = 64;
constexpr int most_rounds = 4;  ///< each finds what is a thirty-second as large
constexpr int rest_places = 256;
constexpr float sky_share = 0.4f;   ///< of the rays of a place in the open, at least
constexpr double open_share = 0.95;  ///< of places in the open

using Voxel = std::tuple<int, int, int>;

bool overlap(const scene::Bounds& a, const scene::Bounds& b) {
  return glm::all(glm::lessThan(a.min, b.max)) && glm::all(glm::lessThan(b.min, a.max));
}

struct Normals {
  glm::dvec3 sum{0};
  double count = 0;

  void add(const Normals& other) { sum += other.sum, count += other.count; }
  bool alike() const { return glm::length(sum) >= alike_length * count; }
};

/// Voxels of `size` from `origin` on in which normals differ; none where the points are too few to tell, or
/// where those in all other voxels differ from each other.
std::vector<Voxel> detailed_voxels(const std::vector<rays::PartPoint>& points, const vec3& origin,
                                   float size) {
  std::map<Voxel, Normals> voxels;
  for (const rays::PartPoint& p : points) {
    const glm::ivec3 at(glm::floor((p.point.position - origin) / size));
    voxels[{at.x, at.y, at.z}].add({glm::dvec3(p.point.normal), 1});
  }
  std::vector<Voxel> detailed;
  Normals in_detail, rest;
  for (const auto& [voxel, normals] : voxels) {
    if (!normals.alike()) detailed.push_back(voxel);
    (normals.alike() ? rest : in_detail).add(normals);
  }
  const bool dense = in_detail.count >= points_per_voxel * static_cast<double>(detailed.size());
  if (!dense || !rest.alike()) return {};
  return detailed;
}

/// Boxes of voxels that touch each other, grown together where these overlap.
std::vector<scene::Bounds> boxes_of(std::vector<Voxel> left, const vec3& origin, float size) {
  std::vector<scene::Bounds> boxes;
  while (!left.empty()) {
    std::vector<Voxel> component{left.back()};
    left.pop_back();
    scene::Bounds box;
    for (std::size_t i = 0; i < component.size(); ++i) {
      const auto [x, y, z] = component[i];
      box.add(origin + size * vec3(x, y, z));
      box.add(origin + size * vec3(x + 1, y + 1, z + 1));
      std::erase_if(left, [&](const Voxel& other) {
        const auto [ox, oy, oz] = other;
        const bool touches = std::abs(ox - x) <= 1 && std::abs(oy - y) <= 1 && std::abs(oz - z) <= 1;
        if (touches) component.push_back(other);
        return touches;
      });
    }
    boxes.push_back(box);
  }
  for (bool merged = true; merged;) {
    merged = false;
    for (std::size_t i = 0; i < boxes.size() && !merged; ++i) {
      for (std::size_t j = i + 1; j < boxes.size() && !merged; ++j) {
        if (!overlap(boxes[i], boxes[j])) continue;
        boxes[i].add(boxes[j].min);
        boxes[i].add(boxes[j].max);
        boxes.erase(boxes.begin() + static_cast<std::ptrdiff_t>(j));
        merged = true;
      }
    }
  }
  std::ranges::sort(boxes, std::greater<>(), volume_of);
  return boxes;
}

/// Whether nearly all places in `bounds` but in none of the boxes see the sky.
bool rest_is_open(const rays::TransportSource& source, const scene::Bounds& bounds,
                  const std::vector<scene::Bounds>& boxes, const Control& control) {
  std::vector<vec3> places;
  for (int i = 0; i < 8 * rest_places && static_cast<int>(places.size()) < rest_places; ++i) {
    // Roberts' R3 sequence.
    const vec3 u(glm::fract(glm::dvec3(0.5) + double(i) * glm::dvec3(0.8191725133961645, 0.6710436067037893,
                                                                     0.5497004779019703)));
    const vec3 place = bounds.min + u * (bounds.max - bounds.min);
    if (std::ranges::none_of(boxes, [&](const scene::Bounds& box) { return inside(box, place); }))
      places.push_back(place);
  }
  const std::vector<Site> sites = look_around(source, places, coarse_fan_size, control);
  const auto open = std::ranges::count_if(sites, [](const Site& site) { return site.escaped > sky_share; });
  return !sites.empty() && static_cast<double>(open) >= open_share * static_cast<double>(sites.size());
}

/// Boxes around the detail in `bounds`; none where they are not worth it.
std::vector<scene::Bounds> divide(const rays::TransportSource& source,
                                  const std::vector<rays::PartPoint>& points, const scene::Bounds& bounds,
                                  const Control& control) {
  const float extent = max_component(bounds.max - bounds.min);
  if (!(extent > 0)) return {};
  std::vector<rays::PartPoint> here;
  std::ranges::copy_if(points, std::back_inserter(here),
                       [&](const rays::PartPoint& p) { return inside(bounds, p.point.position); });
  std::vector<scene::Bounds> boxes;
  float size = 0;
  for (float voxels = most_voxels; voxels >= least_voxels && boxes.empty(); voxels /= 2) {
    size = extent / voxels;
    const vec3 origin = bounds.min - 0.25f * size;
    boxes = boxes_of(detailed_voxels(here, origin, size), origin, size);
  }
  if (boxes.empty() || boxes.size() > most_regions) return {};
  double sum = 0;
  for (scene::Bounds& box : boxes) {
    // A quarter of a voxel more: triangles reach farther than their points.
    box.min = glm::max(box.min - 0.25f * size, bounds.min);
    box.max = glm::min(box.max + 0.25f * size, bounds.max);
    sum += volume_of(box);
  }
  if (sum > least_saving * volume_of(bounds) || !rest_is_open(source, bounds, boxes, control)) return {};
  return boxes;
}

}  // namespace

Regions detail_regions(const rays::TransportSource& source, const Control& control) {
  scene::Bounds bounds = source.part_bounds(0);
  if (bounds.empty()) return {};
  // What lies on the border is inside.
  const vec3 margin(1e-3f * max_component(bounds.max - bounds.min));
  const std::vector<rays::PartPoint> points = source.sample_part(0, 0);
  Regions regions;
  std::vector<scene::Bounds> left{{bounds.min - margin, bounds.max + margin}};
  for (int round = 0; round < most_rounds && !left.empty(); ++round) {
    std::vector<scene::Bounds> next;
    for (const scene::Bounds& box : left) {
      const std::vector<scene::Bounds> parts = divide(source, points, box, control);
      if (parts.empty()) regions.boxes.push_back(box);
      std::ranges::copy(parts, std::back_inserter(next));
    }
    left = std::move(next);
  }
  std::ranges::copy(left, std::back_inserter(regions.boxes));
  if (regions.boxes.size() > most_regions || regions.boxes.size() == 1) {
    const bool whole = regions.boxes.size() > most_regions || regions.boxes[0].min == bounds.min - margin;
    if (whole) return {{bounds}, false};
  }
  std::ranges::stable_sort(regions.boxes, std::greater<>(), volume_of);
  regions.open_rest = true;
  return regions;
}

}  // namespace ssphh::place
