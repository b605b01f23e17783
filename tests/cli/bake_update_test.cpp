// `bake --update`: what has changed since, what is baked again, and what is refused.

#include <algorithm>
#include <filesystem>
#include <fstream>

#include <fmt/format.h>

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
  /// Records by a coarse network.
  const json::Value baked(const std::string& scene, const std::string& output, int records = 0,
                          std::vector<std::string> more = {}) const {
    if (records > 0)
      more.insert(more.end(), {"--directions", "64", "--link-rays", "16", "--surfel-size", "0.4"});
    return json_here(joined(
        {"bake", scene, "-o", output, "--face", "8", "--degree", "3", "--records", std::to_string(records)},
        more));
  }
  const json::Value updated(const std::string& scene, const std::string& old, const std::string& output,
                            const std::vector<std::string>& more = {}) const {
    return json_here(joined({"bake", scene, "--update", old, "-o", output}, more));
  }
  const std::string blue_wall_ = R"("materials": [{"name": "red", "base_color": [0, 0, 1]}])";
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
  const std::string plain = overlay("plain", ""), blue = overlay("blue", blue_wall_);
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
      updated(overlay("blue", blue_wall_), old_, new_, {"--tolerance", "0", "--viz", "off"});
  EXPECT_EQ(update["viz_seconds"], 0.0);
  EXPECT_GT(update["gen_seconds"].number(), 0);
  const probes::ProbeSet before = probes::read_probe_file(old_), now = probes::read_probe_file(new_);
  for (std::size_t i = 0; i < now.probes.size(); ++i) EXPECT_EQ(now.probes[i].edges, before.probes[i].edges);
  EXPECT_EQ(now.generator.viz, before.generator.viz);
}

TEST_F(BakeUpdate, AFileMayBeUpdatedInPlaceAndAgain) {
  const std::string plain = overlay("plain", ""), blue = overlay("blue", blue_wall_);
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

TEST_F(BakeUpdate, RecordsAndFittedWeightsFollowToo) {
  const std::string plain = overlay("plain", ""), blue = overlay("blue", blue_wall_);
  baked(plain, old_, 300, {"--fit"});
  baked(blue, full_, 300, {"--fit"});
  const json::Value update = updated(blue, old_, new_, {"--tolerance", "0"});
  EXPECT_GT(update["records"].number(), 100);
  EXPECT_EQ(bytes(new_), bytes(full_));
  EXPECT_EQ(probes::read_probe_file(new_).baseline->records, 300);
}

TEST_F(BakeUpdate, LightByTransportIsFoundAnewInPlace) {
  const std::string plain = overlay("plain", ""), blue = overlay("blue", blue_wall_);
  for (const char* op : {"surfel", "bounce"}) {
    const std::vector<std::string> more = {"--operator",  op,   "--records",     "200", "--directions", "64",
                                           "--link-rays", "16", "--surfel-size", "0.4"};
    const auto bake = [&](const std::string& scene, const std::string& output) {
      json_here(joined({"bake", scene, "-o", output, "--degree", "3"}, more));
    };
    bake(plain, old_), bake(blue, full_);
    EXPECT_EQ(updated(plain, old_, new_)["rays"], 0) << op;
    EXPECT_EQ(bytes(new_), bytes(old_)) << op;
    const json::Value update = updated(blue, old_, new_, {"--tolerance", "0"});
    EXPECT_EQ(update["operator"], op);
    EXPECT_EQ(update["update"]["changed"][0]["changes"][0], "surface") << op;
    EXPECT_EQ(bytes(new_), bytes(full_)) << op;
    const probes::ProbeSet before = probes::read_probe_file(old_), now = probes::read_probe_file(new_);
    json::Value differ = json::Value::array();
    for (std::size_t i = 0; i < before.probes.size(); ++i)
      if (now.probes[i].groups != before.probes[i].groups) differ.push_back(i);
    EXPECT_GT(differ.size(), 0u) << op;
    EXPECT_EQ(update["update"]["probes"], differ) << op;
    EXPECT_THAT(test::text_here({"bake", blue, "--update", old_, "-o", new_}),
                HasSubstr(fmt::format("all light was found anew: that of {} of 5 probes has changed",
                                      differ.size())));
  }
}

TEST_F(BakeUpdate, ByHandBakesTheProbesThatAreNamed) {
  const std::string plain = overlay("plain", ""), blue = overlay("blue", blue_wall_);
  baked(plain, old_, 300);
  baked(blue, full_, 300);
  const probes::ProbeSet before = probes::read_probe_file(old_), full = probes::read_probe_file(full_);
  ASSERT_EQ(before.probes.size(), 5u);
  const vec3 p = before.probes[3].position;
  const std::string box = fmt::format("{},{},{},{},{},{}", p.x - 0.01f, p.y - 0.01f, p.z - 0.01f, p.x + 0.01f,
                                      p.y + 0.01f, p.z + 0.01f);
  for (const auto& [words, which] :
       std::vector<std::pair<std::vector<std::string>, std::vector<std::size_t>>>{
           {{"--only-probes", "0,2-3"}, {0, 2, 3}}, {{"--only-box=" + box}, {3}}}) {
    const json::Value update = updated(blue, old_, new_, words);
    const probes::ProbeSet now = probes::read_probe_file(new_);
    EXPECT_EQ(update["update"]["probes"].size(), which.size());
    for (std::size_t i = 0; i < 5; ++i) {
      const bool named = std::ranges::count(which, i) > 0;
      EXPECT_EQ(now.probes[i].groups, (named ? full : before).probes[i].groups) << i;
      EXPECT_TRUE(named || now.probes[i].edges == before.probes[i].edges) << i;
    }
    EXPECT_NE(now.surface->groups, before.surface->groups);
    EXPECT_EQ(now.baseline->items, before.baseline->items) << "the rest is still to be compared";
  }
  updated(blue, new_, new_, {"--tolerance", "0"});
  EXPECT_EQ(probes::read_probe_file(new_).probes, full.probes) << "which an update does";
}

TEST_F(BakeUpdate, ByHandBakesTheLightGroupsThatAreNamed) {
  const auto lamps = [&](const std::string& name, int intensity) {
    return overlay(name, fmt::format(R"("lights": [
        {{"name": "a", "light_group": "a", "type": "point", "position": [0, 1, 0], "intensity": {0}}},
        {{"name": "b", "light_group": "b", "type": "point", "position": [0.5, 1, 0], "intensity": {0}}}])",
                                     intensity));
  };
  const std::string dim = lamps("dim", 1), bright = lamps("bright", 2);
  baked(dim, old_, 300);
  baked(bright, full_, 300);
  updated(bright, old_, new_, {"--only-lights", "b", "--tolerance", "0"});
  const probes::ProbeSet before = probes::read_probe_file(old_), full = probes::read_probe_file(full_),
                         now = probes::read_probe_file(new_);
  for (std::size_t g = 0; g < now.light_groups.size(); ++g) {
    const bool named = now.light_groups[g].name == "b";
    for (std::size_t i = 0; i < now.probes.size(); ++i)
      EXPECT_EQ(now.probes[i].groups[g], (named ? full : before).probes[i].groups[g]) << g << " " << i;
    EXPECT_EQ(now.surface->groups[g] == before.surface->groups[g], !named) << g;
  }
  EXPECT_NE(now.probes, before.probes);
}

TEST_F(BakeUpdate, RefusesWhatCannotBeDoneByHand) {
  baked("builtin:cornell", old_);
  const auto problem = [&](const std::vector<std::string>& more) {
    return problem_here(joined({"bake", "builtin:cornell", "-o", new_, "--update", old_}, more));
  };
  EXPECT_THAT(problem_here({"bake", "builtin:cornell", "-o", new_, "--only-probes", "1"}),
              AllOf(HasSubstr("--only-probes"), HasSubstr("give --update FILE")));
  EXPECT_THAT(problem({"--only-probes", "1,5"}), AllOf(HasSubstr("no probe 5"), HasSubstr("0 to 4")));
  for (const char* list : {"x", "1,", "3-1", "-1", "1-", "1.5", "99999999999"})
    EXPECT_THAT(problem({std::string("--only-probes=") + list}), HasSubstr("--only-probes")) << list;
  EXPECT_THAT(problem({"--only-box=9,9,9,10,10,10"}),
              AllOf(HasSubstr("no probe stands in it"), HasSubstr("the probes stand in")));
  EXPECT_THAT(problem({"--only-box=1,0,0,0,1,1"}), HasSubstr("no box"));
  EXPECT_THAT(problem({"--only-lights", "sun"}), AllOf(HasSubstr("--only-lights sun"), HasSubstr("known:")));
  EXPECT_FALSE(std::filesystem::exists(new_));
}

TEST_F(BakeUpdate, DirectLightOfABakedGroupIsFollowedToTheBitsOfABakeInFull) {
  const std::string modes = R"("light_modes": {"lamp": "baked"})", plain = overlay("plain", modes),
                    blue = overlay("blue",
                                   modes + R"(, "materials": [{"name": "red", "base_color": [0, 0, 1]}])");
  baked(plain, old_, 256), baked(blue, full_, 256);
  updated(blue, old_, new_, {"--tolerance", "0"});
  EXPECT_EQ(bytes(new_), bytes(full_));
  // In part: what is near one probe is that of the bake in full, the rest of the old one
  updated(blue, old_, new_, {"--only-probes", "1"});
  const probes::ProbeSet before = probes::read_probe_file(old_), all = probes::read_probe_file(full_),
                         part = probes::read_probe_file(new_);
  ASSERT_EQ(part.surface->direct.size(), 1u);
  EXPECT_EQ(part.surface->direct[0].size(), part.surface->points.size());
  for (std::size_t i = 0; i < part.probes.size(); ++i)
    EXPECT_EQ(part.probes[i].groups, (i == 1 ? all : before).probes[i].groups) << i;
  updated(blue, old_, new_, {"--light-mode", "lamp=realtime"});
  EXPECT_TRUE(probes::baked_groups(probes::read_probe_file(new_)).empty());
  // Where the scene says nothing of it the file knows
  const std::string silent = overlay("silent", R"("materials": [{"name": "red", "base_color": [0, 0, 1]}])");
  updated(silent, old_, new_, {"--tolerance", "0"});
  EXPECT_EQ(probes::baked_groups(probes::read_probe_file(new_)), std::vector<std::string>{"lamp"});
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
