/// Light groups that are baked: drawn as traced, without passes and shadow maps of their own.

#include <gtest/gtest.h>

#include <ssphh/bake/light_modes.h>
#include <ssphh/bake/transport_bake.h>
#include <ssphh/place/init.h>
#include <ssphh/scene/builtin.h>

#include "gl_context.h"
#include "pictures.h"

namespace ssphh {
namespace {

using scene::LightMode;

constexpr test::PictureSize size{96, 54};

/// The court under its sky, with a bulb.
scene::Scene court() {
  scene::Scene scene = scene::make_builtin("court");
  scene::Light& bulb = scene.lights.emplace_back();
  bulb.name = "bulb";
  bulb.intensity = 0.4f;
  bulb.node = static_cast<int>(scene.nodes.size());
  scene.nodes.emplace_back().local.translation = {0.5f, 1.4f, 0.8f};
  scene::validate(scene);
  return scene;
}

/// A bake of the court with modes of its groups, bulb and sky, and what lists its records for pictures.
struct Bake {
  Bake(const std::vector<LightMode>& modes, int points, int rays) {
    const scene::Scene scene = court();
    const trace::TransportScene source(scene);
    bake::TransportBakeParams params;
    params.transport.directions = 512;
    params.transport.surfel_size = 0.2f;
    params.records = {.points = points, .rays = rays, .baked = bake::baked_indices(modes)};
    bake::TransportBakeReport report;
    set = bake::bake_transport(source, place::init_from_scene(scene, 4), params, report);
    bake::set_light_modes(source, set, modes);
    lists = test::listed(scene, set.surface->points, trace::PathTracer(scene));
  }
  probes::ProbeSet set;
  probes::SurfaceLists lists;
};

const Bake& sky_diffuse() {
  static const Bake bake({LightMode::realtime, LightMode::diffuse}, 2048, 256);
  return bake;
}

using BakedLight = test::WithGl;

struct Drawn {
  /// With `set`, whose records the lists are of.
  Drawn(gl::Context& gl, const probes::ProbeSet& set, const probes::SurfaceLists& lists)
      : scene(court()), renderer(gl, scene, test::small_maps) {
    renderer.set_probes(set);
    renderer.set_records(lists);
    renderer.set_record_light(set.surface->light);
  }
  image::Image picture(realtime::View view = realtime::View::lit) {
    realtime::FrameSettings settings;
    settings.weights = probes::WeightMethod::surface;
    settings.supersample = 2;
    settings.view = view;
    stats =
        renderer.draw(scene::camera_pose(scene, ""), settings, {.width = size.width, .height = size.height});
    return renderer.read_back();
  }

  scene::Scene scene;
  realtime::Renderer renderer;
  realtime::FrameStats stats;
};

/// Of the court, by paths.
const image::Image& truth_of_court() {
  static const image::Image truth = [] {
    const scene::Scene scene = court();
    trace::RenderParams params;
    params.width = size.width, params.height = size.height;
    params.camera = scene::camera_pose(scene, "");
    params.path = {.max_depth = 12, .passes = 1, .spp = 16, .seed = 1};  // 82,944 paths
    trace::RenderState state;
    trace::PathTracer(scene).render(params, state);
    return trace::resolve(state.color, state.passes_done);
  }();
  return truth;
}

void expect_drawn_as_traced(gl::Context& gl, const Bake& bake) {
  const scene::Scene scene = court();
  const image::Image drawn = Drawn(gl, bake.set, bake.lists).picture();
  const trace::PathTracer tracer(scene);
  const auto lookup = probes::make_lookup(probes::LookupSpec(), bake.set, tracer);
  const image::Image traced = test::traced(scene, lookup.get(), size, 16, 1, tracer),
                     &truth = truth_of_court();
  vec3 sums[3] = {vec3(0), vec3(0), vec3(0)};
  double off = 0;
  for (int y = 0; y < size.height; ++y) {
    for (int x = 0; x < size.width; ++x) {
      sums[0] += drawn.rgb(x, y), sums[1] += traced.rgb(x, y), sums[2] += truth.rgb(x, y);
      off += static_cast<double>(max_component(glm::abs(drawn.rgb(x, y) - traced.rgb(x, y))));
    }
  }
  for (glm::length_t c = 0; c < 3; ++c) {
    EXPECT_NEAR(sums[0][c] / sums[1][c], 1, 0.01) << "drawn and traced";
    EXPECT_NEAR(sums[0][c] / sums[2][c], 1, 0.02) << "and path traced";
  }
  EXPECT_LT(off / static_cast<double>(max_component(sums[1])), 0.02);
}

TEST_F(BakedLight, IsDrawnAsItIsTraced) {
  expect_drawn_as_traced(gl(), Bake({LightMode::realtime, LightMode::baked}, 2048, 256));
}

TEST_F(BakedLight, OfADiffuseSkyIsDrawnAsItIsTraced) {
  expect_drawn_as_traced(gl(), sky_diffuse());
}

TEST_F(BakedLight, OfADiffuseSkyIsSampledWhereRecordsDoNotLight) {
  probes::ProbeSet undone = sky_diffuse().set;
  undone.light_groups[1].mode = LightMode::realtime;
  probes::merge_groups(undone);
  Drawn some(gl(), sky_diffuse().set, sky_diffuse().lists), all(gl(), undone, sky_diffuse().lists);
  const auto drawn = [](Drawn& by, probes::WeightMethod weights, bool indirect) {
    realtime::FrameSettings settings;
    settings.weights = weights;
    settings.indirect = indirect;
    by.renderer.draw(scene::camera_pose(by.scene, ""), settings,
                     {.width = size.width, .height = size.height});
    return by.renderer.read_back();
  };
  const auto mean = [](const image::Image& image) {
    double sum = 0;
    for (const float v : image.pixels) sum += static_cast<double>(v);
    return sum / static_cast<double>(image.pixels.size());
  };
  // By probes, and of direct light alone, both are the same picture
  for (const auto& [weights, indirect] :
       {std::pair(probes::WeightMethod::mls, true), std::pair(probes::WeightMethod::surface, false)}) {
    const image::Image a = drawn(some, weights, indirect), b = drawn(all, weights, indirect);
    for (std::size_t i = 0; i < a.pixels.size(); ++i) ASSERT_NEAR(a.pixels[i], b.pixels[i], 1e-4f);
  }
  // By records they differ by what 32 directions miss, and no light is there twice or not at all
  const image::Image kept = drawn(some, probes::WeightMethod::surface, true),
                     sampled = drawn(all, probes::WeightMethod::surface, true);
  EXPECT_NEAR(mean(kept) / mean(sampled), 1, 0.04);
  EXPECT_NE(kept.pixels, sampled.pixels);
  // So it is while the set says that the sky is another than it was
  some.renderer.set_kept_light(undone);
  some.renderer.set_record_light(undone.surface->light);
  EXPECT_EQ(drawn(some, probes::WeightMethod::surface, true).pixels, sampled.pixels);
}

TEST_F(BakedLight, NeedsNoShadowMapsUntilItIsNotBaked) {
  const Bake of_sky({LightMode::realtime, LightMode::baked}, 256, 64);
  probes::ProbeSet set = of_sky.set;
  Drawn some(gl(), set, of_sky.lists);
  some.picture();
  const int with_baked = some.stats.shadow_maps_drawn;
  const image::Image direct = some.picture(realtime::View::direct);
  // The same probes, and the sky sampled again: its maps are drawn now.
  set.light_groups[1].mode = LightMode::realtime;
  probes::merge_groups(set);
  Drawn all(gl(), set, of_sky.lists);
  all.picture();
  constexpr int sky_maps = 32;  // RendererParams::environment_samples
  EXPECT_EQ(all.stats.shadow_maps_drawn - with_baked, sky_maps);
  some.renderer.set_probes(set);
  const image::Image direct_again = some.picture(realtime::View::direct);
  EXPECT_GE(some.stats.shadow_maps_drawn, sky_maps);
  // Direct light of surfaces was the bulb's alone.
  const image::Image of_all = all.picture(realtime::View::direct);
  double more = 0;
  for (std::size_t i = 0; i < of_all.pixels.size(); ++i) {
    EXPECT_GE(of_all.pixels[i], direct.pixels[i] - 1e-3f);
    more += static_cast<double>(of_all.pixels[i] - direct.pixels[i]);
    ASSERT_NEAR(direct_again.pixels[i], of_all.pixels[i], 1e-3f);
  }
  EXPECT_GT(more, 0);
  // Without the probes the sky must light again.
  some.renderer.set_probes(of_sky.set);
  some.renderer.clear_probes();
  const image::Image without = some.picture(realtime::View::direct);
  for (std::size_t i = 0; i < of_all.pixels.size(); ++i)
    ASSERT_NEAR(without.pixels[i], of_all.pixels[i], 1e-3f);
}

}  // namespace
}  // namespace ssphh
