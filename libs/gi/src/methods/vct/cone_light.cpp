#include <algorithm>
#include <cmath>

#include <ssphh/gi/vct/cone_light.h>

namespace ssphh::gi::vct {
namespace {

/// Where a ray leaves the box [0, size]; 0 for one that starts outside and goes away.
float way_out(const vec3& origin, const vec3& direction, const vec3& size) {
  float t = std::numeric_limits<float>::infinity();
  for (int axis = 0; axis < 3; ++axis) {
    if (direction[axis] == 0) continue;
    const float wall = direction[axis] > 0 ? size[axis] : 0.0f;
    t = std::min(t, (wall - origin[axis]) / direction[axis]);
  }
  return std::max(t, 0.0f);
}

/// What a direction meets in a voxel: the three sides toward it, weighted by its components.
struct Facing {
  std::array<std::size_t, 3> side;
  vec3 weight;

  explicit Facing(const vec3& direction) : weight(glm::abs(direction)) {
    for (int axis = 0; axis < 3; ++axis)
      side[static_cast<std::size_t>(axis)] = static_cast<std::size_t>(facing_side(direction, axis));
  }
  vec4 of(const Voxel& voxel) const {
    return weight.x * voxel.side[side[0]] + weight.y * voxel.side[side[1]] + weight.z * voxel.side[side[2]];
  }
};

/// Opacity, and opacity times radiance, per voxel of level 0 at a place in grid units, from one level.
vec4 read_level(const Pyramid& voxels, int level, const vec3& place, const Facing& facing) {
  const float scale = std::ldexp(1.0f, -level);
  const vec3 at = place * scale - 0.5f;
  const vec3 low = glm::floor(at), f = at - low;
  const Cell c{static_cast<int>(low.x), static_cast<int>(low.y), static_cast<int>(low.z)};
  vec4 sum(0);
  for (int k = 0; k < 8; ++k) {
    const int x = k & 1, y = k >> 1 & 1, z = k >> 2;
    const Voxel* voxel = voxels.find(level, {c.x + x, c.y + y, c.z + z});
    if (!voxel) continue;
    const float weight = (x ? f.x : 1 - f.x) * (y ? f.y : 1 - f.y) * (z ? f.z : 1 - f.z);
    sum += weight * facing.of(*voxel);
  }
  return scale * sum;
}

}  // namespace

vec3 trace_cone(const Pyramid& voxels, const vec3& origin, const vec3& direction, float tangent,
                const ConeParams& params) {
  const Facing facing(direction);
  const int top = voxels.levels() - 1;
  const float widest = std::ldexp(1.0f, top);
  const Cell& size = voxels.grid().size;
  const float end = way_out(origin, direction, vec3(size.x, size.y, size.z));
  vec4 seen(0);
  for (float t = 0; seen.w < 1;) {
    const float edge = std::clamp(t * tangent, 1.0f, widest);
    if (t > end + 1.5f * edge) break;  // surfaces at the grid's rim are blurred beyond it
    const float way = params.step * edge, level = std::log2(edge);
    const int fine = std::min(static_cast<int>(level), top);
    const float mix = level - static_cast<float>(fine);
    const vec3 place = origin + (t + 0.5f * way) * direction;
    vec4 read = read_level(voxels, fine, place, facing);
    if (mix > 0 && fine < top) read += mix * (read_level(voxels, fine + 1, place, facing) - read);
    cover(seen, (params.opacity * way) * read);
    t += way;
  }
  return vec3(seen);
}

vec3 ConeLight::start(const scene::SurfacePoint& at) const {
  return voxels_.grid().to_grid(at.position) + params_.offset * at.normal;
}

vec3 ConeLight::irradiance(const scene::SurfacePoint& at) const {
  const Frame frame = Frame::around(at.normal);
  const vec3 origin = start(at);
  vec3 sum(0);
  for (const Cone& cone : cones_)
    sum += cone.weight * trace_cone(voxels_, origin, frame.to_world(cone.direction), cone.tangent, params_);
  return sum;
}

vec3 ConeLight::glossy(const scene::SurfacePoint& at, const vec3& r, float roughness) const {
  const Frame frame = Frame::around(r);
  const vec3 origin = start(at);
  vec3 sum(0);
  float weight = 0;
  for (const Cone& cone : cap_cones(lobe_cosine(roughness))) {
    const vec3 direction = frame.to_world(cone.direction);
    if (!(glm::dot(direction, at.normal) > 0)) continue;
    sum += cone.weight * trace_cone(voxels_, origin, direction, cone.tangent, params_);
    weight += cone.weight;
  }
  return weight > 0 ? sum / weight : vec3(0);
}

}  // namespace ssphh::gi::vct
