#include "gpu_scene.h"

#include <algorithm>
#include <cmath>
#include <tuple>

#include <ssphh/rays/posed_world.h>
#include <ssphh/shading/surface.h>

namespace ssphh::realtime {
namespace {

const scene::Material plain_material;

GpuTextureUse gpu_use(const scene::TextureUse& use) {
  const float c = std::cos(use.rotation), s = std::sin(use.rotation);
  return {{c * use.scale.x, s * use.scale.y, -s * use.scale.x, c * use.scale.y}, {use.offset, use.uv_set, 0}};
}

GpuMaterial gpu_material(const scene::Material& m) {
  const float r = (m.ior - 1) / (m.ior + 1);
  GpuMaterial g;
  g.base = vec4(m.base_color, m.alpha);
  g.emission = vec4(m.emission, m.metallic);
  g.rough = {m.diffuse_roughness, m.specular_roughness, r * r * m.specular, m.normal_scale};
  g.alpha = {m.alpha_cutoff, static_cast<float>(m.alpha_mode), m.unlit ? 1.0f : 0.0f,
             m.double_sided ? 1.0f : 0.0f};
  const bool body = m.thickness > 0;
  g.glass = {m.is_glass() ? m.transmission : 0, body ? 0 : 1, m.ior, m.specular};
  g.inside = vec4(shading::absorption_of(m), 0);
  g.base_use = gpu_use(m.base_color_texture);
  g.rough_use = gpu_use(m.metallic_roughness_texture);
  g.emission_use = gpu_use(m.emission_texture);
  g.normal_use = gpu_use(m.normal_texture);
  g.transmission_use = gpu_use(m.transmission_texture);
  return g;
}

int class_of(const scene::Material& m) {
  if (m.unlit) return surface_class::unlit;
  const bool specular = m.metallic > 0 || (m.specular > 0 && m.ior != 1);
  return specular || m.diffuse_roughness != 0 ? surface_class::full : surface_class::lambertian;
}

int textures_of(const scene::Material& m) {
  const bool base = m.base_color_texture.texture >= 0, rough = m.metallic_roughness_texture.texture >= 0,
             emission = m.emission_texture.texture >= 0, normal = m.normal_texture.texture >= 0;
  return int{base} | int{rough} << 1 | int{emission} << 2 | int{normal} << 3;
}

bool partial_cover(const scene::Material& m, const scene::Mesh& mesh) {
  return m.alpha_mode != scene::AlphaMode::opaque &&
         (m.alpha < 1 || m.base_color_texture.texture >= 0 || !mesh.colors.empty());
}

template <class T>
void upload_block(FrameCounters& counters, gl::Buffer& buffer, const T& block, std::size_t index) {
  buffer.update_bytes(index * block_stride, std::as_bytes(std::span<const T>(&block, 1)));
  counters.bytes_uploaded += sizeof(T);
}

void set_world(GpuInstance& instance, const mat4& world) {
  const mat3 linear(world);
  const float det = glm::determinant(linear);
  const bool singular = !(std::abs(det) > 0) || !std::isfinite(1 / det);
  const mat3 normal = singular ? linear : glm::transpose(glm::inverse(linear));
  instance.world = world;
  for (int c = 0; c < 3; ++c) instance.normal[c] = vec4(normal[c], 0);
  const bool moves = instance.emission_scale.w >= 2;
  instance.emission_scale.w = static_cast<float>((det < 0 ? 1 : 0) + (moves ? 2 : 0));
}

}  // namespace

GpuScene::GpuScene(const scene::Scene& scene, std::span<const MeshBuffers> engines,
                   const std::vector<mat4>& world, float anisotropy, FrameCounters& counters)
    : meshes_(make_meshes(scene, engines)), anisotropy_(anisotropy) {
  // Materials; the last one stands for "none"
  for (const scene::Material& m : scene.materials) materials_.push_back(gpu_material(m));
  materials_.push_back(gpu_material(plain_material));
  material_buffer_ = gl::Buffer(materials_.size() * block_stride);
  for (std::size_t m = 0; m < materials_.size(); ++m)
    upload_block(counters, material_buffer_, materials_[m], m);
  add_textures(scene, counters);

  groups_ = groups_of(scene);
  for (std::size_t i = 0; i < scene.instances.size(); ++i) {
    const scene::Instance& instance = scene.instances[i];
    GpuInstance gpu;
    const int material = scene::instance_material(scene, instance);
    const bool none = material < 0;
    const auto m = none ? materials_.size() - 1 : static_cast<std::size_t>(material);
    const bool moves = instance.node >= 0 && scene.nodes[instance.node].movable;
    gpu.emission_scale.w = moves ? 2 : 0;
    instances_.push_back(gpu);
    nodes_.push_back(instance.node);
    if (instance.mesh < 0) continue;
    const GpuMesh& mesh = meshes_.meshes[instance.mesh];
    const bool partial =
        partial_cover(none ? plain_material : scene.materials[m], scene.meshes[instance.mesh]);
    for (const MeshPiece& piece : mesh.pieces) {
      items_.push_back({static_cast<int>(i),
                        static_cast<int>(m),
                        0,
                        mesh.arrays,
                        piece.index_count,
                        mesh.first_vertex,
                        piece.first_index,
                        piece.bounds,
                        {},
                        partial,
                        textures_of(none ? plain_material : scene.materials[m])});
    }
  }
  classify(scene.materials);

  instance_buffer_ = gl::Buffer(instances_.size() * block_stride);
  counters.bytes_uploaded += meshes_.bytes();
  bytes_ += meshes_.bytes() + instance_buffer_.size() + material_buffer_.size();

  std::vector<scene::Bounds> ignored;
  pose(world, ignored, counters);
}

GpuScene::GlassKind GpuScene::glass_kind(const scene::Material& m) {
  if (!m.is_glass()) return GlassKind::none;
  const bool even = m.transmission_texture.texture < 0 && m.metallic_roughness_texture.texture < 0;
  return even && m.transmission * (1 - m.metallic) >= 0.5f ? GlassKind::everywhere : GlassKind::some;
}

void GpuScene::classify(const std::vector<scene::Material>& materials) {
  if (classes_.empty()) {
    for (const scene::Material& m : materials)
      classes_.push_back(class_of(m)), glass_.push_back(glass_kind(m));
    classes_.push_back(class_of(plain_material)), glass_.push_back(GlassKind::none);
  }
  any_full_ = any_glass_ = any_absorbs_ = any_bends_ = any_frosted_ = false;
  for (DrawItem& item : items_) {
    item.surface_class = classes_[item.material];
    const GlassKind glass = glass_[item.material];
    item.glass = glass != GlassKind::none;
    any_full_ |= item.surface_class == surface_class::full && glass != GlassKind::everywhere;
    any_glass_ |= item.glass;
    const vec4& kind = materials_[item.material].glass;
    item.bends = item.glass && kind.y == 0 && kind.z > 1;
    any_bends_ |= item.bends;
    const float roughness = materials_[item.material].rough.y;
    item.frosted = item.glass && kind.y != 0 && roughness * roughness > shading::min_alpha;
    any_frosted_ |= item.frosted;
    any_absorbs_ |= item.glass && vec3(materials_[item.material].inside) != vec3(0);
  }
  std::ranges::stable_sort(items_, [](const DrawItem& a, const DrawItem& b) {
    return std::tuple(a.filters(), a.glass, a.textures, a.surface_class, a.material, a.arrays) <
           std::tuple(b.filters(), b.glass, b.textures, b.surface_class, b.material, b.arrays);
  });
}

void GpuScene::pose(const std::vector<mat4>& world, std::vector<scene::Bounds>& moved,
                    FrameCounters& counters) {
  const auto add_boxes = [&](int instance) {
    for (const DrawItem& item : items_) {
      if (item.instance == instance && !item.world.empty()) moved.push_back(item.world);
    }
  };
  for (std::size_t i = 0; i < instances_.size(); ++i) {
    const mat4 now = nodes_[i] >= 0 ? world[nodes_[i]] : mat4(1);
    if (now == instances_[i].world && !bounds_.empty()) continue;
    add_boxes(static_cast<int>(i));
    set_world(instances_[i], now);
    scene::Bounds around;
    for (DrawItem& item : items_) {
      if (item.instance != static_cast<int>(i)) continue;
      item.world = rays::transformed(item.local, now);
      around.add(item.world.min);
      around.add(item.world.max);
    }
    const float number = static_cast<float>(i + 1);
    instances_[i].middle = around.empty() ? vec4(vec3(now[3]), number) : vec4(around.center(), number);
    add_boxes(static_cast<int>(i));
    upload_block(counters, instance_buffer_, instances_[i], i);
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
  now.transmission_use = materials_[m].transmission_use;
  materials_[m] = now;
  classes_[m] = class_of(material), glass_[m] = glass_kind(material);
  classify({});
  upload_block(counters, material_buffer_, now, m);
}

void GpuScene::set_group_scale(int group, const vec3& scale, FrameCounters& counters) {
  for (std::size_t i = 0; i < instances_.size(); ++i) {
    if (groups_[i] != group) continue;
    instances_[i].emission_scale = vec4(scale, instances_[i].emission_scale.w);
    upload_block(counters, instance_buffer_, instances_[i], i);
  }
}

std::vector<int> GpuScene::groups_of(const scene::Scene& scene) {
  const std::vector<std::string> names = scene::light_groups(scene);
  std::vector<int> groups;
  for (const scene::Instance& instance : scene.instances) {
    const int material = scene::instance_material(scene, instance);
    const bool emissive = material >= 0 && scene.materials[material].emissive();
    groups.push_back(emissive ? scene::light_group_index(names, scene::light_group(scene, instance)) : -1);
  }
  return groups;
}

bool GpuScene::stands_in(const scene::Scene& scene) const {
  return std::ranges::equal(scene.instances, nodes_, {}, &scene::Instance::node);
}

void GpuScene::set_groups(const scene::Scene& scene, const std::vector<vec3>& scales,
                          FrameCounters& counters) {
  groups_ = groups_of(scene);
  for (std::size_t i = 0; i < instances_.size(); ++i) {
    const vec3 scale = groups_[i] < 0 ? vec3(1) : scales[groups_[i]];
    if (vec3(instances_[i].emission_scale) == scale) continue;
    instances_[i].emission_scale = vec4(scale, instances_[i].emission_scale.w);
    upload_block(counters, instance_buffer_, instances_[i], i);
  }
}

void GpuScene::begin(bool positions_only) const {
  positions_only_ = positions_only;
  bound_arrays_ = nullptr;
  bound_material_ = bound_instance_ = -1;
}

void GpuScene::draw(const DrawItem& item, bool textures, FrameCounters& counters) const {
  if (textures && item.material != bound_material_) {
    bind_material(item.material);
    material_buffer_.bind_uniform_range(
        binding::material_block, static_cast<std::size_t>(item.material) * block_stride, sizeof(GpuMaterial));
  }
  if (item.instance != bound_instance_) {
    instance_buffer_.bind_uniform_range(
        binding::instance_block, static_cast<std::size_t>(item.instance) * block_stride, sizeof(GpuInstance));
    bound_instance_ = item.instance;
  }
  const MeshArrays& arrays = meshes_.arrays[item.arrays];
  if (&arrays != bound_arrays_) {
    (positions_only_ ? arrays.position_only : arrays.all).bind();
    bound_arrays_ = &arrays;
  }
  gl::draw_indexed(item.index_count, item.first_index, item.base_vertex, arrays.index);
  ++counters.draw_calls;
  counters.triangles += static_cast<std::uint64_t>(item.index_count / 3);
}

}  // namespace ssphh::realtime
