// What commands print for people holds the figures of their JSON. Times are of another run: only that they
// are there is asked.

#include <fstream>
#include <sstream>

#include <fmt/format.h>
#include <fmt/ranges.h>

#include <ssphh/core/file.h>
#include <ssphh/image/io.h>
#include <ssphh/scene/builtin.h>

#include "commands/bake_watch.h"
#include "here.h"
#include "options/farm_options.h"
#include "temp_dir.h"

namespace ssphh {
namespace {

using test::joined;
using test::json_here;
using test::text_here;
using testing::MatchesRegex;

const std::string time_text = "[0-9.e+-]+";

/// The text as an extended regular expression that nothing else matches; "@" stands for a time.
std::string pattern(const std::string& text) {
  std::string result;
  for (const char c : text) {
    if (c == '@') {
      result += time_text;
      continue;
    }
    if (std::string_view("\\.[]()*+?{}|^$").find(c) != std::string_view::npos) result += '\\';
    result += c;
  }
  return result;
}

double number(const json::Value& object, const char* key) {
  return object[key].number();
}

TEST(Texts, OfASceneNameLampsProfiles) {
  const test::TempDir dir;
  const std::string file = (dir / "lit.ssphh.json").string();
  write_file(file, R"({"scene": "builtin:gallery1", "lights": [
      {"name": "desk", "type": "point", "position": [0, 2, 0], "direction": [0, -1, 0],
       "profile": {"name": "wash.ies", "ies": "TILT=NONE\n1 1 1 2 1 1 2 0 0 0 1 1 0 0 90 0 5 6"}}]})");
  const json::Value profiles = json_here({"scene", "info", file})["lamp_profiles"];
  ASSERT_EQ(profiles.size(), 1u);
  EXPECT_EQ(profiles[0]["lamp"], "desk");
  EXPECT_EQ(profiles[0]["profile"], "wash.ies");
  EXPECT_THAT(text_here({"scene", "info", file}), testing::HasSubstr("\nprofiles     wash.ies of desk\n"));
  EXPECT_EQ(json_here({"scene", "info", "builtin:gallery1"})["lamp_profiles"].size(), 0u);
}

TEST(Texts, OfASceneListLampsWithTheirTypes) {
  const test::TempDir dir;
  const std::string file = (dir / "lit.ssphh.json").string();
  write_file(file, R"({"scene": "builtin:box", "lights": [
      {"name": "panel", "type": "rectangle", "position": [0, 2, 0], "direction": [0, -1, 0], "width": 1, "height": 0.5, "power": 9},
      {"name": "plate", "type": "disc", "position": [0, 2, 0], "direction": [0, -1, 0], "radius": 0.5}]})");
  const json::Value lamps = json_here({"scene", "info", file})["lamps"];
  ASSERT_EQ(lamps.size(), 2u);
  EXPECT_EQ(lamps[0]["name"], "panel");
  EXPECT_EQ(lamps[0]["type"], "rectangle");
  EXPECT_EQ(lamps[1]["type"], "disc");
  EXPECT_THAT(text_here({"scene", "info", file}),
              testing::HasSubstr("\nlamps        panel (rectangle), plate (disc)\n"));
  EXPECT_EQ(json_here({"scene", "info", "builtin:box"})["lamps"].size(), 0u);
}

TEST(Texts, OfScenes) {
  const json::Value list = json_here({"scene", "list"})["scenes"];
  ASSERT_EQ(list.size(), scene::builtin_scenes().size());
  std::vector<std::string> lines;
  for (std::size_t i = 0; i < list.size(); ++i) {
    const scene::BuiltinScene& scene = scene::builtin_scenes()[i];
    EXPECT_EQ(list[i]["name"], "builtin:" + scene.name);
    EXPECT_EQ(list[i]["description"], scene.description);
    const std::string drawn = scene.number ? "?" + scene.number->key + "=N" : std::string();
    lines.push_back(fmt::format("{:<22} {}", list[i]["name"].string() + drawn, scene.description));
  }
  EXPECT_EQ(text_here({"scene", "list"}), fmt::format("{}", fmt::join(lines, "\n")));

  const json::Value info = json_here({"scene", "info", "builtin:cornell"});
  EXPECT_EQ(info["movable"], 0);
  EXPECT_EQ(info["emissive_instances"], 1);
  EXPECT_LT(info["bounds"]["min"][1].number(), info["bounds"]["max"][1].number());
  std::vector<std::string> names;
  for (const json::Value& place : info["sphl_places"].elements()) names.push_back(place["name"].string());
  const auto bound = [&](const char* which) {
    const json::Value& b = info["bounds"][which];
    return fmt::format("{:.3f} {:.3f} {:.3f}", b[0].number(), b[1].number(), b[2].number());
  };
  EXPECT_EQ(text_here({"scene", "info", "builtin:cornell"}),
            fmt::format("builtin:cornell (cornell)\n"
                        "triangles    {} in {} instances of {} meshes\n"
                        "materials    {}, 0 textures\n"
                        "lights       {}, 1 emissive instance, no environment\n"
                        "light groups {}\n"
                        "cameras      {}\n"
                        "SPHLs        {}: {}\n"
                        "movable      0 nodes; animations last 0 s\n"
                        "bounds       {} to {} m\n"
                        "ignored      nothing",
                        print(info["triangles"]), print(info["instances"]), print(info["meshes"]),
                        print(info["materials"]), print(info["lights"]), info["light_groups"][0].string(),
                        info["camera_names"][0].string(), names.size(), fmt::join(names, ", "), bound("min"),
                        bound("max")));
  const test::TempDir dir;
  std::ofstream(dir / "a.obj") << "v 0 0 0\nv 1 0 0\nv 0 0 1\nf 1 2 3\n";
  EXPECT_THAT(text_here({"scene", "info", dir / "a.obj"}),
              testing::HasSubstr("\nlight groups none\ncameras      none\nSPHLs        none\n"));
}

TEST(Texts, OfMethods) {
  const json::Value methods = json_here({"methods"})["methods"];
  ASSERT_GT(methods.size(), 5u);
  for (const json::Value& method : methods.elements()) {
    std::string text = fmt::format("{}\n    {}\n", method["name"].string(), method["about"].string());
    for (const json::Value& p : method["parameters"].elements()) {
      const bool choice = p.contains("choices");
      std::vector<std::string> choices;
      if (choice)
        for (const json::Value& name : p["choices"].elements()) choices.push_back(name.string());
      text += fmt::format("    {:<16} {:<10} {} ({})\n", p["name"].string(),
                          choice ? p["default"].string() : fmt::format("{:g}", number(p, "default")),
                          p["about"].string(),
                          choice ? fmt::format("{}", fmt::join(choices, "|"))
                                 : fmt::format("{:g}..{:g}", number(p, "least"), number(p, "most")));
    }
    text.pop_back();
    const std::string said = text_here({"methods", method["name"].string()});
    EXPECT_EQ(said.substr(0, text.size()), text);
    EXPECT_THAT(text_here({"methods"}), testing::HasSubstr(text));
  }
}

TEST(Texts, OfMeasure) {
  const std::vector<std::string> command = {"measure",     "builtin:cornell",
                                            "--method",    "vpl,photons=8,check_points=0",
                                            "--method",    "direct",
                                            "--points",    "16",
                                            "--truth-spp", "4",
                                            "--max-depth", "3"};
  const json::Value all = json_here(command);
  EXPECT_EQ(all["geometry_builds"], 1);
  std::string text = fmt::format(
      "16 points of 4 paths, {} of them dark; mean {:.5g} W/m2\n"
      "light                    weights   ratio R      G      B    error     95 %    relMSE   colour     "
      "leak   unseen   lookup",
      print(all["dark_points"]), number(all, "mean_truth"));
  for (const json::Value& one : all["results"].elements()) {
    const json::Value &ratio = one["ratio"], &worst = one["worst"];
    text += fmt::format(
        "\n{:<24}{:<11}{:>7.3f}{:>7.3f}{:>7.3f}{:>7.1f} %{:>7.1f} %{:>10.4f}{:>7.2f} %{:>7.2f} % *@ us",
        one["method"].string(), "", ratio[0].number(), ratio[1].number(), ratio[2].number(),
        100 * number(worst, "mean_error"), 100 * number(worst, "p95_relative"), number(worst, "relmse"),
        100 * number(one["chromaticity"], "mean_error"), 100 * number(one, "leak_ratio"));
    EXPECT_GT(number(one, "frame_ms"), 0);
    EXPECT_LT(number(one, "frame_ms"), 2000);
  }
  text += fmt::format(
      "\nerror, 95 % and relMSE of the worst channel; the truth's noise, {:.2g} % of a point, is taken off "
      "error, "
      "relMSE and colour",
      100 * number(all, "noise"));
  std::string wanted = pattern(text);
  for (std::size_t at; (at = wanted.find(" \\*")) != std::string::npos;) wanted.replace(at, 3, " *");
  EXPECT_THAT(text_here(command), MatchesRegex(wanted));
}

TEST(Texts, LargeErrorsOfMeasureStandApart) {
  // Most of what stands on a dark plain gets no light, and ambient light is the same everywhere.
  const std::string text = text_here(
      {"measure", "builtin:random?seed=113", "--method", "ambient", "--points", "32", "--truth-spp", "32"});
  const std::size_t at = text.find("\nambient ");
  ASSERT_NE(at, std::string::npos) << text;
  std::istringstream row(text.substr(at, text.find('\n', at + 1) - at));
  std::vector<std::string> words;
  for (std::string word; row >> word;) words.push_back(word);
  ASSERT_EQ(words.size(), 15u) << text;  // name, ratios, error, 95 %, relMSE, colour, leak, unseen, time
  EXPECT_GT(words[4].size(), 6u);        // too wide for its column
  EXPECT_EQ(words[5], "%");
}

TEST(Texts, OfRespond) {
  const std::vector<std::string> command = {"respond",     "builtin:two-rooms",
                                            "--method",    "vpl",
                                            "--param",     "photons=8",
                                            "--param",     "check_points=0",
                                            "--event",     "lamp.scale=1:2",
                                            "--frames",    "2",
                                            "--points",    "9",
                                            "--truth-spp", "4"};
  const json::Value run = json_here(command);
  EXPECT_EQ(run["frames_to_settle"], 1);
  EXPECT_NE(run["before_error"], run["first_error"]);
  const json::Value& ratio = run["frames"][1]["ratio"];
  const std::string text = text_here(command);
  EXPECT_THAT(text, testing::StartsWith("vpl: bake 0.0"));
  EXPECT_THAT(
      text.substr(text.find('\n') + 1),
      MatchesRegex(pattern(fmt::format(
          "mean error at 9 points: {:.1f} % with the light of before, {:.1f} % after one frame, "
          "{:.1f} % after 2 (ratio{:>7.3f}{:>7.3f}{:>7.3f})\nsettled after 1 frame, @ ms a frame (the first "
          "@)",
          100 * number(run, "before_error"), 100 * number(run, "first_error"),
          100 * number(run, "last_error"), ratio[0].number(), ratio[1].number(), ratio[2].number()))));
}

TEST(Texts, OfBakes) {
  const test::TempDir dir;
  const std::vector<std::string> paths = {"bake", "builtin:box", "-o", dir / "a.sphl", "--face", "1", "--spp",
                                          "1",    "--degree",    "0",  "--records",    "0"};
  const std::string head = (dir / "a.sphl").string() + ": 5 probes of degree 0, 1 light group, 20 edges";
  const json::Value traced = json_here(paths);
  EXPECT_THAT(text_here(paths), MatchesRegex(pattern(fmt::format("{}\nGEN @ s\nVIZ from paths @ s\n{} rays",
                                                                 head, print(traced["rays"])))));
  const std::vector<std::string> transport = {
      "bake", "builtin:box",   "-o",  dir / "a.sphl", "--operator", "surfel",   "--fit", "--directions",
      "64",   "--surfel-size", "0.5", "--link-rays",  "8",          "--degree", "0"};
  const json::Value solved = json_here(transport);
  EXPECT_THAT(
      text_here(transport),
      MatchesRegex(pattern(fmt::format(
          "{}\n{} surfels of 0.5 m, {} links; {} iterations, a bounce keeps at most {:.3g} of the light, "
          "@ % are missing at most; @ s\nlight kept at {} surface points in @ s\nweights fitted at {} points "
          "in @ s\nVIZ from links @ "
          "s\n{} rays",
          head, print(solved["surfels"]), print(solved["links"]), print(solved["iterations"]),
          number(solved, "contraction"), print(solved["records"]), print(solved["fitted"]),
          print(solved["rays"])))));
}

TEST(Texts, OneIsNotSeveral) {
  const test::TempDir dir;
  const std::string scene = dir / "one.ssphh.json", one = dir / "one.sphl", copy = dir / "copy.sphl";
  std::ofstream(dir / "one.obj") << "v 0 0 0\nv 1 0 0\nv 0 0 1\nf 1 2 3\n";
  std::ofstream(scene) << R"({"scene": "one.obj", "sphls": [{"name": "a", "position": [0.2, 0.3, 0.2]}],
    "lights": [{"name": "l", "type": "point", "position": [0.2, 1, 0.2]}]})";
  EXPECT_THAT(text_here({"scene", "info", scene}), testing::HasSubstr("1 in 1 instance of 1 mesh\n"));
  EXPECT_THAT(
      text_here({"bake", scene, "-o", one, "--degree", "0", "--face", "1", "--spp", "1", "--records", "0"}),
      testing::StartsWith(one + ": 1 probe of degree 0, 1 light group, 0 edges\n"));
  EXPECT_THAT(text_here({"probe", "info", one}),
              testing::StartsWith(one + ": 1 probe of degree 0, 0 edges\n"));
  EXPECT_THAT(text_here({"hier", one, "-o", copy}), testing::HasSubstr("0 edges between 1 probe,"));
  EXPECT_THAT(text_here({"probe", "convert", one, "-o", copy}), testing::StartsWith(copy + ": 1 probe, "));
}

TEST(Texts, OfPictures) {
  const test::TempDir dir;
  const std::vector<std::string> size = {"--width", "6", "--height", "4", "--spp", "2", "--max-depth", "2"};
  const std::string out = dir / "a.exr";
  const std::vector<std::string> render = joined({"render", "builtin:cornell", "-o", out}, size);
  const json::Value picture = json_here(render);
  EXPECT_THAT(text_here(render), MatchesRegex(pattern(fmt::format(
                                     "{}: 6×4, 48 paths, {} rays in @ s, mean radiance {:.4g} {:.4g} {:.4g}",
                                     out, print(picture["rays"]), picture["mean"][0].number(),
                                     picture["mean"][1].number(), picture["mean"][2].number()))));
  const std::vector<std::string> truth = joined({"truth", "builtin:cornell", "-o", out}, size);
  const json::Value t = json_here(truth);
  const json::Value &m = t["mean"], &e = t["standard_error"];
  EXPECT_THAT(text_here(truth),
              MatchesRegex(pattern(fmt::format(
                  "{}: 6×4, 2 samples per pixel, depth 2, by path in @ s\nmean radiance {:.5g} {:.5g} {:.5g} "
                  "(standard error {:.1e} {:.1e} {:.1e})\nnoise: RMSE {:.4g}, relMSE {:.4g}",
                  out, m[0].number(), m[1].number(), m[2].number(), e[0].number(), e[1].number(),
                  e[2].number(), number(t["noise"], "rmse"), number(t["noise"], "relmse")))));
}

TEST(Texts, OfComparisons) {
  const test::TempDir dir;
  image::Image a(5, 3), b(5, 3);
  for (std::size_t i = 0; i < a.pixels.size(); ++i) {
    a.pixels[i] = 0.1f + 0.02f * static_cast<float>(i);
    b.pixels[i] = 0.2f + 0.01f * static_cast<float>(i * i % 17);
  }
  image::write_image(dir / "a.exr", a), image::write_image(dir / "b.exr", b);
  const std::vector<std::string> command = {"compare", dir / "a.exr", dir / "b.exr", "--block",
                                            "2",       "-o",          dir / "m.png"};
  const json::Value c = json_here(command);
  const json::Value &blocks = c["blocks"], &ratio = c["mean_ratio"];
  EXPECT_EQ(blocks["columns"], 3);
  EXPECT_EQ(blocks["rows"], 2);
  EXPECT_EQ(
      text_here(command),
      fmt::format("size       5 x 3\n"
                  "MAE        {:.6g}   (sum {:.6g}, max {:.6g}, bias {:+.6g})\n"
                  "RMSE       {:.6g}   (MSE {:.6g})\n"
                  "relMSE     {:.6g}\nMAPE       {:.6g}\nSMAPE      {:.6g}\n"
                  "mean ratio {:.6g} {:.6g} {:.6g}\n"
                  "FLIP       {:.6g}   (largest of {} exposures from {:.2f} to {:.2f} EV)\n"
                  "SSIM       {:.6g}\nPSNR       {:.6g} dB\n"
                  "blocks     3 x 2 of 2 pixels: mean sum {:.6g}, max {:.6g} in block {}, {}\n"
                  "map        {} (absolute, last colour at {:.6g})",
                  number(c, "mae"), number(c, "sum"), number(c, "max"), number(c, "bias"), number(c, "rmse"),
                  number(c, "mse"), number(c, "relmse"), number(c, "mape"), number(c, "smape"),
                  ratio[0].number(), ratio[1].number(), ratio[2].number(), number(c["flip"], "mean"),
                  print(c["flip"]["exposures"]["count"]), number(c["flip"]["exposures"], "first"),
                  number(c["flip"]["exposures"], "last"), number(c, "ssim"), number(c, "psnr"),
                  number(blocks, "mean"), number(blocks, "max"), print(blocks["max_block"][0]),
                  print(blocks["max_block"][1]), (dir / "m.png").string(), number(c["map"], "scale")));
}

TEST(Texts, OfWatchedBakes) {
  app::BakeWatch watch;
  watch.rounds.resize(3);
  watch.rounds[1].problem = "not valid JSON";
  const app::BakeOptions options;
  const std::string first = app::to_text(watch.first, options);
  EXPECT_EQ(app::to_text(watch, options), first + "\n2 saves were baked, 1 could not be");
  watch.rounds.pop_back();
  EXPECT_EQ(app::to_text(watch, options), first + "\n1 save was baked, 1 could not be");
}

TEST(Texts, OfFarms) {
  farm::FarmReport report;
  report.jobs = 7, report.units = 12, report.cached = 0, report.retries = 0, report.workers = 3;
  report.compute_seconds = 2.5, report.seconds = 1.25;
  const std::string base = "farm: 7 jobs, 3 workers, 2.50 s of computing in 1.25 s";
  EXPECT_EQ(app::farm_text(report), base);
  report.cached = 1, report.retries = 1;
  EXPECT_EQ(app::farm_text(report), base + "; 1 of 12 results were known; 1 retry");
  EXPECT_EQ(app::farm_json(report), ssphh::json::Value({{"jobs", 7},
                                                        {"retries", 1},
                                                        {"units", 12},
                                                        {"cached", 1},
                                                        {"workers", 3},
                                                        {"compute_seconds", 2.5},
                                                        {"seconds", 1.25}}));
}

}  // namespace
}  // namespace ssphh
