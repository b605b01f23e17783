/// Lamps with photometric profiles in glTF files, in overlays, and in exports that have no place for them.

#include <gtest/gtest.h>

#include <ssphh/core/file.h>
#include <ssphh/scene/query.h>
#include <ssphh/scene_io/gltf.h>
#include <ssphh/scene_io/gltf_export.h>
#include <ssphh/scene_io/ies.h>
#include <ssphh/scene_io/overlay.h>

#include "error_message.h"
#include "export_fixture.h"
#include "glb_builder.h"
#include "temp_dir.h"

namespace ssphh::scene_io {
namespace {

using scene::LightType;
using test::message_of;

const std::string ies = "IESNA:LM-63-2002\nTILT=NONE\n1 -1 1 3 1 1 2 0 0 0 1 1 0\n0 45 90\n0\n100 250 0\n";

scene::LampProfile profile(const std::string& name, float side) {
  return {name, std::make_shared<const scene::PhotometricTable>(scene::PhotometricTable{
                    scene::Photometry::c, {0, 30.1f, 90}, {0, 90, 360}, {9, 4, 1, 9, side, 0, 9, 4, 1}})};
}

/// Lamps at one node and apart, with one profile and with two.
scene::Scene scene_with_profiles() {
  scene::Scene s;
  for (const char* name : {"room", "hall"}) s.nodes.emplace_back().name = name;
  const auto add = [&](const std::string& name, int node, const scene::LampProfile& p) -> scene::Light& {
    scene::Light& light = s.lights.emplace_back();
    light.name = name, light.node = node, light.profile = p;
    return light;
  };
  add("room", 0, profile("a.ies", 5)).intensity = 123.456f;
  scene::Light& bright = add("bright", 0, profile("a.ies", 5));
  bright.color = {3, 0.1f, 0.7f}, bright.range = 6, bright.group = "pair";
  scene::Light& spot = add("spot", 1, profile("", 2));
  spot.type = LightType::spot, spot.inner_cone = 0.1f, spot.outer_cone = 2.1f, spot.intensity = 0;
  return s;
}

TEST(ProfileFiles, ExportedToGltfAndReadAgainTheLampsAreTheSame) {
  scene::Scene scene = scene_with_profiles();
  scene::validate(scene);
  const std::vector<std::byte> glb = export_glb(scene);
  scene::Scene again = load_gltf(glb, "memory.glb");
  ASSERT_EQ(again.lights.size(), 3u);
  for (std::size_t i = 0; i < 3; ++i) {
    scene::Light light = again.lights[i];
    const scene::Light& before = scene.lights[i];
    SCOPED_TRACE(before.name);
    EXPECT_EQ(light.name, before.name);
    EXPECT_EQ(light.group, before.group);
    EXPECT_EQ(light.type, before.type);
    EXPECT_EQ(light.color, before.color);
    EXPECT_EQ(light.intensity, before.intensity);
    EXPECT_EQ(light.range, before.range);
    if (light.type == LightType::spot) {
      EXPECT_EQ(light.inner_cone, before.inner_cone);
      EXPECT_EQ(light.outer_cone, before.outer_cone);
    }
    EXPECT_EQ(*light.profile.table, *before.profile.table);
    EXPECT_EQ(light.profile.name, before.profile.name.empty() ? "profile 1" : before.profile.name);
  }
  EXPECT_EQ(again.lights[0].profile.table, again.lights[1].profile.table) << "read once";
  const std::string text(reinterpret_cast<const char*>(glb.data()), glb.size());
  EXPECT_EQ(text.find("KHR_lights_punctual"), text.npos);
  std::size_t files = 0;
  for (std::size_t at = text.find("IESNA"); at != text.npos; at = text.find("IESNA", at + 1)) ++files;
  EXPECT_EQ(files, 2u) << "lamps of one luminaire share its file";
}

TEST(ProfileFiles, OfGltfAreScaledToTheirCandelasTimesAMultiplier) {
  const test::TempDir folder;
  write_file(folder / "a lamp.ies", ies);
  test::GlbBuilder b;
  const int view = b.view(std::vector<char>(ies.begin(), ies.end()));
  const auto load = [&](const std::string& instance, const std::string& profiles) {
    return load_gltf(
        b.glb("\"nodes\":[{\"name\":\"n\",\"extensions\":{\"EXT_lights_ies\":" + instance +
              "},\"extras\":{\"light_group\":\"g\"}}],\"extensions\":{\"EXT_lights_ies\":{\"lights\":[" +
              profiles + "]}},\"extensionsRequired\":[\"EXT_lights_ies\"]"),
        folder / "scene.glb");
  };
  const std::string inside =
      "{\"bufferView\":" + std::to_string(view) + ",\"mimeType\":\"application/x-ies-lm-63\"}";
  const scene::Scene plain = load("{\"light\":0}", inside);
  ASSERT_EQ(plain.lights.size(), 1u);
  EXPECT_EQ(plain.lights[0].intensity, 250);
  EXPECT_EQ(plain.lights[0].color, vec3(1));
  EXPECT_EQ(plain.lights[0].name, "n");
  EXPECT_EQ(plain.lights[0].group, "g");
  EXPECT_EQ(plain.lights[0].profile.name, "profile 0");
  const scene::Scene tinted =
      load("{\"light\":1,\"multiplier\":0.5,\"color\":[1,0.5,0.25]}", inside + ",{\"uri\":\"a%20lamp.ies\"}");
  EXPECT_EQ(tinted.lights.at(0).intensity, 125);
  EXPECT_EQ(tinted.lights[0].color, vec3(1, 0.5f, 0.25f));
  EXPECT_EQ(tinted.lights[0].profile.name, "a lamp.ies");
  EXPECT_EQ(*tinted.lights[0].profile.table, *plain.lights[0].profile.table);
  const scene::Scene data = load("{\"light\":0}",
                                 "{\"name\":\"d\",\"uri\":\"data:application/x-ies-lm-63;base64,"
                                 "VElMVD1OT05FIDEgCjEgMSAxIDIgMSAxIDIgMCAwIDAgMSAxIDAgMCA5MCAwIDUgNQo=\"}");
  EXPECT_EQ(data.lights.at(0).profile.name, "d");

  const std::string file = folder / "scene.glb";
  const auto said = [&](const std::string& instance, const std::string& profiles) {
    return message_of([&] { load(instance, profiles); });
  };
  EXPECT_EQ(said("{\"light\":1}", inside),
            file + ": nodes[0].extensions.EXT_lights_ies.light: index 1 out of range, the file has 1 lights");
  EXPECT_EQ(said("{}", inside), file + ": nodes[0].extensions.EXT_lights_ies: \"light\" is missing");
  EXPECT_EQ(said("{\"light\":0}", "{}"), file + ": extensions.EXT_lights_ies.lights[0]: \"uri\" is missing");
  EXPECT_EQ(said("{\"light\":0}", "{\"bufferView\":9}"),
            file +
                ": extensions.EXT_lights_ies.lights[0].bufferView: index 9 out of range, the file has 1 "
                "bufferViews");
  EXPECT_EQ(said("{\"light\":0,\"multiplier\":-1}", inside),
            file + ": nodes[0].extensions.EXT_lights_ies.multiplier: -1 must be at least 0");
  EXPECT_NE(said("{\"light\":0}", "{\"uri\":\"none.ies\"}").find("none.ies"), std::string::npos);
  EXPECT_EQ(
      said("{\"light\":0}", "{\"uri\":\"data:,nothing\"}"),
      file +
          ": extensions.EXT_lights_ies.lights[0]: has no line that begins with TILT= (photometric files of "
          "IES LM-63 have one before their numbers)");
}

TEST(ProfileFiles, OfOverlaysStandBesideThemOrInThem) {
  const test::TempDir folder;
  write_file(folder / "lamp.ies", ies);
  const auto light = [&](const std::string& members) {
    scene::Scene scene;
    apply_overlay(scene, "{\"lights\": [{\"type\": \"point\", " + members + "}]}", folder / "o.json");
    return scene.lights.at(0);
  };
  const scene::Light measured = light(R"("direction": [0, -1, 0], "profile": {"file": "lamp.ies"})");
  EXPECT_EQ(measured.intensity, 250) << "as bright as the file says";
  EXPECT_EQ(measured.profile.name, "lamp.ies");
  EXPECT_EQ(measured.profile.table->candela, (std::vector<float>{100, 250, 0}));
  const scene::Light dimmed = light(
      R"("intensity": 3, "look_at": [0, -1, 0], "profile": {"name": "mine", "ies": "TILT=NONE\n1 1 1 2 1 1 2 0 0 0 1 1 0 0 90 0 5 6"})");
  EXPECT_EQ(dimmed.intensity, 3);
  EXPECT_EQ(dimmed.profile.name, "mine");

  const std::string o = folder / "o.json";
  const auto said = [&](const std::string& members) { return message_of([&] { light(members); }); };
  EXPECT_EQ(said(R"("profile": {"file": "lamp.ies"})"),
            o + ": lights[0]: a point light with a profile needs \"direction\" or \"look_at\"");
  EXPECT_EQ(said(R"("direction": [0, -1, 0], "profile": {"name": "x"})"),
            o + ": lights[0].profile: needs either \"file\" or \"ies\"");
  EXPECT_EQ(said(R"("direction": [0, -1, 0], "profile": {"file": "lamp.ies", "ies": ""})"),
            o + ": lights[0].profile: needs either \"file\" or \"ies\"");
  EXPECT_EQ(said(R"("direction": [0, -1, 0], "profile": {"ies": "TILT=NONE\n1"})"),
            o + ": lights[0].profile.ies:2: the file ends where the lumens per lamp should be");
  scene::Scene scene;
  EXPECT_EQ(message_of([&] {
              apply_overlay(
                  scene, R"({"lights": [{"type": "sphere", "radius": 1, "profile": {"file": "lamp.ies"}}]})",
                  o);
            }),
            o + ": lights[0].profile: only a point or spot light has one");
}

// Other renderers get as much light of a point light, and are told what is lost.
TEST(ProfileFiles, OtherRenderersAreToldWhatTheyLose) {
  scene::Scene scene = test::scene_of_everything();
  for (const auto type : {LightType::point, LightType::spot}) {
    scene::Light light;
    light.name = type == LightType::point ? "downlight" : "wallwasher";
    light.type = type, light.node = 0, light.profile = profile("a", 5);
    scene.lights.push_back(light);
  }
  const test::TempDir folder;
  for (const RendererFormat& format : renderer_formats()) {
    const ExportReport report =
        format.write(scene, test::export_settings(), folder / std::string(format.name));
    int lost = 0;
    for (const std::string& line : report.differences)
      lost +=
          line ==
              "lamps with a photometric profile shine into all directions alike: as much light: downlight" ||
          line == "spots have no photometric profile: as bright everywhere between their cones: wallwasher";
    EXPECT_EQ(lost, 2) << format.name;
  }
}

}  // namespace
}  // namespace ssphh::scene_io
