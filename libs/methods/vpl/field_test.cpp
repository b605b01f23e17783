/// Light gathered from few virtual lights, by hand.

#include "field.h"

#include <gtest/gtest.h>

#include "ray_source.h"

namespace ssphh::methods::vpl {
namespace {

using test::RaySource;
using test::surface_at;

const RaySource empty_space([](const vec3&, const vec3&) { return rays::RayHit{}; });
const rays::SurfacePoint up_facing{vec3(0), {0, 1, 0}};

/// Facing down from a height.
Vpl above(float height, const vec3& power, float x = 0) {
  return {{x, height, 0}, {0, -1, 0}, power, 0};
}

void expect_near(const vec3& actual, const vec3& expected, float relative = 1e-4f) {
  for (int c = 0; c < 3; ++c)
    EXPECT_NEAR(actual[c], expected[c], relative * expected[c] + 1e-7f) << "channel " << c;
}

TEST(VplField, SumsAllLightsHoweverManyRaysTheyTake) {
  // Heights 1, 2, 4 m in turn: power / π · 1 / h². More than one batch of 512 rays.
  const rays::PosedWorld surfaces(empty_space, 0);
  for (const int count : {1, 511, 512, 513, 1100}) {
    std::vector<Vpl> lights;
    vec3 expected(0);
    for (int i = 0; i < count; ++i) {
      const auto height = static_cast<float>(1 << i % 3);
      const vec3 power(1, i, 2);
      lights.push_back(above(height, power));
      expected += power / (pi * height * height);
    }
    const VplField field(lights, surfaces, {}, 0);
    expect_near(field.irradiance(up_facing), expected);
    EXPECT_EQ(field.mean_cut({&up_facing, 1}), count);
    EXPECT_EQ(field.bytes(), static_cast<std::size_t>(count) * sizeof(Vpl));
  }
}

TEST(VplField, LeavesOutWhatIsHiddenByRaysThatStartATenThousandthOfTheRadiusAbove) {
  float least_start = 1;
  const RaySource half([&](const vec3& p, const vec3& d) {
    least_start = std::min(least_start, p.y);
    return d.x > 0.5f ? surface_at(0.9f, d) : rays::RayHit{};
  });
  const rays::PosedWorld surfaces(half, 0);
  const std::vector<Vpl> lights{above(2, vec3(1, 2, 3)), above(2, vec3(7), 1), above(2, vec3(1, 0, 0), -1)};
  // From (∓1, 2) to the origin both cosines are 2 / √5, and 1 / r² is 1 / 5.
  const vec3 expected = (vec3(1, 2, 3) / 4.0f + vec3(4.0f / 25, 0, 0)) / pi;
  expect_near(VplField(lights, surfaces, {}, 0).irradiance(up_facing), expected);
  EXPECT_NEAR(least_start, 1e-4f * std::sqrt(3.0f), 1e-9f);
  expect_near(VplField(lights, surfaces, {}, 1e-6f).irradiance(up_facing), expected);
}

TEST(VplField, LosesWhatTheBoundTakesOfTheWholeLight) {
  const rays::PosedWorld surfaces(empty_space, 0);
  const std::vector<Vpl> lights{above(0.5f, vec3(1, 0, 0)), above(2, vec3(0, 1, 0))};
  // Straight ahead at 1 m is 1: of 4 and ¼ there stay 1 and ¼, weighed as luminance.
  const VplField field(lights, surfaces, {VplKind::point, 1}, 0);
  const double red = 0.2126, green = 0.7152;
  EXPECT_NEAR(field.lost_energy({&up_facing, 1}), 3 * red / (4 * red + green / 4), 1e-4);
  const std::vector<rays::SurfacePoint> two{up_facing, {{0, 0.6f, 0}, {0, 1, 0}}};
  // The second sees the other light alone, at 1.4 m.
  EXPECT_NEAR(field.lost_energy(two), 3 * red / (4 * red + green / 4 + green / 1.96), 1e-4);
  const rays::SurfacePoint away{vec3(0), {0, -1, 0}};
  EXPECT_EQ(field.lost_energy({&away, 1}), 0) << "darkness loses nothing";
  EXPECT_EQ(VplField(lights, surfaces, {}, 0).lost_energy(two), 0);
}

TEST(VplField, CutsCountWhatTheySplit) {
  const rays::PosedWorld surfaces(empty_space, 0);
  std::vector<Vpl> lights;
  for (int i = 0; i < 64; ++i) lights.push_back(above(100, vec3(1), 0.001f * static_cast<float>(i)));
  const VplField far(lights, surfaces, {}, 0.04f), exact(lights, surfaces, {}, 1e-9f);
  const std::vector<rays::SurfacePoint> points{up_facing, {vec3(0), {0, -1, 0}}};
  EXPECT_EQ(far.mean_cut({points.data(), 1}), 32) << "clusters of two are a 32nd of the light";
  EXPECT_EQ(far.mean_cut({points.data() + 1, 1}), 1) << "nothing can arrive";
  EXPECT_EQ(exact.mean_cut({points.data(), 1}), 64);
  EXPECT_EQ(exact.mean_cut(points), 32.5);
  EXPECT_EQ(exact.mean_cut({}), 0);
  EXPECT_EQ(exact.bytes(), 64 * sizeof(Vpl) + 127 * sizeof(LightNode));
  expect_near(exact.irradiance(up_facing), vec3(64 / (pi * 1e4f)), 1e-3f);
}

TEST(VplField, GlossyLobesNarrowWithRoughnessUpToTheSharpest) {
  const rays::PosedWorld surfaces(empty_space, 0);
  const vec3 r = glm::normalize(vec3(1, 3, 0));
  const auto reflected = [&](float roughness, const VplParams& params = {}) {
    return VplField({{{0, 2, 0}, {0, -1, 0}, vec3(1, 2, 3), 0}}, surfaces, params, 0)
        .glossy(up_facing, r, roughness);
  };
  const float cosine = 3 / std::sqrt(10.0f);
  const auto expected = [&](float n) {
    return (n + 1) / (2 * pi) * std::pow(cosine, n) / 4 / pi * vec3(1, 2, 3);
  };
  expect_near(reflected(1), expected(1));
  expect_near(reflected(0.95f), expected(1));
  expect_near(reflected(0.7f), expected(2 / (0.49f * 0.49f) - 2));
  expect_near(reflected(0.5f), expected(30));
  expect_near(reflected(0.2f), expected(100));
  expect_near(reflected(0), expected(100));
}

TEST(VplField, WhatALobeLeavesLessThanAThousandthOfDoesNotCount) {
  const rays::PosedWorld surfaces(empty_space, 0);
  for (const float share : {2e-3f, 5e-4f}) {
    // cos³⁰ = share
    const float cosine = std::pow(share, 1 / 30.0f), sine = std::sqrt(1 - cosine * cosine);
    const VplField field({{{2 * sine, 2 * cosine, 0}, {0, -1, 0}, vec3(1), 0}}, surfaces, {}, 0);
    const vec3 found = field.glossy(up_facing, {0, 1, 0}, 0.5f);
    if (share > 1e-3f)
      expect_near(found, vec3(31 / (2 * pi) * share * cosine / 4 / pi), 1e-2f);
    else
      EXPECT_EQ(found, vec3(0));
  }
}

TEST(VplField, RadiiReachToTheEighthNeighbour) {
  std::vector<Vpl> lights;
  for (int i = 0; i <= 20; ++i) lights.push_back(above(0, vec3(1), static_cast<float>(i)));
  set_radii(lights, 1.5f);
  EXPECT_EQ(lights[10].radius, 1.5f * 4);
  EXPECT_EQ(lights[0].radius, 1.5f * 8);
  EXPECT_EQ(lights[19].radius, 1.5f * 7);
  lights.resize(3);
  set_radii(lights, 1);
  EXPECT_EQ(lights[1].radius, 1) << "the farthest of fewer";
}

TEST(LightTree, ChildrenHoldWhatTheirParentSays) {
  // In pairs whose powers are as one to three.
  std::vector<Vpl> lights;
  for (int i = 0; i < 1024; ++i) {
    const bool strong = i % 2 == 1;
    lights.push_back(
        {vec3(i / 2, strong ? 0.01f : 0, 0), {0, 1, 0}, vec3(strong ? 3 : 1), strong ? 0.5f : 0.2f});
  }
  const std::vector<LightNode> tree = build_light_tree(lights);
  int pairs = 0, strong = 0;
  for (const LightNode& node : tree) {
    if (node.left < 0) {
      EXPECT_EQ(node.right, -1);
      EXPECT_EQ(node.cluster.spread, 0);
      continue;
    }
    const LightNode &l = tree[node.left], &r = tree[node.right];
    EXPECT_TRUE(node.light == l.light || node.light == r.light);
    EXPECT_EQ(node.cluster.least_radius, std::min(l.cluster.least_radius, r.cluster.least_radius));
    EXPECT_EQ(node.cluster.most_radius, std::max(l.cluster.most_radius, r.cluster.most_radius));
    if (l.left >= 0 || r.left >= 0) continue;
    ++pairs;
    strong += node.light % 2;
    EXPECT_EQ(l.light / 2, r.light / 2) << "lights that stand together";
    EXPECT_EQ(node.cluster.power, vec3(4));
  }
  EXPECT_EQ(pairs, 512);
  // Chosen by power: of a binomial distribution five deviations.
  EXPECT_NEAR(strong, 384, 5 * std::sqrt(512 * 0.75 * 0.25));
}

TEST(LightTree, IsSplitAcrossItsLongestEdgeInSpaceAndThenInDirection) {
  // Two heaps far apart, in each of which half of the lights face one way and half the other
  for (int apart = 0; apart < 3; ++apart) {
    for (int turned = 0; turned < 3; ++turned) {
      std::vector<Vpl> lights;
      for (int i = 0; i < 32; ++i) {
        vec3 position = 0.01f * vec3(i % 3, i % 5, i % 7), normal(0);
        position[apart] += i % 2 == 0 ? 0.0f : 8.0f;
        normal[turned] = i / 2 % 2 == 0 ? 1.0f : -1.0f;
        lights.push_back({position, normal, vec3(1), 0});
      }
      const std::vector<LightNode> tree = build_light_tree(lights);
      for (const int heap : {tree.back().left, tree.back().right}) {
        const scene::Bounds& bounds = tree[heap].cluster.bounds;
        EXPECT_LT(bounds.max[apart] - bounds.min[apart], 1) << "apart along axis " << apart;
        for (const int half : {tree[heap].left, tree[heap].right})
          EXPECT_LT(tree[half].cluster.spread, 0.1f) << "apart along " << apart << ", facing " << turned;
      }
    }
  }
}

TEST(LightTree, AClustersConeHoldsTheNormalsOfItsLights) {
  const std::vector<Vpl> lights{{vec3(0), {0, 1, 0}, vec3(1), 0},
                                {vec3(1, 0, 0), {0, 0.6f, 0.8f}, vec3(2), 0}};
  const VplCluster root = build_light_tree(lights).back().cluster;
  EXPECT_NEAR(root.spread, 0.5f * std::acos(0.6f) + 1e-3f, 1e-5f);
  EXPECT_NEAR(glm::dot(root.axis, glm::normalize(vec3(0, 1.6f, 0.8f))), 1, 1e-6f);
  EXPECT_EQ(root.bounds.max, vec3(1, 0, 0));
  std::vector<Vpl> three(3, lights[0]);
  three.push_back({vec3(1, 0, 0), {0, -1, 0}, vec3(2), 0});
  EXPECT_NEAR(build_light_tree(three).back().cluster.spread, pi + 1e-3f, 1e-3f) << "one of four looks back";
  const std::vector<Vpl> opposite{lights[0], {vec3(1, 0, 0), {0, -1, 0}, vec3(2), 0}};
  EXPECT_GE(build_light_tree(opposite).back().cluster.spread, pi / 2)
      << "any axis, and all that faces away from it";
}

}  // namespace
}  // namespace ssphh::methods::vpl
