// Bakes that are blended, and played as keys.

#include <gmock/gmock.h>

#include <ssphh/image/io.h>
#include <ssphh/probes/probe_file.h>

#include "here.h"
#include "options/command_line.h"
#include "temp_dir.h"

namespace ssphh {
namespace {

using test::json_here;
using test::problem_here;
using test::run_here;
using testing::HasSubstr;

class KeyedProbes : public testing::Test {
 protected:
  /// Two bakes of two-rooms, its door shut and open.
  KeyedProbes() {
    bake("0", shut);
    bake("1", open);
  }
  void bake(const std::string& time, const std::string& file) const {
    run_here({"bake", "builtin:two-rooms", "--time", time, "--operator", "surfel", "--probes", "6",
              "--degree", "2", "--directions", "64", "--surfel-size", "0.5", "--viz", "off", "-o", file});
  }

  const test::TempDir dir;
  const std::string shut = dir / "shut.sphl", open = dir / "open.sphl", half = dir / "half.sphl";
};

TEST_F(KeyedProbes, AreBlendedAndPlayed) {
  const json::Value blended = json_here({"probe", "blend", shut, open, "--t", "0.25", "-o", half});
  EXPECT_EQ(blended["time"], 0.25);
  const probes::ProbeSet a = probes::read_probe_file(shut), b = probes::read_probe_file(open),
                         c = probes::read_probe_file(half);
  const vec3 expected = 0.75f * a.probes[0].reflected[0] + 0.25f * b.probes[0].reflected[0];
  EXPECT_LT(glm::distance(c.probes[0].reflected[0], expected), 1e-4f * luminance(expected));

  const auto render = [&](const std::string& probes, const std::string& output) {
    run_here({"render", "builtin:two-rooms", "--time", "0.25", "--probes", probes, "--method", "ssphh",
              "--width", "16", "--height", "9", "--spp", "4", "-o", output});
    return image::read_image(output);
  };
  const image::Image by_file = render(half, dir / "file.exr"),
                     by_keys = render(shut + "," + open, dir / "keys.exr");
  for (std::size_t i = 0; i < by_file.pixels.size(); ++i)
    EXPECT_NEAR(by_file.pixels[i], by_keys.pixels[i], 1e-3f * by_file.pixels[i] + 1e-5f);
}

TEST_F(KeyedProbes, OfOtherPlacesAreRefused) {
  run_here({"bake", "builtin:two-rooms", "--operator", "surfel", "--probes", "7", "--degree", "2",
            "--directions", "64", "--surfel-size", "0.5", "--viz", "off", "-o", half});
  EXPECT_THAT(problem_here({"probe", "blend", shut, half, "-o", dir / "x.sphl"}),
              testing::AllOf(HasSubstr("shut.sphl"), HasSubstr("half.sphl"), HasSubstr("cannot be blended")));
  EXPECT_FALSE(std::filesystem::exists(dir / "x.sphl"));
  const auto refused = [&](const std::string& probes) {
    return problem_here(
        {"render", "builtin:two-rooms", "--method", "ssphh", "--probes", probes, "-o", dir / "x.exr"});
  };
  EXPECT_THAT(refused(shut + "@1," + open), HasSubstr("is a key at 1 s, as another is"));
  EXPECT_THAT(refused(shut + "," + half + "@1"), HasSubstr("cannot be blended"));
  EXPECT_THROW(refused(shut + "@soon," + open), app::ParsingEnded);
}

TEST(KeyedRelight, KeysAreSavedWithTheirRecordsAndPlayed) {
  const test::TempDir dir;
  run_here({"relight", "builtin:two-rooms", "--probes", "6", "--degree", "2", "--directions", "64",
            "--surfel-size", "0.5", "--frames", "3", "--points", "16", "--key-frames", "3", "--save",
            dir / "door.sphl"});
  const std::string shut = dir / "door-0.sphl", open = dir / "door-2.sphl", half = dir / "half.sphl";
  const json::Value blended = json_here({"probe", "blend", shut, open, "-o", half});
  EXPECT_GT(blended["records"].number(), 0);
  EXPECT_EQ(blended["left_out"].size(), 0U);
  EXPECT_EQ(probes::read_probe_file(half).generator.time,
            probes::read_probe_file(dir / "door-1.sphl").generator.time);
  run_here({"render", "builtin:two-rooms", "--time", "0.25", "--probes", shut + "," + open, "--method",
            "ssphh", "--weights", "surface", "--width", "8", "--height", "6", "--spp", "1", "-o",
            dir / "x.exr"});
}

TEST(KeyedRelight, MoreKeysAreNearerToExactPosing) {
  const auto error = [](const char* keys) {
    const json::Value run = json_here({"relight", "builtin:two-rooms", "--probes", "6", "--degree", "2",
                                       "--directions", "64", "--surfel-size", "0.8", "--link-rays", "16",
                                       "--frames", "5", "--points", "128", "--key-frames", keys});
    EXPECT_EQ(run["keyed"]["frames"].size(), 5U);
    EXPECT_LT(run["keyed"]["frames"][0]["mean_error"].number(), 1e-3) << "a key is exact";
    EXPECT_LT(run["keyed"]["frames"][4]["mean_error"].number(), 1e-3);
    return run["keyed"]["mean_error"].number();
  };
  const double two = error("2"), three = error("3"), five = error("5");
  EXPECT_GT(two, 2 * three) << "a quarter where light is smooth";
  EXPECT_LT(five, 1e-3);
  EXPECT_THAT(problem_here({"relight", "builtin:two-rooms", "--probes", "6", "--key-frames", "1"}),
              HasSubstr("one key is no motion"));
}

}  // namespace
}  // namespace ssphh
