// What `ssphh relight` says of its frames: medians, rays, frames that took too long, the curve of its errors.

#include "results/relight_report.h"

#include <cmath>
#include <limits>

#include <gmock/gmock.h>

#include <ssphh/core/file.h>

#include "expected_text.h"
#include "json_text.h"
#include "temp_dir.h"

namespace ssphh::app {
namespace {

using testing::HasSubstr;

transport::RelightReport update(double scale, std::uint64_t pose_rays, std::uint64_t direct_rays,
                                int iterations) {
  transport::RelightReport report;
  report.pose_ms = scale, report.direct_ms = 2 * scale, report.solve_ms = 4 * scale;
  report.project_ms = 8 * scale;
  report.pose_rays = pose_rays, report.direct_rays = direct_rays, report.solve.iterations = iterations;
  return report;
}

/// The first frame lights everything; those after it take 15, 45, 30 and 60 ms.
RelightRun five_frames() {
  RelightRun run;
  run.frames_asked = 5, run.fps = 25, run.build_ms = 123;
  run.updates = {update(100, 9000, 8000, 50), update(1, 10, 100, 2), update(3, 20, 200, 3),
                 update(2, 30, 300, 5), update(4, 40, 500, 6)};
  run.updates[2].solve.converged = false;
  return run;
}

TEST(RelightReport, QuantilesAreOfAllFramesButTheFirst) {
  const json::Value json = relight_json(five_frames());
  EXPECT_EQ(json["frames"], 5);
  EXPECT_EQ(json["frames_asked"], 5);
  EXPECT_EQ(json["cancelled"], false);
  EXPECT_EQ(json["fps"], 25);
  EXPECT_EQ(json["build_ms"], 123);
  EXPECT_EQ(json["first_ms"], 1500);
  EXPECT_EQ(json["median_ms"], 30) << "15 30 45 60: the second, as half of the frames are not above it";
  EXPECT_EQ(json["p99_ms"], 60);
  const std::vector<std::pair<const char*, double>> stages = {
      {"pose", 1}, {"direct", 2}, {"solve", 4}, {"project", 8}};
  EXPECT_EQ(json["stages"].size(), 4u);
  for (const auto& [name, ms] : stages) {
    EXPECT_EQ(json["stages"][name]["median_ms"], 2 * ms) << name;
    EXPECT_EQ(json["stages"][name]["p99_ms"], 4 * ms) << name;
  }
  EXPECT_EQ(json["stages"]["pose"]["rays"], 25);
  EXPECT_EQ(json["stages"]["direct"]["rays"], 275);
  EXPECT_EQ(json["rays_per_frame"], 300);
  EXPECT_EQ(json["stages"]["solve"]["iterations"], 4);
  EXPECT_EQ(json["unconverged"], 1);
  EXPECT_EQ(json["frame_ms"], (json::Value{1500, 15, 45, 30, 60}));
}

TEST(RelightReport, AFrameIsOverItsBudgetAboveTheTimeOfAFrame) {
  RelightRun run = five_frames();
  EXPECT_EQ(relight_json(run)["over_budget"], 2) << "45 and 60 of 40 ms; the first does not count";
  run.fps = 1000.0 / 45;
  EXPECT_EQ(relight_json(run)["over_budget"], 1) << "45 of 45 ms is in time";
  EXPECT_THAT(relight_text(five_frames()), HasSubstr("\n2 of 4 frames took longer than 1/25 s"));
}

TEST(RelightReport, AOneFrameRunIsThatOfItsFirst) {
  RelightRun run = five_frames();
  run.updates.resize(1);
  const json::Value json = relight_json(run);
  EXPECT_EQ(json["median_ms"], 1500);
  EXPECT_EQ(json["rays_per_frame"], 17000);
  EXPECT_EQ(json["over_budget"], 1);
  run.updates.clear();
  const json::Value none = relight_json(run);
  for (const char* key : {"first_ms", "median_ms", "p99_ms", "rays_per_frame", "over_budget"})
    EXPECT_EQ(none[key], 0) << key;
  EXPECT_THAT(relight_text(run), HasSubstr("first frame 0.0 ms"));
}

/// The same in all channels.
void fill(study::LookupError& error, double ratio, double mean_relative, double noise, double relmse) {
  for (study::RelativeError* e :
       {error.channels.data(), &error.channels[1], &error.channels[2], &error.luminance}) {
    e->ratio = ratio, e->mean_relative = mean_relative, e->noise = noise, e->relmse = relmse;
    e->mean_truth = 7, e->median_relative = 0.25, e->p95_relative = 0.75;
  }
}

FrameError error_at(int frame, double ratio, double mean_relative) {
  FrameError e;
  e.frame = frame;
  fill(e.error, ratio, mean_relative, 0.125, 0.04);
  e.error.channels[0].ratio += 0.0625;
  e.error.chromaticity.mean_error = 0.015625;
  e.error.points = 99;
  return e;
}

TEST(RelightReport, ErrorsStandBesideTheirTime) {
  RelightRun run = five_frames();
  run.errors = {error_at(0, 1.5, 0.5), error_at(4, std::numeric_limits<double>::quiet_NaN(), 0.375)};
  const json::Value json = relight_json(run);
  ASSERT_EQ(json["error"].size(), 2u);
  const json::Value& first = json["error"][0];
  EXPECT_EQ(first["frame"], 0);
  EXPECT_EQ(first["seconds"], 0);
  EXPECT_EQ(first["points"], 99);
  EXPECT_EQ(first["ratio"], json::Value({1.5625, 1.5, 1.5}));
  EXPECT_EQ(first["mean_relative"], json::Value({0.5, 0.5, 0.5}));
  EXPECT_EQ(first["worst"]["ratio"], 1.5625);
  EXPECT_EQ(first["luminance"], json::Value({{"mean_truth", 7},
                                             {"ratio", 1.5},
                                             {"mean_error", 0},
                                             {"mean_relative", 0.5},
                                             {"median_relative", 0.25},
                                             {"p95_relative", 0.75},
                                             {"noise", 0.125},
                                             {"relmse", 0.04}}));
  EXPECT_EQ(first["chromaticity"]["mean_error"], 0.015625);
  EXPECT_EQ(json["error"][1]["seconds"], 4 / 25.0);
  EXPECT_TRUE(json["error"][1]["ratio"][2].is_null());
  EXPECT_TRUE(json["error"][1]["luminance"]["ratio"].is_null());
}

TEST(RelightReport, TheTextHoldsTheSameNumbers) {
  RelightRun run = five_frames();
  run.errors = {error_at(0, 1.5, 0.5), error_at(4, 0.875, 0.375)};
  EXPECT_EQ(relight_text(run),
            "network built in 123 ms, first frame 1500.0 ms\n"
            "stage        median ms      p99 ms  rays a frame\n"
            "pose              2.00        4.00            25\n"
            "direct            4.00        8.00           275\n"
            "solve             8.00       16.00\n"
            "project          16.00       32.00\n"
            "frame            30.00       60.00           300\n"
            "2 of 4 frames took longer than 1/25 s\n"
            "\n"
            "frame  seconds  ratio R      G      B  mean rel.   median     95 %    noise    relMSE   colour\n"
            "    0     0.00    1.562  1.500  1.500      0.500    0.250    0.750    0.125    0.0400    0.016\n"
            "    4     0.16    0.938  0.875  0.875      0.375    0.250    0.750    0.125    0.0400    0.016");
  run.cancelled = true, run.frames_asked = 8;
  EXPECT_THAT(relight_text(run), testing::EndsWith("\ncancelled: 5 of 8 frames and 2 errors were done"));
  EXPECT_EQ(relight_json(run)["cancelled"], true);
  EXPECT_EQ(relight_json(run)["frames_asked"], 8);
}

/// Panels of 620 × 150 from x = 60: the ratio from y = 40 on, the errors from 250 on.
TEST(RelightReport, TheCurveShowsRatioAndErrorsOverSeconds) {
  RelightRun run = five_frames();
  // Off by 0.5 at most: the axis reaches 0.55 to both sides. Errors up to 0.5: up to 0.55.
  run.errors = {error_at(0, 1.5, 0.5), error_at(1, std::numeric_limits<double>::infinity(), 0.1),
                error_at(4, 0.725, 0.275)};
  for (FrameError& e : run.errors) e.error.channels[0].ratio -= 0.0625;
  const test::TempDir dir;
  write_error_curve(dir / "error.svg", run);
  const std::string svg = read_text_file(dir / "error.svg");
  EXPECT_THAT(svg, testing::StartsWith("<svg xmlns='http://www.w3.org/2000/svg' viewBox='0 0 720 440'"));
  EXPECT_THAT(svg, testing::EndsWith("</svg>\n"));
  // (1.55 − 1.5) / 1.1 · 150 = 6.8 under the top, (1.55 − 0.725) / 1.1 · 150 = 112.5; the infinite one is
  // left out.
  EXPECT_THAT(svg, HasSubstr("<polyline points='60.0,46.8 680.0,152.5 ' fill='none' stroke='#1b6ca8'/>"
                             "<circle cx='60.0' cy='46.8' r='2' fill='#1b6ca8'/>"
                             "<circle cx='680.0' cy='152.5' r='2' fill='#1b6ca8'/>\n"));
  // 250 + 150 · (1 − e / 0.55) at a quarter of the way, too.
  EXPECT_THAT(svg, HasSubstr("<polyline points='60.0,263.6 215.0,372.7 680.0,325.0 ' fill='none' stroke"));
  EXPECT_THAT(svg, HasSubstr("'60.0,365.9 215.0,365.9 680.0,365.9 '")) << "noise of 0.125";
  EXPECT_THAT(svg, HasSubstr("'60.0,345.5 215.0,345.5 680.0,345.5 '")) << "root of 0.04";
  // Axes: five lines each, from the lowest value to the highest, and the seconds under them.
  EXPECT_THAT(svg, HasSubstr("<line x1='60.0' y1='190.0' x2='680.0' y2='190.0' stroke='#ddd'/>"
                             "<text x='54.0' y='194.0' text-anchor='end'>0.45</text>\n"
                             "<text x='60.0' y='206.0' text-anchor='middle'>0 s</text>\n"));
  EXPECT_THAT(svg, HasSubstr("<line x1='60.0' y1='40.0' x2='680.0' y2='40.0' stroke='#ddd'/>"
                             "<text x='54.0' y='44.0' text-anchor='end'>1.55</text>\n"
                             "<text x='680.0' y='206.0' text-anchor='middle'>0.16 s</text>\n"));
  EXPECT_THAT(svg, HasSubstr("<line x1='60.0' y1='325.0' x2='680.0' y2='325.0' stroke='#ddd'/>"
                             "<text x='54.0' y='329.0' text-anchor='end'>0.275</text>\n"
                             "<text x='370.0' y='416.0' text-anchor='middle'>0.08 s</text>\n"));
  EXPECT_THAT(svg, HasSubstr("<text x='60.0' y='32.0' fill='#b03a2e'>looked up / path traced: red</text>"));
  EXPECT_THAT(svg, HasSubstr("<text x='280.0' y='242.0' fill='#999999'>of which the truth's noise</text>"));
  EXPECT_THAT(svg, HasSubstr("<text x='500.0' y='242.0' fill='#7d3c98'>root of relMSE</text>"));
}

TEST(RelightReport, ACurveOfSmallErrorsIsNotBlownUp) {
  RelightRun run = five_frames();
  FrameError e = error_at(2, 1, 0);
  fill(e.error, 1, 0, 0, -0.01);
  run.errors = {e};
  const test::TempDir dir;
  write_error_curve(dir / "error.svg", run);
  const std::string svg = read_text_file(dir / "error.svg");
  // At least 1.1 · 5 % each way; one frame stands at the left.
  EXPECT_THAT(svg, HasSubstr(">1.05</text>"));
  EXPECT_THAT(svg, HasSubstr(">0.055</text>"));
  EXPECT_THAT(svg, HasSubstr("points='60.0,115.0 '"));
  EXPECT_THAT(svg, HasSubstr("points='60.0,400.0 ' fill='none' stroke='#7d3c98'")) << "below 0 by chance: 0";
}

/// Every line, every curve and every name where it stands, of errors at three times.
TEST(RelightReport, TheCurveIsDrawnAsItWas) {
  RelightRun run = five_frames();
  const auto error = [](int frame, double ratio, double relative, double noise, double relmse) {
    FrameError e;
    e.frame = frame;
    fill(e.error, ratio, relative, noise, relmse);
    return e;
  };
  run.errors = {error(0, 0.9, 0.2, 0.05, 0.04), error(2, 1.2, 0.3, 0.06, 0.25),
                error(4, 1.05, 0.1, 0.02, -1)};
  const test::TempDir dir;
  write_error_curve(dir / "error.svg", run);
  test::expect_text_of("tests/cli/expected/error_curve.svg", read_text_file(dir / "error.svg"));
}

}  // namespace
}  // namespace ssphh::app
