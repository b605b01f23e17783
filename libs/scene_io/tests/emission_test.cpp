/// SPHLs that shine, in overlays, in the extras of glTF files, and in files of their own.

#include <filesystem>
#include <span>
#include <string>

#include <gmock/gmock.h>

#include <ssphh/scene/query.h>
#include <ssphh/scene_io/emission_file.h>
#include <ssphh/scene_io/gltf.h>
#include <ssphh/scene_io/overlay.h>

#include "error_message.h"
#include "json_schema.h"
#include "places.h"
#include "temp_dir.h"

namespace ssphh::scene_io {
namespace {

using scene::LightType;
using scene::Scene;
using test::message_of;

EmissionFile fire() {
  EmissionFile file;
  file.scene = "torch", file.node = "flame", file.radius = 0.25f;
  file.emission = {{sh::IntensitySh(1), sh::IntensitySh(1), sh::IntensitySh(1)}, 24, 0.5f, true};
  file.emission.frames[0][0] = {1, 0.123456789f, 1e-7f};
  file.emission.frames[2][3] = {-0.1f, 3, 2 / 3.0f};
  return file;
}

Scene with_sphl(const std::string& members, const std::filesystem::path& overlay = "o.json") {
  Scene scene;
  apply_overlay(scene,
                R"({"sphls": [{"name": "lamp", "position": [1, 2, 3], "radius": 0.2, )" + members + "}]}",
                overlay);
  return scene;
}
std::string said_of_emission(const std::string& emission) {
  return message_of([&] { with_sphl("\"emission\": " + emission); });
}

TEST(EmissionFile, ComesBackAsItWas) {
  const EmissionFile file = fire(), again = emission_from_json(emission_to_json(file), "f");
  EXPECT_EQ(again.emission, file.emission);
  EXPECT_EQ(again.radius, file.radius);
  EXPECT_EQ(again.scene, "torch");
  EXPECT_EQ(again.node, "flame");
  EmissionFile still = file;
  still.emission = {.frames = {file.emission.frames[2]}};
  EXPECT_EQ(emission_from_json(emission_to_json(still), "f").emission, still.emission);
}

TEST(EmissionFile, IsAsItsSchemaSays) {
  const std::filesystem::path schema = test::source_dir() / "schemas/emission.schema.json";
  EXPECT_THAT(test::schema_errors(schema, emission_to_json(fire())), testing::IsEmpty());
  EmissionFile still = fire();
  still.emission = {.frames = {still.emission.frames[2]}};
  EXPECT_THAT(test::schema_errors(schema, emission_to_json(still)), testing::IsEmpty());
  for (
      const char* bad :
      {R"({"format": "ssphh-emission"})",
       R"({"format": "ssphh-emission", "version": 1, "radius": 1, "degree": 0})",
       R"({"format": "ssphh-emission", "version": 1, "radius": 1, "degree": 0, "rate": 1, "frames": [null]})"})
    EXPECT_THAT(test::schema_errors(schema, bad), testing::Not(testing::IsEmpty())) << bad;
}

TEST(EmissionFile, RefusesWhatIsNone) {
  const std::string head = R"({"format": "ssphh-emission", "version": 1, "radius": 1, )";
  const auto said = [&](const std::string& rest) {
    return message_of([&] { emission_from_json(head + rest + "}", "f"); });
  };
  EXPECT_EQ(said(R"("degree": 0, "rate": 2, "frames": [[1, 2, 3], [1, 2, 3]])"), "no error");
  EXPECT_EQ(said(R"("degree": 0, "rate": 2, "frames": [[1, 2, 3], null, [1, 2, 3]])"),
            "f: frames[1]: is missing (a sequence has no gaps: sample it again)");
  EXPECT_EQ(said(R"("degree": 0, "rate": 2, "frames": [[1, 2, 3], [1,1,1, 1,1,1, 1,1,1, 1,1,1]])"),
            "f: frames[1]: is of degree 1 where degree 0 is expected");
  EXPECT_EQ(said(R"("degree": 2, "coefficients": [1, 2, 3])"),
            "f: coefficients: is of degree 0 where degree 2 is expected");
  EXPECT_EQ(
      said(R"("coefficients": [1, 2, 3, 4, 5, 6])"),
      "f: coefficients: has 6 numbers (3 (degree + 1)² are needed, red, green and blue of each coefficient, "
      "for a degree of 0 to 10)");
  EXPECT_EQ(said(R"("coefficients": [1, 2, 1e99])"), "f: coefficients[2]: 1e+99 is too large a number");
  EXPECT_EQ(said(R"("frames": [[1, 2, 3], [1, 2, 3]])"), "f: \"rate\" is missing");
  EXPECT_EQ(said(R"("rate": 0, "frames": [[1, 2, 3]])"), "f: rate: must be greater than 0 frames per second");
  const std::string no_emission =
      "f: is a probe set: the light that arrives at places of a scene, not what a thing sends out (make an "
      "emission file with: ssphh sphl sample SCENE --node NAME -o FILE.sphl)";
  EXPECT_EQ(message_of([] { emission_from_json("SPHL\r\n\x1a\n....", "f"); }), no_emission);
  EXPECT_EQ(message_of([] { emission_from_json(R"({"format": "ssphh-probes", "version": 7})", "f"); }),
            no_emission);
}

TEST(OverlayEmission, MakesALampOfTheSphl) {
  const Scene scene = with_sphl(
      R"("light_group": "fires", "direction": [0, -1, 0],
         "emission": {"lobe": "beam", "half_angle_degrees": 40, "color": [1, 0.5, 0.25], "intensity": 7})");
  ASSERT_EQ(scene.sphls.size(), 1u);
  ASSERT_EQ(scene.lights.size(), 1u);
  const scene::Light& light = scene.lights[0];
  EXPECT_EQ(light.type, LightType::sphl);
  EXPECT_EQ(light.name, "lamp");
  EXPECT_EQ(light.group, "fires");
  EXPECT_EQ(light.node, scene.sphls[0].node);
  EXPECT_EQ(light.radius, 0.2f);
  EXPECT_EQ(light.color, vec3(1, 0.5f, 0.25f));
  EXPECT_EQ(light.intensity, 7);
  EXPECT_EQ(light.emission.frames[0],
            scene::lobe_emission(scene::Lobe::beam, {0, 0, -1}, glm::radians(40.0f)));
  EXPECT_EQ(with_sphl(R"("enabled": true)").lights.size(), 0u);
}

TEST(OverlayEmission, ComesFromCoefficientsFramesAndFiles) {
  const Scene still = with_sphl(R"("emission": {"coefficients": [1, 2, 3]})");
  EXPECT_EQ(still.lights[0].emission.frames[0][0], vec3(1, 2, 3));
  const Scene moving =
      with_sphl(R"("emission": {"frames": [[1, 2, 3], [3, 2, 1]], "rate": 10, "start": 1, "repeat": true})");
  EXPECT_EQ(moving.lights[0].emission.frames[1][0], vec3(3, 2, 1));
  EXPECT_EQ(moving.lights[0].emission.rate, 10);
  EXPECT_EQ(moving.lights[0].emission.start, 1);
  EXPECT_TRUE(moving.lights[0].emission.repeat);
  const test::TempDir dir;
  write_emission_file(fire(), dir / "fire.sphl");
  const Scene burning = with_sphl(R"("emission": {"file": "fire.sphl", "degree": 1})", dir / "o.json");
  EXPECT_EQ(burning.lights[0].emission, fire().emission);
  EXPECT_FALSE(with_sphl(R"("emission": {"file": "fire.sphl", "repeat": false})", dir / "o.json")
                   .lights[0]
                   .emission.repeat);
  EXPECT_EQ(
      message_of([&] { with_sphl(R"("emission": {"file": "fire.sphl", "degree": 4})", dir / "o.json"); }),
      (dir / "o.json").string() + ": sphls[0].emission.degree: the file's degree is 1");
}

TEST(OverlayEmission, RefusesWhatMakesNoLamp) {
  const std::string at = "o.json: sphls[0].emission";
  EXPECT_EQ(said_of_emission("{}"),
            at + ": needs one of \"file\", \"lobe\", \"coefficients\" and \"frames\"");
  EXPECT_EQ(said_of_emission(R"({"lobe": "uniform", "coefficients": [1, 1, 1]})"),
            at + ": has both \"lobe\" and \"coefficients\"");
  EXPECT_EQ(said_of_emission(R"({"lobe": "star"})"),
            at + ".lobe: \"star\" is none of: uniform, cosine, beam");
  EXPECT_EQ(said_of_emission(R"({"lobe": "beam", "half_angle_degrees": 5})"),
            at + ": a beam of half angle 5° (15° to 180° can be shown by spherical harmonics of degree 10)");
  EXPECT_EQ(said_of_emission(R"({"lobe": "cosine", "half_angle_degrees": 50})"),
            at + ".half_angle_degrees: only a beam has a half angle");
  EXPECT_EQ(said_of_emission(R"({"lobe": "cosine", "direction": [0, 0, 0]})"),
            at + ".direction: must not be zero");
  EXPECT_EQ(said_of_emission(R"({"lobe": "uniform", "rate": 3})"),
            at + ": only \"frames\" have a rate and a start");
  EXPECT_EQ(said_of_emission(R"({"coefficients": [1, 1, 1], "direction": [0, 0, 1]})"),
            at + ": only a \"lobe\" has a direction and a half angle");
  EXPECT_EQ(said_of_emission(R"({"lobe": "uniform", "intensity": -1})"),
            at + ".intensity: -1 must be at least 0");
  EXPECT_EQ(
      said_of_emission(R"({"frames": [[1, 1, 1], [1, 1, 1, 1]], "rate": 2})"),
      at + ".frames[1]: has 4 numbers (3 (degree + 1)² are needed, red, green and blue of each coefficient, "
           "for a degree of 0 to 10)");
  EXPECT_EQ(message_of([] { with_sphl("\"light_group\": \"g\""); }),
            "o.json: sphls[0].light_group: only an SPHL with \"emission\" has a light group");
  Scene scene;
  EXPECT_EQ(
      message_of([&] { apply_overlay(scene, R"({"sphls": [{"position": [0,0,0], "radius": 0}]})", "o"); }),
      "o: sphls[0].radius: must be greater than 0");
  EXPECT_EQ(message_of([&] {
              apply_overlay(scene, R"({"lights": [{"type": "point", "emission": {"lobe": "uniform"}}]})",
                            "o");
            }),
            "o: lights[0].emission: only an SPHL has one");
}

TEST(OverlayEmission, OfALampThatIsNoProbe) {
  Scene scene;
  apply_overlay(
      scene,
      R"({"lights": [{"type": "sphl", "radius": 0.3, "intensity": 4, "emission": {"lobe": "cosine"}}]})",
      "o");
  EXPECT_TRUE(scene.sphls.empty());
  ASSERT_EQ(scene.lights.size(), 1u);
  EXPECT_EQ(scene.lights[0].intensity, 4);
  EXPECT_EQ(scene.lights[0].radius, 0.3f);
}

TEST(GltfEmission, MakesALampOfTheSphl) {
  const auto load = [](const std::string& sphl) {
    const std::string text = R"({"asset": {"version": "2.0"}, "scenes": [{"nodes": [0]}], "scene": 0,
        "nodes": [{"name": "torch", "translation": [1, 2, 3], "extras": {"sphl": )" +
                             sphl + "}}]}";
    return load_gltf(std::as_bytes(std::span(text)), "t.gltf", 0);
  };
  const Scene scene =
      load(R"({"radius": 0.4, "light_group": "g", "emission": {"coefficients": [1, 2, 3], "intensity": 5}})");
  ASSERT_EQ(scene.lights.size(), 1u);
  EXPECT_EQ(scene.lights[0].type, LightType::sphl);
  EXPECT_EQ(scene.lights[0].name, "torch");
  EXPECT_EQ(scene.lights[0].group, "g");
  EXPECT_EQ(scene.lights[0].radius, 0.4f);
  EXPECT_EQ(scene.lights[0].intensity, 5);
  EXPECT_EQ(scene.lights[0].emission.frames[0][0], vec3(1, 2, 3));
  EXPECT_EQ(scene.lights[0].node, scene.sphls[0].node);
  EXPECT_EQ(message_of([&] { load(R"({"emission": {"file": "/etc/passwd"}})"); }).substr(0, 6), "t.gltf");
  EXPECT_EQ(message_of([&] { load(R"({"emission": {"coefficients": [1]}})"); }),
            "t.gltf: nodes[0].extras.sphl.emission.coefficients: must have at least 3 elements, not 1");
}

}  // namespace
}  // namespace ssphh::scene_io
