/// An SPHL that stands in for an object: the profile sampled from it, and the light that it then gives.

#include <gmock/gmock.h>

#include <ssphh/scene/builtin.h>
#include <ssphh/scene/primitives.h>
#include <ssphh/sh/evaluate.h>
#include <ssphh/trace/transport_scene.h>
#include <ssphh/transport/relight_session.h>

#include "lit_session.h"

namespace ssphh {
namespace {

/// A glowing square of side 0.2 at the origin that faces up, one-sided, high above a black floor.
scene::Scene glowing_square() {
  scene::Scene scene;
  scene.nodes.emplace_back();
  scene::Material& glow = scene.materials.emplace_back();
  glow.base_color = vec3(0);
  glow.specular = 0;
  glow.emission = {5, 3, 1};
  scene::Material& black = scene.materials.emplace_back();
  black.base_color = vec3(0);
  black.specular = 0;
  scene::Mesh square = scene::make_quad({-0.1f, 0, 0.1f}, {0.2f, 0, 0}, {0, 0, -0.2f});
  square.material = 0;
  scene::Mesh floor = scene::make_quad({-5, -5, 5}, {10, 0, 0}, {0, 0, -10});
  floor.material = 1;
  scene.meshes = {square, floor};
  scene.instances.push_back({0, 0, -1, "glow"});
  scene.instances.push_back({1, 0, -1, ""});
  scene::validate(scene);
  return scene;
}

TEST(EmissionProfile, OfAGlowingSquareIsItsProjectedAreaTimesItsRadiance) {
  const scene::Scene scene = glowing_square();
  const trace::TransportScene source(scene);
  test::LitSession session(source, {{"above", {0, 0.6f, 0}, 0.1f}});
  session.update();
  const float radius = 0.25f;
  const sh::RadianceSh profile = session.emission_profile({0, 0, 0}, radius, 4);
  // L(ω) = Le · area · cosθ / (π r²) above, 0 below: Le · area/(π r²) times the clamped cosine, whose
  // coefficients are known: √π/2 and √(π/3) for bands 0 and 1 about y.
  const float scale = 0.04f / (pi * radius * radius);
  // 256 beams per direction hit the square or miss it: the edge is found to about 1/16.
  EXPECT_NEAR(profile[0].x, 5 * scale * std::sqrt(pi) / 2, 0.01f * 5 * scale);
  EXPECT_NEAR(profile[1].x, 5 * scale * std::sqrt(pi / 3), 0.01f * 5 * scale);
  EXPECT_NEAR(profile[1].y / profile[1].x, 0.6f, 1e-2f);
  EXPECT_NEAR(profile[2].x, 0, 0.01f * 5 * scale);
  EXPECT_NEAR(profile[3].x, 0, 0.01f * 5 * scale);
}

TEST(EmissionProfile, StandsInForTheObject) {
  // Light at a far probe from the sphere with the profile equals the solid angle integral of the square
  // itself.
  const scene::Scene scene = glowing_square();
  const trace::TransportScene source(scene);
  transport::RelightParams params;
  params.degree = 2;
  const vec3 far_place{0, 3, 1};
  test::LitSession session(source, {{"square", {0, 0, 0}, 0.25f}, {"far", far_place, 0.1f}}, params);
  session.update();
  const sh::RadianceSh profile = session.emission_profile({0, 0, 0}, 0.25f, 8);
  session.state.group_scales[0] = vec3(0);  // the square itself goes dark
  session.shine(0, profile);
  session.update();
  const sh::RadianceSh seen = session.emitted(1);
  // ∫ L dω = Le · area cosθ / d²; the square's own extent changes that by (size/d)² ~ 0.4 %.
  const float distance2 = glm::dot(far_place, far_place);
  const float cosine = far_place.y / std::sqrt(distance2);
  EXPECT_NEAR(seen[0].x / 0.282095f, 5 * 0.04f * cosine / distance2, 0.02f * 5 * 0.04f / distance2);
  EXPECT_GT(seen[2].x, -0.01f);
  EXPECT_LT(seen[1].x, 0) << "the light comes from below";
}

TEST(EmissionProfile, RefusesWhatMakesNoSense) {
  const scene::Scene scene = glowing_square();
  const trace::TransportScene source(scene);
  test::LitSession session(source, {{"above", {0, 0.6f, 0}, 0.1f}});
  EXPECT_THROW(session.emission_profile({0, 0, 0}, 0, 4), Error);
  EXPECT_THROW(session.emission_profile({0, NAN, 0}, 1, 4), Error);
  EXPECT_THROW(session.emission_profile({0, 0, 0}, 1, 11), Error);
  EXPECT_THROW(session.emission_profile({0, 0, 0}, 1, 4, 0), Error);
}

}  // namespace
}  // namespace ssphh
