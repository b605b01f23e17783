// `ssphh sh` and `ssphh cubemap`: what they print and write is what the library gives.

#include <cmath>
#include <fstream>
#include <limits>

#include <fmt/format.h>

#include <ssphh/core/file.h>
#include <ssphh/core/sphere.h>
#include <ssphh/image/cube_layout.h>
#include <ssphh/image/io.h>
#include <ssphh/sh/convert.h>
#include <ssphh/sh/evaluate.h>
#include <ssphh/sh/irradiance.h>
#include <ssphh/sh/project.h>
#include <ssphh/sh/reconstruct.h>
#include <ssphh/sh/rotate.h>
#include <ssphh/sh/window.h>

#include "commands/sh_file.h"
#include "error_message.h"
#include "here.h"
#include "options/command_line.h"
#include "temp_dir.h"

namespace ssphh {
namespace {

using test::joined;
using test::json_here;
using test::problem_here;
using test::run_here;
using test::text_here;
using testing::AllOf;
using testing::HasSubstr;
using testing::StartsWith;

/// Coefficients that all differ, also between channels.
sh::RadianceSh example_light(int degree = 3) {
  sh::RadianceSh light(degree);
  for (int k = 0; k < sh::coefficient_count(degree); ++k) {
    const auto x = static_cast<float>(k);
    light[k] = {1 / (x + 1), 0.5f - 0.1f * x, 0.25f * std::sin(x + 1)};
  }
  return light;
}

class ShTool : public testing::Test {
 protected:
  ShTool() { write(light_); }
  void write(const sh::RadianceSh& light) const {
    std::ofstream(file_) << print(app::sh_to_json(light.values, light.degree()));
  }
  std::vector<std::string> sh(const char* command, const std::vector<std::string>& more) const {
    return joined({"sh", command, file_}, more);
  }
  static void expect_values(const json::Value& object, std::span<const vec3> wanted) {
    ASSERT_EQ(object["coefficients"].size(), wanted.size());
    for (std::size_t k = 0; k < wanted.size(); ++k) {
      for (int c = 0; c < 3; ++c)
        EXPECT_EQ(test::float_of(object["coefficients"][k][c]), wanted[k][c]) << k << " " << c;
    }
  }

  const test::TempDir dir_;
  const std::string file_ = dir_ / "light.json";
  const sh::RadianceSh light_ = example_light();
};

TEST_F(ShTool, EvalGivesEveryBandOfTheUnitDirection) {
  const json::Value eval = json_here({"sh", "eval", "--direction", "1", "-2", "2", "--degree", "4"});
  std::vector<double> wanted(25);
  sh::eval_basis(4, glm::dvec3(vec3(1, -2, 2) / 3.0f), wanted);
  ASSERT_EQ(eval["values"].size(), 25u);
  for (std::size_t k = 0; k < 25; ++k) EXPECT_NEAR(eval["values"][k].number(), wanted[k], 1e-6) << k;
  EXPECT_EQ(json_here({"sh", "eval", "--direction", "0", "0", "1"})["values"].size(), 100u);
  EXPECT_EQ(text_here({"sh", "eval", "--direction", "0", "2", "0", "--degree", "1"}),
            "  0    0    0.28209479\n  1   -1    0.48860251\n  1    0    0.00000000\n  1    1    0.00000000");
  for (const char* bad : {"0", "nan", "inf"})
    EXPECT_THAT(problem_here({"sh", "eval", "--direction", "0", "0", bad}),
                HasSubstr("--direction: is not a direction"));
}

TEST_F(ShTool, IrradianceIsOnASurfaceWithTheNormal) {
  const vec3 wanted = sh::irradiance(light_, glm::normalize(vec3(3, 4, -12)));
  const json::Value found = json_here(sh("irradiance", {"--normal", "3", "4", "-12"}))["irradiance"];
  for (int c = 0; c < 3; ++c) EXPECT_NEAR(test::float_of(found[c]), wanted[c], 1e-6f) << c;
  EXPECT_EQ(text_here(sh("irradiance", {"--normal", "3", "4", "-12"})),
            fmt::format("{:.6g} {:.6g} {:.6g}", wanted.x, wanted.y, wanted.z));
}

image::Image strip(int channels) {
  image::Image picture(24, 4, channels);
  for (std::size_t i = 0; i < picture.pixels.size(); ++i)
    picture.pixels[i] = 1 + std::sin(static_cast<float>(i));
  return picture;
}

TEST_F(ShTool, ProjectIsThatOfTheFaces) {
  for (const int channels : {1, 3, 4}) {
    image::write_image(dir_ / "strip.exr", strip(channels));
    const image::Image read = image::read_image(dir_ / "strip.exr");
    image::Image rgb(24, 4, 3);
    for (int y = 0; y < 4; ++y)
      for (int x = 0; x < 24; ++x) rgb.set_rgb(x, y, read.rgb(x, y));
    const image::CubeMap cube = image::to_cube(rgb, image::Layout::strip_h);
    sh::CubeFaces faces;
    for (std::size_t f = 0; f < 6; ++f) faces[f] = cube.faces[f].pixels;
    const json::Value project = json_here(
        {"sh", "project", dir_ / "strip.exr", "--layout", "strip-h", "--degree", "2", "-o", dir_ / "c.json"});
    EXPECT_EQ(project["degree"], 2);
    expect_values(project, sh::project_cube(2, 4, faces).values);
    EXPECT_EQ(test::parse_json(read_text_file(dir_ / "c.json")), project);
  }
  image::Image bad = strip(3);
  bad.pixels[7] = NAN;
  image::write_image(dir_ / "bad.exr", bad);
  EXPECT_THAT(problem_here({"sh", "project", dir_ / "bad.exr", "--layout", "strip-h"}),
              HasSubstr("NaN or infinite"));
  EXPECT_THROW(run_here({"sh", "project", dir_ / "bad.exr", "--layout", "strip"}), app::ParsingEnded);
}

TEST_F(ShTool, ReconstructEvaluatesAtEveryTexel) {
  for (const bool irradiance : {false, true}) {
    std::vector<std::string> command =
        sh("reconstruct", {"-o", dir_ / "r.exr", "--layout", "strip-v", "--size", "5"});
    if (irradiance) command.emplace_back("--irradiance");
    const json::Value result = json_here(command);
    EXPECT_EQ(result["output"], (dir_ / "r.exr").string());
    EXPECT_EQ(result["width"], 5);
    EXPECT_EQ(result["height"], 30);
    const image::Image picture = image::read_image(dir_ / "r.exr");
    for (int f = 0; f < 6; ++f) {
      for (int y = 0; y < 5; ++y) {
        for (int x = 0; x < 5; ++x) {
          const vec3 d = texel_direction(f, x, y, 5);
          const vec3 wanted = irradiance ? sh::irradiance(light_, d) : sh::eval(light_, d);
          ASSERT_LT(glm::distance(picture.rgb(x, 5 * f + y), wanted), 1e-5f) << f << " " << x << " " << y;
        }
      }
    }
  }
  const json::Value equirect = json_here(sh("reconstruct", {"-o", dir_ / "e.exr", "--size", "32"}));
  EXPECT_EQ(equirect["width"], 64);
  EXPECT_EQ(equirect["height"], 32);
  // Over the poles by what a cube of half the height shows there, to its texels' size.
  const image::Image picture = image::read_image(dir_ / "e.exr");
  EXPECT_LT(glm::distance(picture.rgb(0, 0), sh::eval(light_, {0, 1, 0})), 0.2f);
  EXPECT_LT(glm::distance(picture.rgb(0, 31), sh::eval(light_, {0, -1, 0})), 0.2f);
}

TEST_F(ShTool, RotateTurnsByAxisAndAngleOrByAQuaternion) {
  const auto wanted = sh::Rotation::about_axis(3, {1, 2, -2}, glm::radians(30.0)).apply(light_);
  const double s = std::sin(glm::radians(15.0)) / 3, c = std::cos(glm::radians(15.0));
  const auto near = [&](const json::Value& object) {
    EXPECT_EQ(object["degree"], 3);
    for (std::size_t k = 0; k < 16; ++k)
      for (int i = 0; i < 3; ++i)
        EXPECT_NEAR(test::float_of(object["coefficients"][k][i]), wanted.values[k][i], 1e-5f);
  };
  near(json_here(sh("rotate", {"--axis", "2", "4", "-4", "--angle", "30"})));
  near(json_here(sh("rotate", {"--quaternion", std::to_string(2 * s), std::to_string(4 * s),
                               std::to_string(-4 * s), std::to_string(2 * c)})));
  EXPECT_THAT(problem_here(sh("rotate", {})), HasSubstr("no rotation given"));
  EXPECT_THAT(problem_here(sh("rotate", {"--quaternion", "0", "0", "0", "0"})),
              HasSubstr("is not a rotation"));
  EXPECT_THAT(problem_here(sh("rotate", {"--axis", "0", "0", "0", "--angle", "1"})),
              HasSubstr("--axis: is not a direction"));
  EXPECT_THAT(problem_here(sh("rotate", {"--axis", "0", "0", "1", "--angle", "inf"})), HasSubstr("--angle"));
}

TEST_F(ShTool, ConvertGoesToAConventionAndBack) {
  const json::Value unity = json_here(sh("convert", {"--to", "unity", "-o", dir_ / "u.json"}));
  EXPECT_EQ(unity["convention"], "unity");
  EXPECT_EQ(unity["degree"], 2) << "what it holds";
  expect_values(unity, sh::to_convention(light_, sh::Convention::unity));
  EXPECT_THAT(test::run_here(sh("convert", {"--to", "unity"})).err,
              HasSubstr("bands 3..3 are dropped, unity holds degree 2"));
  EXPECT_THAT(test::run_here(sh("convert", {"--to", "unreal"})).err, testing::Not(HasSubstr("dropped")));
  const json::Value back = json_here({"sh", "convert", dir_ / "u.json", "--from", "unity", "--to", "ssphh"});
  EXPECT_EQ(back["convention"], "ssphh");
  for (std::size_t k = 0; k < 9; ++k)
    EXPECT_NEAR(test::float_of(back["coefficients"][k][1]), light_.values[k].y, 1e-6f);
  EXPECT_THAT(problem_here({"sh", "convert", dir_ / "u.json", "--to", "three"}),
              AllOf(HasSubstr("convention: is \"unity\", not \"ssphh\""), HasSubstr("--from CONVENTION")));
  EXPECT_THAT(problem_here(sh("convert", {"--to", "maya"})),
              HasSubstr("--to: no convention is called \"maya\""));
  EXPECT_THAT(problem_here(sh("convert", {"--from", "maya", "--to", "three"})),
              HasSubstr("--from: no convention"));
}

TEST_F(ShTool, WindowDampsAsAskedFor) {
  expect_values(json_here(sh("window", {"--lanczos", "2.5"})),
                sh::apply_window(light_, sh::lanczos_window(2.5)).values);
  expect_values(json_here(sh("window", {"--hanning", "2.5"})),
                sh::apply_window(light_, sh::hanning_window(2.5)).values);
  for (const auto& [name, goal] :
       {std::pair{"irradiance", sh::NonNegative::irradiance}, {"radiance", sh::NonNegative::radiance}})
    expect_values(json_here(sh("window", {"--auto", "--goal", name})), sh::dering(light_, goal).values);
  expect_values(json_here(sh("window", {"--auto"})), sh::dering(light_).values);
  EXPECT_NE(sh::dering(light_).values, sh::dering(light_, sh::NonNegative::radiance).values);
  for (const char* option : {"--lanczos", "--hanning"})
    for (const char* width : {"0", "-1", "nan"})
      EXPECT_THAT(problem_here(sh("window", {std::string(option) + "=" + width})),
                  StartsWith(std::string(option) + ": must be a width above 0 bands"));
  EXPECT_THAT(problem_here(sh("window", {})), HasSubstr("no window chosen"));
  sh::RadianceSh dark = light_;
  dark[0] = vec3(-1);
  write(dark);
  EXPECT_THAT(test::run_here(sh("window", {"--auto"})).err,
              HasSubstr("the mean is negative; no window can make irradiance positive"));
}

TEST_F(ShTool, TablesNameBandsAndOrders) {
  const std::vector<vec3> values = {{1, 2, 3}, {0.5f, 0, -1}, {1e-7f, 4, 5}, {6, 7, 1234567}};
  EXPECT_EQ(app::sh_text(app::sh_to_json(values, 1)),
            "degree 1\n"
            "  0    0              1             2             3\n"
            "  1   -1            0.5             0            -1\n"
            "  1    0          1e-07             4             5\n"
            "  1    1              6             7   1.23457e+06");
  EXPECT_EQ(print(app::rgb_to_json({0.1f, 1, -2.5f})), "[0.1,1,-2.5]") << "the shortest that reads back";
}

TEST_F(ShTool, FilesThatAreNoCoefficientsAreToldWhy) {
  const auto problem = [&](const std::string& text) {
    std::ofstream(file_) << text;
    return test::message_of([&] { app::read_radiance_sh(file_); });
  };
  for (const char* other : {"[]", R"({"degree": 1})", R"({"coefficients": []})"})
    EXPECT_THAT(problem(other),
                AllOf(HasSubstr("holds no coefficients"), HasSubstr("expected {\"degree\": N")));
  EXPECT_THAT(problem(std::string(9, '[')), HasSubstr("nested deeper than 8 levels"));
  EXPECT_THAT(problem(R"({"degree": 1.5, "coefficients": []})"),
              HasSubstr("degree: 1.5 must be an integer from 0 to 10"));
  EXPECT_THAT(problem(R"({"degree": 11, "coefficients": []})"), HasSubstr("degree: 11 must be an integer"));
  EXPECT_THAT(problem(R"({"degree": -1, "coefficients": []})"), HasSubstr("degree: -1 must be an integer"));
  EXPECT_THAT(problem(R"({"degree": 1, "coefficients": [[1, 2, 3]]})"),
              HasSubstr("coefficients: must have 4 elements, not 1"));
  EXPECT_THAT(problem(R"({"degree": 0, "coefficients": [[1, 2]]})"),
              HasSubstr("coefficients[0]: must have 3 elements, not 2"));
  EXPECT_THAT(problem(R"({"degree": 0, "coefficients": [[1, 2, "3"]]})"),
              HasSubstr("coefficients[0][2]: must be a number, not string"));
  EXPECT_THAT(problem(R"({"degree": 0, "coefficients": [[1, 2, 1e39]]})"), HasSubstr("coefficients[0][2]"));
  EXPECT_EQ(problem(R"({"degree": 0, "coefficients": [[1, 2, 3]], "deep": [[[[[[1]]]]]]})"), "no error");
  EXPECT_THAT(problem(R"({"degree": 0, "coefficients": [[1, 2, 3]], "deep": [[[[[[[[[1]]]]]]]]]})"),
              HasSubstr("nested deeper than 8 levels"));
  const std::string light = R"({"degree": 0, "coefficients": [[1, 2, 3]]})";
  EXPECT_EQ(problem(light + std::string((16u << 20) - light.size(), ' ')), "no error");
  EXPECT_NE(problem(light + std::string((16u << 20) - light.size() + 1, ' ')), "no error");
}

TEST_F(ShTool, CubemapConvertRearrangesAndResamples) {
  image::write_image(dir_ / "strip.exr", strip(3));
  const image::Image input = image::read_image(dir_ / "strip.exr");
  const auto convert = [&](const char* to, const std::vector<std::string>& more) {
    return json_here(joined(
        {"cubemap", "convert", dir_ / "strip.exr", "-o", dir_ / "out.exr", "--from", "strip-h", "--to", to},
        more));
  };
  EXPECT_EQ(convert("cross-v", {}), json::Value({{"output", (dir_ / "out.exr").string()},
                                                 {"from", "strip-h"},
                                                 {"to", "cross-v"},
                                                 {"width", 12},
                                                 {"height", 16}}));
  EXPECT_EQ(image::read_image(dir_ / "out.exr").pixels,
            image::convert_layout(input, image::Layout::strip_h, image::Layout::cross_v).pixels);
  convert("equirect", {"--size", "6"});
  EXPECT_EQ(image::read_image(dir_ / "out.exr").pixels,
            image::convert_layout(input, image::Layout::strip_h, image::Layout::equirect, 6).pixels);
  EXPECT_THAT(problem_here({"cubemap", "convert", dir_ / "strip.exr", "-o", dir_ / "x.exr", "--from",
                            "cross-h", "--to", "strip-h"}),
              StartsWith((dir_ / "strip.exr").string() + ": "));
  EXPECT_THAT(
      problem_here({"cubemap", "convert", "none.exr", "-o", "x.txt", "--from", "cross-h", "--to", "strip-h"}),
      HasSubstr("x.txt"));
}

TEST(ShFile, CoefficientsBeyondAFloatAreTold) {
  for (const float bad : {std::numeric_limits<float>::infinity(), std::nanf("")})
    EXPECT_EQ(test::message_of([&] {
                app::rgb_to_json({1, bad, 0});
              }),
              "coefficients: one is beyond what a float holds, 3.4e38 (scale them down first)");
}

}  // namespace
}  // namespace ssphh
