// `bake --operator surfel` and what reads its probes: options that stand in each other's way, scenes that
// differ.

#include <fstream>

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <ssphh/probes/probe_file.h>

#include "commands/bake.h"
#include "here.h"
#include "temp_dir.h"
#include "tool_checks.h"

namespace ssphh {
namespace {

using test::expect_failure;
using test::joined;
using test::run_json;
using test::run_tool;
using test::TempDir;
using test::ToolResult;
using testing::AllOf;
using testing::HasSubstr;

std::vector<std::string> bake_with_records(const std::string& scene, const std::string& output,
                                           const std::vector<std::string>& more = {}) {
  return joined({"bake", scene, "-o", output, "--operator", "surfel", "--directions", "64", "--link-rays",
                 "16", "--degree", "2"},
                more);
}

/// Without the records, which take most of the time where light comes from elsewhere.
std::vector<std::string> small_bake(const std::string& scene, const std::string& output,
                                    const std::vector<std::string>& more = {}) {
  return joined(bake_with_records(scene, output, {"--records", "0"}), more);
}

std::vector<std::string> small_render(const std::string& scene, const std::string& probes,
                                      const std::string& output, const std::vector<std::string>& more = {}) {
  return joined({"render", scene, "--probes", probes, "-o", output, "--width", "16", "--height", "9",
                 "--method", "ssphh", "--spp", "1"},
                more);
}

TEST(TransportBakeCli, TellsOfTheOperatorInResultAndFile) {
  const TempDir dir;
  const std::string probes = dir / "a.sphl.json", binary = dir / "a.sphl";
  const json::Value bake = run_json(small_bake("builtin:box", probes, {"--surfel-size", "0.25", "--fit"}));
  EXPECT_EQ(bake["operator"], "surfel");
  EXPECT_GT(bake["surfels"].number(), 100);
  EXPECT_GT(bake["links"].number(), bake["surfels"].number());
  EXPECT_GT(bake["iterations"].number(), 1);
  EXPECT_NEAR(bake["contraction"].number(), 0.5, 0.01) << "the albedo of the closed box";
  EXPECT_EQ(bake["edges"], 5 * 4) << "each of five probes sees every other";
  EXPECT_EQ(bake["viz"], "links");
  EXPECT_GT(bake["fitted"].number(), 100);

  run_json({"probe", "convert", probes, "-o", binary});
  const json::Value info = run_json({"probe", "info", binary});
  EXPECT_EQ(info["generator"]["operator"], "surfel");
  EXPECT_EQ(info["generator"]["viz"], "links");
  EXPECT_EQ(info["generator"]["directions"], 64);
  EXPECT_EQ(info["generator"]["surfel_size"], 0.25);
  EXPECT_EQ(info["generator"]["link_rays"], 16);
  EXPECT_EQ(info["fitted"], bake["fitted"]);
  EXPECT_EQ(info["probes"].size(), 5u);
}

TEST(TransportBakeCli, BounceIsAnOperatorOfItsOwn) {
  const TempDir dir;
  const std::string probes = dir / "b.sphl";
  const json::Value bake =
      run_json({"bake", "builtin:box", "-o", probes, "--operator", "bounce", "--directions", "256",
                "--link-rays", "16", "--degree", "2", "--surfel-size", "0.25"});
  EXPECT_EQ(bake["operator"], "bounce");
  EXPECT_GT(bake["iterations"].number(), 1);
  EXPECT_NEAR(bake["contraction"].number(), 0.5, 0.02) << "the albedo of the closed box";
  EXPECT_EQ(run_json({"probe", "info", probes})["generator"]["operator"], "bounce");
}

TEST(TransportBakeCli, RenderTakesFittedWeightsWhereTheFileHasThem) {
  const TempDir dir;
  const std::string fitted = dir / "f.sphl", plain = dir / "p.sphl", picture = dir / "x.exr";
  run_json(small_bake("builtin:box", fitted, {"--surfel-size", "0.25", "--fit"}));
  run_json(small_bake("builtin:box", plain, {"--surfel-size", "0.25"}));
  const auto mean = [&](const std::string& probes, const std::vector<std::string>& more) {
    return run_json(small_render("builtin:box", probes, picture, more))["mean"];
  };
  EXPECT_EQ(mean(fitted, {}), mean(fitted, {"--weights", "fitted"}));
  EXPECT_NE(mean(fitted, {}), mean(fitted, {"--weights", "distance"}));
  EXPECT_EQ(mean(plain, {}), mean(plain, {"--weights", "mls"}));
  expect_failure(small_render("builtin:box", plain, picture, {"--weights", "fitted"}),
                 "has no fitted weights");
}

TEST(TransportBakeCli, RecordsAreTakenWhereTheFileHasThemOnCpuAndGpu) {
  const TempDir dir;
  const std::string kept = dir / "k.sphl", plain = dir / "p.sphl", picture = dir / "x.exr";
  const json::Value bake = run_json(
      bake_with_records("builtin:box", kept, {"--surfel-size", "0.25", "--records", "300", "--fit"}));
  EXPECT_LE(bake["records"].number(), 300);
  EXPECT_GT(bake["records"].number(), 100);
  EXPECT_GE(bake["record_seconds"].number(), 0);
  EXPECT_EQ(run_json({"probe", "info", kept})["records"], bake["records"]);
  EXPECT_GT(run_json(bake_with_records("builtin:box", plain, {"--surfel-size", "0.25"}))["records"].number(),
            300)
      << "without being asked";
  const json::Value without =
      run_json(bake_with_records("builtin:box", plain, {"--surfel-size", "0.25", "--records", "0"}));
  EXPECT_EQ(without["records"], 0);
  EXPECT_TRUE(without["record_seconds"].is_null());
  const auto mean = [&](const std::vector<std::string>& more) {
    return run_json(small_render("builtin:box", kept, picture, more))["mean"];
  };
  EXPECT_EQ(mean({}), mean({"--weights", "surface"}));
  EXPECT_NE(mean({}), mean({"--weights", "fitted"}));
  EXPECT_EQ(mean({"--backend", "gl"}), mean({"--backend", "gl", "--weights", "surface"}));
  EXPECT_NE(mean({"--backend", "gl"}), mean({"--backend", "gl", "--weights", "fitted"}));
  expect_failure(small_render("builtin:box", plain, picture, {"--weights", "surface"}),
                 "has no surface records");
  // With light of paths, records still hold every bounce
  const json::Value paths = run_json({"bake", "builtin:box", "-o", plain, "--face", "4", "--spp", "1",
                                      "--surfel-size", "0.25", "--records", "200", "--viz", "off"});
  EXPECT_GT(paths["records"].number(), 50);
}

TEST(TransportBakeCli, PathTracedProbesHaveNoNumbersOfTransport) {
  const TempDir dir;
  const json::Value bake =
      run_json({"bake", "builtin:box", "-o", dir / "a.sphl", "--face", "4", "--spp", "1", "--records", "0"});
  EXPECT_EQ(bake["operator"], "path");
  for (const char* key : {"surfels", "links", "iterations", "contraction"})
    EXPECT_TRUE(bake[key].is_null()) << key;
  const json::Value mean = run_json({"hier", dir / "a.sphl", "-o", dir / "b.sphl", "--operator", "mean"});
  EXPECT_GT(mean["contraction"].number(), 0);
  const json::Value paper = run_json({"hier", dir / "a.sphl", "-o", dir / "b.sphl"});
  EXPECT_TRUE(paper["contraction"].is_null());
}

TEST(TransportBakeCli, RecordsStandBesideProbesOfEveryBounceUnlessToldOtherwise) {
  const TempDir dir;
  const auto records = [&](const std::vector<std::string>& more) {
    return run_json(test::joined({"bake", "builtin:box", "-o", dir / "a.sphl", "--face", "2", "--spp", "1",
                                  "--degree", "0", "--viz", "off"},
                                 more))["records"]
        .number();
  };
  const std::vector<std::string> coarse = {"--link-rays", "8", "--surfel-size", "0.3", "--directions", "64"};
  EXPECT_GT(records(coarse), 50);
  EXPECT_GT(records(test::joined(coarse, {"--max-depth", "25"})), 50);
  EXPECT_EQ(records({"--max-depth", "24"}), 0);
  EXPECT_EQ(records({"--gen", "local"}), 0);
  EXPECT_EQ(records({"--records", "0"}), 0);
  EXPECT_GT(records(test::joined(coarse, {"--max-depth", "3", "--records", "64"})), 0)
      << "whoever asks gets them";
}

TEST(TransportBakeCli, ManyProbesAreLitBySurfelsUnlessPathsAreAskedFor) {
  const TempDir dir;
  app::BakeOptions options;
  options.scene.source = "builtin:box";
  options.output = dir / "a.sphl";
  options.degree = 0;
  options.viz = probes::VizMethod::none;
  options.records = 0;
  options.params.face_size = 1, options.params.path.spp = 1;
  options.transport.transport = {.directions = 64, .surfel_size = 0.3f, .link_rays = 8};
  const auto operator_of = [&](const char* probes, const std::vector<std::string>& of_paths = {}) {
    options.place.probes = probes;
    options.of_paths = of_paths;
    return app::run_bake(options).set.generator.op;
  };
  EXPECT_EQ(operator_of("64"), probes::LightOperator::path);
  EXPECT_EQ(operator_of("65"), probes::LightOperator::surfel);
  EXPECT_EQ(operator_of("65", {"--spp"}), probes::LightOperator::path);
  options.params.gen = probes::GenMode::local;
  EXPECT_EQ(operator_of("65"), probes::LightOperator::path);
}

TEST(TransportBakeCli, QualityIsWhatIsNotGivenByItself) {
  const TempDir dir;
  const auto bake = [&](const std::vector<std::string>& more) {
    run_json(test::joined(
        {"bake", "builtin:box", "-o", dir / "a.sphl", "--degree", "0", "--viz", "off", "--records", "0"},
        more));
    return probes::read_probe_file(dir / "a.sphl").generator;
  };
  const bake::Effort draft = bake::effort_of(bake::Quality::draft),
                     good = bake::effort_of(bake::Quality::good);
  const probes::GeneratorInfo by_word = bake({"--quality", "draft", "--operator", "surfel"}),
                              by_hand = bake({"--quality", "draft", "--operator", "surfel", "--directions",
                                              "100", "--link-rays", "20", "--surfel-size", "0.3"}),
                              usual = bake({"--operator", "surfel"}),
                              paths = bake({"--quality", "draft", "--face", "1"}),
                              own_paths = bake({"--quality", "draft", "--face", "1", "--spp", "7"});
  EXPECT_EQ(by_word.directions, draft.directions);
  EXPECT_EQ(by_word.link_rays, draft.link_rays);
  EXPECT_EQ(by_hand.directions, 100);
  EXPECT_EQ(by_hand.link_rays, 20);
  EXPECT_EQ(usual.directions, good.directions);
  EXPECT_EQ(usual.link_rays, good.link_rays);
  EXPECT_LT(usual.surfel_size, by_word.surfel_size);
  EXPECT_EQ(paths.spp, draft.spp);
  EXPECT_EQ(own_paths.spp, 7);
}

TEST(TransportBakeCli, SurfelsGrowToStayWithinMemoryAndSaySo) {
  const TempDir dir;
  const auto bake = [&](const std::vector<std::string>& more) {
    return run_json(
        test::joined({"bake", "builtin:house", "-o", dir / "a.sphl", "--degree", "0", "--viz", "off",
                      "--records", "0", "--operator", "surfel", "--probes", "20", "--directions", "64"},
                     more));
  };
  // A draft has surfels that grow with distance, too, and for that alone no warning
  const json::Value plenty = bake({"--quality", "draft"}),
                    little = bake({"--quality", "draft", "--max-memory", "0.07"});
  EXPECT_LT(little["surfels"].number(), 0.7 * plenty["surfels"].number());
  EXPECT_THAT(print(little["warnings"]), testing::HasSubstr("--max-memory"));
  EXPECT_THAT(print(plenty["warnings"]), testing::Not(testing::HasSubstr("--max-memory")));
}

TEST(TransportBakeCli, SurfelBakesHaveAHierarchyByThemselves) {
  const TempDir dir;
  const std::string probes = dir / "a.sphl", out = dir / "b.sphl";
  const json::Value bake = run_json(small_bake("builtin:box", probes, {"--neighbors", "3"}));
  EXPECT_EQ(bake["edges"], 5 * 3);
  for (const char* op : {"coefficient", "mean"}) {
    const json::Value hier = run_json({"hier", probes, "-o", out, "--operator", op, "--neighbors", "2"});
    EXPECT_EQ(hier["edges"], 5 * 2) << op;
    EXPECT_EQ(hier["light"], "surfel");
    EXPECT_EQ(hier["viz"], "links");
  }
  expect_failure({"hier", probes, "-o", out, "--operator", "matrix"}, "--viz-transfer");
}

TEST(TransportBakeCli, EdgesAreTracedWhereAskedFor) {
  const TempDir dir;
  const std::string probes = dir / "a.sphl";
  const std::vector<std::string> paths = {"--viz-transfer", "--face", "4", "--spp", "1"};
  const json::Value bake = run_json(small_bake("builtin:box", probes, paths));
  EXPECT_EQ(bake["operator"], "surfel");
  EXPECT_EQ(bake["viz"], "path");
  EXPECT_EQ(run_json({"hier", probes, "-o", dir / "b.sphl", "--operator", "matrix"})["edges"], bake["edges"]);

  const json::Value beside =
      run_json({"bake", "builtin:box", "-o", probes, "--face", "4", "--spp", "1", "--viz", "links",
                "--directions", "64", "--link-rays", "16", "--degree", "1", "--records", "0"});
  EXPECT_EQ(beside["operator"], "path");
  EXPECT_EQ(beside["edges"], 5 * 4);
  EXPECT_GT(beside["surfels"].number(), 0);
  EXPECT_EQ(run_json({"probe", "info", probes})["generator"]["viz"], "links");
}

TEST(TransportBakeCli, OptionsWithoutEffectAreRefused) {
  const TempDir dir;
  const std::string out = dir / "a.sphl";
  expect_failure(small_bake("builtin:box", out, {"--spp", "4"}), "--spp");
  expect_failure(small_bake("builtin:box", out, {"--gen", "local"}), "--gen local");
  expect_failure(small_bake("builtin:box", out, {"--viz", "off", "--neighbors", "3"}), "--neighbors");
  expect_failure(small_bake("builtin:box", out, {"--viz", "links", "--viz-transfer"}), "--viz-transfer");
  expect_failure(small_bake("builtin:box", out, {"--neighbors", "-2"}), "--neighbors", 2);
  expect_failure({"bake", "builtin:box", "-o", out, "--records", "0", "--directions", "64"}, "--directions");
  expect_failure({"bake", "builtin:box", "-o", out, "--operator", "photons"}, "photons", 2);
  expect_failure(small_bake("builtin:box", out, {"--link-rays", "0"}), "--link-rays", 2);
}

TEST(TransportBakeCli, EveryWeightLightsTheBoxAlike) {
  // A constant field shows no difference between blends whose weights add up to 1.
  const TempDir dir;
  const std::string probes = dir / "a.sphl";
  run_json(small_bake("builtin:box", probes));
  std::vector<double> means;
  for (const char* weights : {"distance", "trilinear", "mls"}) {
    const json::Value render = run_json(
        small_render("builtin:box", probes, dir / "x.exr", {"--weights", weights, "--passes", "16"}));
    means.push_back(render["mean"][1].number());
  }
  // Emission 1 and the series 1/2 + 1/4 + ... = 1, to the noise of 64 directions and 16 link rays.
  EXPECT_NEAR(means[0], 2, 0.1);
  EXPECT_NEAR(means[1], means[0], 0.02);
  EXPECT_NEAR(means[2], means[0], 0.05);
  expect_failure(small_render("builtin:box", probes, dir / "x.exr", {"--weights", "nearest"}), "nearest", 2);
  expect_failure(
      small_render("builtin:box", probes, dir / "x.exr", {"--weights", "mls", "--lookup", "light"}),
      "--weights");
}

TEST(SameScene, AnotherSceneIsAnErrorThatNamesTheDifferencesAndForceGoesOn) {
  const TempDir dir;
  const std::string probes = dir / "a.sphl", out = dir / "x.exr";
  run_json(small_bake("builtin:box", probes));
  const std::vector<std::string> other = small_render("builtin:gallery1", probes, out);
  const ToolResult refused = run_tool(other);
  EXPECT_EQ(refused.exit_code, 1);
  EXPECT_THAT(refused.err, AllOf(HasSubstr("a.sphl"), HasSubstr("\"box\", now \"gallery1\""),
                                 HasSubstr("hash"), HasSubstr("light groups: 1"), HasSubstr("--force")));
  EXPECT_FALSE(std::filesystem::exists(out));
  const ToolResult forced = run_tool(small_render("builtin:gallery1", probes, out, {"--force"}));
  EXPECT_EQ(forced.exit_code, 0) << forced.err;
  EXPECT_THAT(forced.err, AllOf(HasSubstr("warning"), HasSubstr("gallery1")));

  expect_failure({"probe", "lint", probes, "--scene", "builtin:gallery1"}, "another scene");
  EXPECT_THAT(run_tool({"probe", "lint", probes, "--scene", "builtin:gallery1", "--force"}).err,
              HasSubstr("another scene"));
}

TEST(SameScene, AnotherPoseIsADifferenceOnlyWhereSomethingMoves) {
  const TempDir dir;
  const std::string still = dir / "box.sphl", moving = dir / "rooms.sphl", out = dir / "x.exr";
  run_json(small_bake("builtin:box", still));
  EXPECT_EQ(run_tool(small_render("builtin:box", still, out, {"--time", "1"})).exit_code, 0);
  run_json(small_bake("builtin:two-rooms", moving, {"--time", "0.5"}));
  expect_failure(small_render("builtin:two-rooms", moving, out), "time 0.5 s, now 0 s");
  EXPECT_EQ(run_tool(small_render("builtin:two-rooms", moving, out, {"--time", "0.5"})).exit_code, 0);
}

TEST(SameScene, NewCamerasAndProbesAreNoDifferenceANewLampIs) {
  const TempDir dir;
  const std::string probes = dir / "a.sphl", overlay = dir / "o.json", out = dir / "x.exr";
  run_json(small_bake("builtin:cornell", probes));
  std::ofstream(overlay)
      << R"({"cameras": [{"name": "new", "position": [0.2, 0.3, 0.5], "look_at": [0, 0.2, 0]}],
                                "sphls": [{"name": "more", "position": [0.2, 0.3, 0.2]}]})";
  EXPECT_EQ(run_tool(small_render("builtin:cornell", probes, out, {"--overlay", overlay, "--camera", "new"}))
                .exit_code,
            0);
  std::ofstream(overlay)
      << R"({"lights": [{"name": "torch", "type": "point", "position": [0.2, 0.4, 0.2], "intensity": 1}]})";
  expect_failure(small_render("builtin:cornell", probes, out, {"--overlay", overlay}), "torch");
}

}  // namespace
}  // namespace ssphh
