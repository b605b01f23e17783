/// Where detail is found, on scenes of a few triangles whose sky is told by brute force.

#include "../src/regions.h"

#include <algorithm>

#include <gtest/gtest.h>

#include <ssphh/place/lattice.h>
#include <ssphh/place/place.h>

#include "plain_scene.h"

namespace ssphh::place {
namespace {

bool holds(const scene::Bounds& box, const vec3& low, const vec3& high) {
  return glm::all(glm::lessThanEqual(box.min, low)) && glm::all(glm::greaterThanEqual(box.max, high));
}

TEST(Regions, AGroupOfBlocksOnAPlainIsOneHoweverFarThePlainReaches) {
  for (const float half : {100.0f, 1000.0f, 20000.0f}) {
    scene::Scene scene = plain(half);
    add_blocks(scene, {30, 0, -20});
    const Regions regions = detail_regions(SampledSource(scene), {});
    ASSERT_EQ(regions.boxes.size(), 1u) << half;
    EXPECT_TRUE(regions.open_rest);
    EXPECT_TRUE(holds(regions.boxes[0], {31, 0, -19}, {35, 1, -15})) << half << " m";
    EXPECT_LT(max_component(regions.boxes[0].max - regions.boxes[0].min), 80) << half << " m";
  }
}

TEST(Regions, TwoGroupsAreTwoTheLargerFirst) {
  scene::Scene scene = plain(500);
  add_blocks(scene, {-300, 0, 0});
  for (int i = 0; i < 8; ++i) add_blocks(scene, {200.0f + 6 * static_cast<float>(i), 0, 50});
  const Regions regions = detail_regions(SampledSource(scene), {});
  ASSERT_EQ(regions.boxes.size(), 2u);
  EXPECT_TRUE(holds(regions.boxes[0], {201, 0, 51}, {245, 1, 55}));
  EXPECT_TRUE(holds(regions.boxes[1], {-299, 0, 1}, {-295, 1, 5}));
  EXPECT_GT(volume_of(regions.boxes[0]), volume_of(regions.boxes[1]));
}

TEST(Regions, CountWhatStandsApartInThem) {
  for (const int rows : {1, 2, 4, 7}) {
    scene::Scene scene = plain(200);
    for (int i = 0; i < rows * rows; ++i) {
      const vec3 corner(20.0f * static_cast<float>(i % rows), 0, 20.0f * static_cast<float>(i / rows));
      add_blocks(scene, corner);
    }
    const auto houses = static_cast<std::size_t>(rows * rows);
    const Regions regions = detail_regions(SampledSource(scene), {});
    EXPECT_GE(regions.structures, houses - houses / 8) << rows;
    EXPECT_LE(regions.structures, houses) << rows;
  }
}

TEST(Regions, DoNotCountLampPosts) {
  scene::Scene scene = plain(200);
  add_blocks(scene, {0, 0, 0});
  for (int i = 0; i < 5; ++i) {
    const vec3 at(30.0f + 10 * static_cast<float>(i), 0, 30);
    add(scene, scene::make_box(at, at + vec3(0.1f, 1, 0.1f)));
  }
  EXPECT_EQ(detail_regions(SampledSource(scene), {}).structures, 1u);
}

TEST(Regions, WithoutDetailOrWithDetailEverywhereItIsTheWholeScene) {
  const scene::Scene bare = plain(10);
  const SampledSource source(bare);
  const Regions regions = detail_regions(source, {});
  ASSERT_EQ(regions.boxes.size(), 1u);
  EXPECT_EQ(regions.boxes[0].min, source.part_bounds(0).min);
  EXPECT_EQ(regions.boxes[0].max, source.part_bounds(0).max);
  EXPECT_FALSE(regions.open_rest);

  scene::Scene full = plain(10);
  for (int i = 0; i < 9; ++i)
    add_blocks(full, {-9 + 6 * static_cast<float>(i % 3), 0, -9 + 6 * static_cast<float>(i / 3)});
  EXPECT_FALSE(detail_regions(SampledSource(full), {}).open_rest);
  EXPECT_TRUE(detail_regions(SampledSource(scene::Scene{}), {}).boxes.empty());
}

TEST(Regions, DetailInAClosedHallTakesNothingFromTheHall) {
  // The same blocks within walls, and a low roof: the rest is a room, not the open.
  scene::Scene scene = plain(100);
  add_blocks(scene, {30, 0, -20});
  add(scene, scene::make_box({-100, -1, -100}, {100, 12, 100}));
  const SampledSource source(scene);
  const Regions regions = detail_regions(source, {});
  ASSERT_EQ(regions.boxes.size(), 1u);
  EXPECT_FALSE(regions.open_rest);
  EXPECT_EQ(regions.boxes[0].max, source.part_bounds(0).max);
}

TEST(Regions, RoomsInAHallAreARegionAndABodyThereIsNone) {
  // Rooms of 6 m by 6 by 2.5, walls of 0.2 m with a doorway, in a hall of a kilometre.
  scene::Scene scene;
  const auto hall = [&] {
    scene = {};
    for (const float side : {-500.0f, 500.0f}) {
      add(scene, scene::make_quad({side, -500, -500}, {0, 1000, 0}, {0, 0, 1000}));
      add(scene, scene::make_quad({-500, side, -500}, {1000, 0, 0}, {0, 0, 1000}));
      add(scene, scene::make_quad({-500, -500, side}, {1000, 0, 0}, {0, 1000, 0}));
    }
  };
  hall();
  for (const float x : {0.0f, 6.2f}) {
    add(scene, scene::make_box({x, -0.2f, 0}, {x + 6, 0, 6}));
    add(scene, scene::make_box({x, 2.5f, 0}, {x + 6, 2.7f, 6}));
    for (const float z : {0.0f, 5.8f}) add(scene, scene::make_box({x, 0, z}, {x + 6, 2.5f, z + 0.2f}));
    add(scene, scene::make_box({x, 0, 0}, {x + 0.2f, 2.5f, 6}));
    add(scene, scene::make_box({x + 5.8f, 0, 0}, {x + 6, 2.5f, 2.5f}));
    add(scene, scene::make_box({x + 5.8f, 0, 3.5f}, {x + 6, 2.5f, 6}));
  }
  const Regions rooms = detail_regions(SampledSource(scene), {});
  ASSERT_EQ(rooms.boxes.size(), 1u);
  EXPECT_TRUE(rooms.open_rest);
  EXPECT_TRUE(holds(rooms.boxes[0], {1, 0.2f, 1}, {11, 2.3f, 5}));
  EXPECT_LT(max_component(rooms.boxes[0].max - rooms.boxes[0].min), 40);

  // Enough blocks that the hall's own walls are few beside them.
  hall();
  add_blocks(scene, {0, 0, 0});
  add_blocks(scene, {6, 0, 0});
  const Regions body = detail_regions(SampledSource(scene), {});
  EXPECT_FALSE(body.open_rest);
  EXPECT_GT(max_component(body.boxes[0].max - body.boxes[0].min), 999);
}

TEST(Regions, ADividedPlainHasNoDetail) {
  // Thirty by thirty quads of the same direction beside the blocks.
  scene::Scene scene;
  for (int i = 0; i < 900; ++i)
    add(scene,
        scene::make_quad({static_cast<float>(i % 30) * 14 - 210, 0, static_cast<float>(i / 30) * 14 - 196},
                         {14, 0, 0}, {0, 0, -14}));
  add_blocks(scene, {30, 0, -20});
  const Regions regions = detail_regions(SampledSource(scene), {});
  EXPECT_TRUE(regions.open_rest);
  EXPECT_LT(max_component(regions.boxes[0].max - regions.boxes[0].min), 80);
}

/// Signs of two points each stand on the ground, of two, far from the 108 points of the blocks.
TEST(Regions, ATenthAsManyPointsOfOtherDirectionsIsFewAndMoreIsNot) {
  for (const int signs : {4, 5}) {
    scene::Scene scene = plain(100);
    add_blocks(scene, {30, 0, -20});
    for (int i = 0; i < signs; ++i)
      add(scene, scene::make_quad({-80, 2, 10 * static_cast<float>(i) - 60}, {0, 2, 0}, {0, 0, 2}));
    EXPECT_EQ(detail_regions(SampledSource(scene), {}).open_rest, signs == 4) << signs;
  }
}

/// The grid around the regions is as fine as it may be, by tenths, with no more places than it is given.
TEST(Regions, TheOpenRestHasAtMostFortyEightPlaces) {
  scene::Scene scene = plain(100);
  add_blocks(scene, {30, 0, -20});
  const SampledSource source(scene);
  PlaceParams params;
  params.spacing = 3;
  params.levels = 0;
  float widest = 0;
  for (const PlacedProbe& probe : place_probes(source, params).probes)
    widest = std::max(widest, probe.spacing);
  const auto places = [&](float spacing) {
    return lattice_places(widened(source.part_bounds(0), spacing), spacing);
  };
  EXPECT_LE(places(widest), 48);
  EXPECT_GT(places(0.89f * widest), 48);
}

/// Its walls are a few long triangles, far apart beside its width, and the plain's voxels as wide as it is
/// long across.
TEST(Regions, ATunnelIsOneWhateverItsUnit) {
  for (const float unit : {1.0f, 0.001f}) {
    const auto box = [&](const vec3& low, const vec3& high) {
      return scene::make_box(unit * low, unit * high);
    };
    scene::Scene scene;
    add(scene, scene::make_quad(unit * vec3(-40, 0, 910), unit * vec3(80, 0, 0), unit * vec3(0, 0, -950)));
    for (const float x : {-3.3f, 3.0f}) add(scene, box({x, 0, 0}, {x + 0.3f, 4, 870}));
    add(scene, box({-3.3f, 4, 0}, {3.3f, 4.3f, 870}));
    for (int i = 0; i < 20; ++i) {
      const float z = 20 + 42 * static_cast<float>(i);
      add(scene, box({-2.8f, 0.3f, z}, {-1.2f, 1.3f, z + 4}));
    }
    const SampledSource source(scene);
    const Regions regions = detail_regions(source, {});
    ASSERT_EQ(regions.boxes.size(), 1u) << unit;
    EXPECT_TRUE(regions.open_rest);
    EXPECT_TRUE(holds(regions.boxes[0], unit * vec3(-3, 0.5f, 20), unit * vec3(3, 3.5f, 850))) << unit;
    EXPECT_LT(regions.boxes[0].max.x, 8 * unit);
    PlaceParams params;
    params.spacing = 14 * unit;
    const std::vector<PlacedProbe> probes = place_probes(source, params).probes;
    const auto within = std::ranges::count_if(probes, [&](const PlacedProbe& probe) {
      return std::abs(probe.position.x) < 3 * unit && probe.position.y < 4 * unit;
    });
    EXPECT_GT(within, 60) << unit << ": of " << probes.size();
  }
}

}  // namespace
}  // namespace ssphh::place
