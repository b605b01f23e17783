/// What rays of the world meet, and the surfels of it.

#include <algorithm>
#include <array>
#include <cmath>

#include <ssphh/core/random.h>
#include <ssphh/core/sphere.h>

#include "network_data.h"

namespace ssphh::transport {
namespace {

rays::SurfacePoint transformed(const rays::SurfacePoint& p, const mat4& matrix) {
  const mat3 linear(matrix);
  return {vec3(matrix * vec4(p.position, 1)),
          glm::normalize(glm::transpose(glm::inverse(linear)) * p.normal)};
}

}  // namespace

rays::RayQuery transformed(const rays::RayQuery& ray, const mat4& matrix) {
  return {vec3(matrix * vec4(ray.origin, 1)), mat3(matrix) * ray.direction, ray.t_max};
}

rays::RayQuery fan_ray(const rays::SurfacePoint& from, float lift, std::uint32_t index, std::size_t salt) {
  const std::uint64_t h = mix64(salt);
  const double u = 0.7548776662466927 * (index + 1) + static_cast<double>(h >> 32) * 0x1p-32;
  const double v = 0.5698402909980532 * (index + 1) + static_cast<double>(h & 0xffffffffu) * 0x1p-32;
  const vec2 p{static_cast<float>(u - std::floor(u)), static_cast<float>(v - std::floor(v))};
  const vec3 local = sample_cosine_hemisphere(glm::min(p, vec2(0x1.fffffep-1f)));
  return {from.position + lift * from.normal, Frame::around(from.normal).to_world(local)};
}

bool meets(const rays::RayQuery& ray, const scene::Bounds& box) {
  float near = 0, far = ray.t_max;
  for (int axis = 0; axis < 3; ++axis) {
    const float inverse = 1 / ray.direction[axis];
    const float a = (box.min[axis] - ray.origin[axis]) * inverse;
    const float b = (box.max[axis] - ray.origin[axis]) * inverse;
    // A ray in the plane of a side gives NaN, which min and max of this form pass over.
    near = std::max(near, std::fmin(a, b));
    far = std::min(far, std::fmax(a, b) * (1 + 1e-5f) + 1e-6f);
  }
  return near <= far;
}

bool meets_any(const rays::RayQuery& ray, const std::vector<scene::Bounds>& boxes) {
  return std::any_of(boxes.begin(), boxes.end(),
                     [&](const scene::Bounds& box) { return !box.empty() && meets(ray, box); });
}

rays::SurfacePoint TransportNetwork::Data::to_world(int part, const rays::SurfacePoint& point) const {
  return part == 0 ? point : transformed(point, poses[part]);
}

rays::RayQuery TransportNetwork::Data::sample_segment(std::size_t sample) const {
  const std::size_t s = sample / sample_count();
  const Surfel& surfel = surfels.surfels()[s];
  return SurfelSet::segment(surfel.point, surfel.height, local_samples[sample], surfel.height);
}

bool TransportNetwork::Data::parts_block(const rays::RayQuery& segment) const {
  for (const PlacedPart& p : placed) {
    const rays::RayQuery local = transformed(segment, p.to_part);
    if (!meets(local, p.bounds)) continue;
    std::uint8_t hit = 0;
    source.occluded(p.part, {&local, 1}, {&hit, 1});
    if (hit) return true;
  }
  return false;
}

bool TransportNetwork::Data::blocked(const rays::RayQuery& segment) const {
  std::uint8_t hit = 0;
  source.occluded(0, {&segment, 1}, {&hit, 1});
  return hit || parts_block(segment);
}

bool TransportNetwork::Data::covered(int part, const rays::SurfacePoint& point) const {
  const vec3 lift = link_lift * surfels.size() * point.normal;
  const rays::RayQuery through{point.position - lift, 2.0f * lift, 1};
  std::uint8_t hit = 0;
  if (part != 0) source.occluded(0, {&through, 1}, {&hit, 1});
  for (std::size_t p = 0; p < placed.size() && !hit; ++p) {
    if (placed[p].part == part) continue;
    const rays::RayQuery local = transformed(through, placed[p].to_part);
    if (meets(local, placed[p].bounds)) source.occluded(placed[p].part, {&local, 1}, {&hit, 1});
  }
  return hit != 0;
}

int TransportNetwork::Data::find(int part, const rays::SurfacePoint& point) const {
  if (part > 0) {
    // A ray that starts within a body, where another touches it, meets its inside: nothing lights that, and
    // within a body thinner than the lift sight would start on its far side.
    const float start = link_lift * surfels.size();
    const rays::RayQuery lift{point.position + start * point.normal,
                              1.05f * surfels.lift(surfels.level(part, point.position)) * point.normal, 1};
    std::uint8_t inside = 0;
    source.occluded(part, {&lift, 1}, {&inside, 1});
    if (inside) return no_patch;
  }
  const rays::SurfacePoint world = to_world(part, point);
  const float height = surfels.height(part, point);
  return find_nearest(part, point, [&](int s) {
    const Surfel& surfel = surfels.surfels()[s];
    return !blocked(SurfelSet::segment(world, height, to_world(part, surfel.point), surfel.height));
  });
}

int TransportNetwork::Data::find_static(const rays::SurfacePoint& point) const {
  const float height = surfels.height(0, point);
  return find_nearest(0, point, [&](int s) {
    const Surfel& surfel = surfels.surfels()[s];
    const rays::RayQuery way = SurfelSet::segment(point, height, surfel.point, surfel.height);
    std::uint8_t hit = 0;
    source.occluded(0, {&way, 1}, {&hit, 1});
    return !hit;
  });
}

bool TransportNetwork::Data::near_parts(const MovingRay& way) const {
  if (swept.size() < 2) return false;
  const auto before = way.way_before();
  if (meets_any(way.ray, swept) || (before && meets_any(*before, swept))) return true;
  if (way.patch == no_patch) return false;
  const rays::SurfacePoint point{way.ray.origin + way.ray.t_max * way.ray.direction, way.normal};
  const Surfel& met = surfel_of(way.patch);
  return meets_any(SurfelSet::segment(point, met.height, met.point, met.height), swept);
}

template <class Sees>
int TransportNetwork::Data::find_nearest(int part, const rays::SurfacePoint& point, const Sees& sees) const {
  for (const int s : surfels.cell(part, point)) {
    if (sees(s)) return patch_at(s, point.position);
  }
  std::array<int, 12> room;
  for (const int s : surfels.candidates(part, point, room)) {
    if (sees(s)) return patch_at(s, point.position);
  }
  return no_patch;
}

std::int32_t TransportNetwork::Data::patch_at(int surfel, const vec3& point) const {
  const std::size_t m = sample_count(), first = static_cast<std::size_t>(surfel) * m;
  std::size_t nearest = first;
  float least = std::numeric_limits<float>::infinity();
  for (std::size_t i = first; i < first + m && i < sample_exists.size() && sample_exists[i]; ++i) {
    const vec3 away = local_samples[i].position - point;
    if (const float distance2 = glm::dot(away, away); distance2 < least) least = distance2, nearest = i;
  }
  return static_cast<std::int32_t>(nearest);
}

bool TransportNetwork::Data::meet_part(rays::RayQuery& ray, rays::RayHit& hit, int& part) const {
  bool any = false;
  for (const PlacedPart& p : placed) {
    const rays::RayQuery local = transformed(ray, p.to_part);
    if (!meets(local, p.bounds)) continue;
    rays::RayHit found;
    source.intersect(p.part, {&local, 1}, {&found, 1});
    if (!(found.distance < ray.t_max)) continue;
    ray.t_max = found.distance;
    hit = found;
    part = p.part;
    any = true;
  }
  return any;
}

std::optional<Resolved> TransportNetwork::Data::resolve_part(rays::RayQuery ray) const {
  rays::RayHit hit;
  int part = 0;
  if (!meet_part(ray, hit, part)) return std::nullopt;
  const PlacedPart& p = placed[part - 1];
  const vec3 position = vec3(p.to_part * vec4(ray.origin + ray.t_max * ray.direction, 1));
  // The part's palette entries were made when the network was built.
  return Resolved{find(part, {position, hit.normal}), pack_albedo(hit.albedo),
                  gbuffer.palette.find(hit.emission, hit.group), ray.t_max};
}

Resolved TransportNetwork::Data::resolve(const MovingRay& unobstructed) const {
  if (const auto before = unobstructed.way_before()) {
    if (const auto met = resolve_part(*before)) return *met;
  }
  const rays::RayQuery& ray = unobstructed.ray;
  if (const auto met = resolve_part(ray)) return *met;
  if (unobstructed.patch == no_patch)
    return {no_patch, unobstructed.albedo, unobstructed.emission, ray.t_max};
  const rays::SurfacePoint point{ray.origin + ray.t_max * ray.direction, unobstructed.normal};
  const Surfel& surfel = surfel_of(unobstructed.patch);
  const bool hidden = parts_block(SurfelSet::segment(point, surfel.height, surfel.point, surfel.height));
  return {hidden ? find(0, point) : unobstructed.patch, unobstructed.albedo, unobstructed.emission,
          ray.t_max};
}

void TransportNetwork::Data::see_one(rays::RayQuery ray, rays::RayHit& hit, int& patch) const {
  ray.t_max = std::min(ray.t_max, hit.distance);
  int part = 0;
  if (!meet_part(ray, hit, part) && hit.escaped()) return;
  vec3 position = ray.origin + ray.t_max * ray.direction;
  if (part > 0) position = vec3(placed[part - 1].to_part * vec4(position, 1));
  patch = find(part, {position, hit.normal});
}

}  // namespace ssphh::transport
