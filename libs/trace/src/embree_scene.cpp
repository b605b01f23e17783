#include "embree_scene.h"

#include <algorithm>
#include <map>

#include <embree3/rtcore.h>

#include <ssphh/core/happens_before.h>
#include <ssphh/core/random.h>
#include <ssphh/scene/query.h>

namespace ssphh::trace {

struct EmbreeScene::Embree {
  RTCDevice device = nullptr;
  RTCScene scene = nullptr;
  std::map<int, RTCScene> meshes;              ///< shared object-space scenes of instanced meshes
  std::map<int, std::vector<vec3>> positions;  ///< their padded vertices

  ~Embree() {
    if (scene) rtcReleaseScene(scene);
    for (const auto& [mesh, child] : meshes) rtcReleaseScene(child);
    if (device) rtcReleaseDevice(device);
  }
};

namespace {

/// What the alpha filter needs, reached through Embree's context pointer.
struct FilterContext {
  RTCIntersectContext base;  // first: Embree hands back a pointer to it
  const EmbreeScene* scene;
  std::uint64_t alpha_seed;
};

int instance_of(unsigned geometry, unsigned instance) {
  return static_cast<int>(instance == RTC_INVALID_GEOMETRY_ID ? geometry : instance);
}

bool has_partial_alpha(const scene::Scene& scene, const scene::Mesh& mesh, int material) {
  if (material < 0) return false;
  const scene::Material& m = scene.materials[static_cast<std::size_t>(material)];
  if (m.alpha_mode == scene::AlphaMode::opaque) return false;
  return m.alpha < 1 || m.base_color_texture.texture >= 0 || !mesh.colors.empty();
}

bool uses_uv_set(const scene::Scene& scene, int material, int set) {
  if (material < 0) return false;
  const scene::Material& m = scene.materials[static_cast<std::size_t>(material)];
  for (const scene::TextureUse* use :
       {&m.base_color_texture, &m.metallic_roughness_texture, &m.emission_texture, &m.normal_texture}) {
    if (use->texture >= 0 && (use->uv_set == 1) == (set == 1)) return true;
  }
  return false;
}

RTCScene new_scene(RTCDevice device) {
  RTCScene scene = rtcNewScene(device);
  // Without ROBUST, rays leak between triangles at shared edges.
  rtcSetSceneFlags(scene, RTC_SCENE_FLAG_ROBUST);
  rtcSetSceneBuildQuality(scene, RTC_BUILD_QUALITY_HIGH);
  return scene;
}

/// Lets a candidate hit pass by chance. The decision is a hash of ray and triangle, so it depends neither on
/// the order in which Embree offers the candidates nor on how often it offers one.
void alpha_filter(const RTCFilterFunctionNArguments* arguments) {
  const auto& context = *reinterpret_cast<const FilterContext*>(arguments->context);
  const RTCHit found = rtcGetHitFromHitN(arguments->hit, arguments->N, 0);
  const Hit hit{instance_of(found.geomID, found.instID[0]), found.primID, {found.u, found.v}, 0};
  const float alpha = context.scene->alpha(hit);
  if (alpha >= 1) return;
  const std::uint64_t triangle = (static_cast<std::uint64_t>(hit.instance) << 32) | hit.triangle;
  const float threshold =
      context.alpha_seed == 0
          ? 0.5f
          : to_unit_float(static_cast<std::uint32_t>(hash_combine(context.alpha_seed, triangle) >> 32)) +
                0x1p-25f;
  if (alpha < threshold) arguments->valid[0] = 0;
}

FilterContext filter_context(const EmbreeScene& scene, std::uint64_t alpha_seed) {
  FilterContext context{{}, &scene, alpha_seed};
  rtcInitIntersectContext(&context.base);
  return context;
}

/// A triangle geometry over the mesh's indices. `vertices` must have one element more than the mesh: Embree
/// reads 16 bytes at each.
RTCGeometry new_triangles(RTCDevice device, const scene::Mesh& mesh, const std::vector<vec3>& vertices) {
  RTCGeometry geometry = rtcNewGeometry(device, RTC_GEOMETRY_TYPE_TRIANGLE);
  rtcSetSharedGeometryBuffer(geometry, RTC_BUFFER_TYPE_VERTEX, 0, RTC_FORMAT_FLOAT3, vertices.data(), 0,
                             sizeof(vec3), mesh.positions.size());
  rtcSetSharedGeometryBuffer(geometry, RTC_BUFFER_TYPE_INDEX, 0, RTC_FORMAT_UINT3, mesh.triangles.data(), 0,
                             sizeof(uvec3), mesh.triangles.size());
  return geometry;
}

}  // namespace

EmbreeScene::EmbreeScene(const scene::Scene& scene, const std::vector<mat4>& world,
                         std::uint64_t flatten_limit, const std::vector<bool>& only)
    : scene_(scene), parts_(scene.instances.size()), embree_(std::make_unique<Embree>()) {
  {
    const LibraryWrites settings;  // strings that Embree's tasks compare
    embree_->device = rtcNewDevice(nullptr);
  }
  if (!embree_->device) throw Error("ray tracer", "Embree does not start on this machine");
  embree_->scene = new_scene(embree_->device);

  const auto chosen = [&](std::size_t i) {
    return scene.instances[i].mesh >= 0 && (only.empty() || only[i]);
  };

  // Count the copies that flattening would make of meshes used more than once.
  std::vector<int> uses(scene.meshes.size());
  std::uint64_t copied = 0;
  for (std::size_t i = 0; i < scene.instances.size(); ++i) {
    if (!chosen(i)) continue;
    const scene::Instance& instance = scene.instances[i];
    const auto m = static_cast<std::size_t>(instance.mesh);
    if (++uses[m] > 1) copied += scene.meshes[m].triangles.size();
  }

  // Add every instance under its own index as geometry id.
  for (std::size_t i = 0; i < scene.instances.size(); ++i) {
    const scene::Instance& instance = scene.instances[i];
    if (!chosen(i) || scene.meshes[static_cast<std::size_t>(instance.mesh)].triangles.empty()) continue;
    Part& part = parts_[i];
    part.mesh = &scene.meshes[static_cast<std::size_t>(instance.mesh)];
    part.material = scene::instance_material(scene, instance);
    part.emissive = part.material >= 0 && scene.materials[static_cast<std::size_t>(part.material)].emissive();
    if (instance.node >= 0) part.world = world[static_cast<std::size_t>(instance.node)];
    const mat3 linear(part.world);
    const float det = glm::determinant(linear);
    const bool singular = !(std::abs(det) > 0) || !std::isfinite(1 / det);
    part.normal_matrix = singular ? linear : glm::transpose(glm::inverse(linear));
    part.instanced = !singular && copied > flatten_limit && uses[static_cast<std::size_t>(instance.mesh)] > 1;
    try {
      part.instanced ? add_instanced(static_cast<int>(i)) : add_flat(static_cast<int>(i));
    } catch (const std::bad_alloc&) {
      throw Error("ray tracer", "the scene's geometry does not fit into memory");
    }
  }
  rtcCommitScene(embree_->scene);
  check("the acceleration structure");
}

EmbreeScene::~EmbreeScene() = default;

bool EmbreeScene::intersect(const Ray& ray, std::uint64_t alpha_seed, RayTask& task, Hit& hit) const {
  ++task.rays;
  if (task.record) task.record->push_back({ray.origin, ray.t_max, ray.direction, false});
  FilterContext context = filter_context(*this, alpha_seed);
  RTCRayHit r;
  r.ray.org_x = ray.origin.x, r.ray.org_y = ray.origin.y, r.ray.org_z = ray.origin.z;
  r.ray.dir_x = ray.direction.x, r.ray.dir_y = ray.direction.y, r.ray.dir_z = ray.direction.z;
  r.ray.tnear = 0, r.ray.tfar = ray.t_max;
  r.ray.time = 0, r.ray.mask = ~0u, r.ray.id = 0, r.ray.flags = 0;
  r.hit.geomID = r.hit.instID[0] = RTC_INVALID_GEOMETRY_ID;
  rtcIntersect1(embree_->scene, &context.base, &r);
  if (r.hit.geomID == RTC_INVALID_GEOMETRY_ID) return false;
  hit = {instance_of(r.hit.geomID, r.hit.instID[0]), r.hit.primID, {r.hit.u, r.hit.v}, r.ray.tfar};
  return true;
}

bool EmbreeScene::occluded(const Ray& ray, std::uint64_t alpha_seed, RayTask& task) const {
  if (!(ray.t_max > 0)) return false;
  ++task.rays;
  if (task.record) task.record->push_back({ray.origin, ray.t_max, ray.direction, true});
  FilterContext context = filter_context(*this, alpha_seed);
  RTCRay r;
  r.org_x = ray.origin.x, r.org_y = ray.origin.y, r.org_z = ray.origin.z;
  r.dir_x = ray.direction.x, r.dir_y = ray.direction.y, r.dir_z = ray.direction.z;
  r.tnear = 0, r.tfar = ray.t_max;
  r.time = 0, r.mask = ~0u, r.id = 0, r.flags = 0;
  rtcOccluded1(embree_->scene, &context.base, &r);
  return r.tfar < 0;
}

shading::Surface EmbreeScene::surface(const Hit& hit, const vec3& wo, vec3& ray_origin) const {
  const Part& part = parts_[static_cast<std::size_t>(hit.instance)];
  float magnitude = 0;
  if (!part.instanced) {
    const shading::SurfaceGeometry geometry = part.records.at(hit.triangle, hit.barycentric, magnitude);
    const shading::Surface surface = shading::surface_of(geometry, scene_, *part.mesh, part.material,
                                                         hit.triangle, hit.barycentric, part.world, wo);
    ray_origin = surface.position + position_error(magnitude) * surface.geometric_normal;
    return surface;
  }
  const shading::Surface surface = shading::surface_at(scene_, *part.mesh, part.material, hit.triangle,
                                                       hit.barycentric, part.world, part.normal_matrix, wo);
  const uvec3& triangle = part.mesh->triangles[hit.triangle];
  for (int i = 0; i < 3; ++i) {
    const vec3 corner(part.world * vec4(part.mesh->positions[triangle[i]], 1));
    magnitude = std::max(magnitude, max_abs_component(corner));
  }
  // An instance's rays are also rounded by the way to object space and back.
  magnitude = 4 * std::max(magnitude, max_abs_component(vec3(part.world[3])));
  ray_origin = surface.position + position_error(magnitude) * surface.geometric_normal;
  return surface;
}

float EmbreeScene::alpha(const Hit& hit) const {
  const Part& part = parts_[static_cast<std::size_t>(hit.instance)];
  return shading::coverage_at(scene_, *part.mesh, part.material, hit.triangle, hit.barycentric);
}

bool EmbreeScene::is_back(const Hit& hit, const vec3& direction) const {
  const Part& part = parts_[static_cast<std::size_t>(hit.instance)];
  if (part.material >= 0 && scene_.materials[static_cast<std::size_t>(part.material)].double_sided)
    return false;
  // The normal matrix keeps "outward" also where the instance is mirrored.
  const uvec3& triangle = part.mesh->triangles[hit.triangle];
  const std::vector<vec3>& p = part.mesh->positions;
  const vec3 front = glm::cross(p[triangle.y] - p[triangle.x], p[triangle.z] - p[triangle.x]);
  return glm::dot(part.normal_matrix * front, direction) > 0;
}

void EmbreeScene::check(const char* what) const {
  const RTCError error = rtcGetDeviceError(embree_->device);
  if (error == RTC_ERROR_NONE) return;
  if (error == RTC_ERROR_OUT_OF_MEMORY) {
    throw Error("ray tracer", std::string("not enough memory for ") + what);
  }
  throw Error("ray tracer",
              std::string("Embree fails to build ") + what + " (error " + std::to_string(error) + ")");
}

void EmbreeScene::add_flat(int instance) {
  Part& part = parts_[static_cast<std::size_t>(instance)];
  part.vertices.reserve(part.mesh->positions.size() + 1);
  for (const vec3& p : part.mesh->positions) part.vertices.emplace_back(part.world * vec4(p, 1));
  part.vertices.emplace_back(0);
  const bool uv_sets[2] = {uses_uv_set(scene_, part.material, 0), uses_uv_set(scene_, part.material, 1)};
  part.records = TriangleRecords(*part.mesh, part.vertices, part.world, part.normal_matrix, uv_sets);

  RTCGeometry geometry = new_triangles(embree_->device, *part.mesh, part.vertices);
  if (has_partial_alpha(scene_, *part.mesh, part.material)) {
    has_alpha_ = true;
    rtcSetGeometryIntersectFilterFunction(geometry, alpha_filter);
    rtcSetGeometryOccludedFilterFunction(geometry, alpha_filter);
  }
  rtcCommitGeometry(geometry);
  rtcAttachGeometryByID(embree_->scene, geometry, static_cast<unsigned>(instance));
  rtcReleaseGeometry(geometry);
}

void EmbreeScene::add_instanced(int instance) {
  const Part& part = parts_[static_cast<std::size_t>(instance)];
  const int mesh_index = scene_.instances[static_cast<std::size_t>(instance)].mesh;
  RTCScene& child = embree_->meshes[mesh_index];
  if (!child) {
    std::vector<vec3>& positions = embree_->positions[mesh_index];
    positions = part.mesh->positions;
    positions.emplace_back(0);
    child = new_scene(embree_->device);
    RTCGeometry triangles = new_triangles(embree_->device, *part.mesh, positions);
    // One instance of the mesh may be opaque and another not: the filter asks the instance's material.
    bool any_alpha = false;
    for (const scene::Instance& other : scene_.instances) {
      any_alpha |= other.mesh == mesh_index &&
                   has_partial_alpha(scene_, *part.mesh, scene::instance_material(scene_, other));
    }
    if (any_alpha) {
      has_alpha_ = true;
      rtcSetGeometryIntersectFilterFunction(triangles, alpha_filter);
      rtcSetGeometryOccludedFilterFunction(triangles, alpha_filter);
    }
    rtcCommitGeometry(triangles);
    rtcAttachGeometryByID(child, triangles, 0);
    rtcReleaseGeometry(triangles);
    rtcCommitScene(child);
    check("an instanced mesh");
  }
  RTCGeometry geometry = rtcNewGeometry(embree_->device, RTC_GEOMETRY_TYPE_INSTANCE);
  rtcSetGeometryInstancedScene(geometry, child);
  rtcSetGeometryTransform(geometry, 0, RTC_FORMAT_FLOAT4X4_COLUMN_MAJOR, &part.world);
  rtcCommitGeometry(geometry);
  rtcAttachGeometryByID(embree_->scene, geometry, static_cast<unsigned>(instance));
  rtcReleaseGeometry(geometry);
}

}  // namespace ssphh::trace
