// `ssphh leak`, `measure`, `respond`, `place` and `bake`: figures against the library's, options where they
// belong.

#include <algorithm>
#include <cmath>
#include <sstream>

#include <fmt/format.h>

#include <ssphh/core/file.h>
#include <ssphh/place/init.h>
#include <ssphh/place/place.h>
#include <ssphh/probes/lookup.h>
#include <ssphh/probes/probe_file.h>
#include <ssphh/scene/builtin.h>
#include <ssphh/study/leak.h>
#include <ssphh/study/lookup_error.h>
#include <ssphh/study/surface_points.h>
#include <ssphh/trace/path_tracer.h>
#include <ssphh/trace/transport_scene.h>

#include "here.h"
#include "options/probe_options.h"
#include "temp_dir.h"

namespace ssphh {
namespace {

using test::joined;
using test::json_here;
using test::problem_here;
using test::text_here;
using testing::AllOf;
using testing::HasSubstr;

/// builtin:two-rooms with probes that hold some light of their own making.
class Rooms : public testing::Test {
 protected:
  Rooms() {
    set_.generator.scene = scene_.name;
    set_.generator.scene_hash = scene::light_hash(scene_);
    set_.generator.time = 0.25f;
    for (const std::string& group : scene::light_groups(scene_)) set_.light_groups.push_back({group});
    for (std::size_t i = 0; i < set_.probes.size(); ++i) {
      sh::RadianceSh light(1);
      light[0] = vec3(1, 2, 3) * static_cast<float>(i + 1);
      light[2] = vec3(0.5f);
      set_.probes[i].groups = {{{}, light}};
    }
    probes::merge_groups(set_);
    probes::write_probe_file(set_, file_);
  }
  std::vector<rays::SurfacePoint> points(float clearance, int count, std::uint64_t seed,
                                         const std::optional<scene::Bounds>& box = {}) const {
    return study::reachable_points(source_, app::viewpoints(scene_, source_, {&set_, 1}, 0.25f), 0.25f,
                                   {count, seed, clearance, box});
  }

  double unseen_share(const std::vector<rays::SurfacePoint>& at) const {
    std::vector<vec3> probes;
    for (const probes::Probe& probe : set_.probes) probes.push_back(probe.position);
    const auto seen = study::sees_any(source_, at, probes, 0.25f);
    return static_cast<double>(std::ranges::count(seen, 0)) / static_cast<double>(at.size());
  }

  const test::TempDir dir_;
  const std::string file_ = dir_ / "a.sphl";
  const scene::Scene scene_ = scene::make_builtin("two-rooms");
  const trace::TransportScene source_{scene_};
  const trace::PathTracer tracer_{scene_, 0.25f};
  probes::ProbeSet set_ = place::init_from_scene(scene_, 1, 0.25f);
};

TEST_F(Rooms, LeakIsThatOfTheLibraryAtTheTimeOfTheProbes) {
  study::LeakParams params;
  params.path.spp = 8, params.path.max_depth = 3, params.path.seed = 3;
  params.dark_share = 0.01f;
  probes::LookupParams lookup;
  lookup.weights = probes::weights_named("distance");
  const study::LeakReport wanted =
      study::measure_leak(tracer_, probes::IrradianceLookup(set_, tracer_, lookup), points(0, 24, 3), params);
  const std::vector<std::string> command = {
      "leak",      "builtin:two-rooms", "--probes", file_,    "--points", "24",     "--truth-spp",
      "8",         "--max-depth",       "3",        "--seed", "3",        "--dark", "0.01",
      "--weights", "distance"};
  const json::Value leak = json_here(command);
  EXPECT_EQ(leak["points"], 24);
  EXPECT_EQ(leak["dark_points"], wanted.dark);
  EXPECT_GT(wanted.dark, 0u);
  EXPECT_NEAR(leak["leak_ratio"].number(), wanted.ratio, 1e-9);
  EXPECT_GT(wanted.ratio, 0);
  EXPECT_NEAR(leak["mean_truth"].number(), wanted.mean_truth, 1e-9);
  EXPECT_NEAR(leak["mean_looked_up"].number(), wanted.mean_looked_up, 1e-9);
  EXPECT_NEAR(leak["truth_noise"].number(), wanted.truth_noise, 1e-9);
  EXPECT_NEAR(leak["dark_share"].number(), 0.01, 1e-8);
  EXPECT_EQ(leak["truth_spp"], 8);
  EXPECT_EQ(leak["weights"], "distance");
  EXPECT_EQ(leak["time"], 0.25);
  EXPECT_EQ(
      text_here(command),
      fmt::format(
          "leaked      {:.4g} % of the looked-up light stands on dark points\n"
          "dark        {} of 24 points: path traced indirect irradiance under 0.01 of the mean, at 3 sigma\n"
          "mean        {:.5g} W/m2 looked up, {:.5g} path traced (noise of a point {:.2g} %)",
          100 * wanted.ratio, wanted.dark, wanted.mean_looked_up, wanted.mean_truth,
          100 * wanted.truth_noise));
  EXPECT_THAT(test::run_here(joined(command, {"--time", "0.5"})).err,
              HasSubstr("was baked at 0.25 s, not at 0.5 s"));
  EXPECT_THAT(problem_here(joined(command, {"-o", dir_ / "x.jpg"})),
              HasSubstr("a leak map is written as .png"));
}

constexpr std::pair<const char*, double study::RelativeError::*> figures[] = {
    {"mean_truth", &study::RelativeError::mean_truth},
    {"ratio", &study::RelativeError::ratio},
    {"mean_error", &study::RelativeError::mean_error},
    {"mean_relative", &study::RelativeError::mean_relative},
    {"median_relative", &study::RelativeError::median_relative},
    {"p95_relative", &study::RelativeError::p95_relative},
    {"noise", &study::RelativeError::noise},
    {"relmse", &study::RelativeError::relmse}};

TEST_F(Rooms, MeasureIsThatOfTheLibrary) {
  study::LeakParams params{.path = {.max_depth = 3, .passes = 1, .spp = 8, .seed = 3}};
  const std::vector<std::string> command = {
      "measure", "builtin:two-rooms", "--time", "0.25",        "--probes", file_,    "--points",
      "24",      "--truth-spp",       "8",      "--max-depth", "3",        "--seed", "3"};
  const auto expect = [&](const json::Value& all, const std::vector<rays::SurfacePoint>& at) {
    const study::TruthAtPoints truth = study::trace_truth(tracer_, at, params);
    EXPECT_EQ(all["points"], at.size());
    EXPECT_EQ(all["dark_points"], truth.dark);
    EXPECT_NEAR(all["mean_truth"].number(), truth.mean, 1e-9);
    EXPECT_EQ(all["truth_spp"], 8);
    for (const json::Value& one : all["results"].elements()) {
      probes::LookupParams lookup;
      lookup.weights = probes::weights_named(one["weights"].string());
      const std::vector<vec3> found = study::look_up(probes::IrradianceLookup(set_, tracer_, lookup), at);
      const study::LookupError e = study::lookup_error(found, truth.estimates);
      const study::RelativeError worst = study::worst_channel(e);
      EXPECT_NEAR(all["noise"].number(), worst.noise, 1e-9);
      const auto near = [](const json::Value& said, double value) {
        EXPECT_NEAR(said.number(), value, 1e-9 * (1 + std::abs(value)));
      };
      for (const auto& [name, figure] : figures) {
        SCOPED_TRACE(name);
        ASSERT_EQ(one[name].size(), 3u);
        for (std::size_t c = 0; c < 3; ++c) near(one[name][c], e.channels[c].*figure);
        near(one["luminance"][name], e.luminance.*figure);
        near(one["worst"][name], worst.*figure);
      }
      const json::Value& colour = one["chromaticity"];
      near(colour["mean"], e.chromaticity.mean);
      near(colour["mean_error"], e.chromaticity.mean_error);
      near(colour["p95"], e.chromaticity.p95);
      near(colour["noise"], e.chromaticity.noise);
      EXPECT_GT(e.chromaticity.mean, 0.01);
      near(one["leak_ratio"], study::leak_ratio(found, truth));
      near(one["unseen"], unseen_share(at));
      EXPECT_GT(one["lookup_us"].number(), 0);
      EXPECT_EQ(one["probes"], file_);
    }
  };
  const json::Value all = json_here(joined(command, {"--weights", "mls,distance"}));
  ASSERT_EQ(all["results"].size(), 2u);
  EXPECT_EQ(all["results"][0]["weights"], "mls");
  EXPECT_EQ(all["results"][1]["weights"], "distance");
  expect(all, points(0.05f, 24, 3));
  const std::string text = text_here(joined(command, {"--weights", "mls,distance"}));
  double leaks = 0;
  for (const json::Value& one : all["results"].elements()) {
    leaks += one["leak_ratio"].number();
    const json::Value &ratio = one["ratio"], &worst = one["worst"];
    EXPECT_THAT(text,
                HasSubstr(fmt::format("\n{:<24} {:<10} {:>6.3f} {:>6.3f} {:>6.3f} {:>6.1f} % {:>6.1f} "
                                      "% {:>9.4f} {:>6.2f} % {:>6.2f} % {:>6.1f} %",
                                      file_, one["weights"].string(), ratio[0].number(), ratio[1].number(),
                                      ratio[2].number(), 100 * worst["mean_error"].number(),
                                      100 * worst["p95_relative"].number(), worst["relmse"].number(),
                                      100 * one["chromaticity"]["mean_error"].number(),
                                      100 * one["leak_ratio"].number(), 100 * one["unseen"].number())));
  }
  EXPECT_GT(leaks, 0.01);
  expect(json_here(joined(command, {"--open", "--clearance", "0.5"})),
         study::points_in_the_open(source_, points(0.5f, 24, 3), 0.25f, 3));
  const scene::Bounds box{{-3, 0, -1}, {0, 2.5f, 1.5f}};
  const std::vector<rays::SurfacePoint> within = points(0.05f, 24, 3, box);
  expect(json_here(joined(command, {"--box", "-3,0,-1,0,2.5,1.5"})), within);
  expect(json_here(joined(command, {"--box", "-3,0,-1,0,2.5,1.5", "--open"})),
         study::points_in_the_open(source_, within, 0.25f, 3, box));
  EXPECT_THAT(problem_here({"measure", "builtin:two-rooms"}),
              HasSubstr("give --probes FILE or --method NAME"));
}

TEST_F(Rooms, RespondTellsTheSameInItsListAndItsTable) {
  const std::string csv = dir_ / "f.csv";
  const json::Value run = json_here({"respond", "builtin:two-rooms", "--method", "direct", "--frames", "4",
                                     "--before", "2", "--points", "16", "--truth-spp", "8", "--max-depth",
                                     "2", "--event", "lamp.scale=1:2", "-o", csv});
  EXPECT_EQ(run["method"], "direct");
  EXPECT_EQ(run["points"], 16);
  ASSERT_EQ(run["frames"].size(), 4u);
  EXPECT_EQ(run["first_error"], run["frames"][0]["worst"]["mean_error"]);
  EXPECT_EQ(run["last_error"], run["frames"][3]["worst"]["mean_error"]);
  EXPECT_EQ(run["frames"][3]["ratio"], json::Value({0, 0, 0})) << "direct light has no indirect";
  EXPECT_EQ(run["before_error"], run["last_error"]);
  EXPECT_EQ(run["frames_to_settle"], 1);
  EXPECT_EQ(run["first_ms"], run["frames"][0]["ms"]);
  std::vector<double> ms;
  for (const json::Value& frame : run["frames"].elements()) ms.push_back(frame["ms"].number());
  std::sort(ms.begin(), ms.end());
  EXPECT_EQ(run["median_ms"], ms[1]) << "half of the four are not above it";
  std::istringstream lines(read_text_file(csv));
  std::string line;
  std::getline(lines, line);
  EXPECT_EQ(line, "frame,ms,ratio_r,ratio_g,ratio_b,mean_error,p95_relative,relmse,chromaticity");
  for (std::size_t f = 0; f < 4; ++f) {
    std::getline(lines, line);
    EXPECT_THAT(line, testing::StartsWith(fmt::format("{},{:.4f},0,0,0,{:.6g},", f + 1,
                                                      run["frames"][f]["ms"].number(),
                                                      run["frames"][f]["worst"]["mean_error"].number())));
  }
  EXPECT_FALSE(std::getline(lines, line));
}

TEST_F(Rooms, PlaceTellsWhatBecameOfEveryPlace) {
  const std::string out = dir_ / "p.ssphh.json";
  place::PlaceParams params = place::place_params(scene_, 0.5f);
  params.spacing = 2, params.clearance = 0.1f, params.levels = 0;
  const place::Placement wanted = place::place_probes(source_, params);
  const std::vector<std::string> command = {
      "place", "builtin:two-rooms", "--time", "0.5", "--probes", "auto:2", "--clearance",
      "0.1",   "--refine",          "0",      "-o",  out};
  const json::Value place = json_here(command);
  const auto count = [&](place::PlaceKind kind) {
    return std::ranges::count(wanted.probes, kind, &place::PlacedProbe::kind);
  };
  EXPECT_EQ(place["output"], out);
  EXPECT_EQ(place["probes"], wanted.probes.size());
  EXPECT_EQ(place["manual"], count(place::PlaceKind::manual));
  EXPECT_EQ(place["refined"], count(place::PlaceKind::refined));
  EXPECT_EQ(place["passages"], count(place::PlaceKind::passage));
  EXPECT_EQ(place["spacing"], wanted.spacing);
  EXPECT_EQ(place["clearance"], wanted.clearance);
  EXPECT_EQ(place["origin"], json::Value({wanted.origin.x, wanted.origin.y, wanted.origin.z}));
  const place::PlaceCounts& c = wanted.counts;
  EXPECT_EQ(place["candidates"], c.candidates);
  EXPECT_EQ(place["relocated"], c.relocated);
  EXPECT_EQ(place["removed"], json::Value({{"total", c.removed()},
                                           {"inside", c.inside},
                                           {"too_close", c.too_close},
                                           {"open_air", c.open_air},
                                           {"redundant", c.redundant},
                                           {"swept", c.swept},
                                           {"unreachable", c.unreachable},
                                           {"surplus", c.surplus}}));
  EXPECT_EQ(place["edges"], wanted.edges.size());
  EXPECT_EQ(place["edges_behind_moving_parts"],
            std::ranges::count(wanted.edges, true, &place::PlacedEdge::moving));
  const json::Value overlay = test::parse_json(read_text_file(out));
  EXPECT_EQ(overlay["scene"], "builtin:two-rooms");
  std::vector<json::Value> sphls;
  for (const place::PlacedProbe& probe : wanted.probes)
    if (probe.kind != place::PlaceKind::manual)
      sphls.push_back({{"name", probe.name},
                       {"position", {probe.position.x, probe.position.y, probe.position.z}},
                       {"radius", probe.radius}});
  EXPECT_EQ(overlay["sphls"], json::Value(sphls));
  EXPECT_THAT(text_here(command),
              HasSubstr(fmt::format(
                  "{} manual, {} near surfaces, {} in passages; {} edges\nof {} places {} were "
                  "removed: {} inside bodies, {} too close to a surface, {} in open air, {} beside "
                  "others, {} in a moving part's way, {} out of sight of cameras, lamps and SPHLs, "
                  "{} more than asked for; {} moved",
                  count(place::PlaceKind::manual), count(place::PlaceKind::refined),
                  count(place::PlaceKind::passage), wanted.edges.size(), c.candidates, c.removed(), c.inside,
                  c.too_close, c.open_air, c.redundant, c.swept, c.unreachable, c.surplus, c.relocated)));
  EXPECT_THAT(problem_here({"place", "builtin:two-rooms", "--probes", "scene", "-o", out}),
              HasSubstr("there is nothing to place"));
  EXPECT_THAT(problem_here({"place", out, "-o", out}), HasSubstr("is the scene itself"));
  EXPECT_THAT(problem_here({"place", out, "--overlay", out, "-o", dir_ / "q.ssphh.json"}),
              HasSubstr("cannot be written together with the overlay that is the scene"));
}

TEST_F(Rooms, DifferencesOfScenesAreNamed) {
  const std::vector<std::string>& groups = source_.light_groups();
  EXPECT_EQ(app::scene_difference(set_, scene_, groups, {}), "");
  EXPECT_EQ(app::scene_difference(set_, scene_, groups, 0.25f), "");
  EXPECT_EQ(app::scene_difference(set_, scene_, groups, 0.5f), "time 0.25 s, now 0.5 s");
  probes::ProbeSet other = set_;
  other.generator.scene_hash.high ^= 1;
  const std::string hashes = fmt::format("geometry, materials or lights (hash {:.8}, now {:.8})",
                                         other.generator.scene_hash.hex(), set_.generator.scene_hash.hex());
  EXPECT_EQ(app::scene_difference(other, scene_, groups, {}), hashes);
  other.generator.scene = "elsewhere";
  other.light_groups.clear();
  for (const char* name : {"a", "b", "c", "d", "e", "f", "g"}) other.light_groups.push_back({name});
  EXPECT_EQ(app::scene_difference(other, scene_, groups, 1.0f),
            "scene \"elsewhere\", now \"two-rooms\"; " + hashes +
                "; light groups: 7 (a, b, c, d, e, f, ...), now 1 (lamp); time 0.25 s, now 1 s");
}

TEST_F(Rooms, ViewpointsAreCamerasAndProbesOrWhatTheSceneHas) {
  const auto cameras = scene_.cameras.size();
  EXPECT_EQ(app::viewpoints(scene_, source_, {&set_, 1}, 0).size(), cameras + set_.probes.size());
  const place::PlaceParams own = place::place_params(scene_, 0);
  const std::vector<vec3> none = app::viewpoints(scene_, source_, {}, 0);
  ASSERT_EQ(none.size(), cameras + own.interest.size() + own.manual.size());
  EXPECT_EQ(none[cameras], own.interest[0]);
  EXPECT_EQ(none.back(), own.manual.back().position);
  EXPECT_EQ(app::viewpoints(scene_, source_, {&set_, 1}, 0).back(), set_.probes.back().position);
}

TEST_F(Rooms, RegionsHaveTheirOwnPoints) {
  const study::LeakParams params{.path = {.max_depth = 3, .passes = 1, .spp = 8, .seed = 3}};
  const std::vector<std::string> command = {"measure",     "builtin:two-rooms",
                                            "--time",      "0.25",
                                            "--probes",    file_,
                                            "--points",    "24",
                                            "--truth-spp", "8",
                                            "--max-depth", "3",
                                            "--seed",      "3",
                                            "--weights",   "mls",
                                            "--region",    "far=-3,0,-1,0,2.5,1.5"};
  const json::Value all = json_here(command);
  const json::Value& regions = all["results"][0]["regions"];
  ASSERT_TRUE(regions.contains("inside")) << "both rooms are closed";
  EXPECT_FALSE(regions.contains("outside"));
  EXPECT_EQ(regions["inside"]["points"], 24);
  EXPECT_EQ(regions["inside"]["ratio"], all["results"][0]["ratio"]);
  EXPECT_EQ(regions["inside"]["leak_ratio"], all["results"][0]["leak_ratio"]);
  const auto within = points(0.05f, 24, 3, scene::Bounds{{-3, 0, -1}, {0, 2.5f, 1.5f}});
  probes::LookupParams lookup;
  lookup.weights = probes::weights_named("mls");
  const study::LookupError e =
      study::lookup_error(study::look_up(probes::IrradianceLookup(set_, tracer_, lookup), within),
                          tracer_.surface_irradiance(within, params.path, {}));
  const json::Value& far = regions["far"];
  EXPECT_EQ(far["points"], 24);
  for (const auto& [name, figure] : figures)
    for (std::size_t c = 0; c < 3; ++c)
      EXPECT_NEAR(far[name][c].number(), e.channels[c].*figure, 1e-9 * (1 + std::abs(e.channels[c].*figure)))
          << name;
  EXPECT_EQ(far["unseen"], unseen_share(within));
  EXPECT_THAT(text_here(command),
              AllOf(HasSubstr("\n  inside, 24 points   "), HasSubstr("\n  far, 24 points   ")));
}

TEST(Measure, RegionsHaveNamesAndCorners) {
  const auto problem = [](const std::string& region, const std::string& second = "a=0,0,0,1,1,1") {
    return problem_here(
        {"measure", "builtin:box", "--method", "direct", "--region", region, "--region", second});
  };
  EXPECT_THAT(problem("kitchen"),
              HasSubstr("--region kitchen: there is no name (it is NAME=x0,y0,z0,x1,y1,z1"));
  EXPECT_THAT(problem("=0,0,0,1,1,1"), HasSubstr("there is no name"));
  EXPECT_THAT(problem("b=0,0,0,1,1"), HasSubstr("its six numbers cannot be read"));
  EXPECT_THAT(problem("b=0,0,0,1,1,1,1"), HasSubstr("its six numbers cannot be read"));
  EXPECT_THAT(problem("b=0,0,nan,1,1,1"), HasSubstr("its six numbers cannot be read"));
  EXPECT_THAT(problem("b=0,0,0,1,0,1"), HasSubstr("it is no box"));
  EXPECT_THAT(problem("inside=0,0,0,1,1,1"), HasSubstr("every scene has a region of this name"));
  EXPECT_THAT(problem("a=0,0,0,1,1,1"), HasSubstr("--region a: there are two of this name"));
}

TEST(Measure, OfASceneWithoutCamerasLampsAndSphls) {
  const test::TempDir dir;
  const std::string obj = dir / "sheets.obj";  // two sheets that face each other
  write_file(obj,
             "v -1 0 -1\nv 1 0 -1\nv 1 0 1\nv -1 0 1\nv -1 1 -1\nv 1 1 -1\nv 1 1 1\nv -1 1 1\nf 1 2 3 4\nf 5 "
             "6 7 8\n");
  const json::Value all = json_here({"measure", obj, "--sun-sky", "--method", "direct", "--points", "9",
                                     "--truth-spp", "4", "--max-depth", "2"});
  EXPECT_EQ(all["points"], 9);
  EXPECT_GT(all["mean_truth"].number(), 0);
}
TEST(Measure, ViewsAreRegionsOfWhatEachCameraSees) {
  const std::vector<std::string> command = {"measure", "builtin:two-rooms", "--method", "direct", "--points",
                                            "40",      "--truth-spp",       "4"};
  const json::Value all = json_here(joined(command, {"--views"}))["results"][0]["regions"];
  const json::Value plain = json_here(command)["results"][0]["regions"];
  EXPECT_EQ(all.size(), plain.size() + 2);
  for (const char* name : {"view room-a", "view room-b"}) {
    ASSERT_TRUE(all.contains(name)) << name;
    EXPECT_EQ(all[name]["points"], 40);
  }
  // The lamp stands in room A, and the door is shut
  EXPECT_GT(all["view room-a"]["mean_truth"][0].number(), 0.1);
  EXPECT_EQ(all["view room-b"]["mean_truth"][0].number(), 0);
  const std::vector<std::string> everywhere = {"--views", "--method", "ambient"};
  const json::Value results = json_here(joined(command, everywhere))["results"];
  ASSERT_EQ(results.size(), 2u);
  const json::Value& leaks = results[1]["regions"];
  EXPECT_EQ(leaks["view room-a"]["leak_ratio"], 0);
  EXPECT_EQ(leaks["view room-b"]["leak_ratio"], 1) << "all of what ambient light puts there";
  EXPECT_EQ(leaks["inside"]["leak_ratio"], results[1]["leak_ratio"]);
  EXPECT_THAT(text_here(joined(command, everywhere)), HasSubstr(" 100.00 %"));
}

}  // namespace
}  // namespace ssphh
