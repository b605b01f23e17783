// The tree finds what a loop over all boxes finds.

#include "box_tree.h"

#include <set>

#include <gtest/gtest.h>

#include <ssphh/core/random.h>
#include <ssphh/core/sphere.h>

#include "sweep.h"

namespace ssphh::trace {
namespace {

std::vector<scene::Bounds> random_boxes(int count, Pcg32& random) {
  std::vector<scene::Bounds> boxes;
  for (int i = 0; i < count; ++i) {
    const vec3 center = 10.0f * random.uniform3();
    boxes.push_back({center - random.uniform3(), center + random.uniform3()});
  }
  return boxes;
}

std::set<std::uint32_t> visited(const BoxTree& tree, const Ray& ray) {
  std::set<std::uint32_t> found;
  tree.any(ray, ray.t_max, [&](std::uint32_t box) {
    EXPECT_TRUE(found.insert(box).second) << "visited twice";
    return false;
  });
  return found;
}

TEST(BoxTree, VisitsEveryBoxThatARayMeetsAndLeavesMostOthersOut) {
  Pcg32 random(3);
  for (const int count : {1, 2, 3, 7, 64, 500}) {
    const std::vector<scene::Bounds> boxes = random_boxes(count, random);
    const BoxTree tree(boxes);
    std::size_t met = 0, asked = 0;
    for (int i = 0; i < 200; ++i) {
      Ray ray{10.0f * random.uniform3(), sample_uniform_sphere(random.uniform2()), i % 2 ? 3.0f : 1e30f};
      if (i % 5 == 0) ray.direction[i % 3] = 0;
      if (i % 7 == 0) ray.origin = boxes[0].min, ray.direction = {0, -0.0f, 1};  // along two of its faces
      const std::set<std::uint32_t> found = visited(tree, ray);
      for (std::uint32_t b = 0; b < boxes.size(); ++b) {
        if (!sweep_meets(ray.origin, {ray.direction, ray.direction}, ray.t_max, boxes[b])) continue;
        EXPECT_TRUE(found.contains(b)) << "box " << b << " of " << count;
        ++met;
      }
      asked += found.size();
    }
    if (count >= 64) {
      EXPECT_LT(asked, 8 * met + 2000) << "of " << 200 * count;
    }
  }
}

TEST(BoxTree, EndsWhereItIsTold) {
  Pcg32 random(4);
  const BoxTree tree(random_boxes(100, random));
  const Ray ray{vec3(-5), glm::normalize(vec3(1)), 1e30f};
  ASSERT_GT(visited(tree, ray).size(), 3u);
  int asked = 0;
  EXPECT_TRUE(tree.any(ray, ray.t_max, [&](std::uint32_t) { return ++asked == 2; }));
  EXPECT_EQ(asked, 2);
  float t_max = ray.t_max;
  asked = 0;
  EXPECT_FALSE(tree.any(ray, t_max, [&](std::uint32_t) {
    t_max = 0, ++asked;
    return false;
  }));
  EXPECT_LE(asked, 2) << "a leaf's";
  EXPECT_FALSE(BoxTree().any(ray, t_max, [](std::uint32_t) { return true; }));
}

}  // namespace
}  // namespace ssphh::trace
