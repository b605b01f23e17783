/// Modes of light groups, and dark ones, in overlays and in glTF files.

#include <gtest/gtest.h>

#include <ssphh/core/error.h>
#include <ssphh/core/file.h>
#include <ssphh/scene/builtin.h>
#include <ssphh/scene/query.h>
#include <ssphh/scene/sun_sky.h>
#include <ssphh/scene_io/gltf.h>
#include <ssphh/scene_io/gltf_export.h>
#include <ssphh/scene_io/load.h>
#include <ssphh/scene_io/overlay.h>

#include "temp_dir.h"

namespace ssphh::scene_io {
namespace {

using scene::GroupMode;
using scene::LightMode;
using scene::Scene;

Scene sun_and_sky() {
  Scene scene;
  scene::add_sun_sky(scene, {.width = 8});
  return scene;
}

std::string mode_overlay_error(const std::string& text) {
  Scene scene = sun_and_sky();
  try {
    apply_overlay(scene, text, "side.json", "");
    return "none";
  } catch (const Error& e) {
    return e.what();
  }
}

TEST(LightModesOfFiles, AnOverlaySaysThemOfItsOwnLightsToo) {
  Scene scene = sun_and_sky();
  apply_overlay(scene, R"({"light_modes": {"sky": "baked", "lamp": "mixed"},
                           "lights": [{"name": "lamp", "type": "point"}]})",
                "side.json", "");
  EXPECT_EQ(scene.light_modes,
            (std::vector<GroupMode>{{"sky", LightMode::baked}, {"lamp", LightMode::mixed}}));
}

TEST(LightModesOfFiles, ErrorsNamePlaceAndNames) {
  EXPECT_EQ(mode_overlay_error(R"({"light_modes": {"sky": "bakd"}})"),
            "side.json: light_modes.sky: \"bakd\" is none of: realtime, mixed, baked, diffuse");
  EXPECT_EQ(mode_overlay_error(R"({"light_modes": {"moon": "baked"}})"),
            "side.json: light_modes.moon: the scene has no light group of that name (its groups: sun, sky)");
  EXPECT_NE(mode_overlay_error(R"({"light_modes": ["sky"]})"), "none");
  EXPECT_NE(mode_overlay_error(R"({"light_modes": {"sky": true}})"), "none");
}

TEST(LightModesOfFiles, SurviveGltf) {
  Scene scene = sun_and_sky();
  scene::set_light_mode(scene, "sky", LightMode::baked);
  scene::set_light_mode(scene, "sun", LightMode::realtime);
  EXPECT_EQ(load_gltf(export_glb(scene), "memory.glb").light_modes, scene.light_modes);
  scene.light_modes.clear();
  EXPECT_TRUE(load_gltf(export_glb(scene), "memory.glb").light_modes.empty());
}

TEST(LightModesOfFiles, OfAGltfFileNameGroupsThatItHas) {
  const std::string text = R"({"asset": {"version": "2.0"}, "scene": 0,
    "scenes": [{"extras": {"ssphh": {"environment": {"name": "dusk"}, "light_modes": {"GROUP": "MODE"}}}}]})";
  const auto load = [&](const std::string& group, const std::string& mode) {
    std::string file = text;
    file.replace(file.find("GROUP"), 5, group);
    file.replace(file.find("MODE"), 4, mode);
    return load_gltf(std::as_bytes(std::span(file)), "a.gltf");
  };
  EXPECT_EQ(load("dusk", "baked").light_modes, (std::vector<GroupMode>{{"dusk", LightMode::baked}}));
  EXPECT_THROW(load("dawn", "baked"), Error);
  EXPECT_THROW(load("dusk", "live"), Error);
}

TEST(LightModesOfFiles, OfASkyThatIsReplacedAreDropped) {
  const test::TempDir dir;
  const auto file = dir.path() / "a.ssphh.json";
  write_file(file, R"({"scene": "builtin:cornell", "environment": {"name": "dusk"},
                       "light_modes": {"dusk": "baked"}})");
  EXPECT_EQ(load_scene(file.string()).light_modes.size(), 1u);
  LoadOptions options;
  options.sun_sky.emplace().width = 8;
  EXPECT_TRUE(load_scene(file.string(), options).light_modes.empty());
}

TEST(DarkGroupsOfFiles, SurviveGltfWithWhatTheyEmit) {
  Scene scene = sun_and_sky();
  scene.dark_groups = {"sky"};
  const std::vector<std::byte> glb = export_glb(scene);
  const Scene read = load_gltf(glb, "memory.glb");
  EXPECT_EQ(read.dark_groups, scene.dark_groups);
  EXPECT_EQ(read.environment->color, scene.environment->color);
  scene.dark_groups = {"moon"};
  EXPECT_THROW(load_gltf(export_glb(scene), "memory.glb"), Error);
}

TEST(DarkGroupsOfFiles, EmitNothingUnlessTheyAreToBeKept) {
  const test::TempDir dir;
  const auto file = dir.path() / "a.ssphh.json";
  write_file(file, R"({"scene": "builtin:gallery1", "light_factors": {"cove": [0, 0, 0]}})");
  const Scene seen = load_scene(file.string());
  const Scene kept = load_scene(file.string(), {.keep_dark_light = true});
  EXPECT_EQ(seen.dark_groups, std::vector<std::string>{"cove"});
  EXPECT_EQ(kept.dark_groups, seen.dark_groups);
  EXPECT_EQ(scene::light_groups(seen), scene::light_groups(kept));
  EXPECT_GT(seen.materials.size(), kept.materials.size()) << "those that were put out are copies";
  // What was read as dark and written anew is read again
  const Scene copy = load_gltf(export_glb(seen), "memory.glb");
  EXPECT_EQ(scene::scene_hash(copy), scene::scene_hash(seen));
  EXPECT_EQ(scene::light_groups(copy), scene::light_groups(seen));
  // An overlay above turns it up
  write_file(dir / "b.ssphh.json", R"({"scene": "builtin:gallery1", "overlays": ["a.ssphh.json"],
                                       "light_factors": {"cove": [1, 1, 1]}})");
  const Scene up = load_scene((dir / "b.ssphh.json").string());
  EXPECT_EQ(scene::scene_hash(up), scene::scene_hash(scene::make_builtin("gallery1")));
}

}  // namespace
}  // namespace ssphh::scene_io
