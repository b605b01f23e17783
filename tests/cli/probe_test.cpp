// `ssphh probe info`, `preview` and `ssphh hier`.

#include <algorithm>
#include <cmath>

#include <fmt/format.h>

#include <ssphh/image/io.h>
#include <ssphh/image/sphere_map.h>
#include <ssphh/probes/hier.h>
#include <ssphh/probes/probe_file.h>
#include <ssphh/sh/irradiance.h>
#include <ssphh/sh/reconstruct.h>
#include <ssphh/sh/window.h>

#include "commands/command.h"
#include "error_message.h"
#include "here.h"
#include "probe_tool.h"
#include "results/probe_sheet.h"

namespace ssphh {
namespace {

using test::joined;
using test::json_here;
using test::ProbeTool;
using test::problem_here;
using test::text_here;
using testing::HasSubstr;

TEST_F(ProbeTool, InfoHoldsEverythingOfTheFile) {
  const json::Value info = json_here({"probe", "info", file_});
  EXPECT_EQ(info["file"], file_);
  EXPECT_EQ(info["degree"], 1);
  EXPECT_EQ(info["edges"], 6);
  EXPECT_EQ(info["fitted"], 0);
  EXPECT_FALSE(info.contains("hierarchy"));
  EXPECT_EQ(info["generator"], json::Value({{"operator", "path"},
                                            {"gen", "local"},
                                            {"max_depth", 5},
                                            {"passes", 2},
                                            {"spp", 7},
                                            {"viz", "links"},
                                            {"viz_source", "intensity"},
                                            {"viz_paths", "all"},
                                            {"viz_max_depth", 3},
                                            {"viz_passes", 1},
                                            {"viz_spp", 16},
                                            {"face_size", 9},
                                            {"seed", 11},
                                            {"directions", 64},
                                            {"surfel_size", 0.25},
                                            {"link_rays", 16},
                                            {"scene", "rooms"},
                                            {"scene_hash", Hash128{0x1234, 0x5678}.hex()},
                                            {"time", 1.5}}));
  EXPECT_EQ(info["light_groups"],
            json::Value({{{"name", "lamp"}, {"scale", {1, 0.5, 0.25}}, {"mode", "realtime"}},
                         {{"name", "sky"}, {"scale", {2, 2, 2}}, {"mode", "realtime"}}}));
  ASSERT_EQ(info["probes"].size(), 3u);
  for (std::size_t i = 0; i < 3; ++i) {
    const json::Value& probe = info["probes"][i];
    const probes::Probe& wanted = set_.probes[i];
    EXPECT_EQ(probe["name"], wanted.name);
    expect_rgb(probe["position"], wanted.position);
    EXPECT_EQ(probe["radius"], wanted.radius);
    expect_rgb(probe["mean"], sh::mean(wanted.self));
    expect_rgb(probe["reflected_mean"], sh::mean(wanted.reflected));
    const vec3 lowest = sh::minimum(sh::irradiance_from_radiance(wanted.self));
    EXPECT_NEAR(test::float_of(probe["min_irradiance"]), std::min({lowest.x, lowest.y, lowest.z}), 1e-5f);
    ASSERT_EQ(probe["groups"].size(), 2u);
    expect_rgb(probe["groups"][0]["emitted"], sh::mean(wanted.groups[0].emitted));
    expect_rgb(probe["groups"][0]["reflected"], sh::mean(wanted.groups[0].reflected));
    expect_rgb(probe["groups"][1]["reflected"], sh::mean(wanted.groups[1].reflected));
    ASSERT_EQ(probe["edges"].size(), 2u);
    for (std::size_t e = 0; e < 2; ++e)
      EXPECT_EQ(probe["edges"][e], json::Value({{"from", wanted.edges[e].from},
                                                {"transfer", wanted.edges[e].transfer},
                                                {"matrix", false}}));
    EXPECT_FALSE(probe.contains("neighbor_mean"));
  }
}

TEST_F(ProbeTool, InfoOfAHierarchyHasTheNeighboursLight) {
  json_here({"hier", file_, "-o", out_, "--operator", "mean", "--neighbors", "1", "--threshold", "0.3"});
  probes::ProbeSet set = set_;
  probes::hier(set, {probes::HierOperator::mean, 1, 0.3f});
  const json::Value info = json_here({"probe", "info", out_});
  EXPECT_NEAR(info["hierarchy"]["threshold"].number(), 0.3, 1e-7);
  EXPECT_EQ(info["hierarchy"]["operator"], "mean");
  EXPECT_EQ(info["hierarchy"]["neighbors"], 1);
  for (std::size_t i = 0; i < 3; ++i)
    expect_rgb(info["probes"][i]["neighbor_mean"], sh::mean(set.hierarchy->neighbor[i]));
  EXPECT_THAT(text_here({"probe", "info", out_}), HasSubstr("\nHIER mean, neighbors 1, threshold 0.3\n"));
  json_here({"hier", file_, "-o", out_});
  EXPECT_THAT(text_here({"probe", "info", out_}),
              HasSubstr("\nHIER coefficient, neighbors all, threshold 0\n"));
}

TEST_F(ProbeTool, InfoForPeopleTellsTheSame) {
  const std::string text = text_here({"probe", "info", file_});
  EXPECT_THAT(
      text,
      testing::StartsWith(
          file_ + ": 3 probes of degree 1, 6 edges\n"
                  "scene rooms at 1.5 s; light by path, edges by links\n"
                  "GEN local: paths of depth 5, 2 x 7 samples\n"
                  "9x9x6 texels, seed 11\nP of SPHLs of intensity 1\n"
                  "transport: 64 directions a probe, surfels of 0.25 m, 16 link rays\n"
                  "light group lamp, scale 1 0.5 0.25, realtime\nlight group sky, scale 2 2 2, realtime\n"
                  "mean radiance R, G, B [W/sr/m2] over all directions:\n"
                  "  0  a  at (0, 1, -2) m, radius 0.125 m\n"));
  // The mean of a function is its first coefficient over √4π; b: 0.5 and 2 of the lamp, 0.25 of the sky.
  const double unit = 1 / std::sqrt(4 * pi_d);
  EXPECT_THAT(text, HasSubstr(fmt::format("     reflected  {:9.4g} {:9.4g} {:9.4g}   lamp\n"
                                          "     emitted    {:9.4g} {:9.4g} {:9.4g}   lamp\n"
                                          "     reflected  {:9.4g} {:9.4g} {:9.4g}   sky\n"
                                          "     P  0: 0.25  2: 0.5",
                                          2 * unit, 4 * unit, 6 * unit, 0.5 * unit, unit, 1.5 * unit,
                                          0.25 * unit, 0.5 * unit, 0.75 * unit)));
  probes::ProbeSet bare = set_;
  bare.generator.op = probes::LightOperator::surfel;
  bare.generator.directions = 0;
  for (probes::Probe& probe : bare.probes) probe.edges.clear();
  probes::write_probe_file(bare, file_);
  const std::string less = text_here({"probe", "info", file_});
  EXPECT_THAT(less, testing::AllOf(testing::Not(HasSubstr("paths of")), testing::Not(HasSubstr("transport:")),
                                   testing::EndsWith("     P  no edges")));
}

TEST_F(ProbeTool, HierAddsTheNeighboursThatWereAskedFor) {
  const auto expect = [&](const std::vector<std::string>& options, const probes::HierParams& params) {
    probes::ProbeSet set = set_;
    const std::size_t edges = probes::hier(set, params);
    const json::Value hier = json_here(joined({"hier", file_, "-o", out_}, options));
    EXPECT_EQ(hier["output"], out_);
    EXPECT_EQ(hier["edges"], edges);
    EXPECT_EQ(hier["neighbors"], params.neighbors);
    EXPECT_FLOAT_EQ(test::float_of(hier["threshold"]), params.threshold);
    EXPECT_EQ(hier["operator"], name_of(params.op));
    EXPECT_EQ(hier["probes"], 3);
    EXPECT_EQ(hier["gen"], "local");
    EXPECT_EQ(hier["light"], "path");
    EXPECT_EQ(hier["viz"], "links");
    EXPECT_GT(hier["seconds"].number(), 0);
    EXPECT_LT(hier["seconds"].number(), 1) << "six products of four coefficients";
    const auto contraction = probes::hier_contraction(set, params);
    if (contraction)
      EXPECT_NEAR(hier["contraction"].number(), contraction->upper, 1e-6);
    else
      EXPECT_TRUE(hier["contraction"].is_null());
    const probes::ProbeSet written = probes::read_probe_file(out_);
    ASSERT_TRUE(written.hierarchy);
    EXPECT_EQ(written.hierarchy->sum, set.hierarchy->sum);
  };
  expect({}, {});
  expect({"--operator", "mean"}, {probes::HierOperator::mean, -1, 0});
  expect({"--operator", "mean", "--neighbors", "1"}, {probes::HierOperator::mean, 1, 0});
  expect({"--threshold", "0.26"}, {probes::HierOperator::coefficient, -1, 0.26f});
  expect({"--neighbors", "0"}, {probes::HierOperator::coefficient, 0, 0});
  EXPECT_THAT(
      text_here({"hier", file_, "-o", out_}),
      testing::MatchesRegex(".*: 6 edges between 3 probes, operator coefficient, GEN local: [0-9.]+ us"));
  EXPECT_THAT(text_here({"hier", file_, "-o", out_, "--operator", "mean"}),
              testing::ContainsRegex("another application would change light by up to [0-9.]+$"));
}

TEST_F(ProbeTool, HierScalesGroupsFirst) {
  const auto expect = [&](const std::string& option, const std::string& group, const vec3& scale) {
    probes::ProbeSet set = set_;
    probes::relight(set, group, scale);
    probes::hier(set, {});
    json_here({"hier", file_, "-o", out_, "--scale", option});
    const probes::ProbeSet written = probes::read_probe_file(out_);
    EXPECT_EQ(written.light_groups, set.light_groups) << option;
    EXPECT_EQ(written.hierarchy->sum, set.hierarchy->sum) << option;
  };
  expect("lamp=0.5", "lamp", vec3(0.5f));
  expect("sky=1,2,3", "sky", {1, 2, 3});
  expect("lamp=0", "lamp", vec3(0));
  json_here({"hier", file_, "-o", out_, "--scale", "lamp=3", "--scale", "sky=0,0,1"});
  const probes::ProbeSet both = probes::read_probe_file(out_);
  EXPECT_EQ(both.light_groups[0].scale, vec3(3));
  EXPECT_EQ(both.light_groups[1].scale, vec3(0, 0, 1));
  for (const char* bad : {"lamp", "lamp=", "lamp=x", "lamp=1,", "lamp=1,2", "lamp=1,2,", "lamp=1,2,3,4",
                          "lamp=1,2,3x", "lamp=1;2;3", "lamp=1x"})
    EXPECT_THAT(problem_here({"hier", file_, "-o", out_, "--scale", bad}),
                HasSubstr("must be GROUP=R,G,B or GROUP=X"))
        << bad;
  EXPECT_THAT(problem_here({"hier", file_, "-o", out_, "--scale", "lmp=1"}), HasSubstr("lmp"));
}

TEST_F(ProbeTool, HierWithoutEdgesSaysSo) {
  probes::ProbeSet bare = set_;
  for (probes::Probe& probe : bare.probes) probe.edges.clear();
  probes::write_probe_file(bare, file_);
  const auto warned = [&] {
    return test::run_here({"hier", file_, "-o", out_}).err.find("has no edges between its probes") !=
           std::string::npos;
  };
  EXPECT_TRUE(warned());
  bare.probes.resize(1);
  probes::write_probe_file(bare, file_);
  EXPECT_FALSE(warned()) << "one probe has no neighbours";
  probes::write_probe_file(set_, file_);
  EXPECT_FALSE(warned());
}

/// Pixel (x, y) of a picture of width × width/2.
vec3 seen(const sh::RadianceSh& light, int width, int x, int y) {
  const float w = static_cast<float>(width), h = 0.5f * w;
  return glm::max(sh::eval(light, image::equirect_direction((static_cast<float>(x) + 0.5f) / w,
                                                            (static_cast<float>(y) + 0.5f) / h)),
                  vec3(0));
}

TEST_F(ProbeTool, PreviewShowsOneRowAProbeAndOneColumnALayer) {
  probes::ProbeSet set = set_;
  probes::hier(set, {});
  probes::write_probe_file(set, file_);
  const json::Value result =
      json_here({"probe", "preview", file_, "-o", dir_ / "p.exr", "--width", "16", "--exposure", "1"});
  // 16 × 8 pixels each, four between them.
  EXPECT_EQ(result["width"], 3 * 16 + 2 * 4);
  EXPECT_EQ(result["height"], 3 * 8 + 2 * 4);
  EXPECT_EQ(result["rows"], json::Value({"a", "b", "c"}));
  ASSERT_EQ(result["columns"].size(), 3u);
  const image::Image sheet = image::read_image(dir_ / "p.exr");
  ASSERT_EQ(sheet.width, 56);
  const char* names[] = {"self", "neighbour", "sum"};
  for (int c = 0; c < 3; ++c) {
    const json::Value& column = result["columns"][c];
    EXPECT_EQ(column["layer"], names[c]);
    const float factor = std::exp2(test::float_of(column["exposure"]));
    for (int i = 0; i < 3; ++i) {
      const auto p = static_cast<std::size_t>(i);
      const sh::RadianceSh& light = c == 0   ? set.probes[p].self
                                    : c == 1 ? set.hierarchy->neighbor[p]
                                             : set.hierarchy->sum[p];
      for (int y = 0; y < 8; ++y)
        for (int x = 0; x < 16; ++x)
          ASSERT_LT(glm::distance(sheet.rgb(20 * c + x, 12 * i + y), factor * seen(light, 16, x, y)), 1e-4f)
              << names[c] << " " << i << " " << x << " " << y;
    }
  }
  EXPECT_EQ(sheet.rgb(16, 0), vec3(0.5f)) << "between them";
  EXPECT_EQ(sheet.rgb(0, 8), vec3(0.5f));
  EXPECT_EQ(sheet.rgb(19, 11), vec3(0.5f));
}

// The 99th percentile of the brightest channel is shown as 0.8; own light and sum share it.
TEST_F(ProbeTool, PreviewExposesByTheBrightest) {
  const auto level = [](const std::vector<sh::RadianceSh>& lights) {
    std::vector<float> all;
    for (const sh::RadianceSh& light : lights)
      for (int y = 0; y < 8; ++y)
        for (int x = 0; x < 16; ++x) all.push_back(max_component(seen(light, 16, x, y)));
    std::sort(all.begin(), all.end());
    return all[static_cast<std::size_t>(0.99 * static_cast<double>(all.size() - 1))];
  };
  std::vector<sh::RadianceSh> self;
  for (const probes::Probe& probe : set_.probes) self.push_back(probe.self);
  const app::ProbeSheet plain = app::probe_sheet(set_, 16, 0);
  ASSERT_EQ(plain.columns.size(), 1u);
  EXPECT_EQ(plain.columns[0].name, "self");
  EXPECT_NEAR(plain.columns[0].exposure, std::log2(0.8f / level(self)), 1e-5f);
  EXPECT_NEAR(app::probe_sheet(set_, 16, -2).columns[0].exposure, plain.columns[0].exposure - 2, 1e-5f);
  probes::ProbeSet set = set_;
  probes::hier(set, {});
  const app::ProbeSheet sheet = app::probe_sheet(set, 16, 0);
  EXPECT_NEAR(sheet.columns[0].exposure, std::log2(0.8f / level(set.hierarchy->sum)), 1e-5f);
  EXPECT_EQ(sheet.columns[2].exposure, sheet.columns[0].exposure);
  EXPECT_NEAR(sheet.columns[1].exposure, std::log2(0.8f / level(set.hierarchy->neighbor)), 1e-5f);
  for (probes::Probe& probe : set.probes) probe.self *= vec3(0);
  set.hierarchy.reset();
  EXPECT_EQ(app::probe_sheet(set, 16, 0).columns[0].exposure, 0) << "all is dark";
  EXPECT_THAT(
      text_here({"probe", "preview", file_, "-o", dir_ / "p.png", "--width", "16"}),
      testing::AllOf(HasSubstr("16 x 32 pixels, one row per probe, columns from the left: self (exposure "),
                     HasSubstr("run `ssphh hier` on the file")));
}

TEST_F(ProbeTool, SheetsThatNobodyCouldOpenAreRefused) {
  EXPECT_THAT(test::message_of([] { app::probe_sheet({}, 16, 0); }), HasSubstr("holds no probes"));
  probes::ProbeSet many;
  many.probes.resize(127);  // 2052 · 1028 pixels each: 128 of them are over 2^28
  for (probes::Probe& probe : many.probes) probe.self = test::sloped_light(1, 0);
  many.probes.resize(128, many.probes[0]);
  EXPECT_THAT(test::message_of([&] { app::probe_sheet(many, 2048, 0); }),
              HasSubstr("too large (lower --width)"));
}

}  // namespace
}  // namespace ssphh
