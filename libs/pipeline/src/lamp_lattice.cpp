#include <algorithm>
#include <bit>
#include <cmath>

#include <fmt/format.h>

#include <ssphh/core/math.h>
#include <ssphh/core/parallel.h>
#include <ssphh/core/require.h>
#include <ssphh/core/sphere.h>
#include <ssphh/pipeline/lamp_lattice.h>
#include <ssphh/rays/posed_world.h>

namespace ssphh::pipeline {
namespace {

constexpr float gap = 0.01f;  ///< between a lamp and a surface, at least [m]
constexpr int fan_rays = 64;  ///< by which surfaces near a place are found
constexpr int corner_count = 8;

glm::ivec3 corner_side(int corner) {
  return {corner & 1, corner >> 1 & 1, corner >> 2 & 1};
}

std::size_t index_in(const glm::ivec3& size, const glm::ivec3& at) {
  return (static_cast<std::size_t>(at.z) * static_cast<std::size_t>(size.y) +
          static_cast<std::size_t>(at.y)) *
             static_cast<std::size_t>(size.x) +
         static_cast<std::size_t>(at.x);
}

/// The other way round.
glm::ivec3 at_index(const glm::ivec3& size, std::size_t index) {
  const auto i = static_cast<int>(index);
  return {i % size.x, i / size.x % size.y, i / size.x / size.y};
}

std::size_t count_in(const glm::ivec3& size) {
  return index_in(size, {0, 0, size.z});
}

glm::ivec3 crossings(const LampLattice& lattice) {
  return {lattice.planes[0].size(), lattice.planes[1].size(), lattice.planes[2].size()};
}

/// All poses at once: what blocks in one is in the way.
class Poses {
 public:
  Poses(const rays::TransportSource& source, std::span<const float> times) {
    for (const float time : times) worlds_.emplace_back(source, time);
  }
  bool visible(const vec3& a, const vec3& b) const {
    return std::ranges::all_of(worlds_, [&](const rays::PosedWorld& world) { return world.visible(a, b); });
  }
  bool clear(const vec3& at, float distance) const {
    std::array<rays::RayQuery, fan_rays> fan;
    for (int i = 0; i < fan_rays; ++i) fan[i] = {at, spherical_fibonacci(i, fan_rays), distance};
    std::array<std::uint8_t, fan_rays> blocked{};
    return std::ranges::all_of(worlds_, [&](const rays::PosedWorld& world) {
      world.occluded(fan, blocked);
      return std::ranges::find(blocked, 1) == blocked.end();
    });
  }

 private:
  std::vector<rays::PosedWorld> worlds_;
};

/// Boxes as far as the reach on both sides of the lamp's place.
struct Surroundings {
  vec3 home;
  float box;
  int half;  ///< boxes on each side
  glm::ivec3 size() const { return glm::ivec3(2 * half); }
  vec3 middle(const glm::ivec3& at) const { return home + box * (vec3(at - half) + 0.5f); }
};

/// 1 for boxes that can be reached, ring after ring from the lamp's own place.
std::vector<std::uint8_t> reached(const Surroundings& around, const Poses& poses, float clearance,
                                  const Control& control) {
  const glm::ivec3 size = around.size();
  std::vector<std::uint8_t> free(count_in(size), 0);
  std::vector<glm::ivec3> ring;
  for (int c = 0; c < corner_count; ++c) {
    const glm::ivec3 at = corner_side(c) + around.half - 1;
    if (!poses.visible(around.home, around.middle(at))) continue;
    free[index_in(size, at)] = 1;
    ring.push_back(at);
  }
  while (!ring.empty()) {
    control.check();
    std::vector<std::pair<glm::ivec3, glm::ivec3>> next;  // a box, and the one it is come to from
    for (const glm::ivec3& at : ring) {
      for (int axis = 0; axis < 3; ++axis) {
        for (const int way : {-1, 1}) {
          glm::ivec3 to = at;
          to[axis] += way;
          if (to[axis] < 0 || to[axis] >= size[axis] || free[index_in(size, to)]) continue;
          next.emplace_back(to, at);
        }
      }
    }
    std::vector<std::uint8_t> open(next.size(), 0);
    parallel_for(next.size(), 16, [&](std::size_t i) {
      const vec3 to = around.middle(next[i].first);
      open[i] = poses.visible(around.middle(next[i].second), to) && poses.clear(to, clearance);
    });
    ring.clear();
    for (std::size_t i = 0; i < next.size(); ++i) {
      std::uint8_t& there = free[index_in(size, next[i].first)];
      if (!open[i] || there) continue;
      there = 1;
      ring.push_back(next[i].first);
    }
  }
  return free;
}

/// Planes from `first` to `last` boxes, `home` among them, evenly between it and the ends.
std::vector<int> planes_between(int first, int home, int last) {
  std::vector<int> planes;
  const auto add = [&](int from, int to) {
    const int steps = (to - from + boxes_per_spacing - 1) / boxes_per_spacing;
    for (int k = 0; k < steps; ++k) planes.push_back(from + (to - from) * k / steps - first);
  };
  add(first, home);
  add(home, last);
  planes.push_back(last - first);
  return planes;
}

/// The cell of a box along an axis: index of the plane below it.
int cell_of(const std::vector<int>& planes, int box) {
  return static_cast<int>(std::ranges::upper_bound(planes, box) - planes.begin()) - 1;
}

/// The crossing at a corner of the cell that a box lies in.
glm::ivec3 corner_of(const LampLattice& lattice, const glm::ivec3& box, int corner) {
  glm::ivec3 at = corner_side(corner);
  for (int axis = 0; axis < 3; ++axis) at[axis] += cell_of(lattice.planes[axis], box[axis]);
  return at;
}

vec3 crossing_place(const LampLattice& lattice, const glm::ivec3& at) {
  return lattice.origin +
         lattice.box * vec3(lattice.planes[0][at.x], lattice.planes[1][at.y], lattice.planes[2][at.z]);
}

void check(const LampLatticeParams& params) {
  const auto positive = [](float x) { return x > 0 && std::isfinite(x); };
  require(positive(params.spacing), "lattice of a lamp", "its spacing must be over 0 m");
  require(positive(params.reach), "lattice of a lamp", "its reach must be over 0 m");
  require(params.radius >= 0 && std::isfinite(params.radius), "lattice of a lamp",
          "its radius must not be negative");
  const double along = 2 * std::ceil(double{params.reach} / params.spacing) + 1,
               places = along * along * along;
  if (places <= most_lamp_places) return;
  throw Error("lattice of a lamp",
              fmt::format("places {:.3g} m apart as far as {:.3g} m are {:.0f}, and {:.0f} is the most",
                          params.spacing, params.reach, places, most_lamp_places),
              "set them farther apart, or reach less far");
}

}  // namespace

LampLattice lamp_lattice(const rays::TransportSource& source, std::span<const float> times, const vec3& home,
                         const LampLatticeParams& params, const Control& control) {
  check(params);
  require(is_finite(home) && !times.empty(), "lattice of a lamp", "it needs a place and a time");
  const float box = std::min(params.spacing, params.reach) / boxes_per_spacing;
  const Surroundings around{home, box, static_cast<int>(std::ceil(params.reach / box - 1e-3f))};
  const Poses poses(source, times);
  const float half_diagonal = box * std::sqrt(3.0f) / 2;
  const std::vector<std::uint8_t> free = reached(around, poses, half_diagonal + params.radius + gap, control);

  const glm::ivec3 size = around.size();
  glm::ivec3 first = size, last(0);
  for (std::size_t i = 0; i < free.size(); ++i)
    if (free[i]) first = glm::min(first, at_index(size, i)), last = glm::max(last, at_index(size, i) + 1);
  if (glm::any(glm::greaterThanEqual(first, last)))
    throw Error("lattice of a lamp", "there is no free space around it: it cannot be moved");

  LampLattice lattice;
  lattice.box = box, lattice.boxes = last - first;
  lattice.origin = home + box * vec3(first - around.half);
  for (int axis = 0; axis < 3; ++axis)
    lattice.planes[axis] =
        planes_between(first[axis], std::clamp(around.half, first[axis], last[axis]), last[axis]);
  lattice.seen.assign(count_in(lattice.boxes), 0);
  parallel_for(lattice.seen.size(), 16, [&](std::size_t i) {
    const glm::ivec3 at = at_index(lattice.boxes, i);
    if (!free[index_in(size, at + first)]) return;
    for (int c = 0; c < corner_count; ++c)
      if (poses.visible(around.middle(at + first), crossing_place(lattice, corner_of(lattice, at, c))))
        lattice.seen[i] |= static_cast<std::uint8_t>(1 << c);
  });

  const glm::ivec3 planes = crossings(lattice);
  std::vector<std::uint8_t> needed(count_in(planes), 0);
  for (std::size_t i = 0; i < lattice.seen.size(); ++i)
    for (int c = 0; c < corner_count; ++c)
      if (lattice.seen[i] >> c & 1)
        needed[index_in(planes, corner_of(lattice, at_index(lattice.boxes, i), c))] = 1;
  lattice.place_of.assign(needed.size(), -1);
  for (std::size_t i = 0; i < needed.size(); ++i) {
    if (!needed[i]) continue;
    lattice.place_of[i] = static_cast<std::int32_t>(lattice.places.size());
    lattice.places.push_back(crossing_place(lattice, at_index(planes, i)));
  }
  return lattice;
}

std::array<LampShare, 8> lamp_shares(const LampLattice& lattice, const vec3& at) {
  std::array<LampShare, 8> shares;
  const vec3 place = (at - lattice.origin) / lattice.box;
  glm::ivec3 box(0), cell(0);
  vec3 share;
  for (int axis = 0; axis < 3; ++axis) {
    // What stands on the last border counts as inside; beyond is nowhere.
    if (!(place[axis] >= 0 && place[axis] <= static_cast<float>(lattice.boxes[axis]))) return shares;
    const std::vector<int>& planes = lattice.planes[axis];
    box[axis] = std::min(static_cast<int>(place[axis]), lattice.boxes[axis] - 1);
    cell[axis] = cell_of(planes, box[axis]);
    const auto low = static_cast<float>(planes[cell[axis]]),
               high = static_cast<float>(planes[cell[axis] + 1]);
    share[axis] = (place[axis] - low) / (high - low);
  }
  const std::uint8_t seen = lattice.seen[index_in(lattice.boxes, box)];
  float sum = 0;
  for (int c = 0; c < corner_count; ++c) {
    if (!(seen >> c & 1)) continue;
    const glm::ivec3 side = corner_side(c);
    const vec3 parts = glm::mix(1.0f - share, share, vec3(side));
    shares[c] = {lattice.place_of[index_in(crossings(lattice), cell + side)], parts.x * parts.y * parts.z};
    sum += shares[c].weight;
  }
  // Right at a corner that is not seen the others count alike.
  for (LampShare& one : shares)
    if (one.place >= 0)
      one.weight = sum > 0 ? one.weight / sum : 1.0f / static_cast<float>(std::popcount(seen));
  return shares;
}

}  // namespace ssphh::pipeline
