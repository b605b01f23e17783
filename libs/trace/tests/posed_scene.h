#pragma once

#include <gtest/gtest.h>

#include <ssphh/core/random.h>
#include <ssphh/core/sphere.h>

#include "posed_geometry.h"

namespace ssphh::test {

struct OwnGeometry {
  trace::ShadedGeometry shaded;
};

/// A scene's geometry at a time, ready for rays.
struct PosedScene : private OwnGeometry, trace::PosedGeometry {
  explicit PosedScene(const scene::Scene& scene, float time = 0,
                      std::uint64_t flatten_limit = trace::SceneGeometry::default_flatten_limit)
      : OwnGeometry{{std::make_shared<const trace::SceneGeometry>(scene, flatten_limit), scene}},
        trace::PosedGeometry(shaded, shaded.layout().poses(scene, time)) {}
};

/// Sends 3000 rays to a body of half size `scale` at `center` and new ones, half of them grazing, from what
/// they hit: adds to `rays` those that leave it, to `shadowed` those of them that hit something.
inline void count_shadowed(const PosedScene& scene, const vec3& center, float scale, std::uint64_t seed,
                           int& rays, int& shadowed) {
  trace::RayTask task;
  Pcg32 random(seed);
  for (int i = 0; i < 3000; ++i) {
    const vec3 from = center + 3 * scale * sample_uniform_sphere(random.uniform2());
    const vec3 target = center + 0.5f * scale * sample_uniform_sphere(random.uniform2());
    const vec3 direction = glm::normalize(target - from);
    trace::Hit hit;
    ASSERT_TRUE(scene.intersect({from, direction}, 0, task, hit));
    vec3 origin;
    const shading::Surface surface = scene.surface(hit, -direction, origin);
    const vec3& normal = surface.geometric_normal;
    vec3 out = Frame::around(normal).to_world(sample_cosine_hemisphere(random.uniform2()));
    if (i % 2) out = glm::normalize(out + 30.0f * (out - glm::dot(out, normal) * normal));
    if (!(glm::dot(out, normal) > 0)) continue;
    ++rays;
    trace::Hit again;
    shadowed += scene.intersect({origin, out}, 0, task, again);
  }
}

/// The scene as it stands at `time`, with nothing that could move: every node under none.
inline scene::Scene frozen(scene::Scene scene, float time) {
  const std::vector<mat4> world = scene::world_matrices(scene, time);
  scene.animations.clear();
  for (std::size_t i = 0; i < world.size(); ++i) scene.nodes[i].parent = -1, scene.nodes[i].matrix = world[i];
  return scene;
}

}  // namespace ssphh::test
