/// Leaves of a tree of lights: found as often as it says, and each light in one of them.

#include "lights/light_tree.h"

#include <algorithm>
#include <cmath>
#include <limits>
#include <vector>

#include <gtest/gtest.h>

#include <ssphh/core/random.h>

namespace ssphh::shading::test {
namespace {

std::vector<LightTree::Light> random_lights(int count, Pcg32& random) {
  std::vector<LightTree::Light> lights;
  for (int i = 0; i < count; ++i) {
    const vec3 center = 20.0f * random.uniform3() * vec3(1, 0.2f, 3), size = random.uniform3();
    lights.push_back({{center - size, center + size}, std::exp(6 * random.uniform())});
  }
  return lights;
}

/// Share of even numbers for which choose() finds each light's leaf.
std::vector<double> frequencies(const LightTree& tree, std::size_t lights, const vec3& from, int count) {
  std::vector<double> found(lights, 0);
  for (int i = 0; i < count; ++i) {
    const auto choice = tree.choose(from, (static_cast<float>(i) + 0.5f) / static_cast<float>(count));
    EXPECT_GE(choice.u, 0);
    EXPECT_LT(choice.u, 1);
    for (const std::uint32_t light : choice.leaf.lights) found[light] += 1.0 / count;
  }
  return found;
}

TEST(LightTree, FindsLeavesAsOftenAsItSays) {
  Pcg32 random(3);
  for (const int count : {1, 16, 17, 40, 300}) {
    const std::vector<LightTree::Light> lights = random_lights(count, random);
    LightTree tree;
    tree.assign(lights);
    for (int place = 0; place < 4; ++place) {
      const vec3 from = 30.0f * random.uniform3();
      const int samples = 20000;
      const std::vector<double> found = frequencies(tree, lights.size(), from, samples);
      double all = 0;
      for (std::size_t i = 0; i < lights.size(); ++i) {
        const LightTree::Leaf leaf = tree.leaf_of(i, from);
        // Even numbers miss an interval's length by one of them at each end
        EXPECT_NEAR(found[i], static_cast<double>(leaf.probability), 2.0 / samples) << i << " of " << count;
        EXPECT_GT(leaf.probability, 0);
        EXPECT_LE(leaf.lights.size(), LightTree::most_in_leaf);
        EXPECT_EQ(std::ranges::count(leaf.lights, static_cast<std::uint32_t>(i)), 1);
        EXPECT_TRUE(std::ranges::is_sorted(leaf.lights));
        all += static_cast<double>(leaf.probability) / static_cast<double>(leaf.lights.size());
      }
      EXPECT_NEAR(all, 1, 1e-5);
    }
  }
}

TEST(LightTree, PassesTheNumberOnWithinALeaf) {
  Pcg32 random(4);
  const std::vector<LightTree::Light> lights = random_lights(40, random);
  LightTree tree;
  tree.assign(lights);
  const vec3 from(3, 1, 2);
  const LightTree::Leaf leaf = tree.leaf_of(7, from);
  std::vector<float> us;
  for (int i = 0; i < 10000; ++i) {
    const auto choice = tree.choose(from, (static_cast<float>(i) + 0.5f) / 10000);
    if (choice.leaf.lights.data() == leaf.lights.data()) us.push_back(choice.u);
  }
  ASSERT_GT(us.size(), 100u);
  EXPECT_TRUE(std::ranges::is_sorted(us));
  EXPECT_LT(us.front(), 2.0f / static_cast<float>(us.size()));
  EXPECT_GT(us.back(), 1 - 2.0f / static_cast<float>(us.size()));
}

TEST(LightTree, TakesTheNearAndTheStrong) {
  std::vector<LightTree::Light> lights;
  for (int i = 0; i < 20; ++i) {
    const vec3 place(i < 10 ? 0.0f : 10.0f, 0, static_cast<float>(i % 10) * 0.1f);
    lights.push_back({{place, place}, 1});
  }
  LightTree tree;
  tree.assign(lights);
  // Boxes of .9 m by themselves, whose centres are 1 and 9 m away
  const float near = tree.leaf_of(0, {1, 0, 0.45f}).probability;
  EXPECT_NEAR(near, 0.05f + 0.9f * 81 / 82, 1e-5f);
  EXPECT_NEAR(tree.leaf_of(19, {1, 0, 0.45f}).probability, 1 - near, 1e-6f);
  // Within a box no nearer than its radius
  EXPECT_NEAR(tree.leaf_of(0, {0, 0, 0.45f}).probability, 0.05f + 0.9f / (1 + 0.45f * 0.45f / 100), 1e-5f);
  for (int i = 10; i < 20; ++i) lights[i].power = 81;
  tree.assign(lights);
  EXPECT_NEAR(tree.leaf_of(0, {1, 0, 0.45f}).probability, 0.5f, 1e-5f);
}

TEST(LightTree, OfUselessLightsIsEmptyAndOfAFewFindsTheOthers) {
  LightTree tree;
  EXPECT_TRUE(tree.empty());
  tree.assign({});
  EXPECT_TRUE(tree.empty());
  const float nan = std::numeric_limits<float>::quiet_NaN(), inf = std::numeric_limits<float>::infinity();
  std::vector<LightTree::Light> lights(40, {{vec3(1), vec3(1)}, 0});
  for (int i = 0; i < 40; ++i) lights[i].power = i % 3 == 0 ? nan : i % 3 == 1 ? -1 : inf;
  tree.assign(lights);
  EXPECT_TRUE(tree.empty());
  // All at one place, one of them lit
  lights[33].power = 2;
  tree.assign(lights);
  EXPECT_FALSE(tree.empty());
  for (const float u : {0.0f, 0.5f, 0.999f})
    EXPECT_EQ(std::ranges::count(tree.choose(vec3(1), u).leaf.lights, 33u), 1);
  EXPECT_EQ(tree.leaf_of(33, vec3(1)).probability, 1);
}

}  // namespace
}  // namespace ssphh::shading::test
