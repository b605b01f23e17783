/// Nodes move points as an independent computation in double precision does, and whole scenes turn and grow.

#include <ssphh/scene/query.h>

#include "geometry.h"
#include "property.h"
#include "random_scene.h"

namespace ssphh::scene {
namespace {

using namespace ssphh::test;
using glm::dvec3;

/// v + 2w(u × v) + 2u × (u × v), q = (w, u): no matrix.
dvec3 turned(const glm::dquat& q, const dvec3& v) {
  const dvec3 u(q.x, q.y, q.z), c = 2.0 * glm::cross(u, v);
  return v + q.w * c + glm::cross(u, c);
}

/// The point in world space, one node after the other.
dvec3 carried(const Scene& scene, int node, dvec3 p) {
  for (; node >= 0; node = scene.nodes[node].parent) {
    const Node& n = scene.nodes[node];
    if (n.matrix) {
      dvec3 sum((*n.matrix)[3]);
      for (int c = 0; c < 3; ++c) sum += p[c] * dvec3((*n.matrix)[c]);
      p = sum;
    } else {
      p = turned(glm::dquat(n.local.rotation), dvec3(n.local.scale) * p) + dvec3(n.local.translation);
    }
  }
  return p;
}

/// Without motion: animated nodes take their values from keys.
Scene still_scene(std::uint64_t seed) {
  Scene scene = random_scene(seed);
  scene.animations.clear();
  return scene;
}

double distance(const vec3& a, const dvec3& b) {
  return glm::distance(dvec3(a), b);
}

TEST(PoseProperty, MatricesMovePointsAsTheNodesDoOneByOne) {
  EXPECT_TRUE(for_all(seeds(), vectors3(-2, 2)).cases(60).holds([](std::uint64_t seed, const vec3& p) {
    const Scene scene = still_scene(seed);
    const std::vector<mat4> world = world_matrices(scene);
    double worst = 0;
    for (int n = 0; n < static_cast<int>(scene.nodes.size()); ++n) {
      const dvec3 expected = carried(scene, n, dvec3(p));
      const vec3 found(world[n] * vec4(p, 1));
      // Up to a dozen nested transforms, each of a handful of roundings; what cancels was at most 1e3 or so.
      worst = std::max(worst, distance(found, expected) / (10 + glm::length(expected)));
    }
    return at_most(worst, 1e-4);
  }));
}

TEST(PoseProperty, ARootThatTurnsMovesAndGrowsDoesSoToAllTriangles) {
  EXPECT_TRUE(for_all(seeds(), directions(), floats(0, 6), vectors3(-5, 5), floats(0.1f, 10))
                  .cases(60)
                  .holds([](std::uint64_t seed, const vec3& axis, float angle, const vec3& move, float size) {
                    Scene scene = still_scene(seed);
                    const auto before = scene::world_triangles(scene);
                    Transform root{move, glm::angleAxis(angle, axis), vec3(size)};
                    // Nodes without a parent hang on a new one.
                    for (Node& node : scene.nodes) ++node.parent;
                    scene.nodes.insert(scene.nodes.begin(), {"root", -1, root, {}, false});
                    for (Instance& instance : scene.instances) ++instance.node;
                    const auto after = scene::world_triangles(scene);
                    double worst = 0;
                    for (std::size_t t = 0; t < before.size(); ++t) {
                      for (std::size_t c = 0; c < 3; ++c) {
                        const dvec3 expected =
                            double(size) * turned(glm::dquat(root.rotation), dvec3(before[t][c])) +
                            dvec3(move);
                        worst = std::max(worst, distance(after[t][c], expected) /
                                                    (double(size) * (10 + glm::length(before[t][c])) + 5));
                      }
                    }
                    return at_most(worst, 1e-4);
                  }));
}

TEST(PoseProperty, BoundsHoldEveryTriangleAndNoMore) {
  EXPECT_TRUE(for_all(seeds(), floats(0, 4)).cases(40).holds([](std::uint64_t seed, float time) {
    const Scene scene = random_scene(seed);
    const Bounds bounds = world_bounds(scene, world_matrices(scene, time));
    vec3 low(INFINITY), high(-INFINITY);
    for (const auto& triangle : scene::world_triangles(scene, time)) {
      for (const vec3& p : triangle) low = glm::min(low, p), high = glm::max(high, p);
    }
    // The same products in the same order.
    return at_most(static_cast<double>(glm::distance(low, bounds.min) + glm::distance(high, bounds.max)),
                   1e-6 * static_cast<double>(glm::length(high - low)));
  }));
}

TEST(PoseProperty, TimeBeforeTheFirstKeyAndAfterTheLastIsTheirs) {
  EXPECT_TRUE(for_all(seeds(), floats(0, 100)).cases(40).holds([](std::uint64_t seed, float beyond) {
    Scene scene = random_scene(seed);
    for (AnimationChannel& c : scene.animations[0].channels) c.times = {1, 2, 3};
    const auto same = [&](float time, float key) {
      const std::vector<mat4> a = world_matrices(scene, time), b = world_matrices(scene, key);
      double worst = 0;
      for (std::size_t n = 0; n < a.size(); ++n) {
        for (int c = 0; c < 4; ++c)
          worst =
              std::max(worst, double(glm::distance(a[n][c], b[n][c])) / (1 + double(glm::length(b[n][c]))));
      }
      return worst;
    };
    if (animation_duration(scene) != 3) return at_most(1, 0) << ": duration";
    // Interpolation that ends at a key rounds.
    return at_most(std::max(same(1 - beyond, 1), same(3 + beyond, 3)), 1e-5);
  }));
}

}  // namespace
}  // namespace ssphh::scene
