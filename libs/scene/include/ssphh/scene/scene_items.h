#pragma once
/// What decides the light in a scene, thing by thing: which object, lamp or environment has changed between
/// two states of a scene, and how.

#include <span>
#include <string>
#include <vector>

#include <ssphh/core/enum_names.h>
#include <ssphh/core/hash.h>

namespace ssphh::scene {

struct Scene;

enum class ItemKind { object, light, environment };
constexpr auto enum_table(ItemKind) {
  using enum ItemKind;
  return std::to_array<EnumName<ItemKind>>(
      {{object, "object"}, {light, "light"}, {environment, "environment"}});
}

/// An instance, a lamp or the environment, with content hashes: equal hashes, equal light. What a thing lacks
/// is zero.
struct SceneItem {
  ItemKind kind = ItemKind::object;
  std::string name;
  Hash128 shape;     ///< of an object: its mesh
  Hash128 place;     ///< where it stands in the pose of the time, and how it moves
  Hash128 surface;   ///< of an object: how it reflects
  Hash128 emission;  ///< what it emits, and its light group

  friend bool operator==(const SceneItem&, const SceneItem&) = default;
};

/// Instances in their order, lamps in theirs, the environment. Cameras, SPHLs and nodes on which nothing else
/// stands do not count, as in light_hash(); `time` in seconds chooses the pose.
std::vector<SceneItem> scene_items(const Scene& scene, float time = 0);

enum class ItemChange { added, removed, moved, shape, surface, emission };
constexpr auto enum_table(ItemChange) {
  using enum ItemChange;
  return std::to_array<EnumName<ItemChange>>({{added, "added"},
                                              {removed, "removed"},
                                              {moved, "moved"},
                                              {shape, "shape"},
                                              {surface, "surface"},
                                              {emission, "emission"}});
}

struct ChangedItem {
  ItemKind kind = ItemKind::object;
  std::string name;  ///< as it is now; of what was removed, as it was
  std::vector<ItemChange> changes;

  friend bool operator==(const ChangedItem&, const ChangedItem&) = default;
};

/// What leads from `before` to `now`: a thing that equals another in everything but its name is that one;
/// those left are matched by kind and name, in their order. What is there now comes first, then what was
/// removed.
std::vector<ChangedItem> changed_items(std::span<const SceneItem> before, std::span<const SceneItem> now);

/// Whether any of them is a body that hides or reflects otherwise than before; else light alone has changed.
bool bodies_changed(std::span<const ChangedItem> changed);

}  // namespace ssphh::scene
