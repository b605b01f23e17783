#include "gather_points.h"

#include <algorithm>
#include <numeric>

namespace ssphh::methods::vct {
namespace {

/// Parent voxel and main side.
struct Place {
  std::uint64_t key;
  const Patch* patch;
  bool moves;
  std::uint32_t index;
};

void add_places(std::span<const Patch> patches, bool moves, std::vector<Place>& places) {
  for (std::size_t i = 0; i < patches.size(); ++i) {
    const Cell c = voxel_cell(patches[i].voxel);
    const auto parent = std::uint64_t{voxel_key({c.x / 2, c.y / 2, c.z / 2})};
    places.push_back({parent << 3 | static_cast<std::uint64_t>(main_side(patches[i].normal)), &patches[i],
                      moves, static_cast<std::uint32_t>(i)});
  }
}

}  // namespace

int main_side(const vec3& normal) {
  const vec3 a = glm::abs(normal);
  const int axis = a.x >= a.y && a.x >= a.z ? 0 : a.y >= a.z ? 1 : 2;
  return 2 * axis + (normal[axis] < 0 ? 1 : 0);
}

GatherPoints gather_points(std::span<const Patch> still, std::span<const Patch> moving) {
  std::vector<Place> places;
  add_places(still, false, places);
  add_places(moving, true, places);
  std::ranges::stable_sort(places, {}, &Place::key);
  GatherPoints gather;
  gather.of_still.resize(still.size()), gather.of_moving.resize(moving.size());
  for (std::size_t begin = 0; begin < places.size();) {
    vec3 position(0), normal(0);
    float weight = 0;
    std::size_t end = begin;
    for (; end < places.size() && places[end].key == places[begin].key; ++end) {
      const Patch& patch = *places[end].patch;
      const float own = std::accumulate(patch.cover.begin(), patch.cover.end(), 0.0f);
      position += own * patch.position, normal += own * patch.normal, weight += own;
      (places[end].moves ? gather.of_moving : gather.of_still)[places[end].index] =
          static_cast<std::uint32_t>(gather.points.size());
    }
    // Normals with the same main direction never cancel.
    gather.points.push_back({position / weight, glm::normalize(normal)});
    begin = end;
  }
  return gather;
}

}  // namespace ssphh::methods::vct
