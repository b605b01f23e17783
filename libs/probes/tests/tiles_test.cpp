/// Sets in tiles: what a tile has of the whole, what the whole gets back, and the folder that keeps them.

#include <fstream>
#include <numeric>

#include <gmock/gmock.h>

#include <ssphh/core/file.h>
#include <ssphh/probes/probe_file.h>
#include <ssphh/probes/tile_folder.h>

#include "error_message.h"
#include "random_set.h"
#include "temp_dir.h"

namespace ssphh::probes {
namespace {

using test::message_of;
using testing::ElementsAre;
using testing::HasSubstr;

constexpr float no_end = std::numeric_limits<float>::infinity();
const Hash128 key{1, 2};

/// 0 and 1 on the left; 2, 3 and 4 on the right, of which 0 sees 3 and 1 sees none.
std::vector<Tile> two_tiles() {
  return {{0, 2, {3}, {vec3(-no_end), vec3(5, no_end, no_end)}},
          {2, 3, {0, 1}, {vec3(5, -no_end, -no_end), vec3(no_end)}}};
}

ProbeSet random_whole() {
  ProbeSet set = test::random_set(7, 5, 1);
  set.surface = test::random_records(11, 40, 2);
  set.surface->direct = {{}, set.surface->groups[0]};
  merge_groups(set);
  return set;
}

TEST(TileBoxes, HoldTheirLowerBorderAndNotTheirUpperOne) {
  const TileBox box{{0, 0, 0}, {1, 2, 3}};
  EXPECT_TRUE(box.contains({0, 0, 0}) && box.contains({0.5f, 1.99f, 2.99f}));
  EXPECT_FALSE(box.contains({1, 1, 1}) || box.contains({0.5f, 2, 1}) || box.contains({0.5f, 1, 3}));
  EXPECT_FALSE(box.contains({-1e-6f, 0, 0}));
  EXPECT_TRUE(TileBox().contains(vec3(1e30f)) && TileBox().contains(vec3(-1e30f)));
}

TEST(Tiles, CountProbesAndTellWhereASetOfSomeHasThem) {
  const std::vector<Tile> tiles = two_tiles();
  EXPECT_EQ(probe_count(tiles), 5u);
  EXPECT_THAT(places_of(tiles), ElementsAre(0, 1, 2, 3, 4));
  const std::size_t right[] = {1};
  EXPECT_THAT(places_of(tiles, right), ElementsAre(-1, -1, 0, 1, 2));
}

TEST(Tiles, TakeTheirProbesTheirHaloTheEdgesBetweenAndTheRecordsInTheirBox) {
  const ProbeSet whole = random_whole();
  const Tile tile = two_tiles()[0];
  const ProbeSet part = set_of_tile(whole, tile);
  ASSERT_EQ(part.probes.size(), 3u);
  EXPECT_EQ(part.probes[0].groups, whole.probes[0].groups);
  EXPECT_EQ(part.probes[2].name, whole.probes[3].name);
  ASSERT_EQ(part.probes[0].edges.size(), 2u);  // of 1 and 3; 2 and 4 are not there
  EXPECT_EQ(part.probes[0].edges[0].from, 1);
  EXPECT_EQ(part.probes[0].edges[1].from, 2);
  EXPECT_EQ(part.probes[0].edges[1].h, whole.probes[0].edges[2].h);
  std::size_t inside = 0;
  for (std::size_t p = 0; p < whole.surface->points.size(); ++p) {
    if (whole.surface->points[p].position.x >= 5) continue;
    ASSERT_LT(inside, part.surface->points.size());
    EXPECT_EQ(part.surface->points[inside].position, whole.surface->points[p].position);
    EXPECT_EQ(part.surface->groups[1][inside], whole.surface->groups[1][p]);
    EXPECT_EQ(part.surface->direct[1][inside], whole.surface->direct[1][p]);
    ++inside;
  }
  EXPECT_EQ(part.surface->points.size(), inside);
  EXPECT_GT(inside, 5u);
}

TEST(Tiles, PutTogetherAreTheWholeAgainButForEdgesThatNoneHas) {
  const ProbeSet whole = random_whole();
  const std::vector<Tile> tiles = two_tiles();
  ProbeSet again;
  again.degree = whole.degree;
  again.probes.resize(5);
  for (const Tile& tile : tiles) put_tile(tile, set_of_tile(whole, tile), places_of(tiles), again);
  merge_groups(again);
  EXPECT_EQ(again.light_groups, whole.light_groups);
  EXPECT_EQ(again.generator, whole.generator);
  for (std::size_t i = 0; i < 5; ++i) {
    EXPECT_EQ(again.probes[i].name, whole.probes[i].name);
    EXPECT_EQ(again.probes[i].groups, whole.probes[i].groups);
    EXPECT_EQ(again.probes[i].self, whole.probes[i].self);
  }
  EXPECT_EQ(again.probes[0].edges.size(), 2u);
  EXPECT_EQ(again.probes[0].edges[1].from, 3);
  EXPECT_EQ(again.probes[0].edges[1].h, whole.probes[0].edges[2].h);
  EXPECT_EQ(again.probes[4].edges, whole.probes[4].edges);  // 0, 1, 2 and 3: all are in its tile or its halo
  EXPECT_EQ(again.surface->points.size(), whole.surface->points.size());
  EXPECT_EQ(again.surface->light.size(), whole.surface->points.size());
}

TEST(Tiles, OfUnlikeSurfelsAreTogetherOfTheFinest) {
  const std::vector<Tile> tiles = two_tiles();
  ProbeSet whole;
  whole.probes.resize(5);
  for (const float size : {0.5f, 0.25f}) {
    ProbeSet part = set_of_tile(random_whole(), tiles[size == 0.5f ? 0 : 1]);
    part.generator.surfel_size = size;
    put_tile(tiles[size == 0.5f ? 0 : 1], std::move(part), places_of(tiles), whole);
  }
  EXPECT_EQ(whole.generator.surfel_size, 0.25f);
}

class TileFolders : public testing::Test {
 protected:
  void fill(const TileFolder& folder) const {
    for (std::size_t t = 0; t < 2; ++t) folder.write(t, set_of_tile(whole, two_tiles()[t]));
  }
  std::string message(const std::function<void()>& f) const { return message_of(f); }
  void write_index(const std::string& text) const { write_file(path / "tiles.json", text); }

  test::TempDir dir;
  std::filesystem::path path = dir / "town.tiles";
  ProbeSet whole = random_whole();
};

TEST_F(TileFolders, KeepTilesAndJoinThem) {
  const TileFolder folder(path, key, two_tiles());
  EXPECT_FALSE(folder.has(0));
  fill(folder);
  EXPECT_TRUE(folder.has(0) && folder.has(1));
  const TileFolder opened(path);
  EXPECT_EQ(opened.tiles(), two_tiles());
  const ProbeSet joined = read_probe_file(path);
  ASSERT_EQ(joined.probes.size(), 5u);
  EXPECT_EQ(joined.probes[3].groups, whole.probes[3].groups);
  EXPECT_EQ(joined.surface->points.size(), whole.surface->points.size());
  const std::size_t right[] = {1};
  const ProbeSet of_right = opened.join(right);
  ASSERT_EQ(of_right.probes.size(), 3u);
  EXPECT_EQ(of_right.probes[0].groups, whole.probes[2].groups);
  ASSERT_EQ(of_right.probes[0].edges.size(), 2u);  // those of 0 and 1 lead away
  EXPECT_EQ(of_right.probes[0].edges[0].from, 1);
  EXPECT_EQ(of_right.probes[0].edges[0].h, whole.probes[2].edges[2].h);
}

TEST_F(TileFolders, GoOnWithTheSameKeyAndTilesAlone) {
  fill(TileFolder(path, key, two_tiles()));
  EXPECT_TRUE(TileFolder(path, key, two_tiles()).has(1));
  std::vector<Tile> other = two_tiles();
  other[0].halo = {4};
  EXPECT_FALSE(TileFolder(path, key, other).has(1));
  fill(TileFolder(path, key, two_tiles()));
  const TileFolder anew(path, {1, 3}, two_tiles());
  EXPECT_FALSE(anew.has(0) || anew.has(1));
}

TEST_F(TileFolders, LeaveWhatIsNotTheirs) {
  std::filesystem::create_directories(path);
  write_file(path / "holiday.txt", std::string("dear diary"));
  EXPECT_THAT(message([&] { TileFolder(path, key, two_tiles()); }), HasSubstr("holds no tiles"));
  std::filesystem::remove(path / "holiday.txt");
  const TileFolder folder(path, key, two_tiles());
  fill(folder);
  write_file(path / "holiday.txt", std::string("dear diary"));
  folder.remove();
  EXPECT_FALSE(folder.has(0) || std::filesystem::exists(path / "tiles.json"));
  EXPECT_TRUE(std::filesystem::exists(path / "holiday.txt"));
  std::filesystem::remove_all(path);
  write_file(path, std::string("a file"));
  EXPECT_THAT(message([&] { TileFolder(path, key, two_tiles()); }), HasSubstr("holds no tiles"));
}

TEST_F(TileFolders, NameWhatIsWrongWithThem) {
  const TileFolder folder(path, key, two_tiles());
  folder.write(0, set_of_tile(whole, two_tiles()[0]));
  EXPECT_THAT(message([&] { read_probe_file(path); }), HasSubstr("1.sphl: is missing"));
  folder.write(1, set_of_tile(whole, two_tiles()[0]));
  EXPECT_THAT(message([&] { read_probe_file(path); }), HasSubstr("has 3 probes, tiles.json lists 5"));
  folder.write(1, set_of_tile(test::random_set(1, 5, 2), two_tiles()[1]));
  EXPECT_THAT(message([&] { read_probe_file(path); }), HasSubstr("of another degree"));
  EXPECT_THAT(message([&] { folder.join({}); }), HasSubstr("no tile"));
  EXPECT_THAT(message([&] { write_probe_file(whole, path); }), HasSubstr("only a bake writes tiles"));
  EXPECT_THAT(message([&] { TileFolder(dir / "none.tiles"); }), HasSubstr("tiles.json"));
  const std::string tile = R"({"probes":2,"halo":[],"min":[null,null,null],"max":[null,null,null]})";
  const auto index = [](const std::string& tiles) {
    return R"({"ssphh_tiles":1,"key":"00","tiles":[)" + tiles + "]}";
  };
  const std::pair<std::string, const char*> broken[] = {
      {"{", "tiles.json"},
      {R"({"ssphh_tiles":2,"key":"00","tiles":[]})", "ssphh_tiles"},
      {index(""), "tiles"},
      {index(R"({"probes":0,"halo":[],"min":[null,null,null],"max":[null,null,null]})"), "tiles[0].probes"},
      {index(tile + R"(,{"probes":1,"halo":[3],"min":[null,null,null],"max":[null,null,null]})"),
       "tiles[1].halo[0]"},
      {index(R"({"probes":2,"halo":[],"min":[null,null],"max":[null,null,null]})"), "tiles[0].min"}};
  for (const auto& [text, place] : broken) {
    write_index(text);
    EXPECT_THAT(message([&] { TileFolder opened(path); }), HasSubstr(place)) << text;
  }
}

TEST_F(TileFolders, AreKnownByTheirNames) {
  EXPECT_TRUE(is_tile_folder("a/town.tiles") && is_tile_folder("a/town.tiles/"));
  EXPECT_FALSE(is_tile_folder("town.sphl") || is_tile_folder("tiles"));
}

TEST_F(TileFolders, HaveTheContentOfAllTheirFiles) {
  const TileFolder folder(path, key, two_tiles());
  fill(folder);
  const Hash128 content = folder.content();
  EXPECT_EQ(TileFolder(path).content(), content);
  whole.light_groups[0].scale *= 2;
  folder.write(1, set_of_tile(whole, two_tiles()[1]));
  EXPECT_NE(folder.content(), content);
}

}  // namespace
}  // namespace ssphh::probes
