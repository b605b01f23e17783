// Progress of the commands: the stages they tell of, each ended with what it said it would do.

#include <fstream>

#include "gl_context.h"
#include "here.h"
#include "progress_recorder.h"
#include "temp_dir.h"

namespace ssphh {
namespace {

using testing::ElementsAre;

std::vector<std::string> stages(const std::vector<std::string>& arguments) {
  test::ProgressRecorder progress;
  test::run_here(arguments, {&progress, nullptr});
  return progress.finished();
}

TEST(Stages, OfBakesAndPictures) {
  const test::TempDir dir;
  const std::string file = dir / "a.sphl", out = dir / "a.exr";
  // Five probes, six faces of 2×2 texels
  EXPECT_THAT(stages({"bake", "builtin:box", "-o", file, "--face", "2", "--spp", "3", "--degree", "1",
                      "--records", "0"}),
              ElementsAre("GEN: 120 texels", "VIZ: 120 texels", "trials: 5 probes"));
  const std::vector<std::string> render = {"builtin:box", "-o", out,     "--width", "4",
                                           "--height",    "3",  "--spp", "2"};
  EXPECT_THAT(stages(test::joined(test::joined({"render"}, render), {"--passes", "3"})),
              ElementsAre("render: 72 paths"));
  EXPECT_THAT(stages(test::joined({"truth"}, render)), ElementsAre("render: 12 paths", "render: 12 paths"));
}

TEST(Stages, OfWhatMoves) {
  const test::TempDir dir;
  const std::vector<std::string> done = stages({"relight",
                                                "builtin:two-rooms",
                                                "--frames",
                                                "3",
                                                "--truth",
                                                "2",
                                                "--points",
                                                "4",
                                                "--truth-spp",
                                                "2",
                                                "-o",
                                                dir / "f",
                                                "--pictures",
                                                "3",
                                                "--width",
                                                "4",
                                                "--height",
                                                "3",
                                                "--spp",
                                                "1",
                                                "--surfel-size",
                                                "0.5",
                                                "--link-rays",
                                                "8",
                                                "--poses",
                                                "3",
                                                "--directions",
                                                "64"});
  ASSERT_GE(done.size(), 10u);
  EXPECT_EQ(done[0], "probe G-buffers: 6 probes");
  EXPECT_EQ(done[5], "poses: 3 poses");
  // Where more are needed, and where the other poses need them
  EXPECT_THAT(std::vector(done.begin() + 6, done.end() - 2),
              testing::Each(testing::StartsWith("gathering at surfaces: ")));
  EXPECT_EQ(done.end()[-2], "relighting: 3 frames");
  EXPECT_EQ(done.back(), "path tracing the truth: 2 frames");
  EXPECT_THAT(
      stages({"respond", "builtin:two-rooms", "--method", "direct", "--frames", "3", "--points", "4",
              "--truth-spp", "2", "--event", "lamp.scale=0:1"}),
      ElementsAre("surface points: 4 points", "irradiance: 8 paths", testing::_, "responding: 3 frames"));
}

using StagesOfGl = test::WithGl;

TEST_F(StagesOfGl, AreTheirFrames) {
  const test::TempDir dir;
  const std::vector<std::string> tiny = {"builtin:box", "--width", "8", "--height", "6", "--frames", "2"};
  EXPECT_THAT(stages(test::joined({"bench-frame"}, test::joined(tiny, {"--warm-up", "1"}))),
              ElementsAre("frames: 3 frames"));
  EXPECT_THAT(stages(test::joined({"turntable"}, test::joined(tiny, {"-o", dir / "turn"}))),
              ElementsAre("turntable: 2 frames"));
}

}  // namespace
}  // namespace ssphh
