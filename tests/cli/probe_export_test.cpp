// `ssphh probe export` on a small set that was made by hand.

#include <fmt/format.h>

#include <ssphh/core/file.h>
#include <ssphh/place/init.h>
#include <ssphh/probes/probe_file.h>
#include <ssphh/scene/builtin.h>

#include "error_message.h"
#include "here.h"
#include "temp_dir.h"

namespace ssphh {
namespace {

using test::joined;
using test::json_here;
using test::problem_here;
using testing::AllOf;
using testing::HasSubstr;

class ProbeExportTool : public testing::Test {
 protected:
  ProbeExportTool() {
    probes::ProbeSet set = place::init_from_scene(scene::make_builtin("two-rooms"), 3);
    set.light_groups = {{"lamp"}, {"the sun"}};
    for (probes::Probe& probe : set.probes) {
      probe.groups.resize(2);
      for (probes::GroupLight& light : probe.groups) {
        light.reflected = sh::RadianceSh(3);
        light.reflected[0] = vec3(1, 2, 3);
      }
    }
    probes::merge_groups(set);
    probes::write_probe_file(set, file_);
  }
  std::vector<std::string> to(const std::string& target, const std::vector<std::string>& more = {}) const {
    return joined(
        {"probe", "export", file_, "--scene", "builtin:two-rooms", "--to", target, "-o", dir_ / "out"}, more);
  }

  const test::TempDir dir_;
  const std::string file_ = dir_ / "a.sphl";
};

TEST_F(ProbeExportTool, WritesTheFilesThatItNamesAndTellsWhatIsLost) {
  for (const auto& [target, endings] :
       std::vector<std::pair<std::string, std::vector<std::string>>>{{"csv", {".csv"}},
                                                                     {"gltf", {".glb"}},
                                                                     {"unity", {".json", ".cs"}},
                                                                     {"blender", {".py"}},
                                                                     {"three", {".json", ".bin"}},
                                                                     {"godot", {".tres"}},
                                                                     {"bevy", {".vxgi.ktx2", ".json"}},
                                                                     {"babylon", {".json", ".bin"}},
                                                                     {"playcanvas", {".json", ".bin"}}}) {
    const json::Value said = json_here(to(target));
    ASSERT_EQ(said["files"].size(), endings.size()) << target;
    std::uintmax_t bytes = 0;
    for (std::size_t i = 0; i < endings.size(); ++i) {
      const std::string file = dir_ / ("out" + endings[i]);
      EXPECT_EQ(said["files"][i].string(), file);
      bytes += std::filesystem::file_size(file);
    }
    EXPECT_EQ(*said["bytes"].integer(), static_cast<std::int64_t>(bytes));
    EXPECT_THAT(json::print(said["lost"]), HasSubstr("lamp, the sun are summed"));
    EXPECT_THAT(test::text_here(to(target)), HasSubstr("not carried: other poses than that at 0 s"));
  }
}

TEST_F(ProbeExportTool, GroupsApart) {
  const json::Value each = json_here(to("csv", {"--groups", "separate"}));
  const std::string lamp = dir_ / "out-lamp.csv", sun = dir_ / "out-the_sun.csv";
  EXPECT_EQ(each["files"], json::Value::array({lamp, sun}));
  EXPECT_THAT(read_text_file(lamp), HasSubstr(",1,2,3,0,0,0"));
  json_here(to("csv"));
  EXPECT_THAT(read_text_file(dir_ / "out.csv"), HasSubstr(",2,4,6,0,0,0"));
  EXPECT_EQ(json_here(to("csv", {"--group", "the sun"}))["files"], json::Value::array({sun}));
  EXPECT_THAT(problem_here(to("csv", {"--group", "moon"})), HasSubstr("none of: lamp, the sun"));
}

// An engine blends keys number by number: that the cells of a grid of its own would lie elsewhere, as its
// door does not stand in the wall's gap, must not matter.
TEST_F(ProbeExportTool, KeysHaveTheSameCells) {
  probes::ProbeSet open = probes::read_probe_file(file_);
  open.generator.time = 1;
  for (probes::Probe& probe : open.probes) probe.groups[0].reflected[0] = vec3(5, 6, 7);
  probes::merge_groups(open);
  const std::string other = dir_ / "b.sphl";
  probes::write_probe_file(open, other);
  const auto keys = [&](const std::string& files, const std::string& target) {
    std::vector<std::string> line = to(target);
    line[2] = files;
    return line;
  };
  const auto header = [&](const std::string& name) { return json::parse(read_text_file(dir_ / name), name); };

  const json::Value said = json_here(keys(other + "," + file_, "three"));  // in whatever order
  ASSERT_EQ(said["files"].size(), 4u);
  EXPECT_EQ(said["key_times"], json::Value::array({0, 1}));
  EXPECT_THAT(json::print(said["lost"]), Not(HasSubstr("other poses")));
  const json::Value shut = header("out-key0.json"), ajar = header("out-key1.json");
  for (const char* part : {"min", "max", "resolution"}) EXPECT_EQ(shut[part], ajar[part]) << part;
  EXPECT_EQ(shut["texture"]["file"].string(), "out-key0.bin");
  EXPECT_NE(read_text_file(dir_ / "out-key0.bin"), read_text_file(dir_ / "out-key1.bin"));
  json_here(keys(other, "three"));
  EXPECT_NE(header("out.json")["min"], shut["min"]);

  json_here(keys(file_ + "," + other, "csv"));
  EXPECT_THAT(read_text_file(dir_ / "out-key1.csv"), HasSubstr(",6,8,10,0,0,0"));
  // One editor script for all: two would define the same class.
  const json::Value unity = json_here(keys(file_ + "," + other, "unity"));
  EXPECT_EQ(unity["files"],
            json::Value::array({std::string(dir_ / "out-key0.json"), std::string(dir_ / "out.cs"),
                                std::string(dir_ / "out-key1.json")}));
  EXPECT_THAT(problem_here(keys(file_ + "," + other + "@0", "csv")), HasSubstr("is a key at 0 s"));
}

TEST_F(ProbeExportTool, ListNeedsNothing) {
  const json::Value list = json_here({"probe", "export", "--list"});
  EXPECT_EQ(list["targets"].size(), 9u);
  EXPECT_THAT(test::text_here({"probe", "export", "--list"}),
              AllOf(HasSubstr("three: "), HasSubstr("  loses ")));
}

TEST_F(ProbeExportTool, BadInputIsNamed) {
  EXPECT_THAT(problem_here({"probe", "export", file_, "--to", "csv", "-o", dir_ / "x"}),
              HasSubstr("--scene is missing"));
  EXPECT_THAT(
      problem_here({"probe", "export", file_, "--scene", "builtin:cornell", "--to", "csv", "-o", dir_ / "x"}),
      HasSubstr("another scene"));
  EXPECT_THAT(problem_here(to("three", {"--grid", "wide"})), HasSubstr("neither auto nor a length"));
  EXPECT_THAT(problem_here(to("three", {"--grid", "0.001"})), HasSubstr("would fit"));
  EXPECT_THAT(problem_here(to("csv", {"--grid", "1"})), HasSubstr("has no grid"));
}

}  // namespace
}  // namespace ssphh
