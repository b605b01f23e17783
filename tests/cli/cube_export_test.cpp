// Cube cameras and VIZ's emitter for other renderers: what is written, and what Blender makes of it.

#include <fmt/format.h>
#include <gmock/gmock.h>

#include <ssphh/core/file.h>
#include <ssphh/probes/probe_file.h>
#include <ssphh/scene/builtin.h>
#include <ssphh/scene/query.h>

#include "commands/child_process.h"
#include "here.h"
#include "temp_dir.h"

namespace ssphh {
namespace {

using test::json_here;
using test::problem_here;
using test::TempDir;
using testing::HasSubstr;

const std::vector<scene::ProbePlace>& places() {
  static const std::vector<scene::ProbePlace> found = scene::sphl_places(scene::make_builtin("cornell"));
  return found;
}

json::Value exported(const TempDir& dir, const std::string& to, std::vector<std::string> more) {
  more.insert(more.begin(), {"export", "builtin:cornell", "--to", to, "-o", dir / to});
  return json_here(more);
}

TEST(CubeExport, VizLightsTheSceneByOneSphereAlone) {
  for (const bool intensity : {true, false}) {
    const TempDir dir;
    exported(dir, "cycles",
             {"--projection", "cube", "--at", places()[0].name, "--face", "8", "--viz-from", places()[1].name,
              "--viz-source", intensity ? "intensity" : "radiance"});
    const json::Value scene = test::parse_json(read_text_file(dir / "cycles/scene.json"));
    EXPECT_EQ(scene["width"], 8);
    ASSERT_EQ(scene["lights"].size(), 1u);
    const json::Value light = scene["lights"][0];
    const double r = places()[1].radius;
    EXPECT_EQ(light["type"], "sphere");
    EXPECT_NEAR(light["radius"].number(), r, 1e-6);
    EXPECT_FLOAT_EQ(light["intensity"].number(), intensity ? 1 / (pi_d * r * r) : 1);
    for (std::size_t c = 0; c < 3; ++c)
      EXPECT_FLOAT_EQ(light["position"][c].number(), places()[1].position[static_cast<int>(c)]);
    EXPECT_FALSE(scene.contains("environment"));
    for (const json::Value& mesh : scene["meshes"].elements()) {
      const json::Value material = scene["materials"][static_cast<std::size_t>(mesh["material"].number())];
      for (std::size_t c = 0; c < 3; ++c) EXPECT_EQ(material["emission"][c], 0) << mesh["name"].string();
    }
  }
}

// Emitters stay out of GEN's reflected light, belong to VIZ's, and are all there is at depth 0.
TEST(CubeExport, HidesLampsWhereTheyAreNotAskedFor) {
  const auto hides = [](std::vector<std::string> more) {
    const TempDir dir;
    more.insert(more.begin(), {"--projection", "cube", "--at", places()[0].name});
    exported(dir, "mitsuba", more);
    return read_text_file(dir / "mitsuba/scene.xml").find("hide_emitters") != std::string::npos;
  };
  EXPECT_TRUE(hides({}));
  EXPECT_FALSE(hides({"--max-depth", "0"}));
  EXPECT_FALSE(hides({"--viz-from", places()[1].name}));
}

TEST(CubeExport, RefusesWhatMakesNoSense) {
  const TempDir dir;
  const auto said = [&](std::vector<std::string> more, const std::string& to = "pbrt") {
    more.insert(more.begin(), {"export", "builtin:cornell", "--to", to, "-o", dir / "x"});
    return problem_here(more);
  };
  EXPECT_THAT(said({"--at", places()[0].name}), HasSubstr("add --projection cube"));
  EXPECT_THAT(said({"--projection", "cube", "--at", "nobody"}), HasSubstr("its SPHLs: "));
  EXPECT_THAT(said({"--viz-from", "nobody"}), HasSubstr("is no SPHL of the scene (its SPHLs: "));
  EXPECT_THAT(said({"--projection", "cube", "--at", places()[1].name, "--viz-from", places()[1].name}),
              HasSubstr("lies within the sphere of \"" + places()[1].name));
  EXPECT_THAT(said({"--projection", "cube"}, "gltf"), HasSubstr("holds the scene, no picture"));
  EXPECT_FALSE(std::filesystem::exists(dir / "x"));
}

/// What Blender renders with an exported cube: the files of one part.
std::vector<std::string> cube_of_blender(const TempDir& dir, const std::string& part) {
  app::run_program({"blender", "--background", "--factory-startup", "--python", dir / "cycles/render.py",
                    "--", "--cube", dir / "cycles/cube.json", "--output", dir / "faces"},
                   dir.path() / "log", std::chrono::seconds(600), Control{});
  std::vector<std::string> files;
  for (int face = 0; face < 6; ++face) files.push_back(dir / fmt::format("faces/{}{:04}.exr", part, face));
  return files;
}

probes::ProbeSet imported(const TempDir& dir, const std::vector<std::string>& images,
                          const std::vector<std::string>& more) {
  std::vector<std::string> words = {"probe", "import"};
  words.insert(words.end(), images.begin(), images.end());
  words.insert(words.end(), {"--scene", "builtin:cornell", "--sphl", places()[0].name, "--degree", "4", "-o",
                             dir / "theirs.sphl"});
  words.insert(words.end(), more.begin(), more.end());
  json_here(words);
  return probes::read_probe_file(dir / "theirs.sphl");
}

probes::ProbeSet baked(const TempDir& dir) {
  json_here({"bake",        "builtin:cornell",
             "--probes",    "scene",
             "--operator",  "path",
             "--degree",    "4",
             "--max-depth", "3",
             "--face",      "16",
             "--spp",       "256",
             "--viz",       "path",
             "--records",   "0",
             "-o",          dir / "ours.sphl"});
  return probes::read_probe_file(dir / "ours.sphl");
}

// Within 2 % of the mean in every coefficient: Cycles takes texels by area and we by solid angle, and both
// have noise of 256 paths in each of 1536 texels.
TEST(CubeExport, CyclesPicturesImportedAreOurGenAndViz) {
  if (app::find_program("blender").empty()) GTEST_SKIP() << "no blender: scripts/install-deps --with-blender";
  const TempDir dir;
  const probes::ProbeSet ours = baked(dir);
  const std::vector<std::string> cube = {"--projection", "cube",  "--at", places()[0].name, "--face",
                                         "16",           "--spp", "256",  "--max-depth",    "3"};
  exported(dir, "cycles", cube);
  const probes::Probe gen = imported(dir, cube_of_blender(dir, "reflected"), {}).probes[0];
  const sh::RadianceSh& own = ours.probes[0].groups.at(0).reflected;
  ASSERT_EQ(gen.reflected.values.size(), own.values.size());
  for (std::size_t k = 0; k < own.values.size(); ++k)
    for (int c = 0; c < 3; ++c)
      EXPECT_NEAR(gen.reflected.values[k][c], own.values[k][c], 0.02f * own[0][c]) << k << ' ' << c;

  std::vector<std::string> viz = cube;
  viz.insert(viz.end(), {"--viz-from", places()[1].name});
  exported(dir, "cycles", viz);
  const probes::Probe seen =
      imported(dir, cube_of_blender(dir, "all"), {"--viz-from", places()[1].name}).probes[0];
  const auto edge = std::ranges::find(ours.probes[0].edges, 1, &probes::Edge::from);
  ASSERT_NE(edge, ours.probes[0].edges.end());
  EXPECT_NEAR(seen.edges.at(0).transfer / edge->transfer, 1, 0.03);
}

}  // namespace
}  // namespace ssphh
