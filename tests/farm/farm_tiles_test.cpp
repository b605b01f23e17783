/// Tiles of transport on a farm: the bits of a bake here.

#include <gmock/gmock.h>

#include "farm_process.h"
#include "json_schema.h"
#include "places.h"

namespace ssphh::test {
namespace {

/// Over 512 probes in the Cornell box, as cheap as may be: two tiles.
std::vector<std::string> two_tiles() {
  return {"bake",          "builtin:cornell",
          "--probes",      "auto:0.245",
          "--refine",      "0",
          "--operator",    "surfel",
          "--quality",     "draft",
          "--degree",      "1",
          "--directions",  "32",
          "--link-rays",   "8",
          "--surfel-size", "0.6",
          "--records",     "50",
          "--viz",         "links",
          "--neighbors",   "2"};
}

TEST(FarmTiles, HaveTheBitsOfALocalBake) {
  const TempDir dir;
  auto command = two_tiles();
  const std::string here = (dir / "here.sphl").string(), there = (dir / "there.sphl").string();
  command.insert(command.end(), {"-o", here});
  const json::Value local = run_json(command);
  EXPECT_EQ(local["tiles"], 2);
  EXPECT_GT(local["edges"].number(), 512);
  command.back() = there;
  const std::string cache = (dir / "cache").string();
  command.insert(command.end(), {"--local", "2", "--cache", cache});
  json::Value object = run_json(command);
  EXPECT_EQ(read_file(there), read_file(here));
  EXPECT_EQ(object["farm"]["units"], 2);
  EXPECT_EQ(object["farm"]["jobs"], 2);
  EXPECT_EQ(object["surfels"], local["surfels"]);
  object = run_json(command);
  EXPECT_EQ(object["farm"]["cached"], 2);
  EXPECT_EQ(object["farm"]["jobs"], 0);
  EXPECT_EQ(read_file(there), read_file(here));
}

TEST(FarmTiles, KeepTheirMessagesAsJsonOfTheSchemas) {
  const TempDir dir;
  auto command = two_tiles();
  const std::string folder = (dir / "box.tiles").string(), kept = (dir / "kept").string();
  command.insert(command.end(), {"-o", folder, "--local", "1", "--cache", "none", "--keep-messages", kept});
  run_json(command);
  EXPECT_TRUE(std::filesystem::exists(folder + "/tiles.json") && std::filesystem::exists(folder + "/1.sphl"));
  int messages = 0;
  for (const auto& entry : std::filesystem::directory_iterator(kept)) {
    const std::string name = entry.path().filename(), text = read_text_file(entry.path());
    const std::string what = name.substr(5, name.find('.', 5) - 5);  // 0001.job.json
    EXPECT_THAT(schema_errors(source_dir() / ("schemas/farm-" + what + ".schema.json"), text),
                testing::IsEmpty())
        << name;
    ++messages;
  }
  EXPECT_EQ(messages, 4);
}

}  // namespace
}  // namespace ssphh::test
