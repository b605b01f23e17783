// Where a number stops to be good enough: a little on either side of every such bound of the readers.

#include <gtest/gtest.h>

#include <ssphh/image/io.h>
#include <ssphh/scene_io/gltf.h>
#include <ssphh/scene_io/overlay.h>

#include "error_message.h"
#include "export/equal_area.h"
#include "export/surface_model.h"
#include "ignored.h"
#include "mtl.h"

namespace ssphh::scene_io {
namespace {

using test::message_of;

scene::Scene gltf(const std::string& members) {
  const std::string text = R"({"asset": {"version": "2.0"},)" + members + "}";
  return load_gltf(std::as_bytes(std::span(text)), "f");
}

TEST(ReaderEdges, RotationsKeepTheirBitsWithinAMillionthOfALengthOfOne) {
  const auto w = [](const std::string& value) {
    return gltf(R"("nodes": [{"rotation": [0, 0, 0, )" + value + "]}]").nodes.at(0).local.rotation.w;
  };
  EXPECT_EQ(w("1.00000095"), 1.00000095f);  // eight steps of a float above 1
  EXPECT_EQ(w("1.00000107"), 1) << "nine";
  EXPECT_EQ(w("0.99999905"), 0.99999905f);
  EXPECT_EQ(w("0.99999893"), 1);
  EXPECT_EQ(w("1.02e-6"), 1);
  EXPECT_EQ(message_of([&] { w("0.98e-6"); }), "f: nodes[0].rotation: is no unit quaternion");
}

TEST(ReaderEdges, ConesEndAtARightAngle) {
  const auto said = [](const std::string& inner, const std::string& outer) {
    return message_of([&] {
      gltf(
          R"("extensions": {"KHR_lights_punctual": {"lights": [{"type": "spot", "spot": {"innerConeAngle": )" +
          inner + R"(, "outerConeAngle": )" + outer + "}}]}}");
    });
  };
  const std::string wrong = "f: extensions.KHR_lights_punctual.lights[0].spot: cone angles ";
  EXPECT_EQ(said("0", "1.5707973"), "no error");
  EXPECT_TRUE(said("0", "1.5707976").starts_with(wrong));
  EXPECT_EQ(said("0.5", "0.500001"), "no error");
  EXPECT_TRUE(said("0.5", "0.5").starts_with(wrong));
  EXPECT_TRUE(said("-0.001", "0.5").starts_with(wrong));
}

/// The axes of a camera of an overlay.
mat3 looking(const std::string& direction, const std::string& up) {
  scene::Scene scene;
  apply_overlay(scene, R"({"cameras": [{"direction": )" + direction + R"(, "up": )" + up + "}]}", "o");
  return mat3(scene.nodes.at(0).local.matrix());
}

TEST(ReaderEdges, DirectionsAlongTheVerticalTurnOtherwise) {
  // Across up and direction, as long as these are 1e-4 apart; else across x.
  EXPECT_NEAR(looking("[1.02e-4, 1, 0]", "[0, 1, 0]")[0].z, 1, 1e-6f);
  EXPECT_NEAR(looking("[0.98e-4, 1, 0]", "[0, 1, 0]")[0].z, -1, 1e-6f);
  EXPECT_NEAR(looking("[1.02e-4, 1, 0]", "[0, 7, 0]")[0].z, 1, 1e-6f) << "however long up is";
  EXPECT_NEAR(looking("[0.98e-4, 1, 0]", "[0, 7, 0]")[0].z, -1, 1e-6f);
  // Across z where x itself is too near.
  EXPECT_NEAR(looking("[0.89, 0.456, 0]", "[0.89, 0.456, 0]")[0].x, 0, 1e-6f);
  EXPECT_NEAR(looking("[0.91, 0.4146, 0]", "[0.91, 0.4146, 0]")[0].z, 0, 1e-6f);
  EXPECT_GT(std::abs(looking("[0.91, 0.4146, 0]", "[0.91, 0.4146, 0]")[0].x), 0.1f);
}

TEST(ReaderEdges, AnIgnoredListHasTwoHundredKindsAndARest) {
  Ignored ignored;
  for (int i = 0; i < 200; ++i) ignored.add("kind " + std::to_string(1000 + i));
  ignored.add("nothing", 0);
  ASSERT_EQ(ignored.lines().size(), 200u);
  EXPECT_EQ(ignored.lines().back(), "kind 1199 (1)");
  ignored.add("one more"), ignored.add("yet another", 4);
  ignored.add("kind 1005", 2);
  ASSERT_EQ(ignored.lines().size(), 201u);
  EXPECT_EQ(ignored.lines().back(), "other things (5)");
  EXPECT_EQ(ignored.lines()[5], "kind 1005 (3)");
}

TEST(ReaderEdges, EqualAreaImagesHaveTwiceTheTexelsWithinBounds) {
  const auto size = [](int width, int height) {
    scene::Environment environment;
    environment.equirect = image::Image(width, height);
    return equal_area_image(environment).width;
  };
  EXPECT_EQ(size(1, 1), 16) << "at least";
  EXPECT_EQ(size(16, 8), 16);
  EXPECT_EQ(size(16, 9), 17) << "√288 = 16.97";
  EXPECT_EQ(size(20, 10), 20);
}

TEST(ReaderEdges, SurfacesBetweenTheKinds) {
  scene::Material m;
  EXPECT_EQ(surface_kind(m), SurfaceKind::dielectric);
  m.ior = 1;
  EXPECT_EQ(surface_kind(m), SurfaceKind::lambert) << "it reflects nothing at its surface";
  m.metallic = 1;
  EXPECT_EQ(surface_kind(m), SurfaceKind::metal);
  m.metallic_roughness_texture.texture = 0;
  EXPECT_EQ(surface_kind(m), SurfaceKind::mixture) << "the texture says where";
  m.metallic_roughness_texture.texture = -1, m.metallic = 0.999f;
  EXPECT_EQ(surface_kind(m), SurfaceKind::mixture);
  m.unlit = true;
  EXPECT_EQ(surface_kind(m), SurfaceKind::black);
  EXPECT_EQ(roughness_alpha(0), 1e-3f);
  EXPECT_FLOAT_EQ(roughness_alpha(-0.5f), 0.25f);
  EXPECT_NEAR(ior_of(1), (1 + std::sqrt(0.99)) / (1 - std::sqrt(0.99)), 0.1);  // of 399: the root's rounding
  EXPECT_EQ(ior_of(-1), 1);
  EXPECT_FLOAT_EQ(ior_of(0.04f), 1.5f);
}

TEST(ReaderEdges, IdentifiersAreShortAndPlain) {
  EXPECT_EQ(identifier("mesh", 7, ""), "mesh7");
  EXPECT_EQ(identifier("mesh", 7,
                       " a--b \xC3\xA4"
                       "c9"),
            "mesh7_a_b_c9");
  EXPECT_EQ(identifier("mesh", 7, std::string(100, 'x')), "mesh7_" + std::string(42, 'x'));
}

}  // namespace
}  // namespace ssphh::scene_io
