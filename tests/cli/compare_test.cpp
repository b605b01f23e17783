// What `ssphh compare` counts, and when it fails.

#include <cmath>
#include <filesystem>
#include <limits>
#include <utility>

#include <fmt/format.h>
#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <ssphh/image/io.h>
#include <ssphh/metrics/false_edges.h>

#include "joined.h"
#include "temp_dir.h"
#include "tool_checks.h"

namespace ssphh {
namespace {

using image::Image;
using test::run_json;
using test::run_tool;
using test::TempDir;
using test::ToolResult;
using testing::HasSubstr;

constexpr float nan_value = std::numeric_limits<float>::quiet_NaN();
constexpr float infinite = std::numeric_limits<float>::infinity();

/// 4×3 pixels of (1, 2, 3), and the same with 1/4, 1/2 and −1 added.
class Compare : public testing::Test {
 protected:
  Compare() {
    for (int y = 0; y < 3; ++y) {
      for (int x = 0; x < 4; ++x) {
        reference_.set_rgb(x, y, vec3(1, 2, 3));
        picture_.set_rgb(x, y, vec3(1.25f, 2.5f, 2));
      }
    }
  }
  /// The command with its files written anew.
  std::vector<std::string> command(const std::vector<std::string>& more = {}) {
    image::write_image(dir_ / "ref.exr", reference_);
    image::write_image(dir_ / "test.exr", picture_);
    return test::joined({"compare", dir_ / "ref.exr", dir_ / "test.exr"}, more);
  }
  /// The errors of `pixels` good pixels, which are all equal.
  static void expect_errors(const json::Value& errors, int pixels, int nonfinite) {
    EXPECT_EQ(errors["pixels"], pixels);
    EXPECT_EQ(errors["nonfinite_pixels"], nonfinite);
    EXPECT_NEAR(errors["mae"].number(), 1.75 / 3, 1e-12);
    EXPECT_NEAR(errors["bias"].number(), -0.25 / 3, 1e-12);
    EXPECT_NEAR(errors["sum"].number(), 1.75 * pixels, 1e-12);
    EXPECT_EQ(errors["max"], 1);
    EXPECT_NEAR(errors["mean_ratio"][2].number(), 2.0 / 3, 1e-12);
  }

  const TempDir dir_;
  Image reference_{4, 3}, picture_{4, 3};
};

TEST_F(Compare, FinitePicturesSucceed) {
  expect_errors(run_json(command()), 12, 0);
}

TEST_F(Compare, APixelThatIsNoNumberFails) {
  for (const auto& [image, bad] :
       {std::pair{&picture_, nan_value}, {&reference_, infinite}, {&picture_, -infinite}}) {
    float& channel = image->at(2, 1)[1];
    const float good = std::exchange(channel, bad);
    // The numbers are of the other pixels.
    expect_errors(run_json(command(), 1), 11, 1);
    channel = good;
  }
  picture_.at(2, 1)[1] = nan_value;
  const ToolResult result = run_tool(command());
  EXPECT_EQ(result.exit_code, 1);
  EXPECT_THAT(result.out, HasSubstr("1 pixels are infinite or NaN and were left out"));
  EXPECT_THAT(result.out, HasSubstr("--allow-nonfinite accepts them"));
}

TEST_F(Compare, AllowNonfiniteCountsThemAndSucceeds) {
  reference_.at(0, 0)[0] = nan_value;
  picture_.at(3, 2)[2] = infinite;
  picture_.at(1, 2)[0] = -infinite, reference_.at(1, 2)[1] = nan_value;  // one pixel, bad in both
  expect_errors(run_json(command({"--allow-nonfinite"}), 0), 9, 3);
  const ToolResult result = run_tool(command({"--allow-nonfinite"}));
  EXPECT_EQ(result.exit_code, 0);
  EXPECT_THAT(result.out, HasSubstr("3 pixels are infinite or NaN and were left out"));
  EXPECT_THAT(result.out, Not(HasSubstr("--allow-nonfinite")));
  expect_errors(run_json(command(), 1), 9, 3);
}

TEST_F(Compare, WhatAMaskLeavesOutIsNotBad) {
  Image mask(4, 3);
  for (int y = 0; y < 3; ++y) {
    for (int x = 0; x < 3; ++x) mask.set_rgb(x, y, vec3(1));
  }
  image::write_image(dir_ / "mask.exr", mask);
  const std::vector<std::string> with_mask = {"--mask", dir_ / "mask.exr"};
  picture_.set_rgb(3, 0, vec3(50));
  expect_errors(run_json(command(with_mask)), 9, 0);
  picture_.at(3, 1)[0] = nan_value;
  expect_errors(run_json(command(with_mask)), 9, 0);
  picture_.at(0, 1)[0] = nan_value;
  expect_errors(run_json(command(with_mask), 1), 8, 1);
}

TEST_F(Compare, ExposureMultipliesBothPictures) {
  const json::Value errors = run_json(command({"--exposure", "2"}));
  EXPECT_NEAR(errors["mae"].number(), 4 * 1.75 / 3, 1e-12);
  EXPECT_NEAR(errors["mean_ratio"][0].number(), 1.25, 1e-12);
}

/// A wall in even light with noise as truth, and a test that is 10 % brighter in its right half; REF and TEST
/// as `render
/// --aov` writes them.
class CompareEdges : public testing::Test {
 protected:
  CompareEdges() {
    truth_.indirect = truth_.albedo = truth_.normal = Image(width, height),
    truth_.depth = Image(width, height, 1);
    test_.indirect = Image(width, height);
    for (int y = 0; y < height; ++y) {
      for (int x = 0; x < width; ++x) {
        truth_.indirect.set_rgb(x, y,
                                vec3(0.5f * (1 + 0.01f * static_cast<float>((x * 7 + y * 13) % 5 - 2))));
        truth_.albedo.set_rgb(x, y, vec3(0.5f));
        truth_.normal.set_rgb(x, y, vec3(0, 0, 1));
        *truth_.depth.at(x, y) = 3;
        test_.indirect.set_rgb(x, y, vec3(x > 30 ? 0.55f : 0.5f));
      }
    }
    image::write_image(dir_ / "ref.exr", truth_.indirect);
    image::write_image(dir_ / "test.exr", test_.indirect);
    image::write_image(dir_ / "ref.indirect.exr", truth_.indirect);
    image::write_image(dir_ / "ref.albedo.exr", truth_.albedo);
    image::write_image(dir_ / "ref.normal.exr", truth_.normal);
    image::write_image(dir_ / "ref.depth.exr", truth_.depth);
    image::write_image(dir_ / "test.indirect.exr", test_.indirect);
  }
  std::vector<std::string> command(const std::vector<std::string>& more) const {
    return test::joined({"compare", dir_ / "ref.exr", dir_ / "test.exr"}, more);
  }

  static constexpr int width = 64, height = 40;
  const TempDir dir_;
  metrics::SurfacePicture truth_, test_;
};

TEST_F(CompareEdges, AreThoseOfTheLibrary) {
  test_.albedo = truth_.albedo;  // for want of its own
  const metrics::FalseEdges wanted = metrics::false_edges(truth_, test_);
  EXPECT_GT(wanted.edges, 30u);
  const json::Value edges = run_json(command({"--edges"}))["edges"];
  EXPECT_EQ(edges["share"], wanted.share);
  EXPECT_EQ(edges["pixels"], wanted.edges);
  EXPECT_EQ(edges["tested"], wanted.tested);
  EXPECT_EQ(edges["tested_share"], static_cast<double>(wanted.tested) / (width * height));
  EXPECT_EQ(edges["least_step"], wanted.least_step);
  EXPECT_FALSE(run_json(command({})).contains("edges"));
  EXPECT_THAT(run_tool(command({"--edges"})).out,
              HasSubstr(fmt::format(
                  "\nedges      {:.3g} % of the pixels tested lie on a false edge: {} of {}; {:.3g} % "
                  "could be tested, for steps of 3 %",
                  100 * wanted.share, wanted.edges, wanted.tested,
                  100 * static_cast<double>(wanted.tested) / (width * height))));
}

TEST_F(CompareEdges, OfTheTestsOwnAlbedoAndOutsideOfAMaskAreLeftOut) {
  // A test that says that its right half is whiter has even irradiance.
  Image albedo = truth_.albedo, mask(width, height);
  for (int y = 0; y < height; ++y) {
    for (int x = 0; x < width; ++x) {
      if (x > 30) albedo.set_rgb(x, y, vec3(0.55f));
      mask.set_rgb(x, y, vec3(x > 34 ? 1.0f : 0.0f));
    }
  }
  image::write_image(dir_ / "test.albedo.exr", albedo);
  EXPECT_EQ(run_json(command({"--edges"}))["edges"]["pixels"], 0);
  std::filesystem::remove(dir_ / "test.albedo.exr");
  image::write_image(dir_ / "mask.exr", mask);
  const json::Value masked = run_json(command({"--edges", "--mask", dir_ / "mask.exr"}))["edges"];
  EXPECT_EQ(masked["pixels"], 0);
  EXPECT_LT(masked["tested"].number(), 30 * height);
}

TEST_F(CompareEdges, AMapShowsThemOrHoldsTheirSteps) {
  const json::Value map = run_json(command({"--map", "edges", "-o", dir_ / "map.exr"}));
  EXPECT_TRUE(map.contains("edges")) << "a map asks for them";
  EXPECT_EQ(map["map"]["kind"], "edges");
  const Image steps = image::read_image(dir_ / "map.exr");
  EXPECT_NEAR(*steps.at(30, 20), std::log(0.55f / 0.5f), 0.01f);
  EXPECT_EQ(*steps.at(10, 20), 0);
  EXPECT_NEAR(run_json(command({"--map", "edges", "-o", dir_ / "map.png"}))["map"]["scale"].number(), 0.2,
              1e-6);
  const Image shown = image::read_image(dir_ / "map.png");
  EXPECT_GT(shown.rgb(30, 20).x, 2 * shown.rgb(30, 20).z) << "red to yellow";
  EXPECT_EQ(shown.rgb(10, 20).x, shown.rgb(10, 20).z) << "grey";
}

TEST_F(CompareEdges, NameThePictureThatIsMissing) {
  std::filesystem::remove(dir_ / "ref.normal.exr");
  const ToolResult result = run_tool(command({"--edges"}));
  EXPECT_EQ(result.exit_code, 1);
  EXPECT_THAT(result.err, testing::AllOf(HasSubstr("ref.normal.exr: is not there"),
                                         HasSubstr("--aov indirect,albedo,normal,depth")));
}

}  // namespace
}  // namespace ssphh
