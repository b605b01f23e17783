/// Direct light alone, drawn and traced at depth 1: what a metal ball mirrors of the sky, a sun that moves.

#include <map>

#include <gmock/gmock.h>

#include <ssphh/scene/primitives.h>
#include <ssphh/scene/sun_sky.h>
#include <ssphh/scene/with_lighting.h>

#include "gl_context.h"
#include "picture_bounds.h"
#include "pictures.h"

namespace ssphh {
namespace {

using test::PictureSize;

class DirectLight : public test::WithGl {};

/// A ball in the open under a sky that grows dark downwards and has a window in it.
scene::Scene ball_under_sky() {
  scene::Scene s;
  s.materials.resize(1);
  s.meshes.push_back(scene::make_sphere(1, 96, 48));
  s.meshes[0].material = 0;
  scene::Instance ball;
  ball.mesh = 0;
  s.instances.push_back(ball);
  scene::Node eye;
  eye.local.translation = {0, 0, 3.4f};
  s.nodes.push_back(eye);
  s.cameras.emplace_back().node = 0;
  s.environment.emplace().equirect = image::Image(128, 64, 3);
  s.environment->rotation = 0.6f;
  for (int y = 0; y < 64; ++y) {
    for (int x = 0; x < 128; ++x) {
      const bool window = x > 78 && x < 100 && y > 14 && y < 30;
      const float up = 1 - static_cast<float>(y) / 64;
      s.environment->equirect.set_rgb(x, y, window ? vec3(6, 5, 3) : vec3(0.2f, 0.5f, 1) * up);
    }
  }
  scene::validate(s);
  return s;
}

/// Mean absolute difference of 8 x 8 blocks over the mean, in the colour where it is largest.
double block_difference(const image::Image& a, const image::Image& b) {
  double most = 0;
  for (int c = 0; c < 3; ++c) {
    std::map<std::pair<int, int>, double> blocks;
    double sum = 0, off = 0;
    for (int y = 0; y < a.height; ++y) {
      for (int x = 0; x < a.width; ++x) {
        blocks[{x / 8, y / 8}] += static_cast<double>(a.at(x, y)[c] - b.at(x, y)[c]);
        sum += static_cast<double>(a.at(x, y)[c]);
      }
    }
    for (const auto& [place, difference] : blocks) off += std::abs(difference);
    most = std::max(most, off / sum);
  }
  return most;
}

TEST_F(DirectLight, ABallMirrorsTheEnvironmentByItsRoughnessAsTraced) {
  // What the split sum leaves: lobes are round about one direction, those of rough surfaces are not. Seen to
  // be 1.7, 4.0, 10 % of the colour that the window shows most of; 13.4 % of a Blinn-Phong lobe, which has
  // less of a tail than the tiles' GGX
  struct Case {
    float roughness;
    double most;
  };
  scene::Scene s = ball_under_sky();
  realtime::Renderer renderer(gl(), s, test::small_maps);
  for (const Case& c : {Case{0.12f, 0.02}, {0.35f, 0.045}, {0.7f, 0.105}, {-0.4f, 0.14}}) {
    SCOPED_TRACE(testing::Message() << "roughness " << c.roughness);
    scene::Material& metal = s.materials[0];
    metal.metallic = 1, metal.specular_roughness = c.roughness, metal.base_color = {0.9f, 0.7f, 0.5f};
    renderer.set_material(0, metal);
    const PictureSize size{96, 96};
    const trace::PathTracer tracer(s);
    const image::Image truth = test::traced(s, nullptr, size, 32, 1, tracer);
    const image::Image picture = test::drawn(renderer, s, size);
    EXPECT_LT(block_difference(truth, picture), c.most);
    EXPECT_NEAR(test::mean_luminance(picture) / test::mean_luminance(truth), 1, 0.03);
  }
}

TEST_F(DirectLight, ASkyTurnedAndColouredIsThatOfASceneWhoseSkyIsSo) {
  scene::Scene s = ball_under_sky();
  const PictureSize size{64, 64};
  s.materials[0].metallic = 0.5f;  // matte and mirroring
  s.materials[0].specular_roughness = 0.12f;
  realtime::Renderer turned(gl(), s, test::small_maps);
  const image::Image before = test::drawn(turned, s, size);
  scene::LightingState state = turned.lighting();
  state.environment_rotation = 1.1f;
  state.group_scales = {{1.5f, 0.5f, 0.8f}};
  turned.set(state);
  const image::Image after = test::drawn(turned, s, size);
  realtime::Renderer fresh(gl(), scene::with_lighting(s, state), test::small_maps);
  // The same 32 directions and tiles; by turning they differ in their last bits
  EXPECT_TRUE(
      test::picture_is(after, test::PictureBounds::around(test::drawn(fresh, s, size), 0.002f, 1e-4f)));
  EXPECT_FALSE(test::picture_is(after, test::PictureBounds::around(before, 0.1f, 0.02f))) << "it turned";
  turned.set(scene::lighting_at(s));
  EXPECT_EQ(test::drawn(turned, s, size).pixels, before.pixels) << "and back, to the bit";
}

// Seen to be 1.5 and 1.1 %; the picture of the hour before is 197 and 65 % off.
TEST_F(DirectLight, ASunThatMovesTakesItsSkyAlongAsTraced) {
  scene::Scene s = ball_under_sky();
  s.materials[0].specular = 0;
  s.meshes.push_back(scene::make_quad({-4, -1, 4}, {8, 0, 0}, {0, 0, -8}));
  s.meshes[1].material = 0;
  s.instances.push_back({1, s.instances[0].node, -1, ""});
  scene::SunSkyParams params{
      .elevation = 0.4f, .azimuth = 0.3f, .width = 128, .model = scene::SkyModel::physical};
  scene::add_sun_sky(s, params);
  const PictureSize size{64, 64};
  realtime::Renderer renderer(gl(), s);
  const image::Image first = test::drawn(renderer, s, size);
  for (const float elevation : {0.15f, 1.2f}) {
    SCOPED_TRACE(testing::Message() << "elevation " << elevation);
    params.elevation = elevation, params.azimuth = 2.5f;
    scene::LightingState state = scene::lighting_at(s);
    scene::set_sun_sky(state, s, scene::make_sun_sky(params));
    renderer.set(state);
    const image::Image picture = test::drawn(renderer, s, size);
    const scene::Scene then = scene::with_lighting(s, state);
    const trace::PathTracer tracer(then);
    const image::Image truth = test::traced(then, nullptr, size, 64, 1, tracer);
    EXPECT_LT(block_difference(truth, picture), 0.03);
    EXPECT_GT(block_difference(truth, first), 0.2) << "of another hour";
    EXPECT_NEAR(test::mean_luminance(picture) / test::mean_luminance(truth), 1, 0.02);
  }
  renderer.set(scene::lighting_at(s));
  EXPECT_EQ(test::drawn(renderer, s, size).pixels, first.pixels) << "and back, to the bit";
}

TEST_F(DirectLight, TheSkyIsWholeWhateverTheScaleOfIndirectLight) {
  const scene::Scene s = ball_under_sky();
  realtime::Renderer renderer(gl(), s, test::small_maps);
  renderer.set_probes(test::made_up_probes({{0, 1.5f, 1}, {1, -1.5f, 1}}));
  const PictureSize size{64, 64};
  realtime::FrameSettings settings;
  const image::Image whole = test::drawn(renderer, s, size, settings);
  settings.sky = realtime::Sky::black;
  const image::Image ball = test::drawn(renderer, s, size, settings);
  settings.sky = realtime::Sky::environment;
  for (const int scale : {2, 3, 8}) {
    settings.indirect_scale = scale;
    const image::Image picture = test::drawn(renderer, s, size, settings);
    int sky = 0;
    for (int y = 0; y < size.height; ++y) {
      for (int x = 0; x < size.width; ++x) {
        if (ball.rgb(x, y) != vec3(0)) continue;
        ++sky;
        EXPECT_EQ(picture.rgb(x, y), whole.rgb(x, y)) << scale << ": " << x << " " << y;
      }
    }
    EXPECT_GT(sky, 1000);
  }
}

}  // namespace
}  // namespace ssphh
