/// The same bits: for any number of threads, and through interruption, saving and resuming.

#include <gtest/gtest.h>

#include <ssphh/core/parallel.h>

#include "hand_made.h"
#include "temp_dir.h"
#include "thread_count.h"

namespace ssphh::test {
namespace {

scene::Scene small_scene() {
  scene::Scene scene;
  add_room(scene, lambertian(vec3(0.6f, 0.5f, 0.4f)));
  add_object(scene, scene::make_sphere(0.4f, 16, 8), scene::Material{}, "ball");
  add_light(scene, scene::LightType::sphere, 3, vec3(0.6f), vec3(0, -1, 0), "globe").radius = 0.1f;
  add_light(scene, scene::LightType::point, 1, vec3(-0.6f), vec3(0, -1, 0), "bulb");
  return scene;
}

trace::RenderParams small_view(int passes) {
  trace::RenderParams params;
  params.width = 40, params.height = 30;
  params.camera.world = look_at(vec3(0.7f, 0.3f, 0.9f), vec3(0));
  params.path = {3, passes, 3, 9};
  params.per_group = true;
  return params;
}

void expect_same(const trace::RenderState& a, const trace::RenderState& b) {
  EXPECT_EQ(a.passes_done, b.passes_done);
  EXPECT_EQ(a.paths, b.paths);
  EXPECT_EQ(a.rays, b.rays);
  EXPECT_EQ(a.color.pixels, b.color.pixels);
  EXPECT_EQ(a.direct.pixels, b.direct.pixels);
  EXPECT_EQ(a.indirect.pixels, b.indirect.pixels);
  EXPECT_EQ(a.albedo.pixels, b.albedo.pixels);
  EXPECT_EQ(a.normal.pixels, b.normal.pixels);
  EXPECT_EQ(a.depth.pixels, b.depth.pixels);
  EXPECT_EQ(a.coverage.pixels, b.coverage.pixels);
  ASSERT_EQ(a.groups.size(), b.groups.size());
  for (std::size_t g = 0; g < a.groups.size(); ++g) EXPECT_EQ(a.groups[g].pixels, b.groups[g].pixels);
}

TEST(Determinism, OneThreadAndTwoGiveTheSameImage) {
  const scene::Scene scene = small_scene();
  trace::RenderState one, two;
  {
    const Threads threads(1);
    one = render(scene, small_view(2));
  }
  {
    const Threads threads(2);
    two = render(scene, small_view(2));
  }
  EXPECT_GT(mean_of(one.color), 0.01);
  expect_same(one, two);
}

TEST(Determinism, OneThreadAndTwoGiveTheSameCubes) {
  const scene::Scene scene = small_scene();
  const trace::PathTracer tracer(scene);
  const rays::CubeRequest request{vec3(0.1f, 0.6f, 0.2f), 8, {2, 2, 4, 3}};
  const std::vector<rays::GhostSphere> ghosts{{vec3(0.5f, 0.5f, 0), 0.05f}, {vec3(-0.5f, 0.6f, 0), 0.3f}};
  std::vector<rays::GroupRadiance> gen[2];
  std::vector<image::CubeMap> viz[2];
  std::vector<vec3> sums[2];
  for (int t = 0; t < 2; ++t) {
    const Threads threads(t + 1);
    gen[t] = tracer.incident_radiance(request, {});
    sums[t].resize(rays::RadianceSource::ghost_chunk_count);
    viz[t] = tracer.ghost_radiance(
        request, ghosts,
        [&, t](int chunk, const rays::GhostPath& path) { sums[t][chunk] += path.throughput; }, {});
  }
  for (std::size_t f = 0; f < 6; ++f) {
    for (std::size_t g = 0; g < gen[0].size(); ++g) {
      EXPECT_EQ(gen[0][g].emitted.faces[f].pixels, gen[1][g].emitted.faces[f].pixels);
      EXPECT_EQ(gen[0][g].reflected.faces[f].pixels, gen[1][g].reflected.faces[f].pixels);
    }
    for (std::size_t g = 0; g < ghosts.size(); ++g)
      EXPECT_EQ(viz[0][g].faces[f].pixels, viz[1][g].faces[f].pixels);
  }
  EXPECT_EQ(sums[0], sums[1]);
}

TEST(Determinism, SavedAndResumedRenderEqualsAnUninterruptedOne) {
  const scene::Scene scene = small_scene();
  const TempDir folder;
  const trace::RenderParams whole = small_view(4), half = small_view(2);
  const trace::RenderState uninterrupted = render(scene, whole);
  const trace::RenderState first = render(scene, half);
  EXPECT_EQ(first.key, uninterrupted.key) << "the key does not depend on the number of passes";
  trace::save_state(first, folder / "state");
  trace::RenderState resumed = trace::load_state(folder / "state", first.key);
  expect_same(first, resumed);
  trace::PathTracer(scene).render(whole, resumed);
  expect_same(uninterrupted, resumed);
}

/// Asks for a stop when a number of paths is done.
class StopAfter : public Progress {
 public:
  StopAfter(CancelToken& token, std::uint64_t paths) : token_(token), paths_(paths) {}
  void begin(const std::string&, std::uint64_t, const std::string&) override {}
  void advance(std::uint64_t count) override {
    if ((done_ += count) >= paths_) token_.request();
  }
  void end() override {}

 private:
  CancelToken& token_;
  std::uint64_t paths_;
  std::atomic<std::uint64_t> done_{0};
};

TEST(Determinism, CancelledRenderKeepsFinishedPassesAndContinues) {
  const scene::Scene scene = small_scene();
  const trace::PathTracer tracer(scene);
  const trace::RenderParams params = small_view(4);
  CancelToken token;
  StopAfter stop(token, 40 * 30 * 3 * 5 / 2);  // in the middle of the third pass
  trace::RenderState state;
  EXPECT_THROW(tracer.render(params, state, {&stop, &token}), Cancelled);
  EXPECT_EQ(state.passes_done, 2);
  trace::RenderState two = render(scene, small_view(2));
  EXPECT_EQ(state.color.pixels, two.color.pixels);
  tracer.render(params, state);
  EXPECT_EQ(state.passes_done, 4);
  EXPECT_EQ(state.color.pixels, render(scene, params).color.pixels);
}

TEST(Determinism, CancelledCubeThrows) {
  const scene::Scene scene = small_scene();
  CancelToken token;
  token.request();
  EXPECT_THROW(trace::PathTracer(scene).incident_radiance({vec3(0, 0.7f, 0), 16, {}}, {nullptr, &token}),
               Cancelled);
}

TEST(Determinism, OtherSeedsGiveOtherNoise) {
  trace::RenderParams params = small_view(1);
  const trace::RenderState a = render(small_scene(), params);
  params.path.seed = 10;
  const trace::RenderState b = render(small_scene(), params);
  EXPECT_NE(a.color.pixels, b.color.pixels);
  EXPECT_NE(a.key, b.key);
}

}  // namespace
}  // namespace ssphh::test
