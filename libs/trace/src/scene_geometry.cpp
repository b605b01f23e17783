#include <atomic>
#include <cmath>

#include <ssphh/core/happens_before.h>
#include <ssphh/core/parallel.h>
#include <ssphh/core/require.h>
#include <ssphh/trace/scene_geometry.h>

#include "geometry_data.h"

namespace ssphh::trace {
namespace {

std::atomic<std::uint64_t> build_count{0};

const scene::Material* material_of(const scene::Scene& scene, const scene::Instance& instance) {
  const int material = scene::instance_material(scene, instance);
  return material < 0 ? nullptr : &scene.materials[material];
}

/// Whether rays may pass some of it.
bool is_filtered(const scene::Scene& scene, const scene::Instance& instance) {
  const scene::Material* m = material_of(scene, instance);
  if (m && m->is_glass()) return true;
  if (!m || m->alpha_mode == scene::AlphaMode::opaque) return false;
  return m->alpha < 1 || m->base_color_texture.texture >= 0 || !scene.meshes[instance.mesh].colors.empty();
}

bool uses_uv_set(const scene::Scene& scene, const scene::Instance& instance, int set) {
  const scene::Material* m = material_of(scene, instance);
  if (!m) return false;
  for (const scene::TextureUse* use : m->texture_uses()) {
    if (use->texture >= 0 && (use->uv_set == 1) == (set == 1)) return true;
  }
  return false;
}

bool same_surface(const scene::Mesh& a, const scene::Mesh& b) {
  return a.positions == b.positions && a.normals == b.normals && a.tangents == b.tangents && a.uvs == b.uvs &&
         a.colors == b.colors && a.triangles == b.triangles;
}

EmbreeScene new_scene(RTCDevice device) {
  EmbreeScene scene(rtcNewScene(device));
  // Without ROBUST, rays leak between triangles at shared edges.
  rtcSetSceneFlags(scene.get(), RTC_SCENE_FLAG_ROBUST);
  rtcSetSceneBuildQuality(scene.get(), RTC_BUILD_QUALITY_HIGH);
  return scene;
}

/// A triangle geometry over the mesh's indices. `vertices` must have one element more than the mesh: Embree
/// reads 16 bytes at each.
RTCGeometry new_triangles(RTCDevice device, const scene::Mesh& mesh, const std::vector<vec3>& vertices,
                          bool filtered) {
  RTCGeometry geometry = rtcNewGeometry(device, RTC_GEOMETRY_TYPE_TRIANGLE);
  rtcSetSharedGeometryBuffer(geometry, RTC_BUFFER_TYPE_VERTEX, 0, RTC_FORMAT_FLOAT3, vertices.data(), 0,
                             sizeof(vec3), mesh.positions.size());
  rtcSetSharedGeometryBuffer(geometry, RTC_BUFFER_TYPE_INDEX, 0, RTC_FORMAT_UINT3, mesh.triangles.data(), 0,
                             sizeof(uvec3), mesh.triangles.size());
  if (filtered) {
    rtcSetGeometryIntersectFilterFunction(geometry, passage_filter);
    rtcSetGeometryOccludedFilterFunction(geometry, passage_filter);
  }
  return geometry;
}

void attach(RTCScene scene, RTCGeometry geometry, std::size_t id) {
  rtcCommitGeometry(geometry);
  rtcAttachGeometryByID(scene, geometry, static_cast<unsigned>(id));
  rtcReleaseGeometry(geometry);
}

}  // namespace

SceneGeometry::Data::Data(const scene::Scene& scene_in, std::uint64_t flatten_limit)
    : scene(scene_in), layout(scene_in), instances(scene_in.instances.size()) {
  try {
    within_thread_count([&] {
      {
        const LibraryWrites settings;  // strings that Embree's tasks compare
        // AVX-512 rounds otherwise: a farm's machines would not find the same bits
        device.reset(rtcNewDevice("max_isa=avx2"));
      }
      if (!device) throw Error("ray tracer", "Embree does not start on this machine");
      build(flatten_limit);
    });
  } catch (const std::bad_alloc&) {
    throw Error("ray tracer", "the scene's geometry does not fit into memory");
  }
}

void SceneGeometry::Data::build(std::uint64_t flatten_limit) {
  for (std::size_t p = 0; p < layout.parts.size(); ++p) parts.push_back(new_scene(device.get()));

  // Count the copies that flattening would make of meshes used more than once.
  std::vector<int> uses(scene.meshes.size());
  std::uint64_t copied = 0;
  for (const scene::Instance& instance : scene.instances) {
    const auto m = static_cast<std::size_t>(instance.mesh);
    if (++uses[m] > 1) copied += scene.meshes[m].triangles.size();
  }

  // Add every instance to its part under its own index as geometry id.
  for (std::size_t i = 0; i < instances.size(); ++i) {
    const scene::Instance& instance = scene.instances[i];
    InstanceGeometry& geometry = instances[i];
    geometry.mesh = &scene.meshes[instance.mesh];
    if (geometry.mesh->triangles.empty()) continue;
    if (instance.node >= 0) geometry.to_frame = layout.frames.to_frame[instance.node];
    const mat3 linear(geometry.to_frame);
    const float det = glm::determinant(linear);
    const bool singular = !(std::abs(det) > 0) || !std::isfinite(1 / det);
    geometry.normal_matrix = singular ? linear : glm::transpose(glm::inverse(linear));
    geometry.shared = !singular && copied > flatten_limit && uses[instance.mesh] > 1;
    geometry.filtered = is_filtered(scene, instance);
    filters |= geometry.filtered;
    geometry.shared ? add_shared(i) : add_flat(i);
  }
  for (const EmbreeScene& part : parts) rtcCommitScene(part.get());
  check("the acceleration structure");
}

void SceneGeometry::Data::check(const char* what) const {
  const RTCError error = rtcGetDeviceError(device.get());
  if (error == RTC_ERROR_NONE) return;
  if (error == RTC_ERROR_OUT_OF_MEMORY) {
    throw Error("ray tracer", std::string("not enough memory for ") + what);
  }
  throw Error("ray tracer",
              std::string("Embree fails to build ") + what + " (error " + std::to_string(error) + ")");
}

void SceneGeometry::Data::add_flat(std::size_t i) {
  InstanceGeometry& g = instances[i];
  g.vertices.reserve(g.mesh->positions.size() + 1);
  for (const vec3& p : g.mesh->positions) g.vertices.emplace_back(g.to_frame * vec4(p, 1));
  g.vertices.emplace_back(0);
  const scene::Instance& instance = scene.instances[i];
  const bool uv_sets[2] = {uses_uv_set(scene, instance, 0), uses_uv_set(scene, instance, 1)};
  g.records = TriangleRecords(*g.mesh, g.vertices, g.to_frame, g.normal_matrix, uv_sets);
  attach(parts[layout.instance_part[i]].get(), new_triangles(device.get(), *g.mesh, g.vertices, g.filtered),
         i);
}

void SceneGeometry::Data::add_shared(std::size_t i) {
  const InstanceGeometry& g = instances[i];
  const int mesh = scene.instances[i].mesh;
  SharedMesh& shared = shared_meshes_[mesh];
  if (!shared.scene) {
    shared.positions = g.mesh->positions;
    shared.positions.emplace_back(0);
    shared.scene = new_scene(device.get());
    // One instance of the mesh may be opaque and another not: the filter asks the instance's material.
    bool filtered = false;
    for (const scene::Instance& other : scene.instances)
      filtered |= other.mesh == mesh && is_filtered(scene, other);
    attach(shared.scene.get(), new_triangles(device.get(), *g.mesh, shared.positions, filtered), 0);
    rtcCommitScene(shared.scene.get());
    check("an instanced mesh");
  }
  RTCGeometry geometry = rtcNewGeometry(device.get(), RTC_GEOMETRY_TYPE_INSTANCE);
  rtcSetGeometryInstancedScene(geometry, shared.scene.get());
  rtcSetGeometryTransform(geometry, 0, RTC_FORMAT_FLOAT4X4_COLUMN_MAJOR, &g.to_frame);
  attach(parts[layout.instance_part[i]].get(), geometry, i);
}

bool SceneGeometry::Data::fits(const scene::Scene& other) const {
  if (&other == &scene) return true;
  if (other.instances.size() != instances.size() || other.meshes.size() != scene.meshes.size()) return false;
  const NodeFrames frames = node_frames(other);
  for (std::size_t i = 0; i < instances.size(); ++i) {
    const scene::Instance &a = scene.instances[i], &b = other.instances[i];
    if (a.mesh != b.mesh || a.node != b.node) return false;
    const auto node = static_cast<std::size_t>(std::max(a.node, 0));
    if (a.node >= 0 && (frames.carrier[node] != layout.frames.carrier[node] ||
                        frames.to_frame[node] != layout.frames.to_frame[node]))
      return false;
    if (is_filtered(other, b) && !is_filtered(scene, a)) return false;
    for (const int set : {0, 1}) {
      if (uses_uv_set(other, b, set) && !uses_uv_set(scene, a, set)) return false;
    }
  }
  for (std::size_t m = 0; m < scene.meshes.size(); ++m) {
    if (!same_surface(scene.meshes[m], other.meshes[m])) return false;
  }
  return true;
}

SceneGeometry::SceneGeometry(const scene::Scene& scene, std::uint64_t flatten_limit) {
  scene::check_indices(scene);
  data_ = std::make_unique<const Data>(scene, flatten_limit);
  build_count.fetch_add(1, std::memory_order_relaxed);
}

SceneGeometry::~SceneGeometry() = default;

SharedGeometry geometry_of(std::shared_ptr<const scene::Scene> scene) {
  require(scene != nullptr, "scene geometry", "there is no scene");
  struct Both {
    explicit Both(std::shared_ptr<const scene::Scene> s) : scene(std::move(s)), geometry(*scene) {}
    std::shared_ptr<const scene::Scene> scene;
    SceneGeometry geometry;
  };
  const auto both = std::make_shared<const Both>(std::move(scene));
  return {both, &both->geometry};
}

std::uint64_t SceneGeometry::builds() noexcept {
  return build_count.load(std::memory_order_relaxed);
}

}  // namespace ssphh::trace
