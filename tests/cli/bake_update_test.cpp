// `bake --update`: what has changed since, what is baked again, and what is refused.

#include <fstream>

#include <ssphh/core/file.h>
#include <ssphh/probes/probe_file.h>
#include <ssphh/scene/builtin.h>

#include "here.h"
#include "temp_dir.h"

namespace ssphh {
namespace {

using test::joined;
using test::json_here;
using test::problem_here;
using testing::AllOf;
using testing::HasSubstr;

class BakeUpdate : public testing::Test {
 protected:
  /// An overlay of builtin:cornell.
  std::string overlay(const std::string& name, const std::string& members) const {
    const std::string file = dir_ / (name + ".ssphh.json");
    std::ofstream(file) << R"({"scene": "builtin:cornell")" << (members.empty() ? "" : ", ") << members
                        << "}";
    return file;
  }
  const json::Value baked(const std::string& scene, const std::string& output,
                          const std::vector<std::string>& more = {}) const {
    return json_here(
        joined({"bake", scene, "-o", output, "--face", "8", "--degree", "3", "--records", "0"}, more));
  }
  const json::Value updated(const std::string& scene, const std::string& old, const std::string& output,
                            const std::vector<std::string>& more = {}) const {
    return json_here(joined({"bake", scene, "--update", old, "-o", output}, more));
  }
  static std::string bytes(const std::string& file) { return read_text_file(file, 1 << 24); }

  const test::TempDir dir_;
  const std::string old_ = dir_ / "old.sphl", new_ = dir_ / "new.sphl", full_ = dir_ / "full.sphl";
};

TEST_F(BakeUpdate, NothingChangedGivesTheSameBytesAndBakesNothing) {
  baked("builtin:cornell", old_);
  const json::Value update = updated("builtin:cornell", old_, new_);
  EXPECT_EQ(bytes(new_), bytes(old_));
  EXPECT_EQ(update["rays"], 0);
  EXPECT_EQ(update["geometry_builds"], 0);
  EXPECT_EQ(update["update"]["from"], old_);
  EXPECT_EQ(update["update"]["changed"].size(), 0u);
  EXPECT_EQ(update["update"]["probes"].size(), 0u);
}

TEST_F(BakeUpdate, AChangedWallIsNamedAndFollowedToTheBitsOfABakeInFull) {
  const std::string plain = overlay("plain", ""),
                    blue = overlay("blue", R"("materials": [{"name": "red", "base_color": [0, 0, 1]}])");
  baked(plain, old_);
  baked(blue, full_);
  const json::Value update = updated(blue, old_, new_, {"--tolerance", "0"});
  const json::Value changed = update["update"]["changed"];
  ASSERT_GE(changed.size(), 1u);
  EXPECT_EQ(changed[0]["kind"], "object");
  EXPECT_EQ(changed[0]["changes"][0], "surface");
  EXPECT_EQ(update["update"]["probes"].size(), update["probes"].number()) << "a wall is seen from everywhere";
  EXPECT_EQ(probes::read_probe_file(new_).probes, probes::read_probe_file(full_).probes);
  EXPECT_EQ(bytes(new_), bytes(full_));
}

TEST_F(BakeUpdate, ALampKeepsTheEdges) {
  const std::string dim = overlay("dim",
                                  R"("lights": [{"name": "l", "type": "point", "position": [0, 1, 0]}])"),
                    bright =
                        overlay("bright", R"("lights": [{"name": "l", "type": "point", "position": [0, 1, 0],
                                                             "intensity": 2}])");
  baked(dim, old_);
  const json::Value update = updated(bright, old_, new_);
  EXPECT_EQ(update["update"]["changed"][0]["kind"], "light");
  EXPECT_EQ(update["viz_seconds"], 0.0);
  const probes::ProbeSet before = probes::read_probe_file(old_), now = probes::read_probe_file(new_);
  ASSERT_GT(probes::edge_count(before), 0u);
  for (std::size_t i = 0; i < now.probes.size(); ++i) EXPECT_EQ(now.probes[i].edges, before.probes[i].edges);
  EXPECT_NE(now.probes[0].groups, before.probes[0].groups);
}

TEST_F(BakeUpdate, VizOffKeepsTheEdges) {
  baked("builtin:cornell", old_);
  const json::Value update =
      updated(overlay("blue", R"("materials": [{"name": "red", "base_color": [0, 0, 1]}])"), old_, new_,
              {"--tolerance", "0", "--viz", "off"});
  EXPECT_EQ(update["viz_seconds"], 0.0);
  EXPECT_GT(update["gen_seconds"].number(), 0);
  const probes::ProbeSet before = probes::read_probe_file(old_), now = probes::read_probe_file(new_);
  for (std::size_t i = 0; i < now.probes.size(); ++i) EXPECT_EQ(now.probes[i].edges, before.probes[i].edges);
  EXPECT_EQ(now.generator.viz, before.generator.viz);
}

TEST_F(BakeUpdate, AFileMayBeUpdatedInPlaceAndAgain) {
  const std::string plain = overlay("plain", ""),
                    blue = overlay("blue", R"("materials": [{"name": "red", "base_color": [0, 0, 1]}])");
  baked(plain, old_);
  baked(plain, full_);
  updated(blue, old_, old_, {"--tolerance", "0"});
  EXPECT_EQ(updated(blue, old_, old_)["rays"], 0);
  updated(plain, old_, old_, {"--tolerance", "0"});
  EXPECT_EQ(bytes(old_), bytes(full_)) << "there and back";
}

TEST_F(BakeUpdate, TakesTheParametersAndThePoseOfTheOldBake) {
  json_here({"bake",        "builtin:two-rooms",
             "-o",          old_,
             "--time",      "1",
             "--face",      "4",
             "--spp",       "3",
             "--passes",    "2",
             "--max-depth", "2",
             "--seed",      "9",
             "--degree",    "1",
             "--gen",       "full",
             "--neighbors", "2",
             "--threshold", "0.001"});
  EXPECT_EQ(updated("builtin:two-rooms", old_, new_)["rays"], 0);
  const std::string dark = dir_ / "dark.ssphh.json";
  std::ofstream(dark) << R"({"scene": "builtin:two-rooms", "environment": {"color": [0.1, 0.1, 0.1]}})";
  updated(dark, old_, new_);
  const probes::ProbeSet before = probes::read_probe_file(old_), now = probes::read_probe_file(new_);
  probes::GeneratorInfo generator = before.generator;
  generator.scene = now.generator.scene, generator.scene_hash = now.generator.scene_hash;
  EXPECT_EQ(now.generator, generator);
  EXPECT_EQ(now.degree, 1);
  EXPECT_EQ(now.baseline->viz_neighbors, 2);
  EXPECT_EQ(now.baseline->viz_threshold, 0.001f);
}

TEST_F(BakeUpdate, RefusesWhatItCannotDo) {
  const auto problem = [&](const std::vector<std::string>& more,
                           const std::string& scene = "builtin:cornell") {
    return problem_here(joined({"bake", scene, "-o", new_}, more));
  };
  EXPECT_THAT(problem({"--tolerance", "0.1"}), AllOf(HasSubstr("--tolerance"), HasSubstr("--update")));
  baked("builtin:cornell", old_);
  for (const char* option : {"--degree", "--face", "--spp", "--time", "--neighbors"})
    EXPECT_THAT(problem({"--update", old_, option, "1"}), AllOf(HasSubstr(option), HasSubstr("was baked")));
  EXPECT_THAT(problem({"--update", old_, "--seed", "3"}), AllOf(HasSubstr("--seed 3"), HasSubstr("seed 0")));
  EXPECT_THAT(problem({"--update", old_, "--probes", "auto"}), HasSubstr("--probes"));
  EXPECT_THAT(problem({"--update", old_, "--viz", "links"}), AllOf(HasSubstr("--viz"), HasSubstr("off")));

  const std::string moved = overlay("moved", R"("sphls": [{"name": "SPHL new", "position": [0, 1, 0.3]}])");
  EXPECT_THAT(problem({"--update", old_}, moved), AllOf(HasSubstr("SPHL new"), HasSubstr("all places")));

  probes::ProbeSet bare = probes::read_probe_file(old_);
  bare.baseline.reset();
  probes::write_probe_file(bare, old_);
  EXPECT_THAT(problem({"--update", old_}), AllOf(HasSubstr(old_), HasSubstr("no baseline")));
}

}  // namespace
}  // namespace ssphh
