#include <cstdlib>

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <ssphh/core/error.h>
#include <ssphh/core/file.h>
#include <ssphh/core/log.h>
#include <ssphh/image/io.h>
#include <ssphh/image/transfer.h>
#include <ssphh/scene/builtin.h>
#include <ssphh/scene/query.h>
#include <ssphh/scene_io/load.h>
#include <ssphh/scene_io/overlay.h>

#include "glb_builder.h"
#include "json_schema.h"
#include "places.h"
#include "temp_dir.h"

namespace ssphh::scene_io {
namespace {

using scene::Scene;
using testing::_;
using testing::HasSubstr;

Scene plain_scene() {
  Scene scene;
  scene.nodes.resize(1);
  scene.nodes[0].name = "arm";
  scene.nodes[0].local.translation = {10, 0, 0};
  scene.materials.resize(1);
  scene.materials[0].name = "clay";
  scene.textures.push_back({"paint", 2, 1, {0, 128, 255, 77, 188, 188, 188, 255}});
  scene.materials[0].base_color_texture.texture = 0;
  return scene;
}

std::string overlay_error(const std::string& text) {
  Scene scene = plain_scene();
  try {
    apply_overlay(scene, text, "test.ssphh.json");
  } catch (const Error& e) {
    return e.what();
  }
  ADD_FAILURE() << "it was accepted: " << text;
  return {};
}

// Also what the schema is tested with.
constexpr const char* rich_overlay = R"({
  "name": "rich", "unit": 0.5, "origin": [1, 0, 0],
  "cameras": [{"name": "c", "position": [0, 0, 5], "look_at": [0, 0, 0], "xfov_degrees": 90, "aspect": 2}],
  "lights": [{"name": "spot", "type": "spot", "position": [0, 3, 0], "direction": [0, -1, 0], "intensity": 7,
              "inner_cone_degrees": 10, "outer_cone_degrees": 20, "light_group": "g", "color": [1, 0.5, 0.25],
              "profile": {"name": "p", "ies": "TILT=NONE\n1 1 1 2 1 1 2 0 0 0 1 1 0 0 90 0 5 6"}},
             {"type": "sphere", "radius": 0.5, "intensity": 2}],
  "without": {"lights": ["nobody"]}, "light_factors": {"g": [1, 1, 1]}, "environment_turn_degrees": 0,
  "sphls": [{"position": [1, 2, 3], "radius": 0.2}, {"name": "on-arm", "position": [0, 1, 0], "node": "arm"}],
  "environment": {"color": [1, 2, 3], "intensity": 2, "rotation_degrees": 180},
  "textures": [{"name": "paint", "gamma": 2, "gain": 0.5, "offset": 0.01}],
  "materials": [{"name": "clay", "base_color": [0.1, 0.2, 0.3], "diffuse_roughness": -0.5, "emission": [1, 0, 0]}]
})";

TEST(Overlay, AddsWhatItSays) {
  Scene scene = plain_scene();
  apply_overlay(scene, rich_overlay, "test.ssphh.json");
  EXPECT_EQ(scene.name, "rich");

  const auto pose = scene::camera_pose(scene, "c");
  EXPECT_EQ(vec3(pose.world[3]), vec3(0, 0, 5));
  EXPECT_EQ(vec3(pose.world[2]), vec3(0, 0, 1)) << "looks along −z";
  EXPECT_NEAR(2 * std::atan(2 * std::tan(pose.camera.yfov / 2)), pi / 2, 1e-6);  // float rounding

  ASSERT_EQ(scene.lights.size(), 2u);
  const auto world = scene::world_matrices(scene);
  const vec3 down = -vec3(world[scene.lights[0].node][2]);
  EXPECT_NEAR(glm::length(down - vec3(0, -1, 0)), 0, 1e-6);  // float rounding
  EXPECT_EQ(scene.lights[0].intensity, 7);
  EXPECT_FLOAT_EQ(scene.lights[0].outer_cone, glm::radians(20.0f));
  EXPECT_EQ(scene::light_group(scene.lights[0]), "g");
  EXPECT_EQ(scene::light_group(scene.lights[1]), "light 2");

  const auto places = scene::sphl_places(scene);
  ASSERT_EQ(places.size(), 2u);
  EXPECT_EQ(places[0].position, vec3(1, 2, 3)) << "what an overlay adds is in metres";
  // The arm stands at 10 of the file's units, whose origin moves by 1 and whose size is halved
  EXPECT_EQ(places[1].position, vec3(4.5f, 0.5f, 0));

  EXPECT_EQ(scene.environment.value().color, vec3(2, 4, 6));
  EXPECT_FLOAT_EQ(scene.environment->rotation, pi);
  EXPECT_EQ(scene.materials[0].base_color, vec3(0.1f, 0.2f, 0.3f));
  EXPECT_EQ(scene.materials[0].diffuse_roughness, -0.5f);
}

TEST(Overlay, ErrorsNameThePlace) {
  EXPECT_THAT(overlay_error(R"({"camera": []})"),
              HasSubstr("unknown member \"camera\" (did you mean \"cameras\"?)"));
  EXPECT_THAT(overlay_error(R"({"cameras": [{"xfov_degrees": 90}]})"),
              HasSubstr("cameras[0]: \"xfov_degrees\" needs"));
  EXPECT_THAT(overlay_error(R"({"lights": [{"type": "laser"}]})"),
              HasSubstr("lights[0].type: \"laser\" is none of: point"));
  EXPECT_THAT(overlay_error(R"({"lights": [{"type": "spot"}]})"), HasSubstr("needs \"direction\""));
  EXPECT_THAT(overlay_error(R"({"lights": [{"type": "sphere"}]})"), HasSubstr("\"radius\" is missing"));
  EXPECT_THAT(overlay_error(R"({"sphls": [{"position": [0, 0]}]})"),
              HasSubstr("sphls[0].position: must have 3 elements, not 2"));
  EXPECT_THAT(overlay_error(R"({"sphls": [{"position": [0,0,0], "node": "leg"}]})"),
              HasSubstr("no node \"leg\""));
  EXPECT_THAT(overlay_error(R"({"sphls": [{"position": [0,0,0], "radius": 0}]})"),
              HasSubstr("greater than 0"));
  EXPECT_THAT(overlay_error(R"({"materials": [{"name": "gold"}]})"), HasSubstr("it has: clay"));
  EXPECT_THAT(overlay_error(R"({"environment": {"image": "none.hdr"}})"), HasSubstr("none.hdr"));
  EXPECT_THAT(overlay_error(R"({"environment": {}, "sun_sky": {}})"), HasSubstr("both"));
  EXPECT_THAT(overlay_error(R"({"sun_sky": {"turbidity": 50}})"), HasSubstr("sun_sky"));
  EXPECT_THAT(overlay_error("[]"), HasSubstr("must be an object"));
}

TEST(Overlay, TheSchemaAgreesWithTheReader) {
  const std::filesystem::path folder = test::source_dir();
  const auto schema = folder / "schemas/scene-overlay.schema.json";
  const auto errors = [&](const std::string& text) { return test::schema_errors(schema, text); };
  EXPECT_THAT(errors(rich_overlay), testing::IsEmpty());
  EXPECT_THAT(errors(read_text_file(folder / "examples/scenes/sponza.ssphh.json")), testing::IsEmpty());
  for (const char* wrong :
       {R"({"camera": []})", R"({"cameras": [{"xfov_degrees": 90}]})", R"({"lights": [{"type": "laser"}]})",
        R"({"lights": [{"type": "point", "direction": [0, -1, 0], "profile": {"path": "x"}}]})",
        R"({"sphls": [{"position": [0, 0]}]})", R"({"sphls": [{"position": [0,0,0], "radius": 0}]})", "[]"}) {
    EXPECT_THAT(errors(wrong), testing::Not(testing::IsEmpty())) << wrong;
    EXPECT_NE(overlay_error(wrong), "");
  }
}

TEST(Overlay, SunSkyGivesEnvironmentAndSun) {
  Scene scene = plain_scene();
  apply_overlay(scene, R"({"sun_sky": {"elevation_degrees": 60, "width": 32}})", "test.ssphh.json");
  EXPECT_TRUE(scene.environment.has_value());
  ASSERT_EQ(scene.lights.size(), 1u);
  EXPECT_EQ(scene.lights[0].type, scene::LightType::directional);

  // A sun in the east, +x, low above the horizon, shines toward −x
  Scene east = plain_scene();
  apply_overlay(east, R"({"sun_sky": {"elevation_degrees": 10, "azimuth_degrees": 90, "width": 32}})",
                "test.ssphh.json");
  const auto world = scene::world_matrices(east);
  const vec3 shines = -vec3(world[east.lights.at(0).node][2]);
  EXPECT_NEAR(shines.x, -std::cos(glm::radians(10.0f)), 1e-6);  // float rounding
  EXPECT_NEAR(shines.z, 0, 1e-6);
}

TEST(Overlay, VariablesAreOnlyThoseOfThisProject) {
  ::setenv("SSPHH_TEST_FOLDER", "/somewhere", 1);
  ::unsetenv("SSPHH_TEST_UNSET");
  EXPECT_EQ(expand_variables("${SSPHH_TEST_FOLDER}/a.glb", "here"), "/somewhere/a.glb");
  EXPECT_EQ(expand_variables("${SSPHH_TEST_UNSET:-../x}/a.glb", "here"), "../x/a.glb");
  EXPECT_EQ(expand_variables("a$b", "here"), "a$b");
  ::setenv("SSPHH_TEST_FOLDER", "rooms", 1);
  const std::string rooms = std::filesystem::current_path() / "rooms";
  EXPECT_EQ(expand_variables("${SSPHH_TEST_FOLDER}/a.glb", "here"), rooms + "/a.glb");
  EXPECT_EQ(expand_variables("../${SSPHH_TEST_FOLDER}/a.glb", "here"), "../rooms/a.glb");
  EXPECT_THROW(expand_variables("${SSPHH_TEST_UNSET}", "here"), Error);
  EXPECT_THROW(expand_variables("${HOME}", "here"), Error);
  EXPECT_THROW(expand_variables("${SSPHH_", "here"), Error);
}

TEST(LoadScene, AnOverlayIsASceneAndStandsBesideOne) {
  const test::TempDir folder;
  write_file(folder / "s.glb", test::rich_glb());
  write_file(folder / "view.ssphh.json", R"({"scene": "s.glb", "sphls": [{"position": [1, 1, 1]}]})");
  EXPECT_EQ(load_scene((folder / "view.ssphh.json").string()).sphls.size(), 2u);
  EXPECT_EQ(load_scene((folder / "s.glb").string()).sphls.size(), 1u);
  write_file(folder / "s.ssphh.json", R"({"sphls": [{"position": [1, 1, 1]}, {"position": [2, 2, 2]}]})");
  EXPECT_EQ(load_scene((folder / "s.glb").string()).sphls.size(), 3u);
  LoadOptions options;
  options.overlay = (folder / "view.ssphh.json").string();
  EXPECT_EQ(load_scene((folder / "s.glb").string(), options).sphls.size(), 2u)
      << "a named overlay replaces the default";
  write_file(folder / "twice.ssphh.json", R"({"scene": "view.ssphh.json"})");
  EXPECT_THROW(load_scene((folder / "twice.ssphh.json").string()), Error);
}

TEST(LoadScene, BuiltinScenesTakeOverlaysAndEnvironments) {
  const test::TempDir folder;
  image::Image sky(4, 2);
  for (float& v : sky.pixels) v = 3;
  image::write_image(folder / "sky.exr", sky);
  write_file(folder / "o.json",
             R"({"scene": "builtin:box", "sphls": [{"name": "extra", "position": [0, 0, 0]}]})");
  LoadOptions options;
  options.environment = (folder / "sky.exr").string();
  options.environment_intensity = 2;
  const Scene plain = load_scene("builtin:box");
  const Scene scene = load_scene((folder / "o.json").string(), options);
  EXPECT_EQ(scene.sphls.size(), plain.sphls.size() + 1);
  EXPECT_EQ(scene.environment.value().equirect.rgb(3, 1), vec3(3));
  EXPECT_EQ(scene.environment->color, vec3(2));
}

TEST(LoadScene, ContentDecidesBeforeExtension) {
  const test::TempDir folder;
  write_file(folder / "glb.obj", test::rich_glb());
  EXPECT_EQ(load_scene((folder / "glb.obj").string()).instances.size(), 1u);
  write_file(folder / "text.glb", "v 0 0 0\n");
  EXPECT_THROW(load_scene((folder / "text.glb").string()), Error);
  write_file(folder / "what.fbx", "Kaydara FBX Binary");
  EXPECT_THROW(load_scene((folder / "what.fbx").string()), Error);
  EXPECT_THROW(load_scene((folder / "nothing.glb").string()), Error);
  EXPECT_THROW(load_scene(folder.path().string()), Error);
  EXPECT_THROW(load_scene("builtin:nothing"), Error);
}

TEST(Overlay, FlippedBitsAreAcceptedOrGiveAnError) {
  const std::string whole = rich_overlay;
  int errors = 0;
  for (std::size_t bit = 0; bit < whole.size() * 8; bit += 5) {  // every byte, another bit each time
    std::string broken = whole;
    broken[bit / 8] = static_cast<char>(broken[bit / 8] ^ (1 << (bit % 8)));
    try {
      Scene scene = plain_scene();
      apply_overlay(scene, broken, "test.ssphh.json");
    } catch (const Error&) {
      ++errors;
    }
  }
  EXPECT_GT(errors, 500);
}

TEST(Overlay, LiesOnOthersAndLeavesOutWhatTheyHave) {
  const test::TempDir dir;
  write_file(dir / "low.ssphh.json", std::string_view(R"({"unit": 2, "lights": [
    {"name": "a", "type": "point"}, {"name": "b", "type": "point", "intensity": 3}],
    "cameras": [{"name": "c", "yheight": 4}], "sphls": [{"name": "s", "position": [0, 0, 0]}]})"));
  Scene scene = plain_scene();
  apply_overlay(scene, R"({"overlays": ["low.ssphh.json"], "without": {"lights": ["a"], "sphls": ["s", "t"]},
    "environment": {"color": [1, 1, 1]}, "environment_turn_degrees": 90,
    "light_factors": {"b": [2, 1, 0.5], "environment": [3, 3, 3]}})",
                dir / "high.ssphh.json");
  ASSERT_EQ(scene.lights.size(), 1u);
  EXPECT_EQ(scene.lights[0].name, "b");
  EXPECT_EQ(scene.lights[0].color * scene.lights[0].intensity, vec3(6, 3, 1.5f));
  EXPECT_TRUE(scene.sphls.empty());
  ASSERT_EQ(scene.cameras.size(), 1u);
  EXPECT_TRUE(scene.cameras[0].orthographic);
  EXPECT_EQ(scene.cameras[0].yheight, 4);
  EXPECT_EQ(scene.environment->color, vec3(3));
  EXPECT_FLOAT_EQ(scene.environment->rotation, pi / 2);
}

TEST(Overlay, GivesModesToGroupsThatItTurnsOff) {
  Scene scene = scene::make_builtin("gallery1");
  apply_overlay(scene, R"({"light_factors": {"cove": [0, 0, 0]}, "light_modes": {"cove": "diffuse"}})",
                "x.json");
  ASSERT_EQ(scene.light_modes.size(), 1u);
  EXPECT_EQ(scene.light_modes[0].group, "cove");
  EXPECT_EQ(scene::light_groups(scene), scene::light_groups(scene::make_builtin("gallery1")));
  EXPECT_EQ(scene.dark_groups, std::vector<std::string>{"cove"});
}

TEST(Overlay, PutsToneCurvesIntoTheTexturesOfAName) {
  Scene scene = plain_scene();
  scene.textures.push_back({"other", 1, 1, {10, 20, 30, 40}});
  apply_overlay(scene, R"({"textures": [{"name": "paint", "gamma": 2, "gain": 0.5, "offset": 0.01}]})",
                "x.json");
  // 128 is 0.2159 of linear light: half of its square is 0.0233
  EXPECT_THAT(scene.textures[0].rgba, testing::ElementsAre(25, image::linear_to_srgb8(0.0333f),
                                                           image::linear_to_srgb8(0.51f), 77, _, _, _, 255));
  EXPECT_THAT(scene.textures[1].rgba, testing::ElementsAre(10, 20, 30, 40));
  scene = plain_scene();
  apply_overlay(scene, R"({"textures": [{"name": "paint"}]})", "x.json");
  EXPECT_EQ(scene.textures[0].rgba, plain_scene().textures[0].rgba);
}

TEST(Overlay, RefusesToneCurvesOfTexturesThatAreNotOrAreNoColours) {
  EXPECT_THAT(overlay_error(R"({"textures": [{"name": "x", "gamma": 2}]})"),
              HasSubstr("no texture \"x\" (it has: paint)"));
  EXPECT_THAT(overlay_error(R"({"textures": [{"name": "paint", "gamma": 0}]})"),
              HasSubstr("textures[0].gamma"));
  Scene scene = plain_scene();
  scene.materials[0].normal_texture.texture = 0;
  try {
    apply_overlay(scene, R"({"textures": [{"name": "paint", "gain": 2}]})", "x.json");
    FAIL() << "normals have no tones";
  } catch (const Error& e) {
    EXPECT_THAT(e.what(), HasSubstr("holds no colours"));
  }
}

TEST(Overlay, RefusesChainsAndGroupsThatAreNot) {
  const test::TempDir dir;
  write_file(dir / "self.ssphh.json", std::string_view(R"({"overlays": ["self.ssphh.json"]})"));
  Scene scene = plain_scene();
  try {
    apply_overlay(scene, R"({"overlays": ["self.ssphh.json"]})", dir / "top.ssphh.json");
    FAIL() << "it goes on for ever";
  } catch (const Error& e) {
    EXPECT_THAT(e.what(), HasSubstr("more than 8 overlays"));
  }
  EXPECT_THAT(overlay_error(R"({"light_factors": {"x": [1, 1, 1]}})"), HasSubstr("no light group \"x\""));
  EXPECT_THAT(
      overlay_error(R"({"lights": [{"name": "x", "type": "point"}], "light_factors": {"x": [1, -1, 1]}})"),
      HasSubstr("below 0"));
  EXPECT_THAT(overlay_error(R"({"environment_turn_degrees": 3})"), HasSubstr("no environment"));
  EXPECT_THAT(overlay_error(R"({"without": {"nodes": []}})"), HasSubstr("nodes"));
}

}  // namespace
}  // namespace ssphh::scene_io
