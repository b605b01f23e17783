#include <algorithm>
#include <array>

#include <ssphh/core/sphere.h>
#include <ssphh/place/sweep.h>

namespace ssphh::place {
namespace {

constexpr int most_poses = 256;
constexpr int part_fan = 48;

vec3 point(const mat4& m, const vec3& p) {
  return vec3(m * vec4(p, 1));
}

/// Farthest way of a corner of the box from one pose to the other.
float motion(const scene::Bounds& box, const mat4& from, const mat4& to) {
  float farthest = 0;
  for (const float x : {box.min.x, box.max.x}) {
    for (const float y : {box.min.y, box.max.y}) {
      for (const float z : {box.min.z, box.max.z}) {
        const vec3 corner(x, y, z);
        farthest = std::max(farthest, glm::distance(point(from, corner), point(to, corner)));
      }
    }
  }
  return farthest;
}

/// Whether the open segment from a to b may meet the box.
bool meets(const scene::Bounds& box, const vec3& a, const vec3& b) {
  return glm::all(glm::lessThanEqual(glm::min(a, b), box.max)) &&
         glm::all(glm::greaterThanEqual(glm::max(a, b), box.min));
}

}  // namespace

Sweep::Sweep(const rays::TransportSource& source, float step) : source_(source) {
  const float duration = source.duration();
  for (int index = 1; index < source.part_count(); ++index) {
    Part part{index, source.part_bounds(index), {}};
    if (part.bounds.empty()) continue;
    int poses = duration > 0 ? 9 : 1;
    const auto pose = [&](int i) {
      return source.part_pose(index,
                              duration * static_cast<float>(i) / static_cast<float>(std::max(poses - 1, 1)));
    };
    for (; poses > 1 && poses < most_poses; poses = std::min(2 * poses, most_poses)) {
      float farthest = 0;
      for (int i = 1; i < poses; ++i)
        farthest = std::max(farthest, motion(part.bounds, pose(i - 1), pose(i)));
      if (farthest <= step) break;
    }
    for (int i = 0; i < poses; ++i) part.to_part.push_back(glm::inverse(pose(i)));
    parts_.push_back(std::move(part));
  }
}

Sweep Sweep::at(const rays::TransportSource& source, float time) {
  Sweep sweep(source);
  for (int index = 1; index < source.part_count(); ++index) {
    const scene::Bounds bounds = source.part_bounds(index);
    if (!bounds.empty())
      sweep.parts_.push_back({index, bounds, {glm::inverse(source.part_pose(index, time))}});
  }
  return sweep;
}

const std::string* Sweep::passes(const vec3& position, float clearance) const {
  for (const Part& part : parts_) {
    for (const mat4& to_part : part.to_part) {
      const vec3 p = point(to_part, position);
      if (!glm::all(glm::greaterThanEqual(p, part.bounds.min - clearance)) ||
          !glm::all(glm::lessThanEqual(p, part.bounds.max + clearance))) {
        continue;
      }
      std::array<rays::RayQuery, part_fan> rays;
      std::array<rays::RayHit, part_fan> hits;
      for (int i = 0; i < part_fan; ++i) {
        rays[i] = {p, spherical_fibonacci(i, part_fan)};
      }
      source_.intersect(part.index, rays, hits);
      int backs = 0;
      bool near = false;
      for (const rays::RayHit& hit : hits) {
        if (hit.escaped()) continue;
        near = near || hit.distance < clearance;
        backs += hit.back ? 1 : 0;
      }
      if (near || 2 * backs > part_fan) return &source_.part_name(part.index);
    }
  }
  return nullptr;
}

bool Sweep::separates(const vec3& a, const vec3& b) const {
  for (const Part& part : parts_) {
    for (const mat4& to_part : part.to_part) {
      const vec3 from = point(to_part, a), to = point(to_part, b);
      if (!meets(part.bounds, from, to)) continue;
      const rays::RayQuery way{from, to - from, 1};
      std::uint8_t blocked = 0;
      source_.occluded(part.index, {&way, 1}, {&blocked, 1});
      if (blocked != 0) return true;
    }
  }
  return false;
}

}  // namespace ssphh::place
