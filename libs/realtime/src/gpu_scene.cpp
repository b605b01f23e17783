#include "gpu_scene.h"

#include <algorithm>
#include <cmath>
#include <cstring>

#include "mesh_pieces.h"

namespace ssphh::realtime {
namespace {

const scene::Material plain_material;

GpuTextureUse gpu_use(const scene::TextureUse& use) {
  const float c = std::cos(use.rotation), s = std::sin(use.rotation);
  return {{c * use.scale.x, s * use.scale.y, -s * use.scale.x, c * use.scale.y},
          {use.offset.x, use.offset.y, use.uv_set == 1 ? 1.0f : 0.0f, use.texture >= 0 ? 1.0f : 0.0f}};
}

GpuMaterial gpu_material(const scene::Material& m) {
  const float r = (m.ior - 1) / (m.ior + 1);
  GpuMaterial g;
  g.base = vec4(m.base_color, m.alpha);
  g.emission = vec4(m.emission, m.metallic);
  g.rough = {m.diffuse_roughness, m.specular_roughness, r * r * m.specular, m.normal_scale};
  g.alpha = {m.alpha_cutoff, static_cast<float>(m.alpha_mode), m.unlit ? 1.0f : 0.0f,
             m.double_sided ? 1.0f : 0.0f};
  g.base_use = gpu_use(m.base_color_texture);
  g.rough_use = gpu_use(m.metallic_roughness_texture);
  g.emission_use = gpu_use(m.emission_texture);
  g.normal_use = gpu_use(m.normal_texture);
  return g;
}

bool partial_cover(const scene::Material& m, const scene::Mesh& mesh) {
  return m.alpha_mode != scene::AlphaMode::opaque &&
         (m.alpha < 1 || m.base_color_texture.texture >= 0 || !mesh.colors.empty());
}

std::vector<GpuVertex> gpu_vertices(const scene::Mesh& mesh) {
  std::vector<GpuVertex> vertices(mesh.positions.size());
  for (std::size_t i = 0; i < vertices.size(); ++i) {
    GpuVertex& v = vertices[i];
    if (!mesh.normals.empty()) v.normal = mesh.normals[i];
    if (!mesh.uvs[0].empty()) v.uv.x = mesh.uvs[0][i].x, v.uv.y = mesh.uvs[0][i].y;
    if (!mesh.uvs[1].empty()) v.uv.z = mesh.uvs[1][i].x, v.uv.w = mesh.uvs[1][i].y;
    if (!mesh.tangents.empty()) v.tangent = mesh.tangents[i];
    if (!mesh.colors.empty()) v.color = mesh.colors[i];
  }
  return vertices;
}

void set_world(GpuInstance& instance, const mat4& world) {
  const mat3 linear(world);
  const float det = glm::determinant(linear);
  const bool singular = !(std::abs(det) > 0) || !std::isfinite(1 / det);
  const mat3 normal = singular ? linear : glm::transpose(glm::inverse(linear));
  instance.world = world;
  for (int c = 0; c < 3; ++c) instance.normal[c] = vec4(normal[c], 0);
  instance.material.y = det < 0 ? 1 : 0;
}

}  // namespace

GpuScene::GpuScene(const scene::Scene& scene, const std::vector<mat4>& world, FrameCounters& counters) {
  // Materials; the last one stands for "none"
  for (const scene::Material& m : scene.materials) materials_.push_back(gpu_material(m));
  materials_.push_back(gpu_material(plain_material));
  material_buffer_ = gl::Buffer(materials_.size() * sizeof(GpuMaterial));
  upload<GpuMaterial>(counters, material_buffer_, materials_);
  add_textures(scene, counters);

  // Groups
  const std::vector<std::string> groups = scene::light_groups(scene);
  group_scales_.assign(std::max<std::size_t>(groups.size(), 1), vec4(1));
  scale_buffer_ = gl::Buffer(group_scales_.size() * sizeof(vec4));
  upload<vec4>(counters, scale_buffer_, group_scales_);

  // Meshes one after the other
  std::vector<vec3> positions;
  std::vector<GpuVertex> vertices;
  std::vector<unsigned> indices;
  std::vector<std::vector<MeshPiece>> pieces;
  std::vector<int> first_vertex;
  for (const scene::Mesh& mesh : scene.meshes) {
    first_vertex.push_back(static_cast<int>(positions.size()));
    positions.insert(positions.end(), mesh.positions.begin(), mesh.positions.end());
    const std::vector<GpuVertex> attributes = gpu_vertices(mesh);
    vertices.insert(vertices.end(), attributes.begin(), attributes.end());
    pieces.push_back(split_mesh(mesh, indices));
  }

  // Instances
  std::vector<unsigned> ids;
  for (std::size_t i = 0; i < scene.instances.size(); ++i) {
    const scene::Instance& instance = scene.instances[i];
    GpuInstance gpu;
    const int material = scene::instance_material(scene, instance);
    const bool none = material < 0;
    const auto m = none ? materials_.size() - 1 : static_cast<std::size_t>(material);
    gpu.material = uvec4(static_cast<unsigned>(m), 0, 0, 0);
    if (!none && scene.materials[m].emissive()) {
      const int group = scene::light_group_index(groups, scene::light_group(scene, instance));
      gpu.material.z = static_cast<unsigned>(group + 1);
    }
    instances_.push_back(gpu);
    nodes_.push_back(instance.node);
    ids.push_back(static_cast<unsigned>(i));
    if (instance.mesh < 0) continue;
    const auto mesh = static_cast<std::size_t>(instance.mesh);
    const bool partial = partial_cover(none ? plain_material : scene.materials[m], scene.meshes[mesh]);
    for (const MeshPiece& piece : pieces[mesh]) {
      items_.push_back({static_cast<int>(i),
                        static_cast<int>(m),
                        piece.index_count,
                        first_vertex[mesh],
                        piece.first_index,
                        piece.bounds,
                        {},
                        partial});
    }
  }
  std::stable_sort(items_.begin(), items_.end(), [](const DrawItem& a, const DrawItem& b) {
    return std::pair(a.partial, a.material) < std::pair(b.partial, b.material);
  });

  positions_ = gl::Buffer(std::span<const vec3>(positions));
  vertices_ = gl::Buffer(std::span<const GpuVertex>(vertices));
  indices_ = gl::Buffer(std::span<const unsigned>(indices));
  instance_ids_ = gl::Buffer(std::span<const unsigned>(ids));
  instance_buffer_ = gl::Buffer(instances_.size() * sizeof(GpuInstance));
  const std::size_t geometry = positions_.size() + vertices_.size() + indices_.size() + instance_ids_.size();
  counters.bytes_uploaded += geometry;
  bytes_ += geometry + instance_buffer_.size() + material_buffer_.size() + scale_buffer_.size();

  for (gl::VertexArray* array : {&all_, &position_only_}) {
    array->attribute(0, positions_, 3, sizeof(vec3), 0);
    array->instance_attribute(5, instance_ids_);
    array->indices(indices_);
  }
  all_.attribute(1, vertices_, 3, sizeof(GpuVertex), offsetof(GpuVertex, normal));
  all_.attribute(2, vertices_, 4, sizeof(GpuVertex), offsetof(GpuVertex, uv));
  all_.attribute(3, vertices_, 4, sizeof(GpuVertex), offsetof(GpuVertex, tangent));
  all_.attribute(4, vertices_, 4, sizeof(GpuVertex), offsetof(GpuVertex, color));

  std::vector<scene::Bounds> ignored;
  pose(world, ignored, counters);
}

void GpuScene::pose(const std::vector<mat4>& world, std::vector<scene::Bounds>& moved,
                    FrameCounters& counters) {
  const auto add_boxes = [&](int instance) {
    for (const DrawItem& item : items_) {
      if (item.instance == instance && !item.world.empty()) moved.push_back(item.world);
    }
  };
  for (std::size_t i = 0; i < instances_.size(); ++i) {
    const mat4 now = nodes_[i] >= 0 ? world[static_cast<std::size_t>(nodes_[i])] : mat4(1);
    if (now == instances_[i].world && !bounds_.empty()) continue;
    add_boxes(static_cast<int>(i));
    set_world(instances_[i], now);
    for (DrawItem& item : items_) {
      if (item.instance == static_cast<int>(i)) item.world = transformed(item.local, now);
    }
    add_boxes(static_cast<int>(i));
    upload(counters, instance_buffer_, std::span<const GpuInstance>(&instances_[i], 1), i);
  }
  bounds_ = {};
  for (const DrawItem& item : items_) {
    bounds_.add(item.world.min);
    bounds_.add(item.world.max);
  }
}

void GpuScene::set_material(int index, const scene::Material& material, FrameCounters& counters) {
  const auto m = static_cast<std::size_t>(index);
  GpuMaterial now = gpu_material(material);
  // Textures stay the scene's
  now.base_use = materials_[m].base_use, now.rough_use = materials_[m].rough_use;
  now.emission_use = materials_[m].emission_use, now.normal_use = materials_[m].normal_use;
  materials_[m] = now;
  upload(counters, material_buffer_, std::span<const GpuMaterial>(&now, 1), m);
}

void GpuScene::set_group_scale(int group, const vec3& scale, FrameCounters& counters) {
  const vec4 value(scale, 1);
  upload(counters, scale_buffer_, std::span<const vec4>(&value, 1), static_cast<std::size_t>(group));
}

void GpuScene::begin(bool positions_only) const {
  material_buffer_.bind_storage(binding::materials);
  instance_buffer_.bind_storage(binding::instances);
  scale_buffer_.bind_storage(binding::group_scales);
  (positions_only ? position_only_ : all_).bind();
  bound_material_ = -2;
}

void GpuScene::draw(const DrawItem& item, bool textures, FrameCounters& counters) const {
  if (textures && item.material != bound_material_) bind_material(item.material);
  gl::draw_indexed(item.index_count, item.first_index, item.base_vertex,
                   static_cast<unsigned>(item.instance));
  ++counters.draw_calls;
  counters.triangles += static_cast<std::uint64_t>(item.index_count / 3);
}

}  // namespace ssphh::realtime
