/// Commands build the acceleration structures of their scene once, whatever they ask of them.

#include "here.h"
#include "temp_dir.h"

namespace ssphh::test {
namespace {

const std::vector<std::string> few = {"--degree", "2", "--surfel-size", "0.5", "--directions", "64"};

int builds(const std::vector<std::string>& command) {
  return static_cast<int>(json_here(command)["geometry_builds"].number());
}

TEST(GeometryBuilds, ABakeBuildsOnce) {
  const TempDir dir;
  const std::string out = (dir.path() / "p.sphl").string();
  const std::vector<std::string> bake = {
      "bake", "builtin:box", "-o",    out,     "--degree", "2", "--face",        "4",  "--spp",
      "1",    "--fit",       "--viz", "links", "--probes", "8", "--surfel-size", "0.5"};
  EXPECT_EQ(builds(bake), 1) << "places, paths and the fit";
  EXPECT_EQ(builds(joined({"bake", "builtin:box", "-o", out, "--operator", "surfel", "--viz", "off"}, few)),
            1);
}

TEST(GeometryBuilds, ARelightingBuildsOnceForAllFrames) {
  const TempDir dir;
  const std::vector<std::string> relight = {
      "relight", "builtin:two-rooms", "--frames", "3",         "--truth",  "1",        "--points",
      "8",       "--truth-spp",       "2",        "--animate", "time=0:1", "--probes", "6",
      "-o",      dir.path().string(), "--width",  "8",         "--height", "6",        "--spp",
      "1"};
  EXPECT_EQ(builds(joined(relight, few)), 1);
}

TEST(GeometryBuilds, OfWhatMeasuresAndDraws) {
  const TempDir dir;
  const std::string probes = (dir.path() / "p.sphl").string(), picture = (dir.path() / "x.exr").string();
  run_here(joined({"bake", "builtin:box", "-o", probes, "--operator", "surfel", "--viz", "off"}, few));
  EXPECT_EQ(builds({"measure", "builtin:box", "--probes", probes, "--method", "ambient", "--method",
                    "ambient", "--points", "8", "--truth-spp", "2"}),
            1);
  EXPECT_EQ(builds({"leak", "builtin:box", "--probes", probes, "--points", "8", "--truth-spp", "2"}), 1);
  for (const char* method : {"path", "ambient"})
    EXPECT_EQ(builds({"render", "builtin:box", "-o", picture, "--method", method, "--width", "4", "--height",
                      "4", "--spp", "1"}),
              1)
        << method;
}

}  // namespace
}  // namespace ssphh::test
