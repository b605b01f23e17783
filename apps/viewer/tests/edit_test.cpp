#include <gmock/gmock.h>

#include <ssphh/scene/builtin.h>
#include <ssphh/scene/sun_sky.h>
#include <ssphh/scene/turn_surroundings.h>
#include <ssphh/scene_io/load.h>

#include "model/document.h"
#include "temp_dir.h"

namespace ssphh::viewer {
namespace {

TEST(History, DragIsOneStepAndUndoTakesItBack) {
  History<int> history(0);
  history.change(1, "move lamp");
  history.change(2, "move lamp");
  history.seal();
  history.change(3, "move lamp");
  history.change(4, "colour lamp");
  EXPECT_EQ(history.undo_name(), "colour lamp");
  EXPECT_TRUE(history.undo());
  EXPECT_EQ(history.now(), 3);
  EXPECT_TRUE(history.undo());
  EXPECT_EQ(history.now(), 2);
  EXPECT_EQ(history.redo_name(), "move lamp");
  EXPECT_TRUE(history.undo());
  EXPECT_EQ(history.now(), 0);
  EXPECT_FALSE(history.undo());
  EXPECT_TRUE(history.redo());
  EXPECT_EQ(history.now(), 2);
  history.change(9, "move lamp");
  EXPECT_FALSE(history.redo()) << "a change after undo ends what could be done again";
  EXPECT_TRUE(history.undo());
  EXPECT_EQ(history.now(), 2);
}

TEST(History, ForgetsTheOldest) {
  History<int> history(0);
  const int steps = static_cast<int>(History<int>::most_steps) + 10;
  for (int i = 1; i <= steps; ++i) history.change(i, "x"), history.seal();
  while (history.undo()) {
  }
  EXPECT_EQ(history.now(), 10);
}

TEST(History, NamesWhatItWouldDo) {
  History<int> history(0);
  EXPECT_EQ(history.undo_name(), "");
  EXPECT_EQ(history.redo_name(), "");
  history.change(1, "a"), history.change(2, "b");
  history.undo();
  EXPECT_EQ(history.undo_name(), "a");
  EXPECT_EQ(history.redo_name(), "b");
  history.change(3, "a");
  EXPECT_EQ(history.now(), 3);
  history.undo();
  EXPECT_EQ(history.now(), 1) << "undo ends a gesture: what follows is a step of its own";
}

TEST(History, EachStateHasItsSerial) {
  History<int> history(7);
  EXPECT_EQ(history.serial(), 0u);
  history.change(1, "move");
  const auto first = history.serial();
  history.change(2, "move");
  const auto second = history.serial();
  EXPECT_TRUE(first != 0 && second != 0 && first != second) << "one step, but two states";
  history.seal();
  history.change(3, "places", false);
  EXPECT_EQ(history.serial(), second) << "counts for nothing";
  history.change(4, "colour");
  const auto third = history.serial();
  EXPECT_GT(third, second);
  history.undo(), history.undo();
  EXPECT_EQ(history.serial(), second);
  history.undo();
  EXPECT_EQ(history.serial(), 0u);
  history.redo(), history.redo(), history.redo();
  EXPECT_EQ(history.serial(), third);
  history.undo();
  history.change(4, "colour");
  EXPECT_GT(history.serial(), third) << "the same value after other edits is another state";
}

Document two_rooms(float time = 0) {
  return make_document("builtin:two-rooms", scene::make_builtin("two-rooms"), time);
}

TEST(Edits, AreLostUntilTheyAreSavedOrUndone) {
  Document document = two_rooms();
  EXPECT_FALSE(document.dirty());
  const auto intensity = [&](float value) {
    document.edit_at_once("dim", [&](Edits& e) { e.lights[0].intensity = value; });
  };
  intensity(1);
  EXPECT_TRUE(document.dirty());
  document.history.undo();
  EXPECT_FALSE(document.dirty());
  document.history.redo();
  document.saved = document.history.serial();
  EXPECT_FALSE(document.dirty());
  document.history.undo();
  EXPECT_TRUE(document.dirty()) << "the file has the edit";
  intensity(2);
  EXPECT_TRUE(document.dirty());
}

TEST(Edits, NoneLeaveTheSceneAsItIs) {
  const Document document = two_rooms(0.5f);
  EXPECT_EQ(scene::scene_hash(edited_scene(*document.scene, document.edits(), document.time)),
            scene::scene_hash(*document.scene));
  const auto states = edited_lighting(*document.scene, document.edits(), 0).lights;
  ASSERT_EQ(states.size(), 1u);
  EXPECT_EQ(light_position(states[0].world), vec3(-2.4f, 2.5f, 0.5f));
  EXPECT_EQ(states[0].intensity, 4);
}

TEST(Edits, EveryKindChangesTheSceneAndIsTakenBack) {
  Document document = two_rooms();
  const Hash128 before = scene::scene_hash(*document.scene);
  std::vector<Hash128> hashes{before};
  const auto edit = [&](const char* what, const auto& change) {
    document.edit(what, change);
    document.history.seal();
    hashes.push_back(scene::scene_hash(edited_scene(*document.scene, document.edits(), 0)));
    EXPECT_NE(hashes.back(), hashes[hashes.size() - 2]) << what;
  };
  edit("move lamp", [&](Edits& e) {
    e.lights[0].world = with_position(edited_lighting(*document.scene, e, 0).lights[0].world, {1, 2, 0.5f});
  });
  edit("colour lamp", [](Edits& e) { e.lights[0].color = {1, 0, 0}; });
  edit("dim lamp", [](Edits& e) { e.lights[0].intensity = 1; });
  edit("switch lamp", [](Edits& e) { e.lights[0].on = false; });
  edit("material", [](Edits& e) { e.materials[0].base_color = {0, 1, 0}; });
  edit("move SPHL", [](Edits& e) { e.sphls[2].position = vec3(0, 1, 0.125f); });
  edit("new SPHL", [](Edits& e) { e.sphls.push_back({-1, vec3(2, 2, 1), new_sphl_name(e), 0.1f, true}); });
  edit("delete SPHL", [](Edits& e) { e.sphls.erase(e.sphls.begin()); });
  for (std::size_t i = hashes.size() - 1; i > 0; --i) {
    EXPECT_EQ(scene::scene_hash(edited_scene(*document.scene, document.edits(), 0)), hashes[i]);
    EXPECT_TRUE(document.history.undo());
  }
  EXPECT_EQ(scene::scene_hash(edited_scene(*document.scene, document.edits(), 0)), before);
}

TEST(Edits, MovedThingsAreWhereTheyWerePut) {
  Document document = two_rooms();
  document.edit("move", [](Edits& e) {
    e.lights[0].world = with_position(mat4(1), {1, 2, 0.5f});
    e.sphls[1].position = vec3(-1, 1, 1);
    e.sphls[0].enabled = false;
    e.sphls.push_back({-1, vec3(2, 2, 1), "mine", 0.25f, true});
  });
  const scene::Scene scene = edited_scene(*document.scene, document.edits(), 0);
  const auto places = scene::sphl_places(scene, 0.7f);
  ASSERT_EQ(places.size(), 6u);
  EXPECT_EQ(places[0].name, "A east");
  EXPECT_EQ(places[0].position, vec3(-1, 1, 1));
  EXPECT_EQ(places[5].name, "mine");
  EXPECT_EQ(places[5].position, vec3(2, 2, 1));
  EXPECT_EQ(places[5].radius, 0.25f);
  const auto world = scene::world_matrices(scene, 0.7f);
  EXPECT_EQ(light_position(world[scene.lights[0].node]), vec3(1, 2, 0.5f));
}

TEST(Edits, OfASceneAreItsOwnValues) {
  scene::Scene scene = scene::make_builtin("two-rooms");
  scene.lights[0].color = {0.5f, 0.25f, 1};
  scene.sphls[1].radius = 0.375f, scene.sphls[2].enabled = false;
  const Edits edits = edits_of(scene);
  EXPECT_EQ(edits.lights,
            (std::vector<LightEdit>{{{}, {0.5f, 0.25f, 1}, 4, true, 0, lamp_of(scene.lights[0])}}));
  EXPECT_EQ(edits.materials.size(), scene.materials.size());
  EXPECT_TRUE(edits.groups.empty());
  ASSERT_EQ(edits.sphls.size(), 6u);
  EXPECT_EQ(edits.sphls[1], (SphlEdit{1, {}, scene.sphls[1].name, 0.375f, true}));
  EXPECT_FALSE(edits.sphls[2].enabled);
}

TEST(Edits, LightsAreAsTheyWereSet) {
  const Document document = two_rooms();
  Edits edits = document.edits();
  edits.lights[0].color = {1, 0.5f, 0.25f}, edits.lights[0].intensity = 3;
  const mat4 own = edited_lighting(*document.scene, edits, 0).lights[0].world;
  EXPECT_EQ(edited_lighting(*document.scene, edits, 0).lights[0],
            (scene::LightState{own, {1, 0.5f, 0.25f}, 3}));
  edits.lights[0].on = false;
  EXPECT_EQ(edited_lighting(*document.scene, edits, 0).lights[0].intensity, 0);
  const mat4 there = with_position(own, {7, 8, 9});
  edits.lights[0].world = there;
  EXPECT_EQ(edited_lighting(*document.scene, edits, 0).lights[0].world, there);
  EXPECT_EQ(there[0], own[0]);
  EXPECT_EQ(there[3], vec4(7, 8, 9, 1));
}

TEST(Edits, ATurnedSkyTakesItsSunAlongUnlessThatWasSetByHand) {
  scene::Scene scene = scene::make_builtin("box");
  scene::add_sun_sky(scene);
  const std::size_t sun = scene.lights.size() - 1;
  Edits edits = edits_of(scene);
  const scene::LightingState still = edited_lighting(scene, edits, 0);
  edits.environment_rotation = 0.5f;
  scene::LightingState turned = still;
  scene::turn_surroundings(turned, scene, 0.5f);
  EXPECT_EQ(edited_lighting(scene, edits, 0), turned);
  EXPECT_NE(turned.lights[sun], still.lights[sun]);
  edits.lights[sun].world = still.lights[sun].world;
  EXPECT_EQ(edited_lighting(scene, edits, 0).lights[sun], still.lights[sun]);
}

TEST(Edits, GroupsWithoutAFactorHaveOne) {
  const scene::Scene scene = scene::make_builtin("gallery1");
  Edits edits = edits_of(scene);
  const std::vector<std::string> groups = scene::light_groups(scene);
  ASSERT_GE(groups.size(), 2u);
  edits.groups[groups[1]] = {1, 2, 3};
  std::vector<vec3> wanted(groups.size(), vec3(1));
  wanted[1] = {1, 2, 3};
  EXPECT_EQ(edited_lighting(scene, edits, 0).group_scales, wanted);
}

TEST(Edits, SurfacesAreTheSameIfEveryValueIs) {
  const scene::Material plain;
  EXPECT_TRUE(same_surface(plain, plain));
  scene::Material named = plain;
  named.name = "other";
  EXPECT_TRUE(same_surface(plain, named));
  const std::vector<void (*)(scene::Material&)> changes = {
      [](scene::Material& m) { m.base_color.y += 0.1f; },
      [](scene::Material& m) { m.alpha -= 0.5f; },
      [](scene::Material& m) { m.metallic += 0.1f; },
      [](scene::Material& m) { m.diffuse_roughness += 0.1f; },
      [](scene::Material& m) { m.specular_roughness += 0.1f; },
      [](scene::Material& m) { m.specular += 0.1f; },
      [](scene::Material& m) { m.ior += 0.1f; },
      [](scene::Material& m) { m.emission.z += 0.1f; }};
  for (std::size_t i = 0; i < changes.size(); ++i) {
    scene::Material changed = plain;
    changes[i](changed);
    EXPECT_FALSE(same_surface(plain, changed)) << i;
  }
}

TEST(Edits, PlacesAreTheSameWhateverTheirNames) {
  const std::vector<SphlEdit> base = {{0, {}, "a", 0.1f, true}, {-1, vec3(1, 2, 3), "b", 0.1f, true}};
  std::vector<SphlEdit> other = base;
  other[0].name = "c", other[1].radius = 2;
  EXPECT_TRUE(same_places(base, other));
  other[0].source = 1;
  EXPECT_FALSE(same_places(base, other));
  other = base, other[1].position = vec3(1, 2, 4);
  EXPECT_FALSE(same_places(base, other));
  other = base, other[0].enabled = false;
  EXPECT_FALSE(same_places(base, other));
  other = base, other.pop_back();
  EXPECT_FALSE(same_places(base, other));
}

TEST(Edits, AnSphlStandsAtItsNodeUnlessMoved) {
  const scene::Scene scene = scene::make_builtin("two-rooms");
  const std::vector<mat4> world = scene::world_matrices(scene, 0);
  const Edits edits = edits_of(scene);
  const auto places = scene::sphl_places(scene, 0);
  for (std::size_t i = 0; i < places.size(); ++i)
    EXPECT_EQ(sphl_position(scene, world, edits.sphls[i]), places[i].position);
  SphlEdit moved = edits.sphls[0];
  moved.position = vec3(1, 2, 3);
  EXPECT_EQ(sphl_position(scene, world, moved), vec3(1, 2, 3));
}

TEST(Edits, MaterialsAloneLeaveLampsAndProbes) {
  const Document document = two_rooms();
  Edits edits = document.edits();
  edits.materials[0].base_color = {0, 1, 0};
  edits.lights[0].intensity = 99;
  edits.sphls.clear();
  const scene::Scene scene = with_materials(*document.scene, edits);
  EXPECT_EQ(scene.materials[0].base_color, vec3(0, 1, 0));
  EXPECT_EQ(scene.lights[0].intensity, document.scene->lights[0].intensity);
  EXPECT_EQ(scene.sphls.size(), 6u);
}

TEST(Edits, DirectionTurnsALightOnTheSpot) {
  mat4 world(1);
  world[3] = vec4(4, 5, 6, 1);
  for (const vec3& direction : {vec3(0, -2, 0), vec3(1, 1, -1)}) {
    const mat4 turned = with_direction(world, direction);
    EXPECT_LT(glm::distance(light_direction(turned), glm::normalize(direction)), 1e-6f);
    EXPECT_EQ(light_position(turned), vec3(4, 5, 6));
    EXPECT_NEAR(glm::determinant(mat3(turned)), 1, 1e-5f);
  }
}

TEST(Edits, ANewSphlGetsANameOfItsOwn) {
  Edits edits;
  for (int i = 0; i < 5; ++i) edits.sphls.push_back({-1, vec3(0), new_sphl_name(edits), 0.1f, true});
  edits.sphls.erase(edits.sphls.begin() + 1);
  EXPECT_EQ(edits.sphls.back().name, "SPHL 5") << "the next number";
  const std::string name = new_sphl_name(edits);
  EXPECT_EQ(name, "SPHL 6") << "5 is taken";
  for (const SphlEdit& sphl : edits.sphls) EXPECT_NE(sphl.name, name);
}

TEST(Document, SavesASceneThatLoadsBackTheSame) {
  Document document = two_rooms(0.4f);
  document.edit("all", [](Edits& e) {
    e.lights[0].world = with_position(mat4(1), {1, 2, 0.5f});
    e.lights[0].color = {0.2f, 0.4f, 1};
    e.lights[0].intensity = 7;
    e.materials[1].base_color = {0.9f, 0.1f, 0.1f};
    e.materials[2].diffuse_roughness = -0.5f;
    e.sphls[0].position = vec3(-3, 1, 0);
    e.sphls.push_back({-1, vec3(2, 2, 1), "mine", 0.2f, true});
  });
  const test::TempDir dir;
  save_document(document, dir / "rooms.glb");
  const scene::Scene back = scene_io::load_scene((dir / "rooms.glb").string());
  EXPECT_EQ(scene::scene_hash(back), scene::scene_hash(scene_to_save(document)));
  const auto places = scene::sphl_places(back), edited = scene::sphl_places(scene_to_save(document));
  ASSERT_EQ(places.size(), 7u);
  for (std::size_t i = 0; i < places.size(); ++i) EXPECT_EQ(places[i].position, edited[i].position);
  // And the session goes on from there as from the original.
  const Document again = make_document("again", back, 0.4f);
  EXPECT_EQ(edited_lighting(back, again.edits(), 0.4f).lights[0].intensity, 7);
  EXPECT_THROW(save_document(document, dir / "rooms.obj"), Error);
}

TEST(Document, KnowsWhenAndHowLargeTheSceneIs) {
  const Document document = two_rooms(0.25f);
  EXPECT_EQ(document.source, "builtin:two-rooms");
  EXPECT_EQ(document.time, 0.25f);
  EXPECT_EQ(document.duration, scene::animation_duration(*document.scene));
  EXPECT_GT(document.duration, 0);
  const auto bounds = scene::world_bounds(*document.scene, scene::world_matrices(*document.scene, 0.25f));
  EXPECT_EQ(document.bounds.min, bounds.min);
  EXPECT_EQ(document.bounds.max, bounds.max);
}

TEST(Document, StartsAtAPlaceThatIsGivenWithWhatItLooksAtInFocus) {
  const View view = start_view(two_rooms(), "1,2,3:1,2,-1:40");
  EXPECT_EQ(view.eye, vec3(1, 2, 3));
  EXPECT_LT(glm::distance(view.center(), vec3(1, 2, -1)), 1e-5f);
  EXPECT_FLOAT_EQ(view.yfov, glm::radians(40.0f));
}

TEST(Document, StartsWithTheMiddleOfTheSceneInFocus) {
  const Document document = two_rooms();
  const View view = start_view(document, "room-b");
  EXPECT_FLOAT_EQ(view.focus, glm::distance(view.eye, document.bounds.center()));
  Document empty = make_document("nothing", scene::Scene(*document.scene), 0);
  empty.bounds = {};
  EXPECT_EQ(start_view(empty, "room-b").focus, 3);
  empty.bounds.add(view.eye - 0.01f), empty.bounds.add(view.eye + 0.01f);
  EXPECT_FLOAT_EQ(start_view(empty, "room-b").focus, 0.04f * empty.bounds.radius())
      << "the camera stands there";
}

TEST(Document, IsSavedWithLightsAndProbesInTheOrderOfTheirNodes) {
  Document document = two_rooms();
  // A moved SPHL gets a node at the end.
  document.edit("move", [](Edits& e) { e.sphls[0].position = vec3(-3, 1, 0); });
  const scene::Scene scene = scene_to_save(document);
  ASSERT_EQ(scene.sphls.size(), 6u);
  for (std::size_t i = 1; i < scene.sphls.size(); ++i)
    EXPECT_LT(scene.sphls[i - 1].node, scene.sphls[i].node);
  EXPECT_EQ(scene.sphls.back().name, "A west");
}

TEST(Document, IsSavedWithTheProbesOfOneNodeInTheirOrder) {
  scene::Scene scene = scene::make_builtin("two-rooms");
  for (const char* name : {"z", "y", "x"}) scene.sphls.push_back({name, scene.sphls.front().node, 0.1f});
  const Document document = make_document("several on a node", std::move(scene), 0);
  std::vector<std::string> names;
  const scene::Scene saved = scene_to_save(document);
  for (const scene::Sphl& sphl : saved.sphls)
    if (sphl.node == saved.sphls.front().node) names.push_back(sphl.name);
  EXPECT_THAT(names, testing::ElementsAre("A west", "z", "y", "x"));
}

TEST(Document, StartsAtTheNamedCamera) {
  const Document document = two_rooms();
  EXPECT_EQ(start_view(document, "room-b").eye, vec3(3.8f, 1.6f, -1.3f));
  EXPECT_EQ(start_view(document, "").eye, vec3(-3.8f, 1.6f, 0.9f));
  EXPECT_THROW(start_view(document, "nowhere"), Error);
}

}  // namespace
}  // namespace ssphh::viewer
