// An overlay with every member as the scene it makes, and every member changed, one at a time. In
// expected/overlay.txt and expected/overlay-changes.txt.

#include <gtest/gtest.h>

#include <ssphh/core/file.h>
#include <ssphh/image/io.h>
#include <ssphh/scene/primitives.h>
#include <ssphh/scene_io/overlay.h>

#include "error_message.h"
#include "expected_text.h"
#include "memory_dir.h"
#include "scene_text.h"
#include "temp_dir.h"
#include "text_changes.h"

namespace ssphh::scene_io {
namespace {

constexpr const char* overlay = R"({
"$schema": "s", "comment": "c", "name": "office", "unit": 0.5, "origin": [1, 2, 3],
"cameras": [
  {"name": "door", "position": [1, 2, 3], "look_at": [4, 2, -1], "up": [0.5, 1, 0], "node": "desk", "yfov_degrees": 30, "aspect": 1.5},
  {"direction": [0, -3, 0], "xfov_degrees": 80, "aspect": 1.25},
  {"position": [0, 1, 0]}],
"lights": [
  {"name": "globe", "light_group": "lamps", "type": "sphere", "position": [0, 2, 0], "color": [1, 0.5, 0.25], "intensity": 3, "radius": 0.125},
  {"type": "spot", "direction": [1, 0, 0], "inner_cone_degrees": 10, "outer_cone_degrees": 20, "range": 4},
  {"type": "directional", "look_at": [0, -1, -1], "angular_diameter_degrees": 2, "node": "moving"},
  {"type": "point", "position": [9, 8, 7]},
  {"type": "rectangle", "position": [1, 3, 1], "direction": [0, -1, 0], "up": [1, 0, 0], "width": 0.5, "height": 0.25, "intensity": 2},
  {"type": "disc", "look_at": [0, -1, 0], "radius": 0.5, "power": 40}],
"sphls": [{"name": "west", "position": [1, 1, 1], "radius": 0.25, "enabled": false, "node": "desk"}, {"position": [2, 1, 1]}],
"environment": {"name": "sky", "light_group": "dome", "image": "sky.exr", "color": [1, 0.5, 2], "intensity": 3, "rotation_degrees": 30},
"materials": [{"name": "clay", "base_color": [0.5, 0.25, 0.125], "alpha": 0.5, "metallic": 0.25, "diffuse_roughness": -0.5,
  "specular_roughness": 0.375, "specular": 0.75, "ior": 1.25, "emission": [1, 2, 3], "double_sided": true, "unlit": true}]})";

scene::Scene base() {
  scene::Scene s;
  s.name = "base";
  s.materials.resize(3);
  s.materials[0].name = "clay", s.materials[1].name = "gold", s.materials[2].name = "clay";
  s.nodes.resize(3);
  s.nodes[0].name = "desk", s.nodes[1].name = "moving", s.nodes[2].name = "desk";
  s.nodes[1].movable = true, s.nodes[1].parent = 0;
  s.meshes.push_back(scene::make_quad(vec3(0), vec3(1, 0, 0), vec3(0, 1, 0)));
  s.instances.push_back({0, 1, -1, {}});
  s.cameras.resize(1), s.lights.resize(1), s.sphls.resize(1);
  s.cameras[0].node = 1, s.lights[0].node = 1, s.sphls[0].node = 1;
  s.animations.push_back(
      {"a", {{1, scene::AnimationPath::scale, scene::Interpolation::linear, {0}, {vec4(1)}}}});
  return s;
}

json::Value parsed(const char* text) {
  return test::sorted(test::parse_json(text));
}

class OverlayText : public testing::Test {
 protected:
  OverlayText() {
    image::Image sky(2, 1);
    sky.pixels = {1, 2, 3, 4, 5, 6};
    image::write_image(dir_ / "sky.exr", sky);
  }

  std::string read(const json::Value& document) const {
    scene::Scene scene = base();
    const std::string said =
        test::message_of([&] { apply_overlay(scene, print(document), dir_ / "o.json"); });
    std::string text = said == "no error" ? test::scene_text(scene) : said + "\n";
    const std::string folder = dir_.path().string();
    for (std::size_t at; (at = text.find(folder)) != std::string::npos;)
      text.replace(at, folder.size(), "FOLDER");
    return text;
  }

  void expect_changes(json::Value document, const std::string& file) {
    const std::vector<std::string> before = test::lines_of(read(document));
    std::string text;
    test::change_members(document, [&](const std::string& change) {
      text += change + "\n" + test::news(read(document), before);
    });
    test::expect_text_of("libs/scene_io/tests/expected/" + file, text);
  }

  const test::TempDir dir_{test::memory_dir()};
};

TEST_F(OverlayText, AllThatIsSaidStandsInTheScene) {
  test::expect_text_of("libs/scene_io/tests/expected/overlay.txt", read(parsed(overlay)));
}

TEST_F(OverlayText, EveryMemberCounts) {
  expect_changes(parsed(overlay), "overlay-changes.txt");
}

TEST_F(OverlayText, EveryMemberOfTheSkyCounts) {
  const auto sky = R"({"sun_sky": {"elevation_degrees": 30, "azimuth_degrees": 100, "turbidity": 4,
                       "ground_albedo": [0.5, 0.25, 0.125], "sun": true, "width": 8}})";
  test::expect_text_of("libs/scene_io/tests/expected/overlay-sky.txt", read(parsed(sky)));
  expect_changes(parsed(sky), "overlay-sky-changes.txt");
}

}  // namespace
}  // namespace ssphh::scene_io
