#include "shaded_geometry.h"

#include <cmath>

#include <ssphh/core/random.h>
#include <ssphh/core/require.h>

#include "glass_passage.h"

namespace ssphh::trace {
namespace {

/// What the filter needs, reached through Embree's context pointer.
struct FilterContext {
  RTCIntersectContext base;  // first: Embree hands back a pointer to it
  const ShadedGeometry* geometry;
  Passage passage;
  bool met_glass;
};

FilterContext filter_context(const ShadedGeometry& geometry, const Passage& passage) {
  FilterContext context{{}, &geometry, passage, false};
  rtcInitIntersectContext(&context.base);
  return context;
}

int instance_of(unsigned geometry, unsigned instance) {
  return static_cast<int>(instance == RTC_INVALID_GEOMETRY_ID ? geometry : instance);
}

const SceneGeometry& held(const SharedGeometry& geometry) {
  require(geometry != nullptr, "scene geometry", "there is none");
  return *geometry;
}

/// Embree may end the process for others (an assertion of Debian's build): they meet nothing.
bool embree_takes(const Ray& ray) {
  constexpr float most = 1.8e18f;
  return max_abs_component(ray.origin) <= most && max_abs_component(ray.direction) <= most &&
         !glm::any(glm::isnan(ray.origin)) && !glm::any(glm::isnan(ray.direction)) &&
         !std::isnan(ray.t_min) && !std::isnan(ray.t_max);
}

/// Of the triangle's corners under `matrix`.
float largest_coordinate(const scene::Mesh& mesh, std::uint32_t triangle, const mat4& matrix) {
  float largest = 0;
  for (int i = 0; i < 3; ++i) {
    const vec3 corner(matrix * vec4(mesh.positions[mesh.triangles[triangle][i]], 1));
    largest = std::max(largest, max_abs_component(corner));
  }
  return largest;
}

}  // namespace

/// The decision is a hash of ray and triangle, so it depends neither on the order in which Embree offers the
/// candidates nor on how often it offers one.
void passage_filter(const RTCFilterFunctionNArguments* arguments) {
  auto& context = *reinterpret_cast<FilterContext*>(arguments->context);
  const RTCHit found = rtcGetHitFromHitN(arguments->hit, arguments->N, 0);
  const Hit hit{instance_of(found.geomID, found.instID[0]), found.primID, {found.u, found.v}, 0};
  const float alpha = context.geometry->alpha(hit);
  const std::uint64_t seed = context.passage.seed;
  const std::uint64_t triangle = (static_cast<std::uint64_t>(hit.instance) << 32) | hit.triangle;
  const auto chance = [&] {
    return to_unit_float(static_cast<std::uint32_t>(hash_combine(seed, triangle) >> 32)) + 0x1p-25f;
  };
  if (alpha < 1 && alpha < (seed == 0 ? 0.5f : chance())) {
    arguments->valid[0] = 0;
    return;
  }
  if (context.passage.glass == PassedGlass::none || !context.geometry->glass(hit.instance)) return;
  if (!passes(context.geometry->glass_at(hit), context.passage)) return;
  arguments->valid[0] = 0;
  context.met_glass = true;
}

ShadedGeometry::ShadedGeometry(SharedGeometry geometry, const scene::Scene& scene)
    : geometry_(std::move(geometry)), data_(&held(geometry_).data()), scene_(scene) {
  if (!data_->fits(scene))
    throw Error("scene geometry", "it was built for a scene with other surfaces", "build one for this scene");
  for (const scene::Instance& instance : scene.instances) {
    InstanceShading& shading = shading_.emplace_back();
    shading.material = scene::instance_material(scene, instance);
    if (shading.material < 0) continue;
    const scene::Material& material = scene.materials[shading.material];
    shading.emissive = material.emissive(), shading.double_sided = material.double_sided;
    shading.glass = material.is_glass();
  }
}

bool ShadedGeometry::intersect(int part, const Ray& ray, const Passage& passage, Hit& hit,
                               bool* met_glass) const {
  if (!embree_takes(ray)) return false;
  FilterContext context = filter_context(*this, passage);
  RTCRayHit r;
  r.ray.org_x = ray.origin.x, r.ray.org_y = ray.origin.y, r.ray.org_z = ray.origin.z;
  r.ray.dir_x = ray.direction.x, r.ray.dir_y = ray.direction.y, r.ray.dir_z = ray.direction.z;
  r.ray.tnear = ray.t_min, r.ray.tfar = ray.t_max;
  r.ray.time = 0, r.ray.mask = ~0u, r.ray.id = 0, r.ray.flags = 0;
  r.hit.geomID = r.hit.instID[0] = RTC_INVALID_GEOMETRY_ID;
  rtcIntersect1(data_->parts[part].get(), &context.base, &r);
  if (met_glass) *met_glass |= context.met_glass;
  if (r.hit.geomID == RTC_INVALID_GEOMETRY_ID) return false;
  hit = {instance_of(r.hit.geomID, r.hit.instID[0]), r.hit.primID, {r.hit.u, r.hit.v}, r.ray.tfar};
  return true;
}

bool ShadedGeometry::occluded(int part, const Ray& ray, const Passage& passage, bool& met_glass) const {
  if (!embree_takes(ray)) return false;
  FilterContext context = filter_context(*this, passage);
  RTCRay r;
  r.org_x = ray.origin.x, r.org_y = ray.origin.y, r.org_z = ray.origin.z;
  r.dir_x = ray.direction.x, r.dir_y = ray.direction.y, r.dir_z = ray.direction.z;
  r.tnear = ray.t_min, r.tfar = ray.t_max;
  r.time = 0, r.mask = ~0u, r.id = 0, r.flags = 0;
  rtcOccluded1(data_->parts[part].get(), &context.base, &r);
  met_glass |= context.met_glass;
  return r.tfar < 0;
}

vec3 ShadedGeometry::through_glass(int part, const Ray& ray, const Passage& passage, RayTask& task) const {
  return trace::through_glass(
      ray,
      [&](const Ray& rest, Hit& hit) {
        ++task.rays;
        return intersect(part, rest, {passage.seed, PassedGlass::none}, hit);
      },
      [&](const Hit& hit, const vec3& wo, vec3& ray_origin) { return surface(hit, wo, ray_origin); });
}

shading::Surface ShadedGeometry::surface(const Hit& hit, const vec3& wo, vec3& ray_origin) const {
  const InstanceGeometry& g = geometry_of(hit);
  if (g.shared) return posed_surface(hit, mat4(1), mat3(1), wo, ray_origin);
  float magnitude = 0;
  const shading::SurfaceGeometry geometry = g.records.at(hit.triangle, hit.barycentric, magnitude);
  const shading::Surface surface = shading::surface_of(geometry, scene_, *g.mesh, shading_of(hit).material,
                                                       hit.triangle, hit.barycentric, g.to_frame, wo);
  ray_origin = surface.position + position_error(magnitude) * surface.geometric_normal;
  return surface;
}

shading::Surface ShadedGeometry::posed_surface(const Hit& hit, const mat4& pose, const mat3& normal_matrix,
                                               const vec3& wo, vec3& ray_origin) const {
  const InstanceGeometry& g = geometry_of(hit);
  const mat4 world = pose * g.to_frame;
  const shading::Surface surface =
      shading::surface_at(scene_, *g.mesh, shading_of(hit).material, hit.triangle, hit.barycentric, world,
                          normal_matrix * g.normal_matrix, wo);
  // Rays are also rounded by the way to the part's frame, or the shared mesh's, and back.
  const float way = std::max(max_abs_component(vec3(pose[3])), max_abs_component(vec3(world[3])));
  const float magnitude = 4 * std::max(largest_coordinate(*g.mesh, hit.triangle, world), way);
  ray_origin = surface.position + position_error(magnitude) * surface.geometric_normal;
  return surface;
}

float ShadedGeometry::alpha(const Hit& hit) const {
  return shading::coverage_at(scene_, *geometry_of(hit).mesh, shading_of(hit).material, hit.triangle,
                              hit.barycentric);
}

shading::GlassParams ShadedGeometry::glass_at(const Hit& hit) const {
  return shading::glass_at(scene_, *geometry_of(hit).mesh, shading_of(hit).material, hit.triangle,
                           hit.barycentric);
}

bool ShadedGeometry::is_back(const Hit& hit, const vec3& direction) const {
  if (shading_of(hit).double_sided) return false;
  const InstanceGeometry& g = geometry_of(hit);
  // The normal matrix keeps "outward" also where the instance is mirrored.
  const uvec3& triangle = g.mesh->triangles[hit.triangle];
  const std::vector<vec3>& p = g.mesh->positions;
  const vec3 front = glm::cross(p[triangle.y] - p[triangle.x], p[triangle.z] - p[triangle.x]);
  return glm::dot(g.normal_matrix * front, direction) > 0;
}

}  // namespace ssphh::trace
