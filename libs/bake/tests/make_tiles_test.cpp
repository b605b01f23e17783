/// How places are divided into tiles.

#include <algorithm>
#include <set>

#include <gmock/gmock.h>

#include <ssphh/bake/tiled_transport.h>
#include <ssphh/core/random.h>

#include "error_message.h"

namespace ssphh::bake {
namespace {

using probes::ProbeSet;
using probes::Tile;
using testing::ElementsAre;

ProbeSet set_at(const std::vector<vec3>& places) {
  ProbeSet set;
  for (const vec3& place : places) {
    probes::Probe& probe = set.probes.emplace_back();
    probe.name = std::to_string(set.probes.size() - 1);
    probe.position = place;
  }
  return set;
}

std::vector<vec3> random_places(std::uint64_t seed, int count) {
  Pcg32 rng(seed);
  std::vector<vec3> places;
  for (int i = 0; i < count; ++i) places.push_back(vec3(100, 3, 40) * rng.uniform3());
  return places;
}

TEST(MakeTiles, CoverSpaceOnceAndHoldTheirOwnProbes) {
  for (std::uint64_t seed = 1; seed <= 5; ++seed) {
    ProbeSet set = set_at(random_places(seed, 500));
    const std::vector<Tile> tiles = make_tiles(set, 40);
    EXPECT_GE(tiles.size(), 13u);
    std::uint32_t next = 0;
    for (const Tile& tile : tiles) {
      EXPECT_EQ(tile.first, next);
      EXPECT_LE(tile.own, 40u);
      EXPECT_GE(tile.own, 9u);  // a quarter at least goes to either side
      for (std::uint32_t k = 0; k < tile.own; ++k)
        EXPECT_TRUE(tile.box.contains(set.probes[tile.first + k].position));
      next += tile.own;
    }
    EXPECT_EQ(next, 500u);
    std::set<std::string> names;
    for (const probes::Probe& probe : set.probes) names.insert(probe.name);
    EXPECT_EQ(names.size(), 500u);
    for (const vec3& p : random_places(seed + 100, 300)) {
      const vec3 anywhere = 3.0f * p - vec3(100, 3, 40);
      EXPECT_EQ(std::ranges::count_if(tiles, [&](const Tile& tile) { return tile.box.contains(anywhere); }),
                1);
    }
  }
}

TEST(MakeTiles, HaveTheNearestProbesOfOthersAroundThem) {
  ProbeSet set = set_at(random_places(3, 300));
  for (const Tile& tile : make_tiles(set, 100)) {
    std::set<std::uint32_t> wanted;
    for (std::uint32_t k = 0; k < tile.own; ++k) {
      std::vector<std::pair<float, std::uint32_t>> others;
      const vec3 at = set.probes[tile.first + k].position;
      for (std::uint32_t i = 0; i < 300; ++i)
        others.emplace_back(glm::distance(set.probes[i].position, at), i);
      std::ranges::sort(others);
      for (std::size_t n = 0; n < 9; ++n) {
        const std::uint32_t i = others[n].second;
        if (i < tile.first || i >= tile.first + tile.own) wanted.insert(i);
      }
    }
    EXPECT_EQ(tile.halo, std::vector<std::uint32_t>(wanted.begin(), wanted.end()));
    EXPECT_FALSE(tile.halo.empty());
  }
}

TEST(MakeTiles, AreCutWhereProbesAreFarthestApart) {
  // Two rows of houses, of six and of four probes, and a wide street between
  std::vector<vec3> places;
  for (int i = 0; i < 10; ++i) places.emplace_back(i < 6 ? i : 14 + i, 0, 0.1f * static_cast<float>(i % 2));
  ProbeSet set = set_at(places);
  const std::vector<Tile> tiles = make_tiles(set, 6);
  ASSERT_EQ(tiles.size(), 2u);
  EXPECT_EQ(tiles[0].own, 6u);
  EXPECT_EQ(tiles[0].box.max.x, 12.5f);
  EXPECT_EQ(tiles[1].box.min.x, 12.5f);
}

TEST(MakeTiles, KeepTheOrderOfASetThatHasIt) {
  ProbeSet set = set_at(random_places(9, 700));
  const std::vector<Tile> tiles = make_tiles(set, 64);
  ProbeSet again = set;
  EXPECT_EQ(make_tiles(again, 64), tiles);
  for (std::size_t i = 0; i < 700; ++i) EXPECT_EQ(again.probes[i].name, set.probes[i].name);
}

TEST(MakeTiles, OfFewProbesAreOneAndOfProbesInOnePlaceStillEnd) {
  ProbeSet few = set_at(random_places(1, 64));
  const std::vector<Tile> one = make_tiles(few, 64);
  ASSERT_EQ(one.size(), 1u);
  EXPECT_TRUE(one[0].halo.empty());
  EXPECT_EQ(one[0].box, probes::TileBox());
  EXPECT_EQ(few.probes[63].name, "63");
  ProbeSet same = set_at(std::vector<vec3>(100, vec3(1, 2, 3)));
  EXPECT_GE(make_tiles(same, 10).size(), 10u);
  EXPECT_THAT(test::message_of([&] { make_tiles(few, 0); }), testing::HasSubstr("one probe at least"));
}

}  // namespace
}  // namespace ssphh::bake
