/// From pieces of surface in voxels to what these show: patches, the light on them, where they gather.

#include "patches.h"

#include <gtest/gtest.h>

#include "error_message.h"
#include "expect_near.h"
#include "gather_points.h"
#include "given_light.h"
#include "inject.h"
#include "patch_light.h"
#include "ray_source.h"

namespace ssphh::methods::vct {
namespace {

using test::expect_near;
using test::RaySource;
using test::surface_at;

TEST(VctGrid, HasAVoxelOfMarginAndWholeBricks) {
  const VoxelGrid grid = make_grid({vec3(1, 2, 3), vec3(8, 4, 3.25f)}, 16);
  EXPECT_EQ(grid.voxel, 0.5f) << "7 m in 14 voxels";
  // 14 + 2, 4 + 2 and 1 + 2 voxels.
  EXPECT_EQ(grid.size, (Cell{16, 8, 4}));
  expect_near(grid.origin, vec3(4.5f - 4, 3 - 2, 3.125f - 1));
  EXPECT_EQ(grid.levels(), 3);
  EXPECT_EQ(grid.level_size(0), grid.size);
  EXPECT_EQ(grid.level_size(1), (Cell{8, 4, 4}));
  EXPECT_EQ(grid.level_size(2), (Cell{4, 4, 4}));
  expect_near(grid.to_grid(grid.to_world(vec3(1.5f, 2, 3))), vec3(1.5f, 2, 3));
  expect_near(grid.to_grid(vec3(1, 2, 3.25f)), vec3(1, 2, 2.25f));
  EXPECT_EQ(make_grid({vec3(0), vec3(6, 6, 2.5f)}, 8).size, (Cell{8, 8, 8})) << "2.5 + 2 need two bricks";
  EXPECT_EQ(make_grid({vec3(0), vec3(6, 6, 2)}, 8).size, (Cell{8, 8, 4}));
}

TEST(VctGrid, RefusesWhatIsNoGrid) {
  const scene::Bounds box{vec3(0), vec3(1)};
  for (const int resolution : {4, 12, 2048})
    EXPECT_NE(test::message_of([&] { make_grid(box, resolution); }).find("8 to 1024"), std::string::npos);
  EXPECT_EQ(make_grid(box, 8).resolution, 8);
  EXPECT_EQ(make_grid(box, 1024).resolution, 1024);
  EXPECT_THROW(make_grid({vec3(1), vec3(1)}, 8), Error);
  EXPECT_THROW(make_grid({}, 8), Error);
}

TEST(VctKeys, GiveBackTheirCell) {
  for (const Cell& cell : {Cell{0, 0, 0}, Cell{1, 2, 3}, Cell{1023, 0, 1023}, Cell{5, 1023, 7}})
    EXPECT_EQ(voxel_cell(voxel_key(cell)), cell);
  EXPECT_LT(voxel_key({1023, 0, 0}), voxel_key({0, 1, 0}));
  EXPECT_LT(voxel_key({0, 1023, 0}), voxel_key({0, 0, 1}));
  EXPECT_EQ(facing_side({1, -1, 0}, 0), 1) << "+x goes on to what is seen from −x";
  EXPECT_EQ(facing_side({1, -1, 0}, 1), 2);
  EXPECT_EQ(opposite(4), 5);
  EXPECT_EQ(opposite(3), 2);
}

TEST(VctMainSide, IsOfTheLongestAxisTheFirstOfEquals) {
  EXPECT_EQ(main_side({0.9f, 0.1f, 0}), 0);
  EXPECT_EQ(main_side({-0.9f, 0.1f, 0.2f}), 1);
  EXPECT_EQ(main_side({0.1f, 0.9f, 0}), 2);
  EXPECT_EQ(main_side({0.1f, -0.9f, 0.3f}), 3);
  EXPECT_EQ(main_side({0.1f, 0.2f, 0.9f}), 4);
  EXPECT_EQ(main_side({0.5f, 0.2f, -0.9f}), 5);
  EXPECT_EQ(main_side({-1, 1, 1}), 1);
  EXPECT_EQ(main_side({0, -1, 1}), 3);
}

Patch patch_at(const Cell& cell, const vec3& position, const vec3& normal, float area = 1) {
  Patch patch;
  patch.voxel = voxel_key(cell);
  patch.position = position;
  patch.normal = normal;
  patch.cover[main_side(normal)] = area;
  return patch;
}

TEST(VctGatherPoints, AreTheMeansOfEightVoxelsThatFaceOneWay) {
  const vec3 up(0, 1, 0), tilted(0.6f, 0.8f, 0);
  const std::vector<Patch> still{
      patch_at({2, 0, 0}, vec3(1, 0, 0), up, 3), patch_at({3, 1, 1}, vec3(5, 4, 0), tilted),
      patch_at({3, 1, 1}, vec3(7, 0, 0), -up), patch_at({4, 0, 0}, vec3(9, 0, 0), up)};
  const std::vector<Patch> moving{patch_at({3, 0, 0}, vec3(2, 2, 2), up, 4),
                                  patch_at({2, 2, 0}, vec3(8), up)};
  const GatherPoints gather = gather_points(still, moving);
  ASSERT_EQ(gather.points.size(), 4u);
  EXPECT_EQ(gather.of_still[0], gather.of_still[1]);
  EXPECT_EQ(gather.of_still[0], gather.of_moving[0]);
  const rays::SurfacePoint& mean = gather.points[gather.of_still[0]];
  expect_near(mean.position, (3.0f * vec3(1, 0, 0) + vec3(5, 4, 0) + 4.0f * vec3(2)) / 8.0f);
  expect_near(mean.normal, glm::normalize(7.0f * up + tilted));
  EXPECT_EQ(gather.points[gather.of_still[2]].normal, -up);
  EXPECT_EQ(gather.points[gather.of_still[3]].position, vec3(9, 0, 0));
  EXPECT_EQ(gather.points[gather.of_moving[1]].position, vec3(8));
}

TEST(VctByVoxel, JoinsWhatStaysAndWhatMoves) {
  const auto patches = [](const std::vector<VoxelKey>& keys) {
    std::vector<Patch> list(keys.size());
    for (std::size_t i = 0; i < keys.size(); ++i) list[i].voxel = keys[i];
    return list;
  };
  const std::vector<VoxelPatches> voxels = by_voxel(patches({3, 3, 7}), patches({1, 3, 9, 9}));
  const auto is = [&](std::size_t i, VoxelKey key, std::array<std::uint32_t, 4> range) {
    const VoxelPatches& v = voxels[i];
    EXPECT_EQ(v.voxel, key);
    EXPECT_EQ((std::array{v.still_begin, v.still_end, v.moving_begin, v.moving_end}), range) << key;
  };
  ASSERT_EQ(voxels.size(), 4u);
  is(0, 1, {0, 0, 0, 1}), is(1, 3, {0, 2, 1, 2}), is(2, 7, {2, 3, 2, 2}), is(3, 9, {3, 3, 2, 4});
  EXPECT_TRUE(by_voxel({}, {}).empty());
}

TEST(VctInject, ShowsToEachSideTheNearestPatchesUntilTheFaceIsCovered) {
  // Two sheets at heights 0.2 and 0.7 that face up, and a wall between them that faces −x.
  std::vector<Patch> still{patch_at({1, 2, 3}, {0, 0.2f, 0}, {0, 1, 0}, 0.8f),
                           patch_at({1, 2, 3}, {0.5f, 0, 0}, {-1, 0, 0}, 0.3f)};
  std::vector<Patch> moving{patch_at({1, 2, 3}, {0, 0.7f, 0}, {0, 1, 0}, 0.6f)};
  still[0].albedo = {1, 0.5f, 0}, still[1].albedo = vec3(0.5f), moving[0].albedo = vec3(0, 0, 1);
  still[0].cover[3] = 0.5f, moving[0].cover[3] = 1;
  const std::vector<vec3> on_still{vec3(pi), vec3(2 * pi)}, on_moving{vec3(3 * pi)};
  const VoxelGrid grid = make_grid({vec3(0), vec3(1)}, 8);
  const std::vector<VoxelKey> keys{voxel_key({1, 2, 3})};
  Pyramid pyramid(grid, Storage::sparse, keys);
  inject(by_voxel(still, moving), {still, on_still}, {moving, on_moving}, pyramid);
  const auto shows = [&](std::size_t side, const vec4& expected) {
    const vec4 found = pyramid.find(0, {1, 2, 3})->side[side];
    for (int c = 0; c < 4; ++c) EXPECT_NEAR(found[c], expected[c], 1e-5f) << side << ", " << c;
  };
  // From above the upper sheet first, and 0.4 of the lower; from below half of the lower first.
  shows(2, vec4(0.4f, 0.2f, 0.6f * 3, 1));
  shows(3, vec4(0.5f, 0.25f, 0.5f * 3, 1));
  shows(1, vec4(vec3(0.3f), 0.3f));
  for (const std::size_t dark : {0u, 4u, 5u}) shows(dark, vec4(0));
}

/// Three patches of one, two and no more than one sample.
PatchSet lit_set() {
  PatchSet set;
  set.patches.resize(3);
  set.samples = {{vec3(1, 0, 0)}, {vec3(2, 0, 0)}, {vec3(4, 0, 0)}, {vec3(8, 0, 0)}};
  set.patches[0].samples = 1;
  set.patches[1].first_sample = 1, set.patches[1].samples = 2;
  set.patches[2].first_sample = 3, set.patches[2].samples = 1;
  return set;
}

TEST(VctPatchLight, IsTheMeanOfAPatchsSamplesOfEachGroup) {
  const PatchSet set = lit_set();
  test::GivenLight light;
  light.at = [](int group, const rays::SurfacePoint& p) {
    return (group == 0 ? vec3(1, 2, 0) : vec3(0, 0, 1)) * p.position.x;
  };
  PatchLight on;
  on.reset(3, 2);
  EXPECT_EQ(on.bytes(), 6 * sizeof(vec3));
  std::vector<vec3> sum(3, vec3(99));
  on.sum(std::vector<vec3>(2, vec3(1)), sum);
  EXPECT_EQ(sum, std::vector<vec3>(3, vec3(0)));
  EXPECT_EQ(on.update(0, set, light), 4u);
  EXPECT_EQ(on.update(1, set, light), 4u);
  on.sum(std::vector<vec3>{vec3(2, 1, 1), vec3(10)}, sum);
  EXPECT_EQ(sum, (std::vector<vec3>{vec3(2, 2, 10), vec3(6, 6, 30), vec3(16, 16, 80)}));
}

TEST(VctPatchLight, IsAskedForAnewOnlyWhereABoxMayShadowIt) {
  const PatchSet set = lit_set();
  test::GivenLight light;
  light.at = [](int, const rays::SurfacePoint&) { return vec3(1); };
  PatchLight on;
  on.reset(3, 2);
  on.update(0, set, light), on.update(1, set, light);
  light.at = [](int, const rays::SurfacePoint&) { return vec3(5); };
  light.shadowed = [](int group, const rays::SurfacePoint& p, const scene::Bounds& box) {
    return group == 1 && p.position.x < box.max.x;
  };
  const std::vector<scene::Bounds> boxes{{vec3(0), vec3(0)}, {vec3(0), vec3(3, 0, 0)}}, none;
  EXPECT_EQ(on.update(1, set, light, &none), 0u);
  EXPECT_EQ(on.update(0, set, light, &boxes), 0u);
  EXPECT_EQ(on.update(1, set, light, &boxes), 3u) << "of the second patch both, for one of them";
  std::vector<vec3> sum(3);
  on.sum(std::vector<vec3>{vec3(0), vec3(1)}, sum);
  EXPECT_EQ(sum, (std::vector<vec3>{vec3(5), vec3(5), vec3(1)}));
}

}  // namespace
}  // namespace ssphh::methods::vct
