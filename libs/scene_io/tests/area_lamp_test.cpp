/// Rectangles and discs in overlays, glTF files and what other renderers are given.

#include <filesystem>
#include <map>

#include <gmock/gmock.h>

#include <ssphh/core/file.h>
#include <ssphh/scene/area_lamp.h>
#include <ssphh/scene/builtin.h>
#include <ssphh/scene_io/gltf_export.h>
#include <ssphh/scene_io/load.h>
#include <ssphh/scene_io/overlay.h>
#include <ssphh/scene_io/renderer_export.h>

#include "temp_dir.h"

namespace ssphh::scene_io {
namespace {

using scene::LightType;
using testing::HasSubstr;

scene::Scene with_lights(const std::string& lights) {
  scene::Scene scene = scene::make_builtin("cornell");
  scene.lights.clear();
  apply_overlay(scene, "{\"lights\": [" + lights + "]}", "o");
  return scene;
}

std::string error_of(const std::string& light) {
  try {
    with_lights(light);
  } catch (const Error& e) {
    return e.what();
  }
  return "";
}

TEST(AreaLampOverlay, HasASizeAndRadianceOrPower) {
  const scene::Scene scene = with_lights(
      R"({"name": "panel", "type": "rectangle", "width": 0.5, "height": 0.25, "position": [1, 2, 3], "direction": [0, -1, 0],
          "up": [1, 0, 0], "intensity": 7, "color": [1, 0.5, 0]},
         {"type": "disc", "radius": 2, "look_at": [0, -1, 0], "power": 50})");
  const scene::Light &panel = scene.lights.at(0), &disc = scene.lights.at(1);
  EXPECT_EQ(panel.type, LightType::rectangle);
  EXPECT_EQ(panel.size, vec2(0.5f, 0.25f));
  EXPECT_EQ(panel.intensity, 7);
  const mat4 world = scene::world_matrices(scene)[static_cast<std::size_t>(panel.node)];
  EXPECT_LT(glm::distance(vec3(world[2]), vec3(0, 1, 0)), 1e-6f);
  EXPECT_LT(glm::distance(vec3(world[1]), vec3(1, 0, 0)), 1e-6f) << "its height goes along up";
  EXPECT_EQ(disc.type, LightType::disc);
  EXPECT_EQ(disc.radius, 2);
  EXPECT_FLOAT_EQ(disc.intensity, 50 / (pi * 4 * pi)) << "P = π A L";
}

TEST(AreaLampOverlay, BadInputIsNamedWithItsPlace) {
  const std::string panel = R"({"type": "rectangle", "direction": [0, -1, 0], )",
                    disc = R"({"type": "disc", "direction": [0, -1, 0], )";
  EXPECT_THAT(error_of(panel + R"("width": 1})"), HasSubstr("lights[0]: \"height\" is missing"));
  EXPECT_THAT(error_of(panel + R"("width": 1, "height": 0})"),
              HasSubstr("lights[0].height: must be greater than 0"));
  EXPECT_THAT(error_of(panel + R"("width": -1, "height": 1})"),
              HasSubstr("lights[0].width: must be greater than 0"));
  EXPECT_THAT(error_of(panel + R"("width": 1e999, "height": 1})"), HasSubstr("o"));
  EXPECT_THAT(error_of(panel + R"("width": "1", "height": 1})"), HasSubstr("lights[0].width"));
  EXPECT_THAT(error_of(panel + R"("width": 1, "height": 1, "depth": 1})"), HasSubstr("depth"));
  EXPECT_THAT(error_of(disc + R"("radius": 0})"), HasSubstr("lights[0].radius: must be greater than 0"));
  EXPECT_THAT(error_of(disc + R"("radius": 1, "width": 2})"),
              HasSubstr("lights[0].width: only a rectangle has one"));
  EXPECT_THAT(error_of(disc + R"("radius": 1, "power": 5, "intensity": 1})"),
              HasSubstr("has both \"intensity\" and \"power\""));
  EXPECT_THAT(error_of(disc + R"("radius": 1, "power": -5})"), HasSubstr("lights[0].power"));
  EXPECT_THAT(error_of(disc + R"("radius": 1e-18, "power": 1e30})"),
              HasSubstr("is too much for so small a lamp"));
  EXPECT_THAT(error_of(R"({"type": "point", "power": 5})"), HasSubstr("only a rectangle or a disc has one"));
  EXPECT_THAT(error_of(R"({"type": "disc", "radius": 1})"), HasSubstr("needs \"direction\" or \"look_at\""));
  EXPECT_THAT(error_of(disc + R"("radius": 1, "profile": {"ies": ""}})"),
              HasSubstr("only a point or spot light"));
}

scene::Scene lamps() {
  scene::Scene scene = with_lights(
      R"({"name": "panel", "light_group": "ceiling", "type": "rectangle", "width": 0.3, "height": 0.7, "position": [0.1, 0.9, 0.2],
          "direction": [0.2, -1, 0.1], "intensity": 7.3, "color": [1, 0.5, 0.25]},
         {"name": "plate", "type": "disc", "radius": 0.2, "position": [-0.5, 0.5, 0], "direction": [1, 0, 0], "power": 5})");
  scene::validate(scene);
  return scene;
}

TEST(AreaLampGltf, ComesBackTheSameAndIsASpotToOthers) {
  const test::TempDir dir;
  const scene::Scene scene = lamps();
  write_glb(dir / "lamps.glb", scene);
  const scene::Scene back = load_scene((dir / "lamps.glb").string());
  EXPECT_EQ(scene::scene_hash(back), scene::scene_hash(scene));
  ASSERT_EQ(back.lights.size(), 2u);
  EXPECT_EQ(back.lights[0].size, scene.lights[0].size);
  EXPECT_EQ(back.lights[0].intensity, scene.lights[0].intensity);
  const std::string text = read_text_file(dir / "lamps.glb");
  EXPECT_THAT(text, HasSubstr("\"type\":\"spot\""));
}

std::string gltf_error(const std::string& light) {
  const test::TempDir dir;
  const std::filesystem::path file = dir / "l.gltf";
  write_file(file, std::string_view(R"({"asset":{"version":"2.0"},"extensionsUsed":["KHR_lights_punctual"],
    "extensions":{"KHR_lights_punctual":{"lights":[)" +
                                    light + R"(]}},
    "nodes":[{"extensions":{"KHR_lights_punctual":{"light":0}}}],"scenes":[{"nodes":[0]}]})"));
  try {
    load_scene(file.string());
  } catch (const Error& e) {
    return e.what();
  }
  return "";
}

TEST(AreaLampGltf, BadExtrasAreNamed) {
  const auto light = [](const std::string& type, const std::string& extras) {
    return R"({"type":")" + type + R"(","spot":{},"extras":{"ssphh":{)" + extras + "}}}";
  };
  EXPECT_EQ(gltf_error(light("spot", R"("type":"rectangle","size":[1,2])")), "");
  EXPECT_EQ(gltf_error(light("spot", R"("type":"disc","radius":2)")), "");
  EXPECT_THAT(gltf_error(light("point", R"("type":"disc","radius":2)")),
              HasSubstr("only a spot light can be a disc"));
  EXPECT_THAT(gltf_error(light("spot", R"("type":"disc","radius":0)")),
              HasSubstr("radius: must be greater than 0"));
  EXPECT_THAT(gltf_error(light("spot", R"("type":"rectangle","size":[1,0])")),
              HasSubstr("must be greater than 0"));
  EXPECT_THAT(gltf_error(light("spot", R"("type":"rectangle","size":[1])")), HasSubstr("size"));
  EXPECT_THAT(gltf_error(light("spot", R"("type":"rectangle")")), HasSubstr("\"size\" is missing"));
  EXPECT_THAT(gltf_error(light("spot", R"("type":"square","size":[1,1])")),
              HasSubstr("\"sphere\", \"sphl\", \"rectangle\" or \"disc\""));
}

TEST(AreaLampGltf, WithoutARadianceTheSpotsIntensityIsSpreadOverTheLamp) {
  const test::TempDir dir;
  const std::filesystem::path file = dir / "l.gltf";
  write_file(file, std::string_view(R"({"asset":{"version":"2.0"},"extensionsUsed":["KHR_lights_punctual"],
    "extensions":{"KHR_lights_punctual":{"lights":[{"type":"spot","intensity":6,"spot":{},
      "extras":{"ssphh":{"type":"rectangle","size":[3,0.5]}}}]}},
    "nodes":[{"extensions":{"KHR_lights_punctual":{"light":0}}}],"scenes":[{"nodes":[0]}]})"));
  EXPECT_FLOAT_EQ(load_scene(file.string()).lights.at(0).intensity, 4);
}

/// Names and bytes of a folder's files.
std::map<std::string, std::string> files_of(const std::filesystem::path& folder) {
  std::map<std::string, std::string> files;
  for (const auto& entry : std::filesystem::directory_iterator(folder))
    files[entry.path().filename().string()] = read_text_file(entry.path());
  return files;
}

TEST(AreaLampExport, OtherRenderersGetGlowingMeshes) {
  const scene::Scene scene = lamps(), meshes = scene::area_lamps_as_meshes(scene, 0);
  for (const RendererFormat& format : renderer_formats()) {
    const test::TempDir dir;
    ExportSettings settings;
    settings.camera = scene::camera_pose(scene, "");
    const ExportReport report = format.write(scene, settings, dir / "lamps");
    format.write(meshes, settings, dir / "meshes");
    EXPECT_EQ(files_of(dir / "lamps"), files_of(dir / "meshes")) << format.name;
    EXPECT_THAT(report.differences,
                testing::Contains(HasSubstr("flat lamps block other light: panel, plate")))
        << format.name;
  }
}

}  // namespace
}  // namespace ssphh::scene_io
