/// Russian roulette on dark surfaces, where hardly a path survives and those that do must weigh much.

#include <array>

#include <gtest/gtest.h>

#include "hand_made.h"
#include "tracer_data.h"

namespace ssphh::test {
namespace {

/// The light of one path by depth.
struct ByDepth {
  std::array<vec3, 8> sums{};
  void add(int depth, int, const vec3& value, const vec3&) {
    if (depth < 8) sums[depth] += value;
  }
  void first_hit(const shading::Surface&, const vec3&, const trace::Ray&, const trace::Hit&) {}
};

// Scattered rays alone find depth d with ρ^d Le exactly, up to roulette.
TEST(Roulette, DarkGlowingRoomGivesTheGeometricSeriesAtEveryDepth) {
  constexpr int batches = 150, paths = 400;
  const vec3 albedo(0.15f, 0.1f, 0.06f), emission(1, 3, 7);
  scene::Scene scene;
  add_room(scene, lambertian(albedo, emission));
  const trace::TracerData data(std::make_shared<const trace::SceneGeometry>(scene), scene, 0);
  const trace::PathOptions options{1 << 20, true, trace::Strategy::bsdf_only};
  trace::RayTask task;
  std::array<std::array<Samples, 3>, 5> means;
  for (std::uint64_t batch = 0; batch < batches; ++batch) {
    ByDepth light;
    for (std::uint32_t s = 0; s < paths; ++s) {
      trace_path(data.geometry, data.emitters(), {vec3(0.1f, 0.2f, 0.3f), glm::normalize(vec3(1, 2, -3))},
                 {hash_combine(11, batch), s}, options, task, light);
    }
    for (std::size_t depth = 0; depth < means.size(); ++depth) {
      for (int c = 0; c < 3; ++c) means[depth][c].add(static_cast<double>(light.sums[depth][c]) / paths);
    }
  }
  // At depth 3 three paths of a thousand are left, 200 in all; at depth 4 some 30.
  for (std::size_t depth = 0; depth < means.size(); ++depth) {
    for (int c = 0; c < 3; ++c) {
      const double expected = static_cast<double>(emission[c]) *
                              std::pow(static_cast<double>(albedo[c]), static_cast<double>(depth));
      // Float sums of 400 equal numbers.
      EXPECT_TRUE(mean_is(means[depth][c], expected, {1e-3, 15}, 2e-5 * expected))
          << "depth " << depth << ", channel " << c;
    }
  }
}

// Depths 3 on are but a thousandth of the light here: seen apart, as the picture's difference to depth 2.
TEST(Roulette, BeginsAtDepthThreeAndNotBefore) {
  EXPECT_EQ(trace::roulette_depth, 3);
  scene::Scene scene;
  add_room(scene, lambertian(vec3(0.15f, 0.1f, 0.06f), vec3(1, 3, 7)));
  const trace::TracerData data(std::make_shared<const trace::SceneGeometry>(scene), scene, 0);
  const trace::PathOptions options{2, true, trace::Strategy::bsdf_only};
  trace::RayTask task;
  for (std::uint32_t s = 0; s < 1000; ++s) {
    ByDepth light;
    trace_path(data.geometry, data.emitters(), {vec3(0.1f, 0.2f, 0.3f), vec3(0, 0, 1)}, {7, s}, options, task,
               light);
    ASSERT_FLOAT_EQ(light.sums[2].x, 0.15f * 0.15f) << "path " << s;
  }
}

}  // namespace
}  // namespace ssphh::test
