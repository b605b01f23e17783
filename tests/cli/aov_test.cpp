// Extra images beside a picture: that they are means over all passes, and add up to it.

#include <fmt/format.h>
#include <gtest/gtest.h>

#include <ssphh/core/file.h>
#include <ssphh/image/io.h>

#include "joined.h"
#include "temp_dir.h"
#include "tool_checks.h"

namespace ssphh {
namespace {

using image::Image;
using test::run_json;
using test::TempDir;

/// A scene with several light groups, in three passes.
std::vector<std::string> picture(const std::string& output, const std::vector<std::string>& more) {
  return test::joined({"render", "builtin:gallery1", "-o", output, "--width", "24", "--height", "16", "--spp",
                       "2", "--passes", "3", "--aov", "direct,indirect,groups"},
                      more);
}

/// Sum of the pictures of all groups.
Image sum_of_groups(const TempDir& dir, const std::string& stem) {
  Image sum;
  int groups = 0;
  for (const auto& entry : std::filesystem::directory_iterator(dir.path())) {
    if (!entry.path().filename().string().starts_with(stem + ".group.")) continue;
    const Image group = image::read_image(entry.path());
    if (groups++ == 0) sum = Image(group.width, group.height);
    for (std::size_t i = 0; i < sum.pixels.size(); ++i) sum.pixels[i] += group.pixels[i];
  }
  EXPECT_GT(groups, 1);
  return sum;
}

/// Each is a mean of three passes: sums in another order differ by a few roundings.
void expect_sum(const Image& a, const Image& b, const Image& whole) {
  ASSERT_EQ(a.pixels.size(), whole.pixels.size());
  ASSERT_EQ(b.pixels.size(), whole.pixels.size());
  for (std::size_t i = 0; i < whole.pixels.size(); ++i)
    ASSERT_NEAR(a.pixels[i] + b.pixels[i], whole.pixels[i], 2e-6f * whole.pixels[i] + 1e-9f) << "float " << i;
}

float brightest(const Image& image) {
  return *std::max_element(image.pixels.begin(), image.pixels.end());
}

TEST(Aovs, OfPathTracingAddUpToThePicture) {
  const TempDir dir;
  run_json(picture(dir / "path.exr", {}));
  const Image whole = image::read_image(dir / "path.exr");
  expect_sum(image::read_image(dir / "path.direct.exr"), image::read_image(dir / "path.indirect.exr"), whole);
  expect_sum(sum_of_groups(dir, "path"), Image(whole.width, whole.height), whole);
}

TEST(Aovs, GroupsWithProbesHoldTheDirectLightAlone) {
  const TempDir dir;
  const std::string probes = dir / "probes.sphl";
  run_json({"bake", "builtin:gallery1", "-o", probes, "--degree", "2", "--face", "4", "--spp", "1", "--viz",
            "off", "--records", "0"});
  run_json(picture(dir / "lit.exr", {"--method", "ssphh", "--probes", probes}));
  const Image groups = sum_of_groups(dir, "lit"), direct = image::read_image(dir / "lit.direct.exr"),
              indirect = image::read_image(dir / "lit.indirect.exr");
  EXPECT_GT(brightest(indirect), 0);
  expect_sum(groups, Image(groups.width, groups.height), direct);
  expect_sum(groups, indirect, image::read_image(dir / "lit.exr"));
}

TEST(Aovs, OfGroupsWhoseNamesAreNoFileNamesAreFilesOfTheirOwn) {
  const TempDir dir;
  write_file(dir / "lamps.mtl",
             "newmtl desk lamp\nKe 1 0 0\nnewmtl desk_lamp\nKe 0 2 0\nnewmtl ../wall\nKe 0 0 4\n");
  write_file(dir / "lamps.obj",
             "mtllib lamps.mtl\nv -4 -1 0\nv -2 -1 0\nv -3 1 0\nv -1 -1 0\nv 1 -1 0\nv 0 1 0\n"
             "v 2 -1 0\nv 4 -1 0\nv 3 1 0\n"
             "usemtl desk lamp\nf 1 2 3\nusemtl desk_lamp\nf 4 5 6\nusemtl ../wall\nf 7 8 9\n");
  run_json({"render", dir / "lamps.obj", "-o", dir / "out.exr", "--width", "8", "--height", "8", "--spp", "1",
            "--aov", "groups"});
  int channel = 0;  // each lamp is of another one
  for (const char* part : {"desk_lamp", "desk_lamp_2", "___wall"}) {
    const Image group = image::read_image(dir / fmt::format("out.group.{}.exr", part));
    vec3 sum(0);
    for (int y = 0; y < group.height; ++y)
      for (int x = 0; x < group.width; ++x) sum += group.rgb(x, y);
    for (int c = 0; c < 3; ++c) EXPECT_EQ(sum[c] > 0, c == channel) << part << ", channel " << c;
    ++channel;
  }
}

TEST(Aovs, OfGroupsAloneAreThoseOfAll) {
  const TempDir dir;
  std::vector<std::string> arguments = picture(dir / "all.exr", {});
  run_json(arguments);
  arguments[3] = dir / "alone.exr";
  arguments.back() = "groups";
  run_json(arguments);
  const Image all = sum_of_groups(dir, "all"), alone = sum_of_groups(dir, "alone");
  EXPECT_EQ(alone.pixels, all.pixels);
  EXPECT_FALSE(std::filesystem::exists(dir / "alone.direct.exr"));
}

}  // namespace
}  // namespace ssphh
