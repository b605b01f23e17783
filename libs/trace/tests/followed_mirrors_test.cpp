/// Pictures with looked-up light: what smooth surfaces mirror is followed to what stands there.

#include <gtest/gtest.h>

#include <ssphh/shading/bsdf.h>

#include "hand_made.h"

namespace ssphh::test {
namespace {

struct GivenLight final : rays::IndirectLight {
  vec3 irradiance(const rays::SurfacePoint&) const override { return given_irradiance; }
  vec3 glossy(const rays::SurfacePoint&, const vec3&, float) const override { return given_radiance; }
  bool follows_mirrors() const override { return follows; }
  std::vector<std::string> direct_groups() const override { return groups; }
  std::vector<std::string> mirrored_groups() const override { return mirrored; }

  vec3 given_irradiance{3, 5, 7}, given_radiance{30, 10, 20};
  bool follows = true;
  std::vector<std::string> groups, mirrored;
};

const vec3 wall(0.2f, 0.5f, 0.7f);

scene::Material metal(float roughness) {
  scene::Material m;
  m.base_color = vec3(0.9f, 0.6f, 0.3f);
  m.metallic = 1;
  m.specular_roughness = roughness;
  return m;
}

scene::Material plastic(float roughness) {
  scene::Material m;
  m.base_color = vec3(0.6f, 0.3f, 0.4f);
  m.specular_roughness = roughness;
  return m;
}

/// A closed room with a shining floor.
scene::Scene room_over(const scene::Material& floor) {
  scene::Scene scene;
  add_room(scene, lambertian(wall));
  add_object(scene, scene::make_quad(vec3(-1, -0.9f, 1), vec3(2, 0, 0), vec3(0, 0, -2)), floor, "floor");
  return scene;
}

trace::RenderParams floor_view(int max_depth, int spp = 16) {
  return view_point(vec3(0.1f, -0.9f, 0.2f), spp, max_depth);
}

/// What the floor leaves straight up: its diffuse layer's share of the irradiance, and of `mirrored` what its
/// lobe reflects.
vec3 left_by(const scene::Material& floor, const vec3& irradiance, const vec3& mirrored) {
  const vec3 diffuse = floor.base_color * (1 - floor.metallic);
  const vec3 f0 = floor.metallic > 0 ? floor.base_color : vec3(0.04f);
  const vec3 e = shading::directional_albedo({vec3(0), f0, 0, floor.specular_roughness}, 1);
  return diffuse * (vec3(1) - e) / pi * irradiance + e * mirrored;
}

/// Within 0.3 % of the specular lobe's table, and the noise.
void expect_floor(const scene::Material& floor, const GivenLight& light, int max_depth,
                  const vec3& expected) {
  const scene::Scene scene = room_over(floor);
  trace::RenderState state;
  trace::PathTracer(scene).render_with(light, floor_view(max_depth), state);
  for (int c = 0; c < 3; ++c) {
    const auto value = static_cast<double>(expected[c]);
    EXPECT_TRUE(mean_is(pixels_of(state.color, c), value, {1e-3, 6}, 0.003 * value)) << c;
    EXPECT_NEAR(mean_of(state.indirect, c), mean_of(state.color, c), 1e-6 * value) << c;
  }
}

TEST(FollowedMirrors, ShowWhatStandsThereInItsLight) {
  const GivenLight light;
  const vec3 walls = wall / pi * light.given_irradiance;
  for (const scene::Material& floor : {metal(0.05f), metal(0.35f), plastic(0.2f)}) {
    SCOPED_TRACE(floor.specular_roughness);
    expect_floor(floor, light, 25, left_by(floor, light.given_irradiance, walls));
  }
}

TEST(FollowedMirrors, OfWideLobesGiveWayToTheProbesLight) {
  const GivenLight light;
  const vec3 walls = wall / pi * light.given_irradiance;
  for (const auto& [roughness, followed] :
       {std::pair(0.4f, 1.0f), {0.45f, 0.75f}, {0.55f, 0.25f}, {0.6f, 0.0f}}) {
    SCOPED_TRACE(roughness);
    const vec3 mirrored = followed * walls + (1 - followed) * light.given_radiance;
    expect_floor(metal(roughness), light, 25, left_by(metal(roughness), vec3(0), mirrored));
  }
}

TEST(FollowedMirrors, AreNotFollowedForALookupThatHasItsOwn) {
  GivenLight light;
  light.follows = false;
  expect_floor(metal(0.1f), light, 25, left_by(metal(0.1f), vec3(0), light.given_radiance));
}

TEST(FollowedMirrors, CountAsOneScatteringEach) {
  // Light of the walls has scattered there, and on the floor, and before that at least once.
  const GivenLight light;
  expect_floor(metal(0.1f), light, 2, vec3(0));
  expect_floor(metal(0.1f), light, 3, left_by(metal(0.1f), vec3(0), wall / pi * light.given_irradiance));
}

TEST(FollowedMirrors, OfMirrorsEndInTheProbesLight) {
  scene::Scene scene;
  scene::Material silver = metal(0.05f);
  silver.base_color = vec3(1);
  add_room(scene, silver);
  const GivenLight light;
  trace::RenderState state;
  trace::PathTracer(scene).render_with(light, view_point(vec3(0.1f, -1, 0.2f), 4, 25), state);
  for (int c = 0; c < 3; ++c)
    EXPECT_NEAR(mean_of(state.color, c), static_cast<double>(light.given_radiance[c]),
                0.02 * light.given_radiance[c]);
}

/// A lamp of each kind, one of them a glowing square.
void add_lamps(scene::Scene& scene) {
  add_object(scene, scene::make_quad(vec3(-0.85f, 0.95f, -0.4f), vec3(0.8f, 0, 0), vec3(0, 0, 0.8f)),
             lambertian(vec3(0), vec3(1, 5, 2)), "panel");
  add_light(scene, scene::LightType::point, 1, vec3(-0.6f, 0.2f, 0.1f), vec3(0, -1, 0), "bulb").color =
      vec3(0.1f, 0.4f, 2);
}

/// Means of two pictures with noise of their own.
void expect_same(const image::Image& a, const image::Image& b) {
  for (int c = 0; c < 3; ++c) {
    EXPECT_GT(mean_of(a, c), 1e-3) << c;
    EXPECT_TRUE(means_agree(pixels_of(a, c), pixels_of(b, c), {1e-3, 15}, 1e-3 * mean_of(a, c))) << c;
  }
}

TEST(FollowedMirrors, ShowTheDirectLightOfWhatStandsThere) {
  // Without any light from a lookup what a floor of metal shows is path traced with one bounce.
  for (const float roughness : {0.1f, 0.35f}) {
    SCOPED_TRACE(roughness);
    scene::Scene scene = room_over(metal(roughness));
    add_lamps(scene);
    GivenLight dark;
    dark.given_irradiance = dark.given_radiance = vec3(0);
    const trace::PathTracer tracer(scene);
    trace::RenderState followed, truth;
    tracer.render_with(dark, floor_view(2, 256), followed);
    trace::RenderParams other = floor_view(2, 256);
    other.path.seed = 7;
    tracer.render(other, truth);
    expect_same(followed.color, truth.color);
    expect_same(followed.indirect, truth.indirect);
  }
}

/// What path tracing finds of direct light on metal.
void expect_direct(const scene::Scene& scene, const GivenLight& light) {
  const trace::PathTracer tracer(scene);
  trace::RenderState looked_up, truth;
  tracer.render_with(light, floor_view(25, 256), looked_up);
  trace::RenderParams other = floor_view(1, 256);
  other.path.seed = 7;
  tracer.render(other, truth);
  expect_same(looked_up.color, truth.color);
}

TEST(FollowedMirrors, ShowEmittersWhoseLightIsLookedUp) {
  // Then walls have it from the lookup, which is dark here: the mirror shows the lamps alone.
  scene::Scene scene = room_over(metal(0.3f));
  add_lamps(scene);
  GivenLight dark;
  dark.given_irradiance = dark.given_radiance = vec3(0);
  dark.groups = {"panel", "bulb"};
  expect_direct(scene, dark);
}

/// A floor in the open, under a sky with a bright spot.
scene::Scene floor_under_a_sky(const scene::Material& floor) {
  scene::Scene scene;
  add_object(scene, scene::make_quad(vec3(-1, -0.9f, 1), vec3(2, 0, 0), vec3(0, 0, -2)), floor, "floor");
  image::Image& sky = scene.environment.emplace().equirect;
  sky = image::Image(64, 32, 3);
  std::ranges::fill(sky.pixels, 0.3f);
  for (int x = 20; x < 24; ++x) sky.set_rgb(x, 8, vec3(90, 60, 20));
  return scene;
}

TEST(MirroredEmitters, AreSeenByWhatHasTheirLightFromALookup) {
  for (const bool lamp : {false, true}) {
    for (const float roughness : {0.3f, 0.5f, 0.9f}) {
      SCOPED_TRACE(testing::Message() << roughness << (lamp ? ", with a lamp" : ""));
      scene::Scene scene = floor_under_a_sky(metal(roughness));
      GivenLight dark;
      dark.given_irradiance = dark.given_radiance = vec3(0);
      dark.groups = {scene.environment->name};
      if (lamp) {
        scene::Light& bulb = add_light(scene, scene::LightType::sphere, 3, vec3(0.5f, 0.2f, 0.3f));
        bulb.radius = 0.2f, bulb.group = "bulb";
        dark.groups.push_back(bulb.group);
      }
      dark.mirrored = dark.groups;
      expect_direct(scene, dark);
    }
  }
}

}  // namespace
}  // namespace ssphh::test
