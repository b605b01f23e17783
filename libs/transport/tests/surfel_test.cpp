/// Clustering of surface points against slow ways to say the same.

#include <algorithm>
#include <cmath>
#include <map>
#include <set>
#include <tuple>

#include <gtest/gtest.h>

#include <ssphh/core/error.h>
#include <ssphh/core/parallel.h>
#include <ssphh/core/random.h>
#include <ssphh/core/sphere.h>
#include <ssphh/scene/primitives.h>
#include <ssphh/transport/surfels.h>

#include "triangle_source.h"

namespace ssphh::transport {
namespace {

using test::TriangleSource;

void add(scene::Scene& scene, scene::Mesh mesh, bool movable = false) {
  scene.nodes.emplace_back().movable = movable;
  scene.meshes.push_back(std::move(mesh));
  scene::Instance instance;
  instance.mesh = static_cast<int>(scene.meshes.size()) - 1;
  instance.node = static_cast<int>(scene.nodes.size()) - 1;
  scene.instances.push_back(instance);
}

/// Two specks at the corners of [0, 4]³: bounds, and nothing in the way.
scene::Scene specks() {
  scene::Scene scene;
  add(scene, scene::make_quad({0, 0, 0}, {1e-4f, 0, 0}, {0, 1e-4f, 0}));
  add(scene, scene::make_quad({4, 4, 4}, {-1e-4f, 0, 0}, {0, -1e-4f, 0}));
  return scene;
}

/// A floor, [0, 4]² at y = 0, with a wall of the given height along x = 2.2.
scene::Scene walled_floor(float wall_height, bool movable = false) {
  scene::Scene scene;
  add(scene, scene::make_quad({0, 0, 4}, {4, 0, 0}, {0, 0, -4}));
  add(scene, scene::make_quad({2.2f, 0, 0}, {0, 0, 4}, {0, wall_height, 0}), movable);
  return scene;
}

std::vector<ClusterPoint> random_points(int count, std::uint64_t seed) {
  Pcg32 random(seed);
  std::vector<ClusterPoint> points;
  for (int i = 0; i < count; ++i) {
    const vec3 position = 4.0f * random.uniform3();
    points.push_back({{position, sample_uniform_sphere(random.uniform2())}, random.uniform3()});
  }
  return points;
}

using Cell = std::tuple<int, int, int, int>;

/// The cell of a point as the header describes it: voxel of `size`, and the axis nearest to the normal. The
/// grid begins 2¼ voxels outside the bounds, which here begin at 0.
Cell cell_of(const rays::SurfacePoint& p, float size) {
  int axis = 0;
  for (int a = 1; a < 3; ++a) {
    if (std::abs(p.normal[a]) > std::abs(p.normal[axis])) axis = a;
  }
  const auto v = [&](int a) { return static_cast<int>(std::floor((p.position[a] + 2.25f * size) / size)); };
  return {v(0), v(1), v(2), 2 * axis + (p.normal[axis] < 0 ? 1 : 0)};
}

TEST(SurfelSet, OneSurfelPerVoxelAndMainDirectionWhereNothingBlocks) {
  const scene::Scene scene = specks();
  const TriangleSource source(scene);
  const std::vector<ClusterPoint> points = random_points(3000, 1);
  SurfelSet set(source, 0.5f);
  const std::vector<int> surfel = set.add(0, points);
  set.update_albedo();

  std::map<Cell, int> of_cell;
  std::map<int, std::pair<glm::dvec3, int>> albedo;
  for (std::size_t i = 0; i < points.size(); ++i) {
    const auto [known, fresh] = of_cell.try_emplace(cell_of(points[i].point, 0.5f), surfel[i]);
    ASSERT_EQ(known->second, surfel[i]) << "point " << i;
    auto& [sum, count] = albedo.try_emplace(surfel[i], glm::dvec3(0), 0).first->second;
    sum += glm::dvec3(points[i].albedo), ++count;
    if (!fresh) continue;
    const Surfel& made = set.surfels()[surfel[i]];
    EXPECT_EQ(made.point.position, points[i].point.position) << "its first point founds a surfel";
    EXPECT_EQ(made.part, 0);
  }
  EXPECT_EQ(of_cell.size(), set.count()) << "different cells have different surfels";
  for (const auto& [s, sum_and_count] : albedo) {
    const glm::dvec3 mean = sum_and_count.first / double(sum_and_count.second);
    for (glm::length_t c = 0; c < 3; ++c) EXPECT_NEAR(double(set.surfels()[s].albedo[c]), mean[c], 1e-6);
  }
  // Numbered by cell: the map runs through the cells in the order of their keys.
  int next = 0;
  for (const auto& [cell, s] : of_cell) EXPECT_EQ(s, next++);
}

TEST(SurfelSet, AThinWallBetweenPointsOfOneVoxelMakesTwoSurfels) {
  // Voxels of 1 m begin at −2.25: x 1.75…2.75, z 0.75…1.75 is one, and the wall at 2.2 divides it.
  const std::vector<ClusterPoint> points{{{{2.1f, 0, 1.5f}, {0, 1, 0}}, vec3(0.5f)},
                                         {{{2.3f, 0, 1.5f}, {0, 1, 0}}, vec3(0.5f)},
                                         {{{2.7f, 0, 1.2f}, {0, 1, 0}}, vec3(0.5f)},
                                         {{{1.8f, 0, 1.7f}, {0, 1, 0}}, vec3(0.5f)}};
  const scene::Scene walled = walled_floor(1), low = walled_floor(0.01f), moving = walled_floor(1, true);
  {
    const TriangleSource source(walled);
    SurfelSet set(source, 1);
    EXPECT_EQ(set.add(0, points), (std::vector<int>{0, 1, 1, 0}));
    // Later points join the surfel that they see, whichever call they come with.
    EXPECT_EQ(set.add(0, {{points[2], points[3]}}), (std::vector<int>{1, 0}));
    EXPECT_EQ(set.count(), 2u);
    EXPECT_EQ(set.members(0).size(), 3u);
    EXPECT_EQ(set.members(1).size(), 3u);
  }
  {
    // Sight passes 0.08 sizes above the surface.
    const TriangleSource source(low);
    SurfelSet set(source, 1);
    EXPECT_EQ(set.add(0, points), (std::vector<int>{0, 0, 0, 0}));
  }
  {
    // A part of its own does not divide what never moves.
    const TriangleSource source(moving);
    ASSERT_EQ(source.part_count(), 2);
    SurfelSet set(source, 1);
    EXPECT_EQ(set.add(0, points), (std::vector<int>{0, 0, 0, 0}));
    const int on_part = set.add(1, {{points[0]}})[0];
    EXPECT_EQ(on_part, 1) << "parts do not share surfels";
    EXPECT_EQ(set.surfels()[1].part, 1);
  }
}

TEST(SurfelSet, EveryMemberSeesItsRepresentative) {
  const scene::Scene scene = walled_floor(0.6f);
  const TriangleSource source(scene);
  SurfelSet set(source, 0.7f);
  Pcg32 random(3);
  std::vector<ClusterPoint> points;
  for (int i = 0; i < 400; ++i)
    points.push_back({{{4 * random.uniform(), 0, 4 * random.uniform()}, {0, 1, 0}}, vec3(0.5f)});
  const std::vector<int> surfel = set.add(0, points);
  std::set<int> left, right;
  for (std::size_t i = 0; i < points.size(); ++i) {
    const rays::RayQuery sight =
        SurfelSet::segment(set.surfels()[surfel[i]].point, set.surfels()[surfel[i]].height, points[i].point,
                           set.height(0, points[i].point));
    std::uint8_t blocked = 1;
    source.occluded(0, {&sight, 1}, {&blocked, 1});
    EXPECT_FALSE(blocked);
    (points[i].point.position.x < 2.2f ? left : right).insert(surfel[i]);
  }
  for (const int s : left) EXPECT_FALSE(right.contains(s)) << "surfel " << s << " reaches through the wall";
}

// The folds of a curtain: 3 cm between sheets, where sight within voxels of 1 m begins 8 cm above a surface.
TEST(SurfelSet, SheetsCloserThanTheLiftOfSightShareNoSurfel) {
  scene::Scene scene;
  add(scene, scene::make_quad({2.2f, 0, 0}, {0, 0, 4}, {0, 4, 0}));
  add(scene, scene::make_quad({2.23f, 0, 0}, {0, 0, 4}, {0, 4, 0}));
  const TriangleSource source(scene);
  SurfelSet set(source, 1);
  Pcg32 random(4);
  std::vector<ClusterPoint> points;
  for (int i = 0; i < 200; ++i) {
    const vec2 at = 4.0f * random.uniform2();
    for (const float x : {2.2f, 2.23f}) points.push_back({{{x, at.x, at.y}, {1, 0, 0}}, vec3(0.5f)});
  }
  const std::vector<int> surfel = set.add(0, points);
  const std::set<int> all(surfel.begin(), surfel.end());
  std::set<int> within;
  for (std::size_t i = 0; i < points.size(); i += 2) within.insert(surfel[i]);
  for (std::size_t i = 1; i < points.size(); i += 2) EXPECT_FALSE(within.contains(surfel[i])) << surfel[i];
  EXPECT_EQ(all.size(), 2 * within.size()) << "sheets alike are divided alike";
  for (const int s : within) {
    EXPECT_NEAR(set.surfels()[s].height, 0.015f, 1e-4f);
    for (const ClusterPoint& place : set.spread_samples(s, 4))
      EXPECT_NEAR(place.point.position.x, 2.2f, 1e-3f);
  }
}

TEST(SurfelSet, NumbersDependOnPointsAndCallsAlone) {
  const scene::Scene scene = walled_floor(0.6f);
  const TriangleSource source(scene);
  const std::vector<ClusterPoint> first = random_points(2000, 5), second = random_points(700, 6);
  std::vector<std::vector<int>> results;
  for (const int threads : {1, 2, 2}) {
    set_thread_count(threads);
    SurfelSet set(source, 0.4f);
    results.push_back(set.add(0, first));
    const std::size_t known = set.count();
    const std::vector<int> later = set.add(0, second);
    EXPECT_TRUE(std::any_of(later.begin(), later.end(), [&](int s) { return s < static_cast<int>(known); }));
    results.back().insert(results.back().end(), later.begin(), later.end());
  }
  set_thread_count(0);
  EXPECT_EQ(results[0], results[1]);
  EXPECT_EQ(results[1], results[2]);
}

TEST(SurfelSet, CandidatesAreTheOwnCellsThenThoseAroundByDistance) {
  const scene::Scene scene = walled_floor(0.6f);
  const TriangleSource source(scene);
  constexpr float size = 0.5f;
  SurfelSet set(source, size);
  Pcg32 random(8);
  std::vector<ClusterPoint> points;
  for (int i = 0; i < 800; ++i)
    points.push_back(
        {{{4 * random.uniform(), 0.3f * random.uniform(), 4 * random.uniform()}, {0, 1, 0}}, vec3(0.5f)});
  set.add(0, points);
  for (std::size_t i = 0; i < points.size(); i += 9) {
    const rays::SurfacePoint& x = points[i].point;
    const auto [cx, cy, cz, bin] = cell_of(x, size);
    std::vector<std::tuple<bool, float, int>> expected;
    std::vector<int> own;
    for (std::size_t s = 0; s < set.count(); ++s) {
      const rays::SurfacePoint& p = set.surfels()[s].point;
      const auto [sx, sy, sz, surfel_bin] = cell_of(p, size);
      if (surfel_bin != bin || std::max({std::abs(sx - cx), std::abs(sy - cy), std::abs(sz - cz)}) > 1)
        continue;
      const vec3 d = p.position - x.position;
      const bool around = sx != cx || sy != cy || sz != cz;
      expected.emplace_back(around, glm::dot(d, d), static_cast<int>(s));
      if (!around) own.push_back(static_cast<int>(s));
    }
    std::sort(expected.begin(), expected.end());
    std::vector<int> order;
    for (const auto& entry : expected) order.push_back(std::get<2>(entry));
    for (const std::size_t room :
         {order.size() + 1, order.size(), order.size() / 2, own.size(), std::size_t{1}}) {
      std::vector<int> nearest(room);
      const std::span<const int> found = set.candidates(0, x, nearest);
      EXPECT_EQ(std::vector<int>(found.begin(), found.end()),
                std::vector<int>(order.begin(),
                                 order.begin() + static_cast<std::ptrdiff_t>(std::min(room, order.size()))));
    }
    const auto cell = set.cell(0, x);
    EXPECT_EQ(std::vector<int>(cell.begin(), cell.end()), own) << "founded in ascending order here";
  }
  std::vector<int> room(4);
  EXPECT_TRUE(set.candidates(0, {{2, 0, 2}, {0, -1, 0}}, room).empty()) << "nothing faces down";
}

TEST(SurfelSet, SpreadMembersAreSpreadAsAllOfThem) {
  // Of three quarters of the points in a half of the surfel: so are the chosen, in both directions.
  const scene::Scene scene = specks();
  const TriangleSource source(scene);
  SurfelSet set(source, 8);
  std::vector<ClusterPoint> points;
  Pcg32 random(2);
  for (int i = 0; i < 48; ++i) {
    const float from = i % 4 == 0 ? 2 : 1;
    points.push_back({{{from + random.uniform(), 1, 1 + 2 * random.uniform()}, {0, 1, 0}}, vec3(0.5f)});
  }
  set.add(0, points);
  ASSERT_EQ(set.count(), 1u);
  for (const int wanted : {1, 2, 8, 16, 48, 60}) {
    const std::vector<ClusterPoint> chosen = set.spread_members(0, wanted);
    const auto count = static_cast<float>(chosen.size());
    ASSERT_EQ(chosen.size(), static_cast<std::size_t>(std::min(wanted, 48)));
    std::set<float> places;
    float beyond = 0, far = 0;
    for (const ClusterPoint& c : chosen) {
      const vec3& at = c.point.position;
      EXPECT_TRUE(std::ranges::any_of(points, [&](const ClusterPoint& p) { return p.point.position == at; }));
      places.insert(at.x), beyond += at.x > 2, far += at.z > 2;
    }
    EXPECT_EQ(places.size(), chosen.size());
    if (wanted < 8) continue;
    EXPECT_NEAR(beyond / count, 0.25f, 0.08f) << wanted;
    EXPECT_NEAR(far / count, 0.5f, 0.15f) << wanted;
  }
  SurfelSet same(source, 8);
  same.add(0, std::vector<ClusterPoint>(10, points[0]));
  EXPECT_EQ(same.spread_members(0, 8).size(), 1u) << "points in one place are one sample";
  SurfelSet line(source, 8);
  for (std::size_t i = 0; i < points.size(); ++i)
    points[i].point.position = {1 + 0.04f * static_cast<float>(i * 29 % 48), 1, 1};
  line.add(0, points);
  EXPECT_NEAR(line.spread_members(0, 1)[0].point.position.x, 1.96f, 0.05f)
      << "the middle of those it stands for";
}

TEST(SurfelSet, PlacesAreSpreadEvenlyOverWhatTheSurfelHasOfItsVoxel) {
  // The wall at x = 2.2 cuts voxels of 1 m in two; a surfel of the floor has one side of it.
  const scene::Scene scene = walled_floor(1);
  const TriangleSource source(scene);
  SurfelSet set(source, 1);
  for (const float side : {2.0f, 2.4f}) {
    const ClusterPoint founder{{{side, 1e-4f, 1.6f}, {0, 1, 0}}, vec3(0.5f)};
    const auto s = static_cast<std::size_t>(set.add(0, {&founder, 1})[0]);
    const std::vector<ClusterPoint> places = set.spread_places(static_cast<int>(s), 16);
    ASSERT_GE(places.size(), 6u) << "of 32 asked for over both sides";
    vec3 low(9), high(-9), sum(0);
    for (const ClusterPoint& place : places) {
      const vec3& at = place.point.position;
      EXPECT_EQ(at.x < 2.2f, side < 2.2f) << "beyond the wall";
      EXPECT_NEAR(at.y, 0, 1e-4f);
      EXPECT_EQ(set.cell(0, place.point)[0], set.cell(0, founder.point)[0]) << "in another voxel";
      low = glm::min(low, at), high = glm::max(high, at), sum += at;
    }
    // Voxels begin 2.25 sizes before the scene
    const vec2 from(side < 2.2f ? 1.75f : 2.2f, 0.75f + 0.0f), to(side < 2.2f ? 2.2f : 2.75f, 1.75f);
    const vec3 mean = sum / static_cast<float>(places.size());
    EXPECT_NEAR(mean.x, 0.5f * (from.x + to.x), 0.2f * (to.x - from.x));
    EXPECT_NEAR(mean.z, 0.5f * (from.y + to.y), 0.2f);
    EXPECT_GT(high.z - low.z, 0.6f);
  }
  EXPECT_EQ(set.spread_places(0, 3).size(), 3u);
}

TEST(SurfelSet, SamplesOfASheetAreEvenAndThoseOfPiecesWhereRaysArrive) {
  // A quarter of the points lies in the farther part of the voxel, from x = 1.25 to 1.75.
  constexpr int wanted = 16;
  const auto beyond = [](float other_height, bool points_on_other) {
    scene::Scene scene;
    add(scene, scene::make_quad({0, 0, 0}, {0, 0, 4}, {4, 0, 0}));
    if (other_height > 0) add(scene, scene::make_quad({1.25f, other_height, 0}, {0, 0, 4}, {2.75f, 0, 0}));
    // Voxels begin 2.25 sizes below this: one ends 5 cm above the sheet
    add(scene, scene::make_quad({0, -0.7f, 0}, {0, 0, 0.1f}, {0.1f, 0, 0}));
    const TriangleSource source(scene);
    SurfelSet set(source, 1);
    std::vector<ClusterPoint> points;
    Pcg32 random(6);
    for (int i = 0; i < 48; ++i) {
      const bool far = i % 4 == 3;
      const vec2 u = random.uniform2();
      const float y = far && points_on_other ? other_height : 0;
      points.push_back({{{(far && (y > 0 || other_height == 0) ? 1.27f : 0.77f) + 0.46f * u.x, y + 1e-5f,
                          1.8f + 0.9f * u.y},
                         {0, 1, 0}},
                        vec3(0.5f)});
    }
    const std::vector<int> surfel = set.add(0, points);
    EXPECT_EQ(surfel[0], surfel[3]) << "one surfel";
    const std::vector<ClusterPoint> samples = set.spread_samples(surfel[0], wanted);
    EXPECT_EQ(samples.size(), static_cast<std::size_t>(wanted));
    return std::ranges::count_if(samples, [](const ClusterPoint& c) { return c.point.position.x > 1.25f; });
  };
  EXPECT_NEAR(beyond(0, false), wanted / 2, 1) << "a sheet";
  EXPECT_NEAR(beyond(0.03f, true), wanted / 4, 1) << "a ledge in it";
  EXPECT_EQ(beyond(0.09f, false), 0) << "below a board that is closer than a tenth";
  EXPECT_NEAR(beyond(0.11f, false), wanted / 2, 1) << "below one that is not";
}

TEST(SurfelSet, AWallAtTheBoundsIsOneLayer) {
  // Hits on x = y = z = 0 and 4 with rounding errors: 4 / 0.5 leaves all six walls at the same place in
  // their voxels.
  const scene::Scene scene = specks();
  const TriangleSource source(scene);
  SurfelSet set(source, 0.5f);
  Pcg32 random(9);
  std::vector<ClusterPoint> points;
  for (int i = 0; i < 60000; ++i) {
    const int axis = i % 3;
    const bool high = i % 2;
    rays::SurfacePoint p{4.0f * random.uniform3(), vec3(0)};
    p.position[axis] = (high ? 4.0f : 0.0f) + 1e-6f * (random.uniform() - 0.5f);
    p.normal[axis] = high ? -1.0f : 1.0f;
    points.push_back({p, vec3(0.5f)});
  }
  set.add(0, points);
  EXPECT_EQ(set.count(), 6u * 9 * 9);
}

TEST(SurfelSet, RefusesSizesThatMakeNoVoxels) {
  const scene::Scene scene = specks();
  const TriangleSource source(scene);
  for (const float size : {0.0f, -1.0f, NAN, INFINITY, 4 / 40000.0f})
    EXPECT_THROW(SurfelSet(source, size), Error) << size;
  EXPECT_NO_THROW(SurfelSet(source, 4 / 30000.0f));
}

}  // namespace
}  // namespace ssphh::transport
