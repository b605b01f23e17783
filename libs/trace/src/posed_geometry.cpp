#include "posed_geometry.h"

#include <algorithm>
#include <cmath>

#include <ssphh/rays/posed_world.h>

#include "glass_passage.h"
#include "surface_gap.h"
#include "sweep.h"

namespace ssphh::trace {

PosedGeometry::PosedGeometry(const ShadedGeometry& geometry, std::span<const mat4> poses)
    : geometry_(geometry) {
  pose(poses);
}

void PosedGeometry::pose(std::span<const mat4> poses) {
  bounds_ = geometry_.layout().parts[0].bounds;
  moving_.clear();
  boxes_.clear();
  for (std::size_t i = 1; i < poses.size(); ++i) {
    const scene::Bounds& bounds = geometry_.layout().parts[i].bounds;
    const float det = glm::determinant(mat3(poses[i]));
    if (bounds.empty() || !(std::abs(det) > 0) || !std::isfinite(1 / det)) continue;
    const mat4 from_world = glm::inverse(poses[i]);
    const float rounding = 4 * position_error(scene_size(bounds) + max_abs_component(vec3(from_world[3])));
    moving_.push_back({static_cast<int>(i), poses[i], from_world, glm::transpose(mat3(from_world)),
                       grown(bounds, rounding)});
    const scene::Bounds box = rays::transformed(bounds, poses[i]);
    bounds_.add(box.min), bounds_.add(box.max);
    boxes_.push_back(grown(box, 4 * position_error(scene_size(box) + max_abs_component(vec3(poses[i][3])))));
  }
  tree_.assign(boxes_);
}

bool PosedGeometry::MovingPart::may_meet(const Ray& ray) const {
  return sweep_meets(ray.origin, {ray.direction, ray.direction}, ray.t_max, bounds);
}

bool PosedGeometry::intersect(const Ray& ray, const Passage& passage, RayTask& task, Hit& hit) const {
  ++task.rays;
  if (task.record) task.record->push_back({ray.origin, ray.t_max, ray.direction, false});
  bool found = geometry_.intersect(0, ray, passage, hit);
  float nearest = found ? hit.distance : ray.t_max;
  tree_.any(ray, nearest, [&](std::uint32_t i) {
    const MovingPart& part = moving_[i];
    Ray local = part.in_frame(ray);
    local.t_max = nearest;
    if (part.may_meet(local) && geometry_.intersect(part.index, local, passage, hit)) {
      found = true;
      nearest = hit.distance;
    }
    return false;
  });
  return found;
}

bool PosedGeometry::occluded(const Ray& ray, const Passage& passage, RayTask& task) const {
  bool met_glass = false;
  return occluded(ray, passage, task, met_glass);
}

vec3 PosedGeometry::transmittance(const Ray& ray, const Passage& passage, RayTask& task) const {
  bool met_glass = false;
  if (occluded(ray, passage, task, met_glass)) return vec3(0);
  if (!met_glass) return vec3(1);
  return through_glass(
      ray,
      [&](const Ray& rest, Hit& hit) {
        return intersect(rest, {passage.seed, PassedGlass::none}, task, hit);
      },
      [&](const Hit& hit, const vec3& wo, vec3& ray_origin) { return surface(hit, wo, ray_origin); });
}

bool PosedGeometry::occluded(const Ray& ray, const Passage& passage, RayTask& task, bool& met_glass) const {
  if (!(ray.t_max > 0)) return false;
  ++task.rays;
  if (task.record) task.record->push_back({ray.origin, ray.t_max, ray.direction, true});
  if (geometry_.occluded(0, ray, passage, met_glass)) return true;
  return tree_.any(ray, ray.t_max, [&](std::uint32_t i) {
    const MovingPart& part = moving_[i];
    const Ray local = part.in_frame(ray);
    return part.may_meet(local) && geometry_.occluded(part.index, local, passage, met_glass);
  });
}

const PosedGeometry::MovingPart* PosedGeometry::moving_part_of(const Hit& hit) const {
  if (moving_.empty()) return nullptr;
  const int part = geometry_.part_of(hit.instance);
  return part == 0 ? nullptr : &*std::ranges::lower_bound(moving_, part, {}, &MovingPart::index);
}

shading::Surface PosedGeometry::surface(const Hit& hit, const vec3& wo, vec3& ray_origin) const {
  const MovingPart* part = moving_part_of(hit);
  return part ? geometry_.posed_surface(hit, part->pose, part->normal_matrix, wo, ray_origin)
              : geometry_.surface(hit, wo, ray_origin);
}

bool PosedGeometry::is_back(const Hit& hit, const vec3& direction) const {
  const MovingPart* part = moving_part_of(hit);
  return geometry_.is_back(hit, part ? mat3(part->from_world) * direction : direction);
}

}  // namespace ssphh::trace
