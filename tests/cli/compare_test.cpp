// What `ssphh compare` counts, and when it fails.

#include <limits>
#include <utility>

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <ssphh/image/io.h>

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
    std::vector<std::string> arguments = {"compare", dir_ / "ref.exr", dir_ / "test.exr"};
    arguments.insert(arguments.end(), more.begin(), more.end());
    return arguments;
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

}  // namespace
}  // namespace ssphh
