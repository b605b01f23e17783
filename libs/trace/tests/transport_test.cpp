/// Many bounces: closed boxes, furnaces, roulette, strategies, and the sums that images must obey.

#include <array>

#include <gtest/gtest.h>

#include "hand_made.h"
#include "tracer_data.h"

namespace ssphh::test {
namespace {

using trace::PathOptions;
using trace::Strategy;

/// Sum of all contributions along one path.
struct Total {
  vec3 value{0};
  void add(int, int, const vec3& v, const vec3&) { value += v; }
  void first_hit(const shading::Surface&, const vec3&, const trace::Ray&, const trace::Hit&) {}
};

/// Means over 16 samples of independent sequences, for one ray.
Samples radiance_along(const scene::Scene& scene, const trace::Ray& ray, const PathOptions& options,
                       int count, std::uint64_t seed = 0) {
  const trace::TracerData data(std::make_shared<const trace::SceneGeometry>(scene), scene, 0);
  trace::RayTask task;
  Samples samples;
  for (int i = 0; i < count; ++i) {
    Total total;
    for (std::uint32_t s = 0; s < 16; ++s) {
      trace_path(data.geometry, data.emitters(), ray, {hash_combine(seed, static_cast<std::uint64_t>(i)), s},
                 options, task, total);
    }
    samples.add(static_cast<double>(luminance(total.value)) / 16);
  }
  EXPECT_EQ(task.invalid, 0u);
  return samples;
}

scene::Scene glowing_room() {
  scene::Scene scene;
  add_room(scene, lambertian(vec3(0.5f), vec3(1)));
  return scene;
}

trace::RenderParams inside_view(int max_depth) {
  trace::RenderParams params;
  params.projection = trace::Projection::equirect;
  params.width = 32, params.height = 16;
  params.camera.world = look_at(vec3(0.1f, 0.2f, 0.3f), vec3(0));
  params.path = {max_depth, 1, 16, 5};
  return params;
}

TEST(Transport, DepthNInAGlowingRoomGivesTheGeometricSum) {
  const scene::Scene scene = glowing_room();
  double expected = 0;
  for (int n = 0; n <= 6; ++n) {
    expected += std::pow(0.5, n);
    // Float sums of 16 samples of up to 2: 1e-6.
    EXPECT_TRUE(mean_is(pixels_of(render(scene, inside_view(n)).color), expected, {1e-3, 7}, 2e-6))
        << "depth " << n;
  }
}

TEST(Transport, EndlessBouncesInAGlowingRoomGiveTwo) {
  EXPECT_TRUE(mean_is(pixels_of(render(glowing_room(), inside_view(1 << 20)).color), 2, {}, 2e-6));
}

TEST(Transport, AlbedoOneEndsByRouletteAlone) {
  // Le/(1 − ρ) for ρ = 0.95: fifty times more light than depth 0 could not end otherwise.
  scene::Scene scene;
  add_room(scene, lambertian(vec3(0.95f), vec3(1)));
  trace::RenderParams params = inside_view(1 << 20);
  params.path.spp = 4;
  EXPECT_TRUE(mean_is(pixels_of(render(scene, params).color), 20, {}, 1e-4));
}

TEST(Transport, FurnaceLeavesExactlyTheAlbedo) {
  // A convex body under radiance 1. Without next-event estimation, cosine sampling has no variance at all.
  scene::Scene scene;
  add_object(scene, scene::make_box(vec3(-1), vec3(1)), lambertian(vec3(0.7f)));
  add_constant_sky(scene, vec3(1));
  const trace::Ray ray{vec3(0.3f, 0.4f, 5), vec3(0, 0, -1)};
  const Samples bsdf_only = radiance_along(scene, ray, {8, true, Strategy::bsdf_only}, 30);
  EXPECT_NEAR(bsdf_only.mean(), 0.7, 1e-6);
  EXPECT_LT(bsdf_only.variance(), 1e-12);
  EXPECT_TRUE(mean_is(radiance_along(scene, ray, {8}, 2000), 0.7, {}, 1e-6));
}

TEST(Transport, FurnaceLeavesTheDirectionalAlbedoOfAGlossyBody) {
  scene::Scene scene;
  scene::Material metal;
  metal.base_color = vec3(0.9f), metal.metallic = 1, metal.specular_roughness = 0.4f;
  add_object(scene, scene::make_box(vec3(-1), vec3(1)), metal);
  add_constant_sky(scene, vec3(1));
  trace::RenderParams params = view_down(vec3(0.2f, 1, 0.2f), 1e-3f, 32);
  params.path = {4, 1, 16, 2};
  const trace::RenderState state = render(scene, params);
  // ∫ f cos θ dω for wo along the normal by the midpoint rule in sin θ (azimuth does not matter).
  const shading::BsdfParams bsdf{vec3(0), metal.base_color, 0, metal.specular_roughness};
  double expected = 0;
  constexpr int steps = 4000;
  for (int i = 0; i < steps; ++i) {
    const double s = (i + 0.5) / steps, cosine = std::sqrt(1 - s * s);
    const vec3 wi(s, 0, cosine);
    // dω = 2π sin θ dθ, dθ = ds / cos θ
    const double f = static_cast<double>(shading::eval_bsdf(bsdf, vec3(0, 0, 1), wi).x);
    expected += f * 2 * pi_d * s / cosine / steps;
  }
  EXPECT_TRUE(mean_is(pixels_of(state.color), expected, {}, 1e-4));
  // The albedo image comes from a coarse table.
  EXPECT_NEAR(mean_of(state.albedo), expected, 0.02);
}

/// A room with a lamp near a corner, and a box in it.
scene::Scene lit_room() {
  scene::Scene scene;
  add_room(scene, lambertian(vec3(0.6f)));
  add_object(scene, scene::make_quad(vec3(-0.4f, 0.95f, -0.4f), vec3(0.8f, 0, 0), vec3(0, 0, 0.8f)),
             lambertian(vec3(0.2f), vec3(4)), "lamp");
  add_object(scene, scene::make_box(vec3(-0.5f, -1, -0.5f), vec3(0, -0.2f, 0)),
             lambertian(vec3(0.8f, 0.4f, 0.2f)), "box");
  return scene;
}

TEST(Transport, RouletteDoesNotChangeTheMean) {
  const scene::Scene scene = lit_room();
  const trace::Ray ray{vec3(0.5f, 0, 0.8f), glm::normalize(vec3(-0.3f, -1, 0.1f))};
  const Samples with = radiance_along(scene, ray, {12, true}, 1500, 1);
  const Samples without = radiance_along(scene, ray, {12, false}, 1500, 2);
  EXPECT_TRUE(means_agree(with, without));
}

TEST(Transport, StrategiesAgreeOnEveryLightThatRaysCanFind) {
  std::array<scene::Scene, 4> scenes{lit_room(), lit_room(), lit_room(), lit_room()};
  // 0: the area lamp; 1: a sphere instead; 2: glossy walls; 3: an open floor under a sky with a sun's disc.
  scenes[1].materials[1].emission = vec3(0);
  add_light(scenes[1], scene::LightType::sphere, 6, vec3(0.4f, 0.5f, 0)).radius = 0.2f;
  scenes[2].materials[0].specular = 1, scenes[2].materials[0].specular_roughness = 0.3f;
  scenes[3].materials[1].emission = vec3(0);
  scenes[3].meshes[0] = scene::make_quad(vec3(-5, -1, 5), vec3(10, 0, 0), vec3(0, 0, -10));
  scenes[3].meshes[0].material = 0;
  add_constant_sky(scenes[3], vec3(0.5f));
  add_light(scenes[3], scene::LightType::directional, 3, vec3(0), vec3(-0.2f, -1, 0.3f)).angular_radius =
      0.3f;
  for (std::size_t i = 0; i < scenes.size(); ++i) {
    const trace::Ray ray{vec3(-0.2f, 0.3f, 0.8f), glm::normalize(vec3(0, -0.5f, -1))};
    const Samples mis = radiance_along(scenes[i], ray, {3, true, Strategy::mis}, 1500, 1);
    const Samples bsdf = radiance_along(scenes[i], ray, {3, true, Strategy::bsdf_only}, 1500, 2);
    const Samples nee = radiance_along(scenes[i], ray, {3, true, Strategy::nee_only}, 1500, 3);
    EXPECT_GT(mis.mean(), 0.01);
    EXPECT_TRUE(means_agree(mis, bsdf, {1e-3, 8})) << "scene " << i;
    EXPECT_TRUE(means_agree(mis, nee, {1e-3, 8})) << "scene " << i;
    EXPECT_LT(mis.variance(), 1.1 * bsdf.variance()) << "scene " << i;
  }
}

scene::Scene three_lamps() {
  scene::Scene scene = lit_room();
  add_light(scene, scene::LightType::point, 0.5f, vec3(0.5f, 0, 0.5f), vec3(0, -1, 0), "bulb");
  add_light(scene, scene::LightType::sphere, 3, vec3(-0.6f, 0.3f, 0.6f), vec3(0, -1, 0), "globe").radius =
      0.1f;
  return scene;
}

TEST(Transport, GroupsAddUpToTheColour) {
  const scene::Scene scene = three_lamps();
  trace::RenderParams params = inside_view(3);
  params.per_group = true;
  params.path.passes = 3, params.path.spp = 2;
  const trace::RenderState state = render(scene, params);
  ASSERT_EQ(state.groups.size(), 3u);
  for (const image::Image& group : state.groups) EXPECT_GT(mean_of(group), 0.001);
  for (std::size_t i = 0; i < state.color.pixels.size(); ++i) {
    float sum = 0;
    for (const image::Image& group : state.groups) sum += group.pixels[i];
    ASSERT_EQ(sum, state.color.pixels[i]) << "exact by definition";
  }
  params.per_group = false;
  const trace::RenderState plain = render(scene, params);
  for (std::size_t i = 0; i < state.color.pixels.size(); ++i) {
    // Only the order of the sums over passes and groups differs.
    ASSERT_NEAR(plain.color.pixels[i], state.color.pixels[i],
                1e-6f * std::abs(state.color.pixels[i]) + 1e-9f);
  }
}

TEST(Transport, SwitchingALampOffLeavesTheOtherGroups) {
  scene::Scene scene = three_lamps();
  trace::RenderParams params = inside_view(2);
  params.per_group = true;
  params.path.spp = 8;
  const trace::RenderState all = render(scene, params);
  scene.lights[0].intensity = 0;
  const trace::RenderState without = render(scene, params);
  const std::vector<std::string> groups = trace::PathTracer(scene).light_groups();
  const auto bulb =
      static_cast<std::size_t>(std::find(groups.begin(), groups.end(), "bulb") - groups.begin());
  ASSERT_LT(bulb, groups.size());
  Samples difference;
  for (std::size_t i = 0; i < all.color.pixels.size(); i += 3) {
    difference.add(
        static_cast<double>(all.color.pixels[i] - all.groups[bulb].pixels[i] - without.color.pixels[i]));
  }
  EXPECT_TRUE(mean_is(difference, 0));
}

TEST(Transport, DirectAndIndirectAddUpToTheColour) {
  const trace::RenderState state = render(three_lamps(), inside_view(4));
  EXPECT_GT(mean_of(state.indirect), 0.05);
  for (std::size_t i = 0; i < state.color.pixels.size(); ++i) {
    // Rounding of a sum in another order.
    ASSERT_NEAR(state.direct.pixels[i] + state.indirect.pixels[i], state.color.pixels[i],
                2e-6f * state.color.pixels[i] + 1e-9f);
  }
}

TEST(Transport, DepthsAddUp) {
  // The same random numbers at every vertex: a deeper render adds the deeper paths and changes nothing else,
  // but for the light found by the last scattered ray, which is part of depth n.
  const scene::Scene scene = three_lamps();
  const trace::RenderState one = render(scene, inside_view(1)), three = render(scene, inside_view(3));
  const trace::RenderState two = render(scene, inside_view(2));
  for (std::size_t i = 0; i < one.color.pixels.size(); ++i) {
    ASSERT_NEAR(one.color.pixels[i], three.direct.pixels[i], 2e-6f * one.color.pixels[i]);
    ASSERT_LE(two.color.pixels[i], three.color.pixels[i] * (1 + 2e-6f));
  }
}

TEST(Transport, DepthZeroShowsEmittersOnly) {
  const trace::RenderState state = render(lit_room(), inside_view(0));
  int lamp = 0, dark = 0;
  for (int y = 0; y < state.color.height; ++y) {
    for (int x = 0; x < state.color.width; ++x) {
      const vec3 c = state.color.rgb(x, y);
      EXPECT_LE(c.x, 4.0001f);
      lamp += c.x > 3.999f, dark += c.x == 0;
    }
  }
  EXPECT_GT(lamp, 5);
  EXPECT_GT(dark, 300);
  EXPECT_EQ(mean_of(state.indirect), 0);
}

TEST(Transport, UnlitSurfacesShowTheirColourAndReflectNothing) {
  scene::Scene scene;
  scene::Material sign;
  sign.base_color = vec3(0.25f, 0.5f, 0.75f);
  sign.unlit = true;
  add_floor(scene, sign);
  add_light(scene, scene::LightType::point, 100, vec3(0, 3, 0));
  const image::Image color = render(scene, view_point(vec3(0), 4, 3)).color;
  for (int c = 0; c < 3; ++c) EXPECT_NEAR(mean_of(color, c), 0.25 * (c + 1), 1e-6);
}

TEST(Transport, NoLightGivesBlackAndNoGroups) {
  scene::Scene scene;
  add_floor(scene, lambertian(vec3(0.5f)));
  const trace::RenderState state = render(scene, view_point(vec3(0), 4, 3));
  EXPECT_EQ(mean_of(state.color), 0);
  EXPECT_NEAR(mean_of(state.albedo), 0.5, 1e-6);
  EXPECT_TRUE(trace::PathTracer(scene).light_groups().empty());
  EXPECT_EQ(mean_of(render(scene::Scene{}, view_point(vec3(0), 1, 3)).coverage), 0);
}

}  // namespace
}  // namespace ssphh::test
