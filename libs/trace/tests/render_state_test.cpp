#include <cstring>

#include <gtest/gtest.h>

#include <ssphh/core/file.h>

#include "error_message.h"
#include "hand_made.h"
#include "memory_dir.h"
#include "render_fields.h"
#include "temp_dir.h"
#include "tracer_data.h"

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

TEST(RenderState, LayersAreItsImagesInTheirOrder) {
  trace::RenderState state;
  state.groups.resize(2);
  const std::vector<const image::Image*> images = {&state.color,    &state.direct,    &state.indirect,
                                                   &state.albedo,   &state.normal,    &state.depth,
                                                   &state.coverage, &state.groups[0], &state.groups[1]};
  std::vector<const image::Image*> found;
  for (const trace::RenderLayer layer : trace::render_layers()) {
    for (const image::Image& image : trace::images_of(std::as_const(state), layer)) found.push_back(&image);
    EXPECT_EQ(trace::images_of(state, layer).data(), trace::images_of(std::as_const(state), layer).data());
  }
  EXPECT_EQ(found, images);
  EXPECT_THROW(trace::images_of(state, static_cast<trace::RenderLayer>(8)), Error);
  const trace::RenderState rendered = some_state();
  for (const trace::RenderLayer layer : trace::render_layers())
    EXPECT_EQ(trace::images_of(rendered, layer)[0].channels, trace::channels_of(layer)) << name_of(layer);
}

TEST(RenderState, DamagedCheckpointsAreRefused) {
  const TempDir folder(memory_dir());
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

/// What is said of a checkpoint without pixels but with a correct checksum, whose head has `value` at a
/// place.
template <class Value>
std::string said_of_head(const TempDir& folder, std::size_t at, Value value, std::size_t floats = 0) {
  trace::RenderParams params = view_point(vec3(0), 1, 1);
  params.width = 0, params.height = 1;
  trace::RenderState state = trace::empty_state(params, 0);
  state.key = {3, 4};
  trace::save_state(state, folder / "head");
  std::vector<std::byte> data = read_file(folder / "head");
  std::memcpy(data.data() + at, &value, sizeof(value));
  data.resize(data.size() - sizeof(Hash128) + floats * sizeof(float));
  const Hash128 hash = Hasher().bytes(data).finish();
  data.resize(data.size() + sizeof(hash));
  std::memcpy(data.data() + data.size() - sizeof(hash), &hash, sizeof(hash));
  write_file(folder / "head", data);
  const std::string said = message_of([&] { trace::load_state(folder / "head", {3, 4}); });
  return said.substr(said.find(": ") == std::string::npos ? 0 : said.find(": ") + 2);
}

TEST(RenderState, HeadsAreWithinTheirLimits) {
  const TempDir folder(memory_dir());
  const auto number = [&](std::size_t at, std::int32_t value, std::size_t floats = 0) {
    return said_of_head(folder, at, value, floats);
  };
  const auto damaged = [](const std::string& problem) {
    return "not a usable render checkpoint: " + problem + " (remove it to start afresh)";
  };
  const std::string senseless = damaged("its header makes no sense"), size = damaged("its size is wrong");
  EXPECT_EQ(number(8, 1), "no error");
  EXPECT_EQ(number(8, 2), damaged("its version 2 is unknown"));
  EXPECT_EQ(number(0, 0), damaged("it does not begin as one"));
  EXPECT_EQ(number(12, 1, 17), "no error") << "seventeen floats for a pixel";
  for (const std::size_t floats : {16, 18}) EXPECT_EQ(number(12, 1, floats), size);
  EXPECT_EQ(number(16, 1 << 20), "no error");
  for (const std::int32_t height : {(1 << 20) + 1, -1}) EXPECT_EQ(number(16, height), senseless);
  EXPECT_EQ(number(12, 1 << 20), size);
  for (const std::int32_t width : {(1 << 20) + 1, -1}) EXPECT_EQ(number(12, width), senseless);
  EXPECT_EQ(number(20, 256), "no error");
  for (const std::int32_t groups : {257, -1}) EXPECT_EQ(number(20, groups), senseless);
  EXPECT_EQ(number(24, 7), "no error");
  EXPECT_EQ(number(24, -1), senseless);
  const std::string other =
      "the checkpoint belongs to another scene or other render parameters (remove it, or repeat the options "
      "it "
      "was made with)";
  for (const std::size_t at : {48, 56}) EXPECT_EQ(said_of_head(folder, at, std::uint64_t{7}), other);
}

TEST(RenderState, EveryCountAndImageIsLoadedAsItWasSaved) {
  const TempDir folder(memory_dir());
  trace::RenderState state = some_state();
  ASSERT_EQ(state.groups.size(), 1u);
  state.passes_done = 5, state.paths = (std::uint64_t{1} << 40) + 3,
  state.rays = (std::uint64_t{1} << 41) + 4;
  trace::save_state(state, folder / "state");
  const trace::RenderState back = trace::load_state(folder / "state", state.key);
  expect_same_fields(back, state);
  const std::vector<std::byte> whole = read_file(folder / "state");
  write_file(folder / "short", std::span(whole).first(64 + 15));
  EXPECT_TRUE(message_of([&] {
                trace::load_state(folder / "short", state.key);
              }).ends_with("checkpoint: the file is too short (remove it to start afresh)"));
}

TEST(RenderState, KeyHoldsEveryFieldOfItsParameters) {
  trace::RenderParams params = view_point(vec3(0), 4, 3);
  params.camera.camera.aspect = 1.5f;
  for (const bool orthographic : {false, true}) {
    params.camera.camera.orthographic = orthographic;
    expect_a_key_of_every_field(params,
                                [](const trace::RenderParams& p) {
                                  return trace::render_key({3, 4}, 0, p);
                                },
                                {{"tile", "a state of a part has the key of the whole"},
                                 {"path/passes", "a state is resumed to have more of them"},
                                 {"camera/camera/name", "for people"},
                                 {"camera/camera/node", "the pose is the camera's world matrix"},
                                 {"camera/camera/aspect", "a render's own size wins"}});
  }
}

TEST(RenderState, KeyHoldsSceneAndTime) {
  const trace::RenderParams params = view_point(vec3(0), 4, 3);
  expect_a_key_of_every_field(Hash128{3, 4},
                              [&](const Hash128& scene) { return trace::render_key(scene, 0.5f, params); });
  expect_a_key_of_every_field(0.5f, [&](float time) { return trace::render_key({3, 4}, time, params); });
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
  fails([](auto& p) { p.path.passes = -1; });
  fails([](auto& p) { p.path.passes = p.path.spp = 1 << 20; });
  fails([](auto& p) { p.path.passes = p.path.spp = 1 << 16; });
  fails([](auto& p) { p.camera.camera.yheight = 0; });
  fails([](auto& p) { p.camera.world[3][0] = NAN; });
  fails([](auto& p) { p.projection = trace::Projection::cube_strip; });
  fails([](auto& p) { p.projection = trace::Projection::pinhole, p.camera.camera.yfov = pi; });
  EXPECT_THROW(trace::PathTracer(scene, INFINITY), Error);
  EXPECT_THROW(tracer.incident_radiance({vec3(NAN), 4, {}}, {}), Error);
  EXPECT_THROW(tracer.incident_radiance({vec3(0), 0, {}}, {}), Error);
  EXPECT_THROW(
      tracer.ghost_radiance({vec3(0), 4, {}}, std::vector<rays::GhostSphere>{{vec3(0), -1}}, nullptr, {}),
      Error);
}

TEST(RenderState, TheLastSampleThatHasANumberIsAllowed) {
  // 65537 · 65535 = 2³² − 1; all passes are done already.
  const scene::Scene scene;
  trace::RenderParams params = view_point(vec3(0), 65535, 1);
  params.path.passes = 65537;
  trace::RenderState state = trace::empty_state(params, 0);
  state.passes_done = params.path.passes;
  EXPECT_NO_THROW(trace::PathTracer(scene).render(params, state));
}

TEST(RenderState, ImagesMayTakeEightGibibytesAndNotMore) {
  // 2³¹ floats.
  EXPECT_NO_THROW(trace::check_image_memory("here", std::uint64_t{1} << 30, 2));
  EXPECT_THROW(trace::check_image_memory("here", (std::uint64_t{1} << 30) + 1, 2), Error);
}

TEST(RenderState, ResolveDividesByPasses) {
  image::Image sum(2, 1, 1);
  sum.pixels = {3, 6};
  EXPECT_EQ(trace::resolve(sum, 3).pixels, (std::vector<float>{1, 2}));
  EXPECT_EQ(trace::resolve(sum, 0).pixels, (std::vector<float>{0, 0}));
}

}  // namespace
}  // namespace ssphh::test
