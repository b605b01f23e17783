#include <map>
#include <tuple>

#include <ssphh/core/require.h>
#include <ssphh/lightmap/lit_scene.h>
#include <ssphh/scene/query.h>

#include "fit.h"

namespace ssphh::lightmap {
namespace {

using scene::Mesh;

/// A vertex of the old mesh as a vertex of the new one.
void copy_vertex(const Mesh& from, std::uint32_t vertex, const vec2& uv, Mesh& to) {
  to.positions.push_back(from.positions[vertex]);
  if (!from.normals.empty()) to.normals.push_back(from.normals[vertex]);
  if (!from.tangents.empty()) to.tangents.push_back(from.tangents[vertex]);
  if (!from.colors.empty()) to.colors.push_back(from.colors[vertex]);
  if (!from.uvs[0].empty()) to.uvs[0].push_back(from.uvs[0][vertex]);
  to.uvs[1].push_back(uv);
}

class Builder {
 public:
  Builder(const Mesh& from, const Layout& layout) : from_(from), layout_(layout) {
    to_.name = from.name, to_.material = from.material;
  }

  void add(const Chart& chart, const PlacedChart& place) {
    // A vertex may lie at two places of one chart: an island of coordinates may be cut.
    std::map<std::tuple<std::uint32_t, float, float>, std::uint32_t> known;
    const vec2 size(layout_.width, layout_.height);
    for (const FlatTriangle& flat : chart.triangles) {
      const uvec3& t = from_.triangles[flat.triangle];
      uvec3 now(0);
      for (int k = 0; k < 3; ++k) {
        const vec2 uv = place.texel(flat.at[k]) / size;
        const auto [at, fresh] =
            known.try_emplace({t[k], uv.x, uv.y}, static_cast<std::uint32_t>(to_.positions.size()));
        if (fresh) copy_vertex(from_, t[k], uv, to_);
        now[k] = at->second;
      }
      to_.triangles.push_back(now);
    }
  }
  Mesh take() { return std::move(to_); }

 private:
  const Mesh& from_;
  const Layout& layout_;
  Mesh to_;
};

/// Whether the instance's textures take the second coordinates and nothing the first.
bool takes_second(const scene::Scene& scene, const scene::Instance& instance) {
  const int index = scene::instance_material(scene, instance);
  if (index < 0) return false;
  return uv_sets_used(scene.materials[index])[1];
}

scene::Material with_first_set(scene::Material material) {
  for (scene::TextureUse* use :
       {&material.base_color_texture, &material.metallic_roughness_texture, &material.emission_texture,
        &material.normal_texture, &material.transmission_texture})
    use->uv_set = 0;
  return material;
}

}  // namespace

scene::Scene with_lightmap(scene::Scene scene, std::span<const Chart> charts, const Layout& layout) {
  require_fit(scene, charts, layout, "lightmap scene");
  const std::size_t old_meshes = scene.meshes.size();
  std::map<int, int> moved_materials;
  std::vector<std::uint8_t> lit(scene.instances.size(), 0);
  for (std::size_t begin = 0; begin < charts.size();) {
    scene::Instance& instance = scene.instances[charts[begin].instance];
    lit[charts[begin].instance] = 1;
    Mesh from = scene.meshes[instance.mesh];
    if (takes_second(scene, instance)) {
      from.uvs[0] = from.uvs[1];
      const int material = scene::instance_material(scene, instance);
      const auto [at, fresh] =
          moved_materials.try_emplace(material, static_cast<int>(scene.materials.size()));
      if (fresh) scene.materials.push_back(with_first_set(scene.materials[material]));
      instance.material = at->second;
    }
    Builder builder(from, layout);
    std::size_t i = begin;
    for (; i < charts.size() && charts[i].instance == charts[begin].instance; ++i)
      builder.add(charts[i], layout.places[i]);
    instance.mesh = static_cast<int>(scene.meshes.size());
    scene.meshes.push_back(builder.take());
    begin = i;
  }
  // Second coordinates that remain would look like a lightmap's.
  std::vector<std::uint8_t> used(old_meshes, 0), keeps(old_meshes, 0);
  for (std::size_t i = 0; i < scene.instances.size(); ++i) {
    const scene::Instance& instance = scene.instances[i];
    if (lit[i] || instance.mesh < 0) continue;
    used[instance.mesh] = 1;
    if (takes_second(scene, instance)) keeps[instance.mesh] = 1;
  }
  std::vector<int> renamed(scene.meshes.size(), -1);
  std::vector<Mesh> meshes;
  for (std::size_t i = 0; i < scene.meshes.size(); ++i) {
    if (i < old_meshes && !used[i]) continue;
    if (i < old_meshes && !keeps[i]) scene.meshes[i].uvs[1].clear();
    renamed[i] = static_cast<int>(meshes.size());
    meshes.push_back(std::move(scene.meshes[i]));
  }
  scene.meshes = std::move(meshes);
  for (scene::Instance& instance : scene.instances)
    if (instance.mesh >= 0) instance.mesh = renamed[instance.mesh];
  return scene;
}

}  // namespace ssphh::lightmap
