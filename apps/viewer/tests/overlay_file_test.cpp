// Edits saved as an overlay are loaded back the same, and no file that was opened is written.

#include "model/overlay_file.h"

#include <gmock/gmock.h>

#include <ssphh/core/file.h>
#include <ssphh/scene/builtin.h>
#include <ssphh/scene_io/gltf_export.h>
#include <ssphh/scene_io/load.h>

#include "model/lamp_aim.h"
#include "model/sky_edit.h"
#include "temp_dir.h"

namespace ssphh::viewer {
namespace {

using testing::HasSubstr;

class OverlayFile : public testing::Test {
 protected:
  std::string path(const std::string& name) const { return dir_ / name; }
  Document open(const std::string& source) const {
    return make_document(source, scene_io::load_scene(source), 0);
  }
  /// What lights the scene, looked up by the lamps' names.
  static void expect_same(const scene::Scene& a, const scene::Scene& b) {
    ASSERT_EQ(a.lights.size(), b.lights.size());
    for (const scene::Light& light : a.lights) {
      SCOPED_TRACE(light.name);
      const auto found = std::ranges::find(b.lights, light.name, &scene::Light::name);
      ASSERT_NE(found, b.lights.end());
      Lamp x = lamp_of(light), y = lamp_of(*found);
      for (float Lamp::*angle : {&Lamp::inner_cone, &Lamp::outer_cone, &Lamp::angular_radius}) {
        EXPECT_NEAR(x.*angle, y.*angle, 1e-6f);
        x.*angle = y.*angle = 0;
      }
      EXPECT_EQ(x, y);
      EXPECT_EQ(light.color, found->color);
      EXPECT_EQ(light.intensity, found->intensity);
      EXPECT_EQ(light.size, found->size);
      const mat4 at = scene::world_matrix(a, light.node, 0.4f),
                 there = scene::world_matrix(b, found->node, 0.4f);
      EXPECT_EQ(light_position(at), light_position(there));
      if (has_direction(light.type, light.profile)) {
        EXPECT_LT(glm::distance(light_direction(at), light_direction(there)), 1e-6f);
        EXPECT_LT(glm::distance(glm::normalize(vec3(at[0])), glm::normalize(vec3(there[0]))), 1e-5f);
      }
    }
    const auto places = [](const scene::Scene& scene) {
      std::map<std::string, scene::ProbePlace> out;
      for (const scene::ProbePlace& place : scene::sphl_places(scene)) out[place.name] = place;
      return out;
    };
    const auto at = places(a), there = places(b);
    ASSERT_EQ(at.size(), there.size());
    for (const auto& [name, place] : at) {
      EXPECT_EQ(place.position, there.at(name).position) << name;
      EXPECT_EQ(place.radius, there.at(name).radius) << name;
    }
    for (std::size_t i = 0; i < a.materials.size(); ++i)
      EXPECT_TRUE(same_surface(a.materials[i], b.materials[i]));
  }
  test::TempDir dir_;
};

TEST_F(OverlayFile, LampsOfAllKindsComeBackTheSame) {
  Document document = open("builtin:two-rooms");
  document.edit("add", [](Edits& e) {
    for (const scene::LightType type :
         {scene::LightType::point, scene::LightType::spot, scene::LightType::directional,
          scene::LightType::sphere, scene::LightType::sphl, scene::LightType::rectangle,
          scene::LightType::disc}) {
      e.lights.push_back(new_lamp(type, std::string(name_of(type)), {1.1f, 2, 0.3f}, 1.7f, -0.3f));
      e.lights.back().world = with_direction(*e.lights.back().world, {0.3f, -1, 0.2f});
      e.lights.back().color = {1, 0.7f, 0.1f};
    }
    set_lamp_number(e.lights[1], "range", 7.3f);
    set_lamp_number(e.lights[2], "outer cone", 23.4f);
    e.lights[4].on = false;
    e.lights[6].world = with_turn(*e.lights[6].world, 0.7f);
    set_lamp_number(e.lights[6], "width", 1.37f);
    set_lamp_number(e.lights[7], "power", 41.7f);
    const scene::LampProfile profile{
        "a \"lamp\"", std::make_shared<const scene::PhotometricTable>(scene::PhotometricTable{
                          scene::Photometry::c, {0, 30.3f, 90}, {0, 90, 360}, {9, 4, 1, 9, 5, 0, 9, 4, 1}})};
    e.lights[1].lamp.profile = e.lights[2].lamp.profile = profile;
    e.lights[0].world = with_position(mat4(1), {-2, 2.2f, 0.1f});
    e.sphls.erase(e.sphls.begin() + 1);
    e.sphls.push_back({-1, vec3(1, 1.5f, 0.5f), "added", 0.2f, true});
    e.materials[2].base_color = {0.1f, 0.2f, 0.3f};
  });
  save_document(document, path("edits.ssphh.json"));
  const scene::Scene back = scene_io::load_scene(path("edits.ssphh.json"));
  expect_same(document.edited(), back);
  // Edits of edits: a file on the other.
  Document second = open(path("edits.ssphh.json"));
  second.edit("more", [](Edits& e) {
    e.lights.erase(e.lights.begin() + 2);
    e.lights[0].intensity = 3;
  });
  save_document(second, path("second.ssphh.json"));
  expect_same(second.edited(), scene_io::load_scene(path("second.ssphh.json")));
}

TEST_F(OverlayFile, LeavesOutWhatWasNotChanged) {
  const Document document = open("builtin:two-rooms");
  save_document(document, path("none.ssphh.json"));
  EXPECT_EQ(read_text_file(path("none.ssphh.json")), "{\n  \"scene\": \"builtin:two-rooms\"\n}\n");
  EXPECT_EQ(scene::scene_hash(scene_io::load_scene(path("none.ssphh.json"))),
            scene::scene_hash(*document.scene));
}

TEST_F(OverlayFile, StandsOnTheFilesThatWereOpened) {
  scene_io::write_glb(path("room.glb"), scene::make_builtin("two-rooms"));
  write_file(path("room.ssphh.json"), std::string_view(R"({"lights": [{"name": "own", "type": "point"}]})"));
  const std::string before = read_text_file(path("room.ssphh.json"));
  Document document = open(path("room.glb"));
  ASSERT_EQ(document.scene->lights.size(), 2u);
  document.edit("dim", [](Edits& e) { e.lights[1].intensity = 9; });
  save_document(document, path("mine.ssphh.json"));
  EXPECT_EQ(read_text_file(path("room.ssphh.json")), before);
  EXPECT_THAT(read_text_file(path("mine.ssphh.json")),
              testing::AllOf(HasSubstr(R"("scene": "room.glb")"), HasSubstr(R"("room.ssphh.json")")));
  expect_same(document.edited(), scene_io::load_scene(path("mine.ssphh.json")));
  scene_io::LoadOptions named;
  named.overlay = path("mine.ssphh.json");
  expect_same(document.edited(), scene_io::load_scene(path("room.glb"), named));
  // An overlay that was named in place of the one beside.
  write_file(path("other.ssphh.json"),
             std::string_view(R"({"lights": [{"name": "other", "type": "point"}]})"));
  EXPECT_THAT(opened_files(path("room.glb"), path("other.ssphh.json")).overlays,
              testing::ElementsAre(path("other.ssphh.json")));
}

TEST_F(OverlayFile, ALampOnAMovingThingStaysThere) {
  scene::Scene scene = scene::make_builtin("two-rooms");
  int door = -1;
  for (std::size_t i = 0; i < scene.nodes.size(); ++i)
    if (scene.nodes[i].movable &&
        std::ranges::count(scene.nodes, scene.nodes[i].name, &scene::Node::name) == 1)
      door = static_cast<int>(i);
  ASSERT_GE(door, 0);
  scene.lights.push_back(scene.lights[0]);
  scene.lights[1].name = "on the door", scene.lights[1].node = door;
  scene_io::write_glb(path("room.glb"), scene);
  Document document = open(path("room.glb"));
  const auto lamp =
      static_cast<std::size_t>(std::ranges::find(document.scene->lights, "on the door", &scene::Light::name) -
                               document.scene->lights.begin());
  document.edit("colour", [&](Edits& e) { e.lights[lamp].color = {1, 0, 0}; });
  save_document(document, path("mine.ssphh.json"));
  expect_same(document.edited(), scene_io::load_scene(path("mine.ssphh.json")));
}

TEST_F(OverlayFile, HoldsCameras) {
  Document document = open("builtin:two-rooms");
  const View view = look_at({1, 1.5f, 0.5f}, {-2, 1, 0.2f}, 0.7f);
  View above = seen_along(view, {0, -1, 0});
  above.orthographic = true, above.yheight = 6.5f;
  const std::size_t before = document.edits().cameras.size();
  ASSERT_GE(before, 2u);
  document.edit("cameras", [&](Edits& e) {
    add_camera(e, "door", view);
    add_camera(e, "plan", above);
    rename_camera(e, 0, "first");
    e.cameras.erase(e.cameras.begin() + 1);
  });
  EXPECT_EQ(start_view(document, "door"), view);
  EXPECT_EQ(start_view(document, "first"), start_view(open("builtin:two-rooms"), ""));
  for (const char* file : {"mine.ssphh.json", "whole.glb"}) {
    SCOPED_TRACE(file);
    save_document(document, path(file));
    const scene::Scene back = scene_io::load_scene(path(file));
    ASSERT_EQ(back.cameras.size(), before + 1);
    const scene::CameraPose door = scene::camera_pose(back, "door");
    EXPECT_EQ(vec3(door.world[3]), view.eye);
    EXPECT_LT(glm::distance(vec3(door.world[2]), -view.forward()), 1e-6f);
    EXPECT_LT(glm::distance(vec3(door.world[1]), view.up()), 1e-6f);
    EXPECT_NEAR(door.camera.yfov, 0.7f, 1e-6f);
    const scene::CameraPose plan = scene::camera_pose(back, "plan");
    EXPECT_TRUE(plan.camera.orthographic);
    EXPECT_EQ(plan.camera.yheight, 6.5f);
    EXPECT_LT(glm::distance(vec3(plan.world[2]), vec3(0, 1, 0)), 1e-6f);
    EXPECT_EQ(vec3(scene::camera_pose(back, "first").world[3]),
              vec3(scene::camera_pose(*document.opened, document.opened->cameras[0].name).world[3]));
    EXPECT_THROW(scene::camera_pose(back, document.opened->cameras[1].name), Error);
  }
}

TEST_F(OverlayFile, HoldsFactorsTheSkyAndItsTurn) {
  scene::Scene scene = scene::make_builtin("two-rooms");
  scene::add_sun_sky(scene, {.elevation = 0.5f});
  const auto same_light = [](const scene::Scene& a, const scene::Scene& b) {
    ASSERT_TRUE(a.environment && b.environment);
    EXPECT_NEAR(a.environment->rotation, b.environment->rotation, 1e-6f);
    EXPECT_EQ(a.environment->color, b.environment->color);
    double difference = 0, sum = 0;
    for (std::size_t i = 0; i < a.environment->equirect.pixels.size(); ++i) {
      difference += std::abs(
          static_cast<double>(a.environment->equirect.pixels[i] - b.environment->equirect.pixels[i]));
      sum += static_cast<double>(a.environment->equirect.pixels[i]);
    }
    EXPECT_LT(difference, 1e-4 * sum);
    ASSERT_EQ(a.lights.size(), b.lights.size());
    for (const scene::Light& light : a.lights) {
      const auto found = std::ranges::find(b.lights, light.name, &scene::Light::name);
      ASSERT_NE(found, b.lights.end());
      EXPECT_NEAR(light.intensity, found->intensity, 1e-4f * light.intensity) << light.name;
      EXPECT_LT(glm::distance(light.color, found->color), 1e-4f) << light.name;
      EXPECT_LT(glm::distance(light_direction(scene::world_matrix(a, light.node)),
                              light_direction(scene::world_matrix(b, found->node))),
                1e-4f)
          << light.name;
    }
  };
  write_file(path("below.ssphh.json"),
             std::string_view(R"({"scene": "builtin:two-rooms", "sun_sky": {"elevation_degrees": 30}})"));
  for (const float turn : {0.0f, 0.8f}) {
    Document document = open(path("below.ssphh.json"));
    scene::SunSkyParams sky = *shown_sky(document);
    sky.elevation = 0.9f, sky.turbidity = 5;
    change_sky(document, sky);
    document.edit("more", [&](Edits& e) { e.groups["lamp"] = {2, 1, 0.5f}, e.environment_rotation = turn; });
    save_document(document, path("sky.ssphh.json"));
    same_light(document.edited(), scene_io::load_scene(path("sky.ssphh.json")));
  }
}

TEST_F(OverlayFile, LiesOnNoOtherSceneByItsName) {
  const Document document = open("builtin:two-rooms");
  save_document(document, path("a.glb"));
  EXPECT_THROW(save_document(document, path("a.ssphh.json")), Error) << "whoever opens a.glb would have it";
  save_document(document, path("b.ssphh.json"));
  EXPECT_THROW(save_document(document, path("b.glb")), Error);
  Document own = open(path("a.glb"));
  save_document(own, path("a.ssphh.json"));
}

TEST_F(OverlayFile, SaysWhatItCannotHold) {
  scene::Scene scene = scene::make_builtin("two-rooms");
  scene.materials[1].name = scene.materials[2].name = "twin";
  Document document = make_document("builtin:two-rooms", std::move(scene), 0);
  document.edit("colour", [](Edits& e) { e.materials[1].base_color = {1, 0, 0}; });
  const auto error = [&] {
    try {
      save_document(document, path("x.ssphh.json"));
    } catch (const Error& e) {
      return std::string(e.what());
    }
    return std::string();
  };
  EXPECT_THAT(error(), testing::AllOf(HasSubstr("twin"), HasSubstr("save the scene as .glb")));
  document.undo();
  EXPECT_EQ(error(), "");
  document.recovered = true;
  EXPECT_THAT(error(), HasSubstr("recovered"));
}

}  // namespace
}  // namespace ssphh::viewer
