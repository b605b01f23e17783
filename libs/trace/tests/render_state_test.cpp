#include <cstring>

#include <gtest/gtest.h>

#include <ssphh/core/file.h>

#include "hand_made.h"
#include "temp_dir.h"

namespace ssphh::test {
namespace {

trace::RenderState some_state() {
  scene::Scene scene;
  add_floor(scene, lambertian(vec3(0.5f)));
  add_light(scene, scene::LightType::point, 5, vec3(0, 2, 0));
  trace::RenderParams params = view_point(vec3(0), 1, 1);
  params.width = 3, params.height = 2, params.per_group = true;
  return render(scene, params);
}

TEST(RenderState, DamagedCheckpointsAreRefused) {
  const TempDir folder;
  const trace::RenderState state = some_state();
  trace::save_state(state, folder / "good");
  EXPECT_EQ(trace::load_state(folder / "good", state.key).color.pixels, state.color.pixels);
  const std::vector<std::byte> good = read_file(folder / "good");

  for (std::size_t length = 0; length < good.size(); length += 7) {
    write_file(folder / "bad", std::span(good).first(length));
    EXPECT_THROW(trace::load_state(folder / "bad", state.key), Error) << "truncated to " << length;
  }
  for (std::size_t i = 0; i < good.size(); i += 3) {
    std::vector<std::byte> flipped = good;
    flipped[i] ^= std::byte{1};
    write_file(folder / "bad", flipped);
    EXPECT_THROW(trace::load_state(folder / "bad", state.key), Error) << "bit flipped at " << i;
  }
}

TEST(RenderState, HostileSizesAreRefusedBeforeMemoryIsTaken) {
  // A header that asks for a million times a million pixels, with a correct checksum.
  const TempDir folder;
  const trace::RenderState state = some_state();
  trace::save_state(state, folder / "good");
  std::vector<std::byte> data = read_file(folder / "good");
  const std::int32_t huge = 1 << 20;
  std::memcpy(data.data() + 12, &huge, 4), std::memcpy(data.data() + 16, &huge, 4);
  Hasher hasher;
  hasher.bytes(std::span(data).first(data.size() - 16));
  const Hash128 hash = hasher.finish();
  std::memcpy(data.data() + data.size() - 16, &hash, 16);
  write_file(folder / "bad", data);
  EXPECT_THROW(trace::load_state(folder / "bad", state.key), Error);
}

TEST(RenderState, AnotherKeyIsRefused) {
  const TempDir folder;
  const trace::RenderState state = some_state();
  trace::save_state(state, folder / "state");
  EXPECT_THROW(trace::load_state(folder / "state", Hash128{1, 2}), Error);
}

TEST(RenderState, KeyDependsOnEverythingButPasses) {
  const Hash128 scene{3, 4};
  const trace::RenderParams base = view_point(vec3(0), 4, 3);
  const Hash128 key = trace::render_key(scene, 0, base);
  const auto changed = [&](auto change) {
    trace::RenderParams p = base;
    change(p);
    return trace::render_key(scene, 0, p) != key;
  };
  EXPECT_FALSE(changed([](auto& p) { p.path.passes = 99; }));
  EXPECT_TRUE(changed([](auto& p) { p.path.spp = 5; }));
  EXPECT_TRUE(changed([](auto& p) { p.path.max_depth = 5; }));
  EXPECT_TRUE(changed([](auto& p) { p.path.seed = 77; }));
  EXPECT_TRUE(changed([](auto& p) { p.width = 5; }));
  EXPECT_TRUE(changed([](auto& p) { p.height = 5; }));
  EXPECT_TRUE(changed([](auto& p) { p.per_group = true; }));
  EXPECT_TRUE(changed([](auto& p) { p.projection = trace::Projection::equirect; }));
  EXPECT_TRUE(changed([](auto& p) { p.camera.camera.yheight = 5; }));
  EXPECT_TRUE(changed([](auto& p) { p.camera.world[3][1] += 0.5f; }));
  EXPECT_NE(trace::render_key(scene, 1, base), key);
  EXPECT_NE(trace::render_key({3, 5}, 0, base), key);
}

TEST(RenderState, StateOfAnotherSizeIsRefused) {
  scene::Scene scene;
  trace::RenderState state = some_state();
  EXPECT_THROW(trace::PathTracer(scene).render(view_point(vec3(0), 1, 1), state), Error);
}

TEST(RenderState, SenselessParametersAreErrors) {
  const scene::Scene scene;
  const trace::PathTracer tracer(scene);
  const auto fails = [&](auto change) {
    trace::RenderParams p = view_point(vec3(0), 1, 1);
    change(p);
    trace::RenderState state;
    EXPECT_THROW(tracer.render(p, state), Error);
    EXPECT_TRUE(state.color.empty());
  };
  fails([](auto& p) { p.width = 0; });
  fails([](auto& p) { p.width = p.height = 1 << 20; });
  fails([](auto& p) { p.path.max_depth = -1; });
  fails([](auto& p) { p.path.spp = 0; });
  fails([](auto& p) { p.path.passes = p.path.spp = 1 << 20; });
  fails([](auto& p) { p.camera.camera.yheight = 0; });
  fails([](auto& p) { p.camera.world[3][0] = NAN; });
  fails([](auto& p) { p.projection = trace::Projection::cube_strip; });
  fails([](auto& p) { p.projection = trace::Projection::pinhole, p.camera.camera.yfov = 4; });
  EXPECT_THROW(trace::PathTracer(scene, INFINITY), Error);
  EXPECT_THROW(tracer.incident_radiance({vec3(NAN), 4, {}}, {}), Error);
  EXPECT_THROW(tracer.incident_radiance({vec3(0), 0, {}}, {}), Error);
  EXPECT_THROW(
      tracer.ghost_radiance({vec3(0), 4, {}}, std::vector<scene::GhostSphere>{{vec3(0), -1}}, nullptr, {}),
      Error);
}

TEST(RenderState, ResolveDividesByPasses) {
  image::Image sum(2, 1, 1);
  sum.pixels = {3, 6};
  EXPECT_EQ(trace::resolve(sum, 3).pixels, (std::vector<float>{1, 2}));
  EXPECT_EQ(trace::resolve(sum, 0).pixels, (std::vector<float>{0, 0}));
}

}  // namespace
}  // namespace ssphh::test
