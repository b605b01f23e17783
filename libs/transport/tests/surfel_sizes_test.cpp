/// How large surfels are, against the header's words by brute force, and sets of surfels of several sizes.

#include <array>
#include <cmath>
#include <map>
#include <set>

#include <gtest/gtest.h>

#include <ssphh/core/random.h>
#include <ssphh/core/sphere.h>
#include <ssphh/scene/primitives.h>
#include <ssphh/transport/surfels.h>

#include "triangle_source.h"

namespace ssphh::transport {
namespace {

using test::TriangleSource;

void add_quad(scene::Scene& scene, const vec3& corner, const vec3& u, const vec3& v) {
  scene.nodes.emplace_back();
  scene.meshes.push_back(scene::make_quad(corner, u, v));
  scene::Instance& instance = scene.instances.emplace_back();
  instance.mesh = static_cast<int>(scene.meshes.size()) - 1;
  instance.node = static_cast<int>(scene.nodes.size()) - 1;
}

/// A floor of 2·`half` metres at y = 0.
scene::Scene plain(float half) {
  scene::Scene scene;
  add_quad(scene, {-half, 0, half}, {2 * half, 0, 0}, {0, 0, -2 * half});
  return scene;
}

TEST(SurfelSizes, OneSizeIsTheSameEverywhere) {
  const SurfelSizes sizes(0.3f);
  EXPECT_EQ(sizes.finest(), 0.3f);
  for (const vec3& place : {vec3(0), vec3(1e6f, 3, -7)}) EXPECT_EQ(sizes.level(place), 0);
  EXPECT_EQ(sizes.level(scene::Bounds{vec3(-1e5f), vec3(1e5f)}), 0);
  EXPECT_EQ(sizes.size(0), 0.3f);
  EXPECT_EQ(sizes.size(3), 2.4f);
}

TEST(SurfelSizes, DoubleWithTheDistanceOfProbesAndWithThatBetweenThem) {
  const std::vector<vec3> probes{{0, 0, 0}, {2, 0, 0}};
  const SurfelSizes sizes(0.1f, probes, 0.25f);
  EXPECT_EQ(sizes.level(vec3(0)), 2) << "0.4 is no more than a quarter of 2, 0.8 is";
  EXPECT_EQ(sizes.level(vec3(0, 1.9f, 0)), 2) << "nearer than probes are apart";
  EXPECT_EQ(sizes.level(vec3(10, 0, 0)), 4) << "1.6 is no more than a quarter of 8, 3.2 is";
  EXPECT_EQ(sizes.level(vec3(1e9f, 0, 0)), 16) << "6.6 km, however far";
  const SurfelSizes alone(0.1f, std::span(probes).first(1), 0.25f);
  EXPECT_EQ(alone.level(vec3(0)), 0);
  EXPECT_EQ(alone.level(vec3(0, 0, 3.3f)), 3);
}

TEST(SurfelSizes, AreHalvedNearLamps) {
  const std::vector<vec3> lamps{{0, 3, 0}, {20, 3, 0}};
  const SurfelSizes sizes(1.6f, lamps);
  EXPECT_EQ(sizes.usual(), 1.6f);
  const auto at = [&](const vec3& x) { return sizes.size(sizes.level(x)); };
  EXPECT_FLOAT_EQ(at({0, 3, 0.01f}), 0.4f) << "a quarter at least";
  EXPECT_FLOAT_EQ(at({0, 3, 1.59f}), 0.4f) << "half the distance is less than 0.8";
  EXPECT_FLOAT_EQ(at({19, 3, 0}), 0.4f);
  EXPECT_FLOAT_EQ(at({0, 0, 0}), 0.8f);
  EXPECT_FLOAT_EQ(at({0, 3, 3.3f}), 1.6f);
  EXPECT_FLOAT_EQ(at({1e6f, 0, 0}), 1.6f);
  EXPECT_EQ(sizes.size(sizes.level(scene::Bounds{vec3(-1), vec3(30)})), 1.6f) << "things that move";
  // Where probes rule, lamps do beside them, and surfels are halved once
  const std::vector<vec3> probes{{0, 3, 40}};
  const SurfelSizes far(0.1f, probes, 0.25f), lit(0.1f, probes, 0.25f, lamps);
  EXPECT_FLOAT_EQ(far.size(far.level(vec3(0, 3, 1))), 6.4f) << "no more than a quarter of 39";
  EXPECT_EQ(lit.usual(), 0.1f);
  EXPECT_FLOAT_EQ(lit.finest(), 0.05f);
  EXPECT_FLOAT_EQ(lit.size(lit.level(vec3(0, 3, 1))), 0.2f) << "no more than a quarter of 1";
  EXPECT_FLOAT_EQ(lit.size(lit.level_by_probes(vec3(0, 3, 1))), 6.4f) << "lamps left out";
  EXPECT_FLOAT_EQ(sizes.size(sizes.level_by_probes({0, 3, 0.01f})), 1.6f);
  EXPECT_TRUE(lit.grow());
  EXPECT_FALSE(sizes.grow());
  EXPECT_FLOAT_EQ(lit.size(lit.level(vec3(0, 3, 0.5f))), 0.1f);
  EXPECT_FLOAT_EQ(lit.size(lit.level(vec3(0, 3, 0.1f))), 0.05f) << "near the lamp";
  EXPECT_FLOAT_EQ(lit.size(lit.level(vec3(0, 3, 40))), 0.1f) << "near the probe";
  EXPECT_FLOAT_EQ(lit.size(lit.level(scene::Bounds{vec3(-1), vec3(1)})), 6.4f) << "things that move";
}

TEST(SurfelSizes, AreTheDoublingsThatTheHeaderTellsOf) {
  Pcg32 random(7);
  std::vector<vec3> probes;
  for (int i = 0; i < 40; ++i) probes.push_back(30.0f * random.uniform3());
  const float finest = 0.05f, share = 0.3f;
  const SurfelSizes sizes(finest, probes, share);
  const auto local_distance = [&](const vec3& x) {
    std::size_t nearest = 0;
    for (std::size_t i = 0; i < probes.size(); ++i)
      if (glm::distance(probes[i], x) < glm::distance(probes[nearest], x)) nearest = i;
    float apart = INFINITY;
    for (std::size_t i = 0; i < probes.size(); ++i)
      if (i != nearest) apart = std::min(apart, glm::distance(probes[i], probes[nearest]));
    return std::max(apart, glm::distance(probes[nearest], x));
  };
  std::set<int> levels;
  for (int i = 0; i < 3000; ++i) {
    const vec3 x = 120.0f * (random.uniform3() - 0.5f);
    const float wanted = share * local_distance(x);
    const int level = sizes.level(x);
    levels.insert(level);
    EXPECT_LE(sizes.size(level), std::max(wanted, finest) * 1.0001f);
    EXPECT_GT(sizes.size(level + 1), wanted * 0.9999f);
    const scene::Bounds box{x - 3.0f * random.uniform3(), x + 3.0f * random.uniform3()};
    EXPECT_LE(sizes.level(box), level) << "the box has the place inside";
  }
  EXPECT_GE(levels.size(), 4u);
}

TEST(SurfelSizes, TheEstimateIsTheSurfaceSeenOverTheVoxelsFace) {
  // A closed box of 4 m by 3 by 5, ten probes inside: 94 m² of walls, every point of which some probe sees.
  scene::Scene scene;
  for (const float side : {0.0f, 1.0f}) {
    add_quad(scene, {4 * side, 0, 0}, {0, 3, 0}, {0, 0, 5});
    add_quad(scene, {0, 3 * side, 0}, {4, 0, 0}, {0, 0, 5});
    add_quad(scene, {0, 0, 5 * side}, {4, 0, 0}, {0, 3, 0});
  }
  const TriangleSource source(scene);
  Pcg32 random(3);
  std::vector<vec3> probes;
  for (int i = 0; i < 10; ++i)
    probes.push_back(vec3(0.5f, 0.4f, 0.6f) + random.uniform3() * vec3(3, 2.2f, 3.8f));
  const ProbeGBuffer seen = trace_gbuffer(source, probes, 2000, {});
  EXPECT_NEAR(estimated_surfels(seen, SurfelSizes(0.25f)), 94 / 0.0625, 0.04 * 94 / 0.0625);
  EXPECT_NEAR(estimated_surfels(seen, SurfelSizes(0.5f)), 94 / 0.25, 0.04 * 94 / 0.25);
  // Few enough: the finest everywhere. Too many: a quarter, or fewer.
  EXPECT_EQ(sizes_within(seen, 0.25f, 2000).level(vec3(9)), 0);
  EXPECT_FALSE(sizes_within(seen, 0.25f, 2000).grow());
  const SurfelSizes grown = sizes_within(seen, 0.25f, 2000, {}, {}, true);
  EXPECT_TRUE(grown.grow());
  EXPECT_GT(grown.level(vec3(90)), 3);
  const SurfelSizes coarse = sizes_within(seen, 0.25f, 1200);
  EXPECT_GT(coarse.level(vec3(9)), 0);
  EXPECT_LE(estimated_surfels(seen, coarse), 300);
  // Wider lamps count only where surfels near them would be coarse
  const std::vector<vec3> lamps{{2, 1.5f, 2.5f}};
  EXPECT_EQ(sizes_within(seen, 0.25f, 2000, lamps).finest(), 0.0625f);
  EXPECT_EQ(sizes_within(seen, 0.25f, 2000, {}, lamps).finest(), 0.25f);
  EXPECT_EQ(sizes_within(seen, 0.25f, 1200, lamps).finest(), 0.25f);
  EXPECT_EQ(sizes_within(seen, 0.25f, 1200, {}, lamps).finest(), 0.125f);
}

TEST(SurfelSizes, APlainOfTenKilometresCostsLittleMoreThanOneOfAHundredMetres) {
  std::vector<vec3> probes;
  for (int i = 0; i < 60; ++i)
    probes.push_back({0.8f * static_cast<float>(i % 8), 1, 0.8f * static_cast<float>(i / 8)});
  std::map<float, double> count;
  for (const float half : {50.0f, 5000.0f}) {
    const scene::Scene scene = plain(half);
    const TriangleSource source(scene);
    const ProbeGBuffer seen = trace_gbuffer(source, probes, 4000, {});
    const SurfelSizes sizes = sizes_within(seen, 0.1f, 12000);
    count[half] = estimated_surfels(seen, sizes);
    EXPECT_LE(count[half], 3000);
    EXPECT_LE(sizes.level(vec3(2, 0, 2)), 3) << "still fine where the probes are";
  }
  EXPECT_GT(count[50], 2000) << "and not coarser than need be";
}

TEST(SurfelSet, SurfelsOfSeveralSizesAreNoWiderThanTheirVoxels) {
  const scene::Scene scene = plain(40);
  const TriangleSource source(scene);
  const std::vector<vec3> probes{{0, 1, 0}, {1, 1, 0}};
  SurfelSet set(source, SurfelSizes(0.2f, probes, 0.5f));
  Pcg32 random(11);
  std::vector<ClusterPoint> points;
  for (int i = 0; i < 20000; ++i) {
    const vec2 at = 80.0f * (random.uniform2() - 0.5f);
    points.push_back({{{at.x, 0, at.y}, {0, 1, 0}}, vec3(0.5f)});
  }
  const std::vector<int> surfel = set.add(0, points);
  std::set<int> levels;
  for (std::size_t i = 0; i < points.size(); ++i) {
    const Surfel& own = set.surfels()[surfel[i]];
    const vec3& position = points[i].point.position;
    EXPECT_EQ(own.level, set.level(0, position));
    const vec3 apart = glm::abs(own.point.position - position);
    EXPECT_LE(std::max(apart.x, apart.z), set.size(own.level) * 1.001f);
    levels.insert(own.level);
  }
  EXPECT_GE(levels.size(), 5u);

  // Across the border of two sizes neighbours are found, too: a point without a surfel in its own voxel.
  SurfelSet one(source, SurfelSizes(0.2f, probes, 0.5f));
  float border = 1;
  while (one.level(0, {border, 0, 0}) == one.level(0, vec3(1, 0, 0))) border += 0.01f;
  const ClusterPoint inside{{{border - 0.05f, 0, 0}, {0, 1, 0}}, vec3(0.5f)};
  const int inner = one.add(0, {&inside, 1})[0];
  const rays::SurfacePoint outside{{border + 0.05f, 0, 0}, {0, 1, 0}};
  EXPECT_NE(one.level(0, outside.position), one.surfels()[inner].level);
  EXPECT_TRUE(one.cell(0, outside).empty());
  std::array<int, 4> room;
  const std::span<const int> found = one.candidates(0, outside, room);
  EXPECT_EQ(std::vector<int>(found.begin(), found.end()), std::vector<int>{inner});
}

TEST(SurfelSet, AMovingPartHasOneSizeOfItsOwn) {
  scene::Scene scene = plain(4);
  add_quad(scene, {0, 0, 0}, {4, 0, 0}, {0, 4, 0});
  scene.nodes.back().movable = true;
  const TriangleSource source(scene);
  SurfelSet set(source, SurfelSizes(0.5f), {0, 2});
  std::vector<ClusterPoint> points;
  for (int i = 0; i < 400; ++i)
    points.push_back(
        {{{0.2f * static_cast<float>(i % 20), 0.2f * static_cast<float>(i / 20), 0}, {0, 0, 1}}, vec3(0.5f)});
  set.add(1, points);
  EXPECT_EQ(set.size(2), 2.0f);
  EXPECT_LE(set.count(), 9u) << "voxels of 2 m";
  for (const Surfel& surfel : set.surfels()) EXPECT_EQ(surfel.level, 2);
  EXPECT_EQ(set.lift(2), 4 * set.lift());
}

}  // namespace
}  // namespace ssphh::transport
