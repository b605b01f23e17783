#include "probe_volume/probe_grid.h"

#include <gtest/gtest.h>

#include <ssphh/core/error.h>
#include <ssphh/core/random.h>
#include <ssphh/scene/primitives.h>

#include "triangle_source.h"

namespace ssphh::methods::probe_volume {
namespace {

/// A room [0, 4] × [0, 2] × [0, 3] seen from inside, with a box in it or not.
scene::Scene room(bool box) {
  scene::Scene scene;
  const auto add = [&](scene::Mesh mesh) {
    scene.meshes.push_back(std::move(mesh));
    scene.nodes.emplace_back();
    scene.instances.push_back(
        {static_cast<int>(scene.meshes.size()) - 1, static_cast<int>(scene.nodes.size()) - 1, -1, ""});
  };
  add(scene::flipped(scene::make_box({0, 0, 0}, {4, 2, 3})));
  if (box) add(scene::make_box({0.5f, 0.3f, 0.5f}, {2.6f, 1.7f, 2.5f}));
  return scene;
}

float field(const vec3& p) {
  return 1 + 2 * p.x - p.y + 3 * p.z;
}

float blend(const GridWeights& weights, const ProbeGrid& grid, const vec3& at) {
  float sum = 0, ones = 0;
  const probes::ProbeWeights found = weights.at(at);
  for (const probes::ProbeWeight& w : found.used()) {
    EXPECT_GT(w.weight, 0);
    sum += w.weight * field(grid.positions[w.probe]);
    ones += w.weight;
  }
  EXPECT_NEAR(ones, 1, 1e-5f);
  return sum;
}

TEST(ProbeGrid, LinearFieldsAndTheNearestPointOutside) {
  const scene::Scene scene = room(false);
  const test::TriangleSource source(scene);
  const ProbeGrid grid = make_probe_grid(source, {.spacing = 0.5f}, {});
  const GridWeights weights(grid);
  EXPECT_EQ(grid.positions.size(), grid.probe.size());
  const vec3 low = grid.positions.front(), high = grid.positions.back();
  Pcg32 random(1);
  for (int i = 0; i < 500; ++i) {
    const vec3 at = vec3(6, 4, 5) * random.uniform3() - 1.0f;
    EXPECT_NEAR(blend(weights, grid, at), field(glm::clamp(at, low, high)), 1e-4f);
  }
}

TEST(ProbeGrid, NoProbesWithinBodies) {
  const scene::Scene scene = room(true);
  const test::TriangleSource source(scene);
  const ProbeGrid grid = make_probe_grid(source, {.spacing = 0.4f, .interest = {{3.5f, 1, 1.5f}}}, {});
  EXPECT_LT(grid.positions.size(), grid.probe.size());
  for (const vec3& p : grid.positions) {
    const bool inside = p.x > 0.5f && p.x < 2.6f && p.y > 0.3f && p.y < 1.7f && p.z > 0.5f && p.z < 2.5f;
    EXPECT_FALSE(inside);
  }
  const GridWeights weights(grid);
  Pcg32 random(2);
  for (int i = 0; i < 500; ++i) blend(weights, grid, vec3(4, 2, 3) * random.uniform3());
}

TEST(ProbeGrid, SpacingFromTheNumberOfPlaces) {
  const scene::Scene scene = room(false);
  const test::TriangleSource source(scene);
  for (const int places : {8, 100, 600}) {
    const auto found = static_cast<double>(make_probe_grid(source, {.places = places}, {}).probe.size());
    // A grid has whole numbers of places along its axes.
    EXPECT_GT(found, 0.4 * places);
    EXPECT_LE(found, 1.5 * places);
  }
  EXPECT_THROW(make_probe_grid(source, {.spacing = 0.01f}, {}), Error);
}

}  // namespace
}  // namespace ssphh::methods::probe_volume
