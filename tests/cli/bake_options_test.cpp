// Options of `bake` as the file shows them.

#include <fstream>

#include <fmt/format.h>

#include <ssphh/core/file.h>
#include <ssphh/place/place.h>
#include <ssphh/probes/probe_file.h>
#include <ssphh/scene/builtin.h>

#include "here.h"
#include "temp_dir.h"

namespace ssphh {
namespace {

using test::joined;
using test::json_here;
using testing::HasSubstr;

/// A bake of as little as can be.
const json::Value small_bake(const std::string& output, const std::vector<std::string>& more) {
  return json_here(joined(
      {"bake", "builtin:box", "-o", output, "--face", "1", "--spp", "1", "--degree", "0", "--records", "0"},
      more));
}

TEST(BakeOptions, ReachTheFile) {
  const test::TempDir dir;
  const std::string file = dir / "a.sphl";
  const json::Value bake = json_here({"bake",        "builtin:two-rooms",
                                      "-o",          file,
                                      "--face",      "3",
                                      "--spp",       "2",
                                      "--passes",    "4",
                                      "--max-depth", "2",
                                      "--seed",      "9",
                                      "--degree",    "2",
                                      "--time",      "0.5",
                                      "--viz",       "off",
                                      "--records",   "0"});
  const probes::ProbeSet set = probes::read_probe_file(file);
  EXPECT_EQ(set.degree, 2);
  EXPECT_EQ(bake["degree"], 2);
  const probes::GeneratorInfo& g = set.generator;
  EXPECT_EQ(g.face_size, 3);
  EXPECT_EQ(g.spp, 2);
  EXPECT_EQ(g.passes, 4);
  EXPECT_EQ(g.max_depth, 2);
  EXPECT_EQ(g.seed, 9u);
  EXPECT_EQ(g.time, 0.5f);
  EXPECT_EQ(g.gen, probes::GenMode::full);
  EXPECT_EQ(bake["output"], file);
  EXPECT_EQ(bake["probes"], set.probes.size());
  EXPECT_EQ(bake["light_groups"], set.light_groups.size());
  EXPECT_EQ(bake["edges"], 0);
  EXPECT_EQ(bake["gen"], "full");
  EXPECT_EQ(bake["viz"], "off");
  EXPECT_EQ(bake["resumed"], 0);
  EXPECT_TRUE(bake["warnings"].is_array());
  small_bake(file, {"--gen", "local", "--viz", "off"});
  EXPECT_EQ(probes::read_probe_file(file).generator.gen, probes::GenMode::local);
  // Four neighbours each, the strongest one kept; none is above 1.
  const json::Value few = small_bake(file, {"--neighbors", "1"});
  EXPECT_EQ(few["edges"], 5);
  EXPECT_EQ(small_bake(file, {"--threshold", "1"})["edges"], 0);
  EXPECT_EQ(small_bake(file, {"--viz-transfer"})["viz"], "path");
  EXPECT_FALSE(probes::read_probe_file(file).probes[0].edges[0].matrix.values.empty());
}

TEST(BakeOptions, VizIsLeftOutForManyProbes) {
  const test::TempDir dir;
  const auto overlay = [&](int count) {
    json::Value sphls = json::Value::array();
    for (int i = 0; i < count; ++i) {
      const double x = -0.4 + 0.1 * (i % 8), y = -0.4 + 0.1 * (i / 8 % 8), z = -0.4 + 0.1 * (i / 64);
      sphls.push_back({{"name", "p" + std::to_string(i)}, {"position", {x, y, z}}, {"radius", 0.01}});
    }
    const std::string file = dir / ("o" + std::to_string(count) + ".json");
    std::ofstream(file) << print(json::Value{{"sphls", sphls}});
    return file;
  };
  const auto viz = [&](int count, const std::vector<std::string>& more = {}) {
    const int own = 5;  // of builtin:box
    const json::Value bake = small_bake(dir / "a.sphl", joined({"--overlay", overlay(count - own)}, more));
    EXPECT_EQ(bake["probes"], count);
    return bake["viz"];
  };
  const std::vector<std::string> quick = {"--directions", "8", "--link-rays", "4", "--surfel-size", "0.5"};
  EXPECT_EQ(viz(65, quick), "links");
  EXPECT_EQ(viz(513), "off");
}

}  // namespace
}  // namespace ssphh
