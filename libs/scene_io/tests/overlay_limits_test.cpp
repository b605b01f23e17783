/// Members of an overlay at the ends of their ranges, and what is said of those beyond.

#include <gtest/gtest.h>

#include <ssphh/scene_io/overlay.h>

#include "error_message.h"

namespace ssphh::scene_io {
namespace {

using ssphh::test::message_of;

/// What is said of an overlay of a scene with the materials "clay" and "gold".
std::string said_of_overlay(const std::string& text) {
  scene::Scene scene;
  scene.materials.resize(2);
  scene.materials[0].name = "clay", scene.materials[1].name = "gold";
  return message_of([&] { apply_overlay(scene, text, "o"); });
}

/// Of an entry of a list, or of an object: `{}` in the pattern stands for the value.
struct Member {
  std::string before, after = "}]}";
  std::string said(const std::string& value) const { return said_of_overlay(before + value + after); }
  void expect_range(const std::string& place, const char* low, const char* high, const char* under,
                    const char* over) const {
    for (const char* good : {low, high}) EXPECT_EQ(said(good), "no error") << place << " " << good;
    for (const char* bad : {under, over})
      EXPECT_EQ(said(bad), "o: " + place + ": " + bad + " must be from " + low + " to " + high);
  }
};

TEST(OverlayLimits, OfColours) {
  const std::string clay = R"({"materials": [{"name": "clay", )";
  for (const std::string name : {"base_color", "attenuation_color"}) {
    const std::string place = "materials[0]." + name;
    Member{clay + '"' + name + R"(": [0.5, )", ", 1]}]}"}.expect_range(place + "[1]", "0", "1", "-1", "1.5");
  }
  const Member emission{clay + R"("emission": [1, 1, )", "]}]}"};
  for (const char* good : {"0", "1e6"}) EXPECT_EQ(emission.said(good), "no error");
  EXPECT_TRUE(emission.said("-1").starts_with("o: materials[0].emission[2]: -1 must be"));
}

TEST(OverlayLimits, OfCameras) {
  const std::string camera = R"({"cameras": [{)";
  Member{camera + R"("yfov_degrees": )"}.expect_range("cameras[0].yfov_degrees", "0.01", "179", "0.005",
                                                      "179.5");
  Member{camera + R"("aspect": 2, "xfov_degrees": )"}.expect_range("cameras[0].xfov_degrees", "0.01", "179",
                                                                   "0.005", "179.5");
  const Member aspect{camera + R"("aspect": )"};
  EXPECT_EQ(aspect.said("0.001"), "no error");
  for (const char* bad : {"0", "-1"})
    EXPECT_EQ(aspect.said(bad), "o: cameras[0].aspect: must be greater than 0");
  EXPECT_EQ(said_of_overlay(camera + R"("xfov_degrees": 90}]})"),
            "o: cameras[0]: \"xfov_degrees\" needs \"aspect\" (16:9 is 1.7778)");
  EXPECT_EQ(said_of_overlay(camera + R"("aspect": 1, "xfov_degrees": 90, "yfov_degrees": 90}]})"),
            "o: cameras[0]: has both \"xfov_degrees\" and \"yfov_degrees\"");
  EXPECT_EQ(said_of_overlay(camera + R"("look_at": [1,0,0], "direction": [1,0,0]}]})"),
            "o: cameras[0]: has both \"look_at\" and \"direction\"");
  EXPECT_EQ(said_of_overlay(camera + R"("position": [1,2,3], "look_at": [1,2,3]}]})"),
            "o: cameras[0].look_at: gives no direction to look in");
  EXPECT_EQ(said_of_overlay(camera + R"("direction": [0,0,0]}]})"),
            "o: cameras[0].direction: gives no direction to look in");
  EXPECT_EQ(said_of_overlay(camera + R"("up": [0,0,0]}]})"), "o: cameras[0].up: must not be zero");
  EXPECT_EQ(said_of_overlay(camera + R"("node": "leg"}]})"),
            "o: cameras[0].node: the scene has no node \"leg\"");
  EXPECT_EQ(said_of_overlay(camera + R"("radius": 1}]})"),
            "o: cameras[0]: unknown member \"radius\" (known: name, position, look_at, direction, up, node, "
            "yfov_degrees, xfov_degrees, aspect, yheight)");
}

TEST(OverlayLimits, OfLights) {
  const std::string spot = R"({"lights": [{"type": "spot", "direction": [0,-1,0], )";
  Member{spot + R"("angular_diameter_degrees": )"}.expect_range("lights[0].angular_diameter_degrees", "0",
                                                                "180", "-1", "181");
  Member{spot + R"("outer_cone_degrees": 90, "inner_cone_degrees": )"}.expect_range(
      "lights[0].inner_cone_degrees", "0", "90", "-1", "91");
  Member{spot + R"("outer_cone_degrees": )"}.expect_range("lights[0].outer_cone_degrees", "0", "90", "-1",
                                                          "91");
  EXPECT_EQ(said_of_overlay(spot + R"("inner_cone_degrees": 45}]})"), "no error")
      << "as wide as the outer one";
  EXPECT_EQ(said_of_overlay(spot + R"("inner_cone_degrees": 46}]})"),
            "o: lights[0]: the inner cone is wider than the outer one");
  const Member intensity{spot + R"("intensity": )"}, range{spot + R"("range": )"};
  EXPECT_EQ(intensity.said("0"), "no error");
  EXPECT_EQ(intensity.said("1e30"), "no error");
  EXPECT_EQ(intensity.said("-1"), "o: lights[0].intensity: -1 must be at least 0");
  EXPECT_EQ(range.said("0"), "o: lights[0].range: must be greater than 0");
  for (const char* type : {"spot", "directional"}) {
    EXPECT_EQ(said_of_overlay(R"({"lights": [{"type": ")" + std::string(type) + "\"}]}"),
              "o: lights[0]: a " + std::string(type) + " light needs \"direction\" or \"look_at\"");
  }
  EXPECT_EQ(said_of_overlay(R"({"lights": [{"type": "point"}]})"), "no error");
  EXPECT_EQ(said_of_overlay(R"({"lights": [{"type": "sphere", "radius": 0}]})"),
            "o: lights[0].radius: must be greater than 0");
  EXPECT_EQ(
      said_of_overlay(R"({"lights": [{"type": "laser"}]})"),
      "o: lights[0].type: \"laser\" is none of: point, spot, directional, sphere, sphl, rectangle, disc");
  EXPECT_EQ(said_of_overlay(R"({"lights": [{}]})"), "o: lights[0]: \"type\" is missing");
}

TEST(OverlayLimits, OfMaterials) {
  const std::string clay = R"({"materials": [{"name": "clay", )";
  const auto member = [&](const std::string& key) { return Member{clay + "\"" + key + "\": "}; };
  for (const char* key : {"alpha", "metallic", "specular"})
    member(key).expect_range("materials[0]." + std::string(key), "0", "1", "-0.5", "1.5");
  for (const char* key : {"diffuse_roughness", "specular_roughness"})
    member(key).expect_range("materials[0]." + std::string(key), "-1", "1", "-1.5", "1.5");
  EXPECT_EQ(member("ior").said("1"), "no error");
  EXPECT_EQ(member("ior").said("0.5"), "o: materials[0].ior: 0.5 must be at least 1");
  EXPECT_EQ(said_of_overlay(R"({"materials": [{"name": "iron"}]})"),
            "o: materials[0].name: the scene has no material \"iron\" (it has: clay, gold)");
  scene::Scene none, many;
  EXPECT_EQ(message_of([&] { apply_overlay(none, R"({"materials": [{"name": "iron"}]})", "o"); }),
            "o: materials[0].name: the scene has no material \"iron\" (it has none)");
  many.materials.resize(21);
  for (scene::Material& m : many.materials) m.name = "m";
  const std::string said =
      message_of([&] { apply_overlay(many, R"({"materials": [{"name": "iron"}]})", "o"); });
  EXPECT_EQ(std::count(said.begin(), said.end(), ','), 19) << "twenty names are enough";
}

TEST(OverlayLimits, OfTheSky) {
  const Member rotation{R"({"environment": {"rotation_degrees": )", "}}"};
  rotation.expect_range("environment.rotation_degrees", "-3600", "3600", "-3601", "3601");
  const Member elevation{R"({"sun_sky": {"width": 8, "elevation_degrees": )", "}}"},
      azimuth{R"({"sun_sky": {"width": 8, "azimuth_degrees": )", "}}"},
      width{R"({"sun_sky": {"width": )", "}}"};
  elevation.expect_range("sun_sky.elevation_degrees", "0", "90", "-1", "91");
  azimuth.expect_range("sun_sky.azimuth_degrees", "-360", "360", "-361", "361");
  EXPECT_EQ(width.said("4097"), "o: sun_sky.width: 4097 must be an integer from 0 to 4096");
  EXPECT_EQ(said_of_overlay(R"({"environment": {"intensity": -1}})"),
            "o: environment.intensity: -1 must be at least 0");
  EXPECT_EQ(said_of_overlay(R"({"environment": {}, "sun_sky": {}})"),
            "o: has both \"environment\" and \"sun_sky\"");
}

TEST(OverlayLimits, OfTheWhole) {
  EXPECT_EQ(said_of_overlay(R"({"unit": 0.001})"), "no error");
  EXPECT_EQ(said_of_overlay(R"({"unit": 0})"), "o: unit: must be greater than 0");
  EXPECT_EQ(said_of_overlay(R"({"unit": "cm"})"), "no error");
  EXPECT_EQ(said_of_overlay(R"({"unit": "auto"})"), "no error");
  EXPECT_EQ(
      said_of_overlay(R"({"unit": "foot"})"),
      "o: unit: \"foot\" is no unit of length: mm, cm, m, inch, auto, or metres per unit as a number above "
      "0");
  std::string sphls;
  for (int i = 0; i < 100'001; ++i) sphls += i ? ",0" : "0";
  EXPECT_EQ(said_of_overlay(R"({"sphls": [)" + sphls + "]}"), "o: sphls: has more than 100000 entries");
  sphls.resize(sphls.size() - 2);
  EXPECT_EQ(said_of_overlay(R"({"sphls": [)" + sphls + "]}"), "o: sphls[0]: must be an object, not number");
}

}  // namespace
}  // namespace ssphh::scene_io
