/// Light looked up from probes at the first hit: which light is asked for, and how much of it is reflected.

#include "indirect_lookup.h"

#include <gtest/gtest.h>

#include <ssphh/shading/bsdf.h>

#include "hand_made.h"

namespace ssphh::test {
namespace {

/// Answers with constants and remembers the questions.
class AskedLight final : public rays::IndirectLight {
 public:
  vec3 irradiance(const rays::SurfacePoint& at) const override {
    diffuse_at.push_back(at);
    return given_irradiance;
  }
  vec3 glossy(const rays::SurfacePoint& at, const vec3& r, float asked_roughness) const override {
    glossy_at.push_back(at);
    mirror = r, roughness = asked_roughness;
    return given_radiance;
  }

  vec3 given_irradiance{3, 5, 7}, given_radiance{0.4f, 0.9f, 1.3f};
  mutable std::vector<rays::SurfacePoint> diffuse_at, glossy_at;
  mutable vec3 mirror{0};
  mutable float roughness = -1;
};

shading::Surface surface_of(const shading::BsdfParams& bsdf) {
  shading::Surface surface;
  surface.position = vec3(1, 2, 3);
  surface.normal = surface.geometric_normal = vec3(0, 1, 0);
  surface.bsdf = bsdf;
  return surface;
}

const vec3 origin(1, 2.25f, 3);
const vec3 wo = glm::normalize(vec3(3, 4, 0));  // cosine 0.8

TEST(IndirectLookup, MatteSurfaceLeavesAlbedoTimesIrradianceOverPi) {
  const AskedLight light;
  const vec3 albedo(0.2f, 0.5f, 0.8f);
  const vec3 radiance = trace::reflected_indirect(light, surface_of({albedo, vec3(0)}), origin, wo, true);
  for (int c = 0; c < 3; ++c) EXPECT_FLOAT_EQ(radiance[c], albedo[c] * light.given_irradiance[c] / pi) << c;
  EXPECT_TRUE(light.glossy_at.empty()) << "nothing mirrors";
  ASSERT_EQ(light.diffuse_at.size(), 1u);
  EXPECT_EQ(light.diffuse_at[0].position, origin) << "raised above the surface";
  EXPECT_EQ(light.diffuse_at[0].normal, vec3(0, 1, 0));
  EXPECT_TRUE(light.diffuse_at[0].moves);
}

TEST(IndirectLookup, MetalMirrorsTheLightAroundItsNormal) {
  const AskedLight light;
  const shading::BsdfParams metal{vec3(0), vec3(0.9f, 0.6f, 0.3f), 0, 0.35f};
  const vec3 radiance = trace::reflected_indirect(light, surface_of(metal), origin, wo, false);
  const vec3 albedo = shading::directional_albedo(metal, 0.8f);
  for (int c = 0; c < 3; ++c) EXPECT_FLOAT_EQ(radiance[c], albedo[c] * light.given_radiance[c]) << c;
  EXPECT_TRUE(light.diffuse_at.empty()) << "nothing is matte";
  ASSERT_EQ(light.glossy_at.size(), 1u);
  EXPECT_EQ(light.glossy_at[0].position, origin);
  EXPECT_FALSE(light.glossy_at[0].moves);
  EXPECT_LT(glm::distance(light.mirror, vec3(-0.6f, 0.8f, 0)), 1e-6f);
  EXPECT_FLOAT_EQ(light.roughness, 0.35f);
}

TEST(IndirectLookup, RoughnessOfBlinnPhongIsAskedWithoutItsSign) {
  const AskedLight light;
  trace::reflected_indirect(light, surface_of({vec3(0), vec3(0.5f), 0, -0.6f}), origin, wo, false);
  EXPECT_FLOAT_EQ(light.roughness, 0.6f);
}

TEST(IndirectLookup, EvenLightIsReflectedByTheDirectionalAlbedo) {
  AskedLight even;
  even.given_radiance = vec3(0.4f, 0.9f, 1.3f);
  even.given_irradiance = pi * even.given_radiance;
  for (const float mirrored : {0.04f, 0.3f}) {
    const shading::BsdfParams plastic{vec3(0.7f, 0.5f, 0.2f), vec3(mirrored, 0.5f * mirrored, 0.1f), 0, 0.4f};
    for (const vec3& from : {wo, glm::normalize(vec3(5, 1, 0))}) {
      const vec3 radiance = trace::reflected_indirect(even, surface_of(plastic), origin, from, false);
      const vec3 albedo = shading::directional_albedo(plastic, from.y);
      for (int c = 0; c < 3; ++c)
        EXPECT_NEAR(radiance[c], albedo[c] * even.given_radiance[c], 1e-6f) << mirrored << " " << c;
    }
  }
}

TEST(IndirectLookup, PicturesAskForLightOfBodiesThatMove) {
  // Of two floors side by side, the one to the right moves; a third, unlit, asks for nothing.
  scene::Scene scene;
  const auto add_tile = [&](float x, const scene::Material& material, bool movable) {
    add_object(scene, scene::make_quad(vec3(x, 0, 1), vec3(1, 0, 0), vec3(0, 0, -1)), material);
    scene.nodes.back().movable = movable;
  };
  scene::Material sign = lambertian(vec3(0.5f));
  sign.unlit = true;
  add_tile(0, lambertian(vec3(0.5f)), false);
  add_tile(1, lambertian(vec3(0.5f)), true);
  add_tile(2, sign, false);
  const trace::PathTracer tracer(scene);
  const auto ask = [&](float x) {
    trace::RenderParams params = view_point(vec3(x, 0, 0.5f), 1, 2);
    params.width = params.height = 1;
    const AskedLight light;
    trace::RenderState state;
    tracer.render_with(light, params, state);
    return light.diffuse_at;
  };
  ASSERT_EQ(ask(0.5f).size(), 1u);
  EXPECT_FALSE(ask(0.5f)[0].moves);
  ASSERT_EQ(ask(1.5f).size(), 1u);
  EXPECT_TRUE(ask(1.5f)[0].moves);
  EXPECT_GT(ask(1.5f)[0].position.y, 0);
  EXPECT_LT(ask(1.5f)[0].position.y, 1e-5f);
  EXPECT_TRUE(ask(2.5f).empty());
}

}  // namespace
}  // namespace ssphh::test
