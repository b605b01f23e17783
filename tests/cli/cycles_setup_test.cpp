// What `truth --renderer cycles` asks of the machine: a Blender on PATH, and that Blender's own Python. A
// script stands in for Blender here.

#include <cmath>
#include <cstdlib>
#include <fstream>

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <ssphh/core/file.h>
#include <ssphh/image/io.h>

#include "stand_in_programs.h"
#include "temp_dir.h"
#include "tool_checks.h"

namespace ssphh {
namespace {

using test::Path;
using test::TempDir;
using test::write_script;
using testing::HasSubstr;

/// A Blender that needs the numpy of the first python3 on PATH, as a distribution's does, and "renders" by
/// copying the picture of its seed. It notes how it was called.
void install_blender(const std::filesystem::path& folder) {
  write_script(folder / "python3", "exit 0\n");
  write_script(folder / "blender", R"(here=$(dirname "$0")
echo "$@" >> "$here/calls"
python3 -c 'import numpy' || { echo "the python3 of a version manager" >&2; exit 1; }
while [ "$1" != -- ]; do shift; done
while [ $# -gt 1 ]; do
  case $1 in
    --output) output=$2 ;;
    --seed) seed=$2 ;;
  esac
  shift
done
cp "$here/seed$seed.exr" "$output"
)");
}

image::Image plain_picture(const vec3& color) {
  image::Image picture(4, 2);
  for (int y = 0; y < 2; ++y) {
    for (int x = 0; x < 4; ++x) picture.set_rgb(x, y, color);
  }
  return picture;
}

TEST(Cycles, BlenderGetsThePythonBesideItWhateverComesFirstOnPath) {
  const TempDir dir;
  write_script(dir / "shims/python3", "exit 1\n");
  install_blender(dir / "bin");
  image::write_image(dir / "bin/seed14.exr", plain_picture({1, 2, 3}));
  image::write_image(dir / "bin/seed15.exr", plain_picture({3, 6, 5}));
  const Path path((dir / "shims").string() + ":" + (dir / "bin").string() + ":/usr/bin:/bin");

  const json::Value truth = test::run_json({"truth", "builtin:box", "--renderer", "cycles", "--width", "4",
                                            "--height", "2", "--spp", "48", "--seed", "7", "--threads", "3",
                                            "--projection", "equirect", "-o", dir / "truth.exr"});
  // Two halves with a seed each, of half of the samples; the result is their mean.
  const std::string calls = read_text_file(dir / "bin/calls");
  for (const char* half : {"a.exr --seed 14 --spp 24 --projection equirect --threads 3\n",
                           "b.exr --seed 15 --spp 24 --projection equirect --threads 3\n"})
    EXPECT_THAT(calls, HasSubstr(half));
  EXPECT_THAT(calls, HasSubstr("--background --factory-startup --python " +
                               (dir / "truth.exr.cycles/render.py").string() + " -- --output "));
  const image::Image picture = image::read_image(dir / "truth.exr");
  EXPECT_EQ(picture.rgb(3, 1), vec3(2, 4, 4));
  EXPECT_EQ(truth["mean"], json::Value({2, 4, 4}));
  // Half of the halves' difference, (1, 2, 1), over the root of the number of pixels.
  for (std::size_t c = 0; c < 3; ++c)
    EXPECT_NEAR(truth["standard_error"][c].number(), (c == 1 ? 2 : 1) / std::sqrt(8.0), 1e-12);
}

// Blender takes relative paths from $PWD, which is another folder where a script changed its own without
// telling.
TEST(Cycles, BlenderGetsWholePaths) {
  const TempDir dir;
  install_blender(dir / "bin");
  for (const char* seed : {"bin/seed0.exr", "bin/seed1.exr"})
    image::write_image(dir / seed, plain_picture({1, 2, 3}));
  const Path path((dir / "bin").string() + ":/usr/bin:/bin");
  const std::filesystem::path out = std::filesystem::relative(dir / "truth.exr");
  ASSERT_TRUE(out.is_relative());
  test::run_json({"truth", "builtin:box", "--renderer", "cycles", "--width", "4", "--height", "2", "--spp",
                  "2", "--projection", "equirect", "-o", out});
  const std::string calls = read_text_file(dir / "bin/calls");
  EXPECT_THAT(calls, HasSubstr("--python /"));
  EXPECT_THAT(calls, HasSubstr("--output /"));
}

TEST(Cycles, WithoutBlenderSaysWhereItLookedAndWhatToInstall) {
  const TempDir dir;
  write_file(dir / "blender", "no program");  // not executable
  const std::string folders = dir.path().string() + ":/nonexistent";
  const Path path(folders);
  test::expect_failure({"truth", "builtin:box", "--renderer", "cycles", "-o", dir / "x.exr"},
                       {"no `blender`", folders, "install-deps --with-blender"});
}

TEST(Cycles, WhenBlenderFailsItsLastWordsAreShown) {
  const TempDir dir;
  write_script(dir / "bin/blender", "echo 'numpy is missing' >&2\nexit 1\n");
  const Path path((dir / "bin").string() + ":/usr/bin:/bin");
  test::expect_failure({"truth", "builtin:box", "--renderer", "cycles", "-o", dir / "x.exr"},
                       {"blender: exited with 1", "blender.log", "numpy is missing"});
}

// The exported program run by hand, by a Python that has Blender's modules but no numpy.
TEST(Cycles, TheExportedProgramNamesWhatIsMissingAndWhereItLooked) {
  const Path path("/usr/bin:/bin:" + std::string(std::getenv("PATH")));  // shims of version managers are slow
  if (std::system("command -v python3 > /dev/null") != 0) GTEST_SKIP() << "no python3";
  const TempDir dir;
  test::run_json({"export", "builtin:box", "--to", "cycles", "-o", dir / "box"});
  write_file(dir / "box/bpy.py", "");
  write_file(dir / "box/mathutils.py", "Matrix = None\n");
  write_file(dir / "box/numpy.py", "raise ImportError(\"No module named 'numpy'\")\n");
  const std::string program = "python3 " + (dir / "box/render.py").string() + " 2> " + (dir / "err").string();
  EXPECT_NE(std::system(program.c_str()), 0);
  const std::string error = read_text_file(dir / "err");
  EXPECT_THAT(error, HasSubstr("No module named 'numpy'"));
  EXPECT_THAT(error, testing::ContainsRegex("Blender's Python is 3\\.[0-9]+.*, /.*; it looked in"));
  EXPECT_THAT(error, HasSubstr("\n  " + (dir / "box").string() + "\n"));
  EXPECT_THAT(error, HasSubstr("PATH=/usr/bin:$PATH blender"));
}

}  // namespace
}  // namespace ssphh
