// Transfer from single virtual lights and clusters against closed forms and by property.

#include <algorithm>
#include <cmath>

#include <gtest/gtest.h>

#include <ssphh/core/random.h>
#include <ssphh/core/sphere.h>

#include "light_tree.h"

namespace ssphh::methods::vpl {
namespace {

Vpl light_at(const vec3& position, const vec3& normal, float radius = 0) {
  return {position, normal, vec3(1), radius};
}

std::vector<Vpl> random_lights(std::uint64_t seed, int count, float radius) {
  Pcg32 random(seed);
  std::vector<Vpl> lights;
  for (int i = 0; i < count; ++i) {
    lights.push_back({2.0f * random.uniform3() - 1.0f, sample_uniform_sphere(random.uniform2()),
                      random.uniform3(), radius * (0.5f + random.uniform())});
  }
  return lights;
}

TEST(VplTransfer, PointsFollowTheSquareLawAndTheBound) {
  const Receiver at{vec3(0), {0, 1, 0}};
  const Vpl light = light_at({0, 2, 0}, {0, -1, 0});
  EXPECT_FLOAT_EQ(transfer(at, light, {}), 0.25f);
  EXPECT_FLOAT_EQ(transfer(at, light, {VplKind::point, 4}), 1.0f / 16);
  EXPECT_EQ(transfer(at, light_at({0, 2, 0}, {0, 1, 0}), {}), 0) << "turned away";
  EXPECT_EQ(transfer(at, light_at({0, -2, 0}, {0, 1, 0}), {}), 0) << "below the horizon";
}

TEST(VplTransfer, SphereAheadIsTheIntegralOverItsCone) {
  // Both cosines are cos θ: 1/(π r²) 2π ∫ cos² θ sin θ dθ = 2 (1 − cos³ α) / 3 r².
  for (const float distance : {5.0f, 2.0f, 1.0f, 0.5f}) {
    const Receiver at{vec3(0), {0, 1, 0}};
    const Vpl light = light_at({0, distance, 0}, {0, -1, 0}, 0.5f);
    const double sine = std::min(0.5 / double(distance), 1.0), cosine = std::sqrt(1 - sine * sine);
    const double expected = 2 * (1 - cosine * cosine * cosine) / (3 * 0.25);
    // Four rings of midpoints: 1/64 is missing of cos² over a hemisphere.
    EXPECT_NEAR(double(transfer(at, light, {VplKind::sphere})) / expected, 1, 0.016) << distance;
  }
  // From afar it is a point.
  const Receiver at{vec3(0), {0, 1, 0}};
  const Vpl far = light_at({3, 9, 1}, glm::normalize(vec3(0, -1, 0.2f)), 0.45f);
  EXPECT_NEAR(double(transfer(at, far, {VplKind::sphere}) / unbounded_transfer(at, far)), 1, 0.01);
}

TEST(VplTransfer, ALobeIsNormalised) {
  // Radiance π all around, from lights on a sphere of unit radius that face inward, is reflected as itself.
  const Receiver at{vec3(0), {0, 1, 0}, 20, glm::normalize(vec3(1, 2, 0))};
  constexpr int count = 20000;
  double sum = 0;
  for (int i = 0; i < count; ++i) {
    const vec3 d = spherical_fibonacci(i, count);
    sum += double(transfer(at, light_at(d, -d), {})) * 4 * pi_d / count;
  }
  // The part of the lobe below the horizon is cut off: cos²¹ of 63°.
  EXPECT_NEAR(sum, 1, 1e-3);
}

TEST(LightTree, BoundsHoldForEveryLightOfACluster) {
  for (const auto& params : {VplParams{}, VplParams{VplKind::point, 0.4f}, VplParams{VplKind::sphere}}) {
    const std::vector<Vpl> lights = random_lights(1, 64, 0.1f);
    const std::vector<LightNode> tree = build_light_tree(lights);
    ASSERT_EQ(tree.size(), 2 * lights.size() - 1);
    // The lights below each node.
    std::vector<std::vector<int>> below(tree.size());
    for (std::size_t n = 0; n < tree.size(); ++n) {
      if (tree[n].left < 0) {
        below[n] = {tree[n].light};
        continue;
      }
      for (const int child : {tree[n].left, tree[n].right}) {
        const auto& part = below[child];
        below[n].insert(below[n].end(), part.begin(), part.end());
      }
      vec3 power(0);
      for (const int l : below[n]) power += lights[l].power;
      EXPECT_LT(glm::distance(power, tree[n].cluster.power), 1e-4f);
      EXPECT_NE(std::find(below[n].begin(), below[n].end(), tree[n].light), below[n].end());
    }
    EXPECT_EQ(below.back().size(), lights.size());

    Pcg32 random(2);
    for (int i = 0; i < 50; ++i) {
      const Receiver at{3.0f * random.uniform3() - 1.5f, sample_uniform_sphere(random.uniform2())};
      for (std::size_t n = 0; n < tree.size(); ++n) {
        const float bound = transfer_bound(at, tree[n].cluster, params);
        for (const int l : below[n]) ASSERT_LE(transfer(at, lights[l], params), bound * 1.0001f + 1e-6f);
      }
    }
  }
}

TEST(LightTree, BoundOfADistantClusterIsNear) {
  std::vector<Vpl> lights = random_lights(3, 16, 0);
  for (Vpl& light : lights) light.position *= 0.1f, light.normal = {0, -1, 0};
  const LightNode root = build_light_tree(lights).back();
  const Receiver at{{0, -5, 0}, {0, 1, 0}};
  EXPECT_NEAR(transfer_bound(at, root.cluster, {}), 1.0f / 25, 0.1f / 25);
}

}  // namespace
}  // namespace ssphh::methods::vpl
