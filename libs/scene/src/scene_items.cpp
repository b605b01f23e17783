#include <algorithm>
#include <map>
#include <tuple>

#include <ssphh/scene/query.h>
#include <ssphh/scene/scene_items.h>

#include "digests.h"

namespace ssphh::scene {
namespace {

/// Digests of materials, what they reflect apart from what they emit.
struct MaterialDigests {
  explicit MaterialDigests(const Scene& scene) {
    std::vector<Hash128> textures;
    for (const Texture& texture : scene.textures) textures.push_back(digest(texture));
    const auto take = [&](const Material& material) {
      Material dark = material;
      dark.emission = vec3(0);
      dark.emission_texture = {};
      surface.push_back(digest(dark, textures));
      emission.push_back(digest(material, textures));
    };
    for (const Material& material : scene.materials) take(material);
    take({});
  }
  std::vector<Hash128> surface, emission;  ///< of the scene's; at the end those of Material{}
};

Hash128 place_digest(const Hash128& node, const mat4& world) {
  Hasher h;
  add(h, node);
  for (int column = 0; column < 4; ++column) {
    for (int row = 0; row < 4; ++row) h.value(world[column][row] + 0.0f);  // no negative zero
  }
  return h.finish();
}

const std::string& name_of_instance(const Scene& scene, const Instance& instance) {
  const std::string& mesh = scene.meshes[instance.mesh].name;
  if (instance.node < 0) return mesh;
  const std::string& node = scene.nodes[instance.node].name;
  return node.empty() ? mesh : node;
}

auto contents(const SceneItem& item) {
  const auto both = [](const Hash128& hash) { return std::pair(hash.high, hash.low); };
  return std::tuple(item.kind, both(item.shape), both(item.place), both(item.surface), both(item.emission));
}

}  // namespace

std::vector<SceneItem> scene_items(const Scene& scene, float time) {
  const std::vector<mat4> world = world_matrices(scene, time);
  const std::vector<Hash128> nodes = node_digests(scene);
  const auto place = [&](int node) {
    if (node < 0) return Hash128{};
    const auto n = static_cast<std::size_t>(node);
    return place_digest(nodes[n], world[n]);
  };
  const MaterialDigests materials(scene);
  std::vector<Hash128> meshes;
  for (const Mesh& mesh : scene.meshes) meshes.push_back(digest(mesh));

  std::vector<SceneItem> items;
  for (const Instance& instance : scene.instances) {
    const int given = instance_material(scene, instance);
    const std::size_t material = given < 0 ? scene.materials.size() : static_cast<std::size_t>(given);
    SceneItem item{ItemKind::object,     name_of_instance(scene, instance), meshes[instance.mesh],
                   place(instance.node), materials.surface[material],       {}};
    if (given >= 0 && scene.materials[material].emissive()) {
      Hasher h;
      add(h.text(light_group(scene, instance)), materials.emission[material]);
      item.emission = h.finish();
    }
    items.push_back(std::move(item));
  }
  for (Light light : scene.lights) {
    SceneItem item{ItemKind::light, light.name, {}, place(light.node), {}, {}};
    light.node = -1;
    Hasher h;
    add(h, light);
    item.emission = h.finish();
    items.push_back(std::move(item));
  }
  if (scene.environment) {
    Hasher h;
    add(h, *scene.environment);
    items.push_back({ItemKind::environment, scene.environment->name, {}, {}, {}, h.finish()});
  }
  return items;
}

std::vector<ChangedItem> changed_items(std::span<const SceneItem> before, std::span<const SceneItem> now) {
  // What equals something of before is done with.
  std::map<decltype(contents(before[0])), std::size_t> known;
  for (const SceneItem& item : before) ++known[contents(item)];
  std::vector<const SceneItem*> new_ones;
  for (const SceneItem& item : now) {
    const auto found = known.find(contents(item));
    if (found == known.end() || found->second == 0) {
      new_ones.push_back(&item);
    } else {
      --found->second;
    }
  }
  // Of equal ones the last are those that are gone.
  std::map<std::pair<ItemKind, std::string>, std::vector<const SceneItem*>> gone;
  for (std::size_t i = before.size(); i-- > 0;) {
    std::size_t& left = known[contents(before[i])];
    if (left == 0) continue;
    --left;
    gone[{before[i].kind, before[i].name}].push_back(&before[i]);
  }

  std::vector<ChangedItem> changed;
  for (const SceneItem* item : new_ones) {
    ChangedItem& change = changed.emplace_back(ChangedItem{item->kind, item->name, {}});
    std::vector<const SceneItem*>& old = gone[{item->kind, item->name}];
    if (old.empty()) {
      change.changes.push_back(ItemChange::added);
      continue;
    }
    const SceneItem& was = *old.back();
    old.pop_back();
    if (item->place != was.place) change.changes.push_back(ItemChange::moved);
    if (item->shape != was.shape) change.changes.push_back(ItemChange::shape);
    if (item->surface != was.surface) change.changes.push_back(ItemChange::surface);
    if (item->emission != was.emission) change.changes.push_back(ItemChange::emission);
  }
  for (const auto& [key, items] : gone) {
    for (auto item = items.rbegin(); item != items.rend(); ++item)
      changed.push_back({(*item)->kind, (*item)->name, {ItemChange::removed}});
  }
  return changed;
}

bool bodies_changed(std::span<const ChangedItem> changed) {
  return std::ranges::any_of(changed, [](const ChangedItem& item) {
    return item.kind == ItemKind::object && std::ranges::any_of(item.changes, [](ItemChange change) {
             return change != ItemChange::emission;
           });
  });
}

}  // namespace ssphh::scene
