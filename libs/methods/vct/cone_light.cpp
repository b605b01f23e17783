#include <algorithm>
#include <cmath>

#include <ssphh/methods/vct/cone_light.h>

#include "voxel_reader.h"

namespace ssphh::methods::vct {
namespace {

/// Whether `p` is farther than `reach` from the box [0, size], and on the way out.
bool gone(const vec3& p, const vec3& direction, const vec3& size, float reach) {
  for (int axis = 0; axis < 3; ++axis) {
    if (direction[axis] >= 0 && p[axis] > size[axis] + reach) return true;
    if (direction[axis] <= 0 && p[axis] < -reach) return true;
  }
  return false;
}

/// What a beam meets in a voxel: the three sides toward it, weighted by the components of its direction.
struct Facing {
  std::array<std::size_t, 3> side;
  vec3 weight;

  explicit Facing(const vec3& direction) : weight(glm::abs(direction)) {
    for (int axis = 0; axis < 3; ++axis) side[axis] = static_cast<std::size_t>(facing_side(direction, axis));
  }
  void add(const Voxel& voxel, float share, vec4& sum) const {
    sum += (share * weight.x) * voxel.side[side[0]];
    sum += (share * weight.y) * voxel.side[side[1]];
    sum += (share * weight.z) * voxel.side[side[2]];
  }
};

/// Opacity, and opacity times radiance, per unit of length at a place in grid units, from one level.
vec4 read_level(VoxelReader& reader, int level, const vec3& place, const Facing& facing) {
  const float scale = 1 / static_cast<float>(1 << level);
  const vec3 at = place * scale - 0.5f;
  const vec3 low = glm::floor(at), f = at - low;
  const Cell c{static_cast<int>(low.x), static_cast<int>(low.y), static_cast<int>(low.z)};
  std::array<const Voxel*, 8> around;
  if (!reader.find8(level, c, around)) return vec4(0);
  vec4 sum(0);
  for (std::size_t k = 0; k < 8; ++k) {
    if (!around[k]) continue;
    const float weight = (k & 1 ? f.x : 1 - f.x) * (k & 2 ? f.y : 1 - f.y) * (k & 4 ? f.z : 1 - f.z);
    facing.add(*around[k], weight, sum);
  }
  return scale * sum;
}

vec4 trace(VoxelReader& reader, const vec3& origin, const vec3& direction, float tangent,
           const ConeParams& params) {
  const Facing facing(direction);
  const int top = reader.voxels().levels() - 1;
  const float widest = std::ldexp(1.0f, top);
  const Cell& cells = reader.voxels().grid().size;
  const vec3 size(cells.x, cells.y, cells.z);
  vec4 seen(0);
  float edge = 1;
  bool crossing = false;
  for (float t = 0; seen.w < 1;) {
    if (!crossing) edge = std::clamp(t * tangent, 1.0f, widest);
    const float way = params.step * edge, level = std::log2(edge);
    const vec3 place = origin + (t + 0.5f * way) * direction;
    // Surfaces at the rim of the grid are blurred beyond it.
    if (gone(place, direction, size, 2 * edge)) break;
    const int fine = std::min(static_cast<int>(level), top);
    const float mix = level - static_cast<float>(fine);
    vec4 read = read_level(reader, fine, place, facing);
    if (mix > 0 && fine < top) read += mix * (read_level(reader, fine + 1, place, facing) - read);
    crossing = read.w > 0;
    cover(seen, (params.opacity * way) * read);
    t += way;
  }
  return seen;
}

}  // namespace

vec4 trace_cone(const Pyramid& voxels, const vec3& origin, const vec3& direction, float tangent,
                const ConeParams& params) {
  VoxelReader reader(voxels);
  return trace(reader, origin, direction, tangent, params);
}

vec3 ConeLight::start(const rays::SurfacePoint& at) const {
  return voxels_.grid().to_grid(at.position) + params_.offset * at.normal;
}

vec3 ConeLight::irradiance(const rays::SurfacePoint& at) const {
  const Frame frame = Frame::around(at.normal);
  const vec3 origin = start(at);
  VoxelReader reader(voxels_);
  vec3 sum(0);
  for (const Cone& cone : cones_) {
    const vec3 direction = frame.to_world(cone.direction);
    sum += cone.weight * vec3(trace(reader, origin, direction, cone.tangent, params_));
  }
  return sum;
}

vec3 ConeLight::glossy(const rays::SurfacePoint& at, const vec3& r, float roughness) const {
  const Frame frame = Frame::around(r);
  const vec3 origin = start(at);
  VoxelReader reader(voxels_);
  vec3 sum(0);
  float weight = 0;
  for (const Cone& cone : cap_cones(lobe_cosine(roughness))) {
    const vec3 direction = frame.to_world(cone.direction);
    if (!(glm::dot(direction, at.normal) > 0)) continue;
    sum += cone.weight * vec3(trace(reader, origin, direction, cone.tangent, params_));
    weight += cone.weight;
  }
  return weight > 0 ? sum / weight : vec3(0);
}

}  // namespace ssphh::methods::vct
