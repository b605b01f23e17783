#include <functional>

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <ssphh/scene/builtin.h>
#include <ssphh/scene/primitives.h>
#include <ssphh/scene/query.h>
#include <ssphh/scene/scene_items.h>

namespace ssphh::scene {
namespace {

using testing::ElementsAre;
using testing::IsEmpty;

/// Two chairs of one mesh, a lamp of glowing surface, a table, a lamp, a sky, and something that moves.
Scene furnished() {
  Scene s;
  s.materials.resize(3);
  s.materials[1].emission = vec3(2);
  s.meshes.push_back(make_box(vec3(0), vec3(1)));
  s.meshes.push_back(make_box(vec3(0), vec3(2)));
  for (const char* name : {"chair", "chair", "glow", "table", "door", "lamp"}) {
    s.nodes.emplace_back().name = name;
    s.nodes.back().local.translation.x = static_cast<float>(s.nodes.size());
  }
  for (const int node : {0, 1, 2, 3, 4}) s.instances.push_back({node == 3, node, node == 2, ""});
  s.lights.resize(1);
  s.lights[0].name = "lamp";
  s.lights[0].node = 5;
  s.environment.emplace();
  s.animations.resize(1);
  s.animations[0].channels.push_back(
      {4, AnimationPath::translation, Interpolation::linear, {0, 1}, {vec4(0), vec4(1)}});
  return s;
}

std::vector<ChangedItem> changes(const std::function<void(Scene&)>& change) {
  Scene now = furnished();
  change(now);
  return changed_items(scene_items(furnished()), scene_items(now));
}

TEST(SceneItems, NothingChangedIsNothing) {
  EXPECT_THAT(changes([](Scene&) {}), IsEmpty());
  EXPECT_FALSE(bodies_changed({}));
}

TEST(SceneItems, NamesCamerasAndSphlsDoNotCount) {
  EXPECT_THAT(changes([](Scene& s) {
                s.nodes[3].name = "desk";
                s.materials[0].name = s.meshes[1].name = "new";
                s.cameras.emplace_back().node = 0;
                s.sphls.push_back({"s", 0, 0.1f, true});
              }),
              IsEmpty());
}

TEST(SceneItems, WhatHangsOnNoNodeHasItsMeshsName) {
  Scene s = furnished();
  s.meshes[1].name = "table top";
  s.instances[3].node = -1;
  EXPECT_EQ(scene_items(s)[3].name, "table top");
}

TEST(SceneItems, OrderDoesNotCount) {
  EXPECT_THAT(changes([](Scene& s) { std::swap(s.instances[0], s.instances[3]); }), IsEmpty());
}

TEST(SceneItems, EveryChangeHasItsName) {
  using enum ItemChange;
  const auto only = [](ItemKind kind, const char* name, ItemChange change) {
    return ElementsAre(ChangedItem{kind, name, {change}});
  };
  EXPECT_THAT(changes([](Scene& s) { s.nodes[1].local.translation.z = 3; }),
              only(ItemKind::object, "chair", moved));
  EXPECT_THAT(changes([](Scene& s) { s.meshes[1].positions[0].x -= 0.1f; }),
              only(ItemKind::object, "table", shape));
  EXPECT_THAT(changes([](Scene& s) { s.instances[3].material = 2, s.materials[2].base_color = vec3(0.1f); }),
              only(ItemKind::object, "table", surface));
  EXPECT_THAT(changes([](Scene& s) { s.materials[1].emission = vec3(3); }),
              only(ItemKind::object, "glow", emission));
  EXPECT_THAT(changes([](Scene& s) { s.instances[2].light_group = "other"; }),
              only(ItemKind::object, "glow", emission));
  EXPECT_THAT(changes([](Scene& s) { s.instances.erase(s.instances.begin() + 3); }),
              only(ItemKind::object, "table", removed));
  EXPECT_THAT(changes([](Scene& s) { s.lights[0].intensity = 7; }), only(ItemKind::light, "lamp", emission));
  EXPECT_THAT(changes([](Scene& s) { s.nodes[5].local.translation.y = 2; }),
              only(ItemKind::light, "lamp", moved));
  EXPECT_THAT(changes([](Scene& s) { s.lights.clear(); }), only(ItemKind::light, "lamp", removed));
  EXPECT_THAT(changes([](Scene& s) { s.environment->rotation = 1; }),
              only(ItemKind::environment, "environment", emission));
  EXPECT_THAT(changes([](Scene& s) { s.environment.reset(); }),
              only(ItemKind::environment, "environment", removed));
  EXPECT_THAT(changes([](Scene& s) { s.animations[0].channels[0].values[1].y = 0.5f; }),
              only(ItemKind::object, "door", moved));
  EXPECT_THAT(changes([](Scene& s) {
                s.nodes.emplace_back().name = "chair";
                s.instances.push_back({0, 6, -1, ""});
              }),
              only(ItemKind::object, "chair", added));
}

TEST(SceneItems, OneThingMayChangeInSeveralWays) {
  EXPECT_THAT(changes([](Scene& s) {
                s.nodes[2].local.scale = vec3(2);
                s.materials[1].emission = s.materials[1].base_color = vec3(0.3f);
              }),
              ElementsAre(ChangedItem{
                  ItemKind::object, "glow", {ItemChange::moved, ItemChange::surface, ItemChange::emission}}));
}

TEST(SceneItems, APoseCountsAsFarAsItMoves) {
  const Scene s = furnished();
  EXPECT_THAT(changed_items(scene_items(s, 0), scene_items(s, 0.5f)),
              ElementsAre(ChangedItem{ItemKind::object, "door", {ItemChange::moved}}));
  EXPECT_THAT(changed_items(scene_items(s, 1), scene_items(s, 2)), IsEmpty()) << "it stands still by then";
}

TEST(SceneItems, BodiesAreToldFromLight) {
  EXPECT_TRUE(bodies_changed(changes([](Scene& s) { s.nodes[1].local.translation.z = 3; })));
  EXPECT_TRUE(bodies_changed(changes([](Scene& s) { s.instances.pop_back(); })));
  EXPECT_TRUE(bodies_changed(changes([](Scene& s) { s.materials[1].base_color = vec3(0.3f); })));
  EXPECT_FALSE(bodies_changed(changes([](Scene& s) { s.materials[1].emission = vec3(3); })));
  EXPECT_FALSE(bodies_changed(changes([](Scene& s) { s.lights.clear(), s.environment.reset(); })));
}

/// Whoever trusts the items where nothing has changed trusts that they see what light_hash sees.
TEST(SceneItems, SeeWhatTheLightHashSees) {
  const auto same = [](const Scene& a, const Scene& b) {
    const bool items = changed_items(scene_items(a), scene_items(b)).empty();
    EXPECT_EQ(items, light_hash(a) == light_hash(b));
  };
  const Scene before = furnished();
  for (const auto& change : std::vector<std::function<void(Scene&)>>{
           [](Scene&) {}, [](Scene& s) { s.nodes[3].name = "desk"; },
           [](Scene& s) { s.materials[0].specular_roughness = 0.2f; },
           [](Scene& s) { s.materials[1].double_sided = true; },
           [](Scene& s) { s.materials[1].unlit = true; }, [](Scene& s) { s.meshes[0].triangles.pop_back(); },
           [](Scene& s) { s.lights[0].range = 5; }, [](Scene& s) { s.lights[0].group = "g"; },
           [](Scene& s) { s.nodes[4].parent = 0; }}) {
    Scene now = furnished();
    change(now);
    same(before, now);
  }
}

}  // namespace
}  // namespace ssphh::scene
