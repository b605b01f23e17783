/// Glass on the way of light: panes and bodies against closed forms, and furnaces that must not show them.

#include <array>

#include <gtest/gtest.h>

#include <ssphh/rays/posed_world.h>
#include <ssphh/shading/glass.h>
#include <ssphh/trace/transport_scene.h>

#include "hand_made.h"
#include "tracer_data.h"

namespace ssphh::test {
namespace {

using trace::Strategy;

scene::Material pane(const vec3& tint = vec3(1)) {
  scene::Material m;
  m.base_color = tint;
  m.specular_roughness = 0, m.transmission = 1;
  return m;
}

scene::Material body(const vec3& left_after_a_metre = vec3(1)) {
  scene::Material m = pane();
  m.thickness = 1;
  m.attenuation_color = left_after_a_metre, m.attenuation_distance = 1;
  return m;
}

shading::GlassShares shares_of(const scene::Material& m, float cosine) {
  shading::GlassParams glass;
  glass.share = m.transmission, glass.tint = m.base_color, glass.ior = m.ior;
  glass.sheet = m.thickness == 0;
  return shading::glass_shares(glass, cosine);
}

/// Level, `size` across, at a height.
void add_pane(scene::Scene& scene, const scene::Material& material, float height, float size = 4) {
  const float h = size / 2;
  add_object(scene, scene::make_quad(vec3(-h, height, h), vec3(size, 0, 0), vec3(0, 0, -size)), material,
             "pane");
}

struct Sums {
  vec3 value{0}, direct{0};
  int deepest = 0;
  void add(int depth, int, const vec3& v, const vec3&) {
    value += v;
    if (depth <= 1) direct += v;
    deepest = std::max(deepest, depth);
  }
  void first_hit(const shading::Surface&, const vec3&, const trace::Ray&, const trace::Hit&) {}
};

/// Means over 16 samples of independent sequences along one ray.
Samples channel_along(const scene::Scene& scene, const trace::Ray& ray, const trace::PathOptions& options,
                      int count, int channel = 0) {
  const trace::TracerData data(std::make_shared<const trace::SceneGeometry>(scene), scene, 0);
  trace::RayTask task;
  Samples samples;
  for (int i = 0; i < count; ++i) {
    Sums sums;
    for (std::uint32_t s = 0; s < 16; ++s)
      trace_path(data.geometry, data.emitters(), ray, {hash_combine(11, static_cast<std::uint64_t>(i)), s},
                 options, task, sums);
    samples.add(static_cast<double>(sums.value[channel]) / 16);
  }
  EXPECT_EQ(task.invalid, 0u);
  return samples;
}

trace::PathOptions many_bounces(Strategy strategy = Strategy::mis) {
  return {1 << 20, true, strategy};
}

vec3 slanted(float cosine) {
  return {std::sqrt(1 - cosine * cosine), cosine, 0};
}

// What a stack of n equal panes lets through, each reflecting r and transmitting t of unpolarised light:
// T ← T t/(1 − R r), R ← r + t² R/(1 − R r), one pane at a time.
TEST(Glass, StackOfPanesLetsThroughWhatItsClosedFormSays) {
  for (const int panes : {1, 2, 5}) {
    for (const float cosine : {1.0f, 0.5f}) {
      scene::Scene scene;
      add_pane(scene, lambertian(vec3(0), vec3(1)), 3, 100);
      scene.materials.back().double_sided = true;
      const vec3 tint(0.8f, 0.5f, 1);
      for (int i = 0; i < panes; ++i) add_pane(scene, pane(tint), 1 + 0.1f * static_cast<float>(i), 60);
      const shading::GlassShares one = shares_of(pane(tint), cosine);
      for (const int channel : {0, 2}) {
        const double r = double{one.reflected[channel]}, t = double{one.transmitted[channel]};
        double all_r = r, all_t = t;
        for (int i = 1; i < panes; ++i) {
          const double between = 1 - all_r * r;
          all_t *= t / between;
          all_r = r + t * t * all_r / between;
        }
        EXPECT_TRUE(mean_is(channel_along(scene, {vec3(0), slanted(cosine)}, many_bounces(), 400, channel),
                            all_t, {1e-3, 12}, 2e-6))
            << panes << " panes, cosine " << cosine << ", channel " << channel;
      }
    }
  }
}

// A slab of a body: (1 − r)² a/(1 − r² a²) with a = exp(−σ d/cos θ) of one way, r of unpolarised light, as
// paths have it.
TEST(Glass, SlabOfABodyAbsorbsByTheWayThroughIt) {
  const scene::Material glass = body({0.3f, 0.8f, 1});
  for (const float cosine : {1.0f, 0.5f}) {
    scene::Scene scene;
    add_pane(scene, lambertian(vec3(0), vec3(1)), 3, 100);
    scene.materials.back().double_sided = true;
    add_object(scene, scene::make_box(vec3(-30, 1, -30), vec3(30, 1.5f, 30)), glass, "slab");
    const double r = double{shares_of(glass, cosine).reflected.x};
    const double within = std::sqrt(1 - (1 - double{cosine} * cosine) / 2.25);
    for (const int channel : {0, 1, 2}) {
      const double a = std::pow(double{glass.attenuation_color[channel]}, 0.5 / within);
      const double expected = (1 - r) * (1 - r) * a / (1 - r * r * a * a);
      EXPECT_TRUE(mean_is(channel_along(scene, {vec3(0), slanted(cosine)}, many_bounces(), 400, channel),
                          expected, {1e-3, 6}, 2e-5))
          << "cosine " << cosine << ", channel " << channel;
    }
  }
}

// Light of a lamp without extent crosses panes on its way to the floor: I cos θ/d² times what each leaves.
TEST(Glass, LampsLightWhatStandsBehindPanes) {
  for (const float x : {0.0f, 1.5f}) {
    scene::Scene scene;
    add_floor(scene, lambertian(vec3(0.5f)));
    const vec3 tint(0.9f, 0.4f, 0.7f);
    add_pane(scene, pane(tint), 1), add_pane(scene, pane(), 1.2f);
    add_light(scene, scene::LightType::point, 10, vec3(x, 2, 0));
    const float d2 = 4 + x * x, cosine = 2 / std::sqrt(d2);
    const vec3 left = shares_of(pane(tint), cosine).transmitted * shares_of(pane(), cosine).transmitted;
    const trace::RenderState state = render(scene, view_point(vec3(0), 4, 1));
    const vec3 expected = 10 * cosine / d2 * left * 0.5f / pi;
    for (int c = 0; c < 3; ++c)
      EXPECT_NEAR(mean_of(state.color, c), double{expected[c]}, 1e-4 * double{expected[c]}) << x << ' ' << c;
    EXPECT_EQ(mean_of(state.indirect), 0) << "panes count no depth";
  }
}

TEST(Glass, SunAndSkyComeThroughPanesToPointsAndToTransport) {
  scene::Scene scene;
  add_floor(scene, lambertian(vec3(0.5f)));
  const vec3 tint(0.9f, 0.4f, 0.7f);
  add_pane(scene, pane(tint), 1, 300);
  add_light(scene, scene::LightType::directional, 3, vec3(0), vec3(-0.6f, -0.8f, 0), "sun");
  const trace::TransportScene source(scene);
  std::vector<mat4> poses(static_cast<std::size_t>(source.part_count()), mat4(1));
  const auto light = source.direct_light(source.lights(0), poses);
  const rays::SurfacePoint point{vec3(0)};
  vec3 irradiance;
  light->irradiance(0, {&point, 1}, {&irradiance, 1});
  const vec3 expected = 3 * 0.8f * shares_of(pane(tint), 0.8f).transmitted;
  EXPECT_NEAR(glm::distance(irradiance, expected), 0, 1e-5f);
  const trace::PathTracer tracer(scene);
  const auto traced = tracer.surface_irradiance({&point, 1}, {1, 1, 16, 1}, {});
  EXPECT_NEAR(glm::distance(traced[0].direct, expected), 0, 1e-5f);
  EXPECT_TRUE(tracer.visible(vec3(0, 0.1f, 0), vec3(0, 5, 0)));
}

// Surfels, links and probes see past glass: it is no surface, takes no points, and says what it leaves of the
// light.
TEST(Glass, IsNoSurfaceToTransportButDimsItsRays) {
  scene::Scene scene;
  add_floor(scene, lambertian(vec3(0.5f)));
  add_pane(scene, pane(vec3(0.5f, 1, 1)), 1);
  add_object(scene, scene::make_box(vec3(-1, 2, -1), vec3(1, 2.5f, 1)), body(vec3(0.25f)), "slab");
  scene::Material curtain = pane(vec3(0.4f));
  curtain.transmission = 0.25f, curtain.specular = 0;
  add_pane(scene, curtain, 5);
  const trace::TransportScene source(scene);
  const rays::RayQuery down{vec3(0.1f, 8, 0.2f), vec3(0, -2, 0)}, below{vec3(0.1f, 4, 0.2f), vec3(0, -2, 0)};
  rays::RayHit hit;
  source.intersect(0, {&down, 1}, {&hit, 1});
  EXPECT_FLOAT_EQ(hit.distance, 1.5f) << "what is mostly no glass is there";
  EXPECT_NEAR(hit.albedo.x, 0.75f * 0.4f, 1e-6f) << "of its opaque share";
  EXPECT_EQ(hit.through, vec3(1));
  source.intersect(0, {&below, 1}, {&hit, 1});
  EXPECT_FLOAT_EQ(hit.distance, 2);
  const float boundary = shares_of(body(), 1).transmitted.x;
  const vec3 expected =
      shares_of(pane(vec3(0.5f, 1, 1)), 1).transmitted * boundary * boundary * std::sqrt(0.25f);
  EXPECT_NEAR(glm::distance(hit.through, expected), 0, 1e-5f);
  EXPECT_FALSE(rays::PosedWorld(source, 0).occluded({vec3(0, 0.5f, 0), vec3(0, 4, 0), 1}));
  for (const rays::PartPoint& p : source.sample_part(0, 0.5))
    EXPECT_TRUE(p.point.position.y == 0 || p.point.position.y == 5) << p.point.position.y;
}

// Light that is the same everywhere and in every direction stays so, whatever glass stands in it: what one
// way takes the other gives, and refraction back and forth takes no radiance.
TEST(Glass, FurnaceDoesNotShowGlass) {
  scene::Scene scene;
  add_room(scene, lambertian(vec3(0.5f), vec3(1)));
  add_object(scene, scene::make_sphere(0.4f, 48, 24), body(), "ball",
             add_node(scene, "ball", vec3(0.3f, -0.2f, 0)));
  add_pane(scene, pane(), -0.75f, 1.2f);
  scene::Material half = pane();
  half.base_color = vec3(1), half.specular = 0, half.transmission = 0.5f;  // white where it is no glass
  add_pane(scene, half, 0.7f, 1.5f);
  trace::RenderParams params;
  params.projection = trace::Projection::equirect;
  params.width = 32, params.height = 16;
  params.camera.world = look_at(vec3(-0.5f, 0.1f, 0.3f), vec3(0));
  params.path = {1 << 20, 1, 64, 5};
  // 2e-3: glass balls made of triangles with interpolated normals lose directions that their facets forbid.
  EXPECT_TRUE(mean_is(pixels_of(render(scene, params).color), 2, {}, 2e-3));
}

TEST(Glass, StrategiesAgreeThroughSmoothAndRoughGlass) {
  for (const float roughness : {0.0f, 0.5f}) {
    for (const float thickness : {0.0f, 1.0f}) {
      scene::Scene scene;
      add_floor(scene, lambertian(vec3(0.5f)));
      scene::Material glass = pane({0.9f, 0.6f, 0.8f});
      glass.specular_roughness = roughness, glass.thickness = thickness;
      if (thickness > 0)
        add_object(scene, scene::make_box(vec3(-1, 0.4f, -1), vec3(1, 0.6f, 1)), glass, "slab");
      else
        add_pane(scene, glass, 0.5f);
      add_light(scene, scene::LightType::sphere, 3, vec3(0.3f, 2, 0)).radius = 0.6f;
      const trace::Ray ray{vec3(0, 0.3f, 0), glm::normalize(vec3(0.2f, -1, 0.1f))};
      const int count = 3000;
      const Samples mis = channel_along(scene, ray, {6, true, Strategy::mis}, count);
      const Samples rays_only = channel_along(scene, ray, {6, true, Strategy::bsdf_only}, count);
      EXPECT_TRUE(means_agree(mis, rays_only, {1e-3, 5}, 1e-6)) << roughness << ' ' << thickness;
      EXPECT_GT(mis.mean(), 0.01) << roughness << ' ' << thickness;
      if (thickness == 0 && roughness == 0) {
        const Samples lights_only = channel_along(scene, ray, {6, true, Strategy::nee_only}, count);
        // The pane's reflections of the lamp, which only rays find, do not light the floor below it.
        EXPECT_TRUE(means_agree(mis, lights_only, {1e-3, 5}, 1e-6));
      }
    }
  }
}

// The last ray of a path goes through panes to the lights behind them.
TEST(Glass, PathsOfDepthOneFindLightsThroughPanes) {
  scene::Scene scene;
  add_floor(scene, lambertian(vec3(0.5f)));
  add_pane(scene, pane(vec3(0.8f)), 0.5f), add_pane(scene, pane(vec3(0.9f)), 0.7f);
  add_light(scene, scene::LightType::sphere, 3, vec3(0.3f, 2, 0)).radius = 0.6f;
  const trace::Ray ray{vec3(0, 0.3f, 0), glm::normalize(vec3(0.2f, -1, 0.1f))};
  const Samples by_rays = channel_along(scene, ray, {1, true, Strategy::bsdf_only}, 3000);
  const Samples by_lights = channel_along(scene, ray, {1, true, Strategy::nee_only}, 3000);
  EXPECT_TRUE(means_agree(by_rays, by_lights, {}, 1e-6));
  EXPECT_GT(by_rays.mean(), 0.01);
}

// Black and glowing in the middle of a body: (1 − r)/n² of its radiance leaves, less what the way out
// absorbs.
TEST(Glass, BodiesAbsorbTheLightOfWhatIsInThem) {
  const scene::Material glass = body({0.3f, 0.8f, 1});
  scene::Scene scene;
  add_object(scene, scene::make_box(vec3(-30, 0, -30), vec3(30, 4, 30)), glass, "block");
  add_pane(scene, lambertian(vec3(0), vec3(2)), 1.5f, 40);
  scene.materials.back().double_sided = true;
  for (const float cosine : {1.0f, 0.5f}) {
    const double r = double{shares_of(glass, cosine).reflected.x};
    const double within = std::sqrt(1 - (1 - double{cosine} * cosine) / 2.25);
    for (const int channel : {0, 1, 2}) {
      const double expected =
          2 * (1 - r) / 2.25 * std::pow(double{glass.attenuation_color[channel]}, 1.5 / within);
      EXPECT_TRUE(
          mean_is(channel_along(scene, {vec3(0, -1, 0), slanted(cosine)}, many_bounces(), 400, channel),
                  expected, {1e-3, 6}, 2e-5))
          << "cosine " << cosine << ", channel " << channel;
    }
  }
}

TEST(Glass, RadianceWithinABodyIsTheSquareOfItsIndexTimesThatOutside) {
  scene::Scene scene;
  add_constant_sky(scene, vec3(1));
  scene::Material glass = body();
  glass.specular = 0;
  add_object(scene, scene::make_box(vec3(-1), vec3(1)), glass, "block");
  const Samples up = channel_along(scene, {vec3(0), vec3(0, 1, 0)}, many_bounces(), 40);
  EXPECT_NEAR(up.mean(), 2.25, 1e-5);
}

}  // namespace
}  // namespace ssphh::test
