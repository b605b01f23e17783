#include <ssphh/scene/with_lighting.h>

#include "digests.h"

namespace ssphh::scene {
namespace {

// What an instance looks like enters through the contents of its mesh and material, so that neither names nor
// unused or doubled objects count. Names count only where they choose something: cameras, SPHLs and light
// groups.

template <class T>
void add_all(Hasher& h, const std::vector<T>& items) {
  h.value(static_cast<std::uint64_t>(items.size()));
  for (const T& item : items) add(h, item);
}

/// Digests of the contents that instances share.
class Contents {
 public:
  explicit Contents(const Scene& scene) : scene_(scene) {
    std::vector<Hash128> textures;
    for (const Texture& texture : scene.textures) textures.push_back(digest(texture));
    for (const Material& material : scene.materials) materials_.push_back(digest(material, textures));
    for (const Mesh& mesh : scene.meshes) meshes_.push_back(digest(mesh));
    plain_ = digest(Material{}, textures);
  }

  /// All of an instance but where it stands.
  void add_instance(Hasher& h, const Instance& instance) const {
    const int material = instance_material(scene_, instance);
    const auto m = static_cast<std::size_t>(material);
    add(h, meshes_[instance.mesh]);
    add(h, material < 0 ? plain_ : materials_[m]);
    h.text(material >= 0 && scene_.materials[m].emissive() ? light_group(scene_, instance) : "");
  }

 private:
  const Scene& scene_;
  std::vector<Hash128> materials_, meshes_;
  Hash128 plain_;
};

void add_environment(Hasher& h, const Scene& scene) {
  h.value(scene.environment.has_value());
  if (scene.environment) add(h, *scene.environment);
}

/// Scenes without any keep the hashes that probe files know them by.
void add_dark_groups(Hasher& h, const Scene& scene) {
  for (const std::string& group : scene.dark_groups) h.text("dark").text(group);
}

Hash128 seen_hash(const Scene& scene) {
  const Contents contents(scene);
  Hasher h;
  add_all(h, scene.nodes);
  h.value(static_cast<std::uint64_t>(scene.instances.size()));
  for (const Instance& instance : scene.instances) contents.add_instance(h.value(instance.node), instance);
  add_all(h, scene.cameras);
  add_all(h, scene.lights);
  add_all(h, scene.sphls);
  for (const Animation& animation : scene.animations) add_all(h, animation.channels);
  add_environment(h, scene);
  add_dark_groups(h, scene);
  return h.finish();
}

Hash128 lit_hash(const Scene& scene) {
  const Contents contents(scene);
  const std::vector<Hash128> nodes = node_digests(scene);
  const auto stands = [&](Hasher& h, int node) { add(h, node < 0 ? Hash128{} : nodes[node]); };
  Hasher h;
  h.text("light").value(static_cast<std::uint64_t>(scene.instances.size()));
  for (const Instance& instance : scene.instances) {
    stands(h, instance.node);
    contents.add_instance(h, instance);
  }
  h.value(static_cast<std::uint64_t>(scene.lights.size()));
  for (Light light : scene.lights) {
    stands(h, light.node);
    light.node = -1;
    add(h, light);
  }
  add_environment(h, scene);
  add_dark_groups(h, scene);
  return h.finish();
}

}  // namespace

Hash128 scene_hash(const Scene& scene) {
  return scene.dark_groups.empty() ? seen_hash(scene) : seen_hash(without_dark_light(scene));
}

Hash128 light_hash(const Scene& scene) {
  return scene.dark_groups.empty() ? lit_hash(scene) : lit_hash(without_dark_light(scene));
}

}  // namespace ssphh::scene
