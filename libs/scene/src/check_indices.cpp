#include "check_indices.h"

#include <algorithm>

#include <fmt/format.h>

#include <ssphh/core/error.h>
#include <ssphh/scene/query.h>

namespace ssphh::scene {
namespace {

void check_index(int index, int lowest, std::size_t count, const std::string& where, const char* what) {
  if (index >= lowest && index < static_cast<int>(count)) return;
  throw Error(where, fmt::format("refers to {} {} of {}", what, index, count));
}

void check_texture(const Texture& texture, const std::string& where) {
  if (texture.width < 1 || texture.height < 1)
    throw Error(where, fmt::format("has {}×{} texels", texture.width, texture.height));
  const std::size_t expected =
      std::size_t{4} * static_cast<std::size_t>(texture.width) * static_cast<std::size_t>(texture.height);
  if (texture.rgba.size() != expected)
    throw Error(where, fmt::format("{} bytes instead of {}", texture.rgba.size(), expected));
}

void check_size(std::size_t size, const Mesh& mesh, const std::string& where, const char* what) {
  if (size == 0 || size == mesh.positions.size()) return;
  throw Error(where, fmt::format("{} {} for {} positions", size, what, mesh.positions.size()));
}

void check_mesh(const Mesh& mesh, const std::string& where) {
  check_size(mesh.normals.size(), mesh, where, "normals");
  check_size(mesh.tangents.size(), mesh, where, "tangents");
  check_size(mesh.colors.size(), mesh, where, "colours");
  for (const auto& uvs : mesh.uvs) check_size(uvs.size(), mesh, where, "texture coordinates");
  for (std::size_t i = 0; i < mesh.triangles.size(); ++i) {
    const uvec3& t = mesh.triangles[i];
    const std::uint32_t largest = std::max({t.x, t.y, t.z});
    if (largest >= mesh.positions.size())
      throw Error(where,
                  fmt::format("triangle {} refers to vertex {} of {}", i, largest, mesh.positions.size()));
  }
}

void check_channel(const AnimationChannel& channel, const Scene& scene, const std::string& where) {
  check_index(channel.node, 0, scene.nodes.size(), where, "node");
  const std::size_t per_key = channel.interpolation == Interpolation::cubic_spline ? 3 : 1;
  if (channel.times.empty()) throw Error(where, "has no keys");
  if (channel.values.size() != per_key * channel.times.size())
    throw Error(where, fmt::format("{} values for {} keys", channel.values.size(), channel.times.size()));
}

void check_use(const TextureUse& use, const Scene& scene, const std::string& where) {
  check_index(use.texture, -1, scene.textures.size(), where, "texture");
  if (use.uv_set < 0 || use.uv_set > 1)
    throw Error(where, fmt::format("uses texture coordinates {}", use.uv_set));
}

}  // namespace

std::string label(const char* kind, std::size_t index, const std::string& name) {
  return name.empty() ? fmt::format("{} {}", kind, index) : fmt::format("{} {} \"{}\"", kind, index, name);
}

void check_nodes(const Scene& scene) {
  for (std::size_t i = 0; i < scene.nodes.size(); ++i) {
    const int parent = scene.nodes[i].parent;
    if (parent >= -1 && parent < static_cast<int>(i)) continue;
    throw Error(label("node", i, scene.nodes[i].name),
                fmt::format("has parent {}; parents stand before their children", parent));
  }
  for (std::size_t i = 0; i < scene.animations.size(); ++i) {
    const std::vector<AnimationChannel>& channels = scene.animations[i].channels;
    for (std::size_t c = 0; c < channels.size(); ++c) {
      check_channel(channels[c], scene,
                    fmt::format("{} channel {}", label("animation", i, scene.animations[i].name), c));
    }
  }
}

void check_indices(const Scene& scene) {
  for (std::size_t i = 0; i < scene.textures.size(); ++i)
    check_texture(scene.textures[i], label("texture", i, scene.textures[i].name));
  for (std::size_t i = 0; i < scene.materials.size(); ++i) {
    const Material& m = scene.materials[i];
    for (const TextureUse* use : m.texture_uses()) check_use(*use, scene, label("material", i, m.name));
  }
  for (std::size_t i = 0; i < scene.meshes.size(); ++i) {
    const std::string where = label("mesh", i, scene.meshes[i].name);
    check_index(scene.meshes[i].material, -1, scene.materials.size(), where, "material");
    check_mesh(scene.meshes[i], where);
  }
  check_nodes(scene);
  for (std::size_t i = 0; i < scene.instances.size(); ++i) {
    const Instance& instance = scene.instances[i];
    const std::string where = label("instance", i, "");
    check_index(instance.mesh, 0, scene.meshes.size(), where, "mesh");
    check_index(instance.material, -1, scene.materials.size(), where, "material");
    check_index(instance.node, -1, scene.nodes.size(), where, "node");
  }
  const auto check_places = [&](const auto& objects, const char* kind) {
    for (std::size_t i = 0; i < objects.size(); ++i)
      check_index(objects[i].node, -1, scene.nodes.size(), label(kind, i, objects[i].name), "node");
  };
  check_places(scene.cameras, "camera");
  check_places(scene.lights, "light");
  check_places(scene.sphls, "SPHL");
}

}  // namespace ssphh::scene
