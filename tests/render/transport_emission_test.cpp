/// SPHLs that are lights (set_emission) against sphere lights and closed forms.

#include <algorithm>

#include <gtest/gtest.h>

#include <ssphh/transport/network.h>
#include <ssphh/transport/relight_session.h>

#include "transport_fixtures.h"

namespace ssphh::test {
namespace {

using transport::RelightParams;
using transport::RelightSession;

RelightParams fine_session() {
  RelightParams params;
  params.transport = small_network();
  params.transport.surfel_size = 0.2f;
  params.degree = 4;
  params.warm_start = false;
  return params;
}

/// The same radiance in every direction.
sh::RadianceSh isotropic(const vec3& radiance) {
  sh::RadianceSh f(0);
  f[0] = root_4pi * radiance;
  return f;
}

struct DarkRoom {
  scene::Scene scene = coloured_room(vec3(0));
  trace::TransportScene source{scene};
};

TEST(RelightEmission, AnIsotropicSphlIsASphereLight) {
  const DarkRoom room;
  const vec3 radiance(5, 3, 2);
  LitSession session(room.source, places_of(room.scene), fine_session());
  session.shine(0, isotropic(radiance));
  session.update();

  scene::Scene lit = room.scene;
  scene::Light lamp;
  lamp.name = "lamp";
  lamp.type = scene::LightType::sphere;
  lamp.radius = 0.1f;
  lamp.intensity = 1;
  lamp.color = radiance;
  lamp.node = lit.sphls[0].node;
  lit.lights.push_back(lamp);
  const trace::TransportScene lit_source(lit, {.light_samples = 256});
  LitSession reference(lit_source, places_of(lit), fine_session());
  reference.update();

  ASSERT_EQ(session.patch_direct().size(), reference.patch_direct().size());
  // The sphere stands above every wall's horizon, where π (r/d)² cosθ is exact; 256 stratified shadow rays
  // leave under 1e-4 of noise, as radiance and cosine hardly vary over the disc.
  for (std::size_t s = 0; s < session.patch_direct().size(); ++s) {
    for (glm::length_t c = 0; c < 3; ++c)
      EXPECT_NEAR(session.patch_direct()[s][c] / reference.patch_direct()[s][c], 1, 2e-4f) << s;
  }
  for (std::size_t i = 0; i < session.reflected().size(); ++i) {
    const sh::RadianceSh &a = session.reflected()[i], &b = reference.reflected()[i];
    for (std::size_t k = 0; k < a.values.size(); ++k) {
      for (glm::length_t c = 0; c < 3; ++c)
        EXPECT_NEAR(a.values[k][c], b.values[k][c], 1e-4f * b.values[0][c]) << i << " " << k;
    }
  }
}

TEST(RelightEmission, OtherProbesSeeTheSphereAsADisc) {
  const DarkRoom room;
  const std::vector<scene::ProbePlace> places = places_of(room.scene);
  LitSession session(room.source, places, fine_session());
  const vec3 radiance(5, 3, 2);
  session.shine(0, isotropic(radiance));
  session.update();
  EXPECT_TRUE(session.emitted(0) == sh::RadianceSh(4)) << "no probe sees itself";
  for (std::size_t i = 1; i < places.size(); ++i) {
    const vec3 to = places[0].position - places[i].position;
    const double d = double(glm::length(to)), edge = std::sqrt(1 - 0.01 / (d * d));
    const sh::RadianceSh seen = session.emitted(static_cast<int>(i));
    // ∫ over the cap of Y₀₀ and of Y₁: 2π(1 − c) Y₀₀ and π(1 − c²) √(3/4π) ω.
    const vec3 u = to / static_cast<float>(d);
    const double band0 = 2 * pi_d * (1 - edge) / double(root_4pi);
    const double band1 = pi_d * (1 - edge * edge) * std::sqrt(3 / (4 * pi_d));
    for (glm::length_t c = 0; c < 3; ++c) {
      const double l = double(radiance[c]);
      EXPECT_NEAR(double(seen[0][c]) / (l * band0), 1, 1e-4);
      EXPECT_NEAR(double(seen[1][c]), l * band1 * double(u.y), 1e-4 * l * band1);
      EXPECT_NEAR(double(seen[2][c]), l * band1 * double(u.z), 1e-4 * l * band1);
      EXPECT_NEAR(double(seen[3][c]), l * band1 * double(u.x), 1e-4 * l * band1);
    }
  }
}

TEST(RelightEmission, SphereLightsAndSmallLampsAreSeenAtTheirTrueSize) {
  // A sphere of 0.1 m and a square of 0.2 m, both of radiance 1: 16 to 60 of the 16,384 rays that look for
  // emitters meet them. A lattice counts the n points of a disc to about √√n.
  scene::Scene scene = coloured_room(vec3(0));
  scene::Light lamp;
  lamp.name = "globe";
  lamp.type = scene::LightType::sphere;
  lamp.radius = 0.1f;
  lamp.node = scene.sphls[0].node;
  scene.lights.push_back(lamp);
  add_body(scene, "tile", scene::make_quad({-0.1f, 0.99f, -0.1f}, {0.2f, 0, 0}, {0, 0, 0.2f}), vec3(0.5f),
           vec3(1));
  scene::validate(scene);
  const trace::TransportScene source(scene);
  const std::vector<scene::ProbePlace> places = places_of(scene);
  LitSession session(source, places, fine_session());
  session.update();
  const auto groups = session.emitted_by_group();
  ASSERT_EQ(groups.size(), 2u);
  for (std::size_t i = 1; i < places.size(); ++i) {
    const vec3 to = places[0].position - places[i].position;
    const double d2 = double(glm::dot(to, to));
    const double globe = 2 * pi_d * (1 - std::sqrt(1 - 0.01 / d2));
    // The square by a fine sum over its area.
    double tile = 0;
    for (int k = 0; k < 400; ++k) {
      const vec3 x(-0.1f + 0.01f * (static_cast<float>(k % 20) + 0.5f), 0.99f,
                   -0.1f + 0.01f * (static_cast<float>(k / 20) + 0.5f));
      const glm::dvec3 w = glm::dvec3(x) - glm::dvec3(places[i].position);
      tile += 1e-4 * std::max(0.0, w.y) / std::pow(glm::dot(w, w), 1.5);
    }
    for (const auto& [measured, exact] :
         {std::pair(groups[0][i][0].y, globe), std::pair(groups[1][i][0].y, tile)}) {
      const double rays = exact / (4 * pi_d) * 16384;
      EXPECT_NEAR(double(measured) * double(root_4pi) / exact, 1, 1.5 * std::pow(rays, 0.25) / rays) << i;
    }
  }
}

TEST(RelightEmission, ADirectedSphlLightsItsSideByItsOwnFunction) {
  // L(ω) = 2 ω·x, clamped at 0: E = π (r/d)² cosθ · 2 (d̂·x) on the right, nothing on the left.
  const DarkRoom room;
  LitSession session(room.source, places_of(room.scene), fine_session());
  sh::RadianceSh leaving(1);
  leaving[3] = vec3(2 / std::sqrt(3 / (4 * pi)));
  session.shine(0, leaving);
  session.update();
  const transport::TransportNetwork& network = session.network();
  std::size_t lit = 0, dark = 0;
  for (std::size_t i = 0; i < network.patch_count(); ++i) {
    if (!network.sample_used()[i]) continue;
    const rays::SurfacePoint& p = network.samples()[i];
    const double d = double(glm::length(p.position));
    const vec3 away = p.position / static_cast<float>(d);
    const double cosine = double(-glm::dot(away, p.normal));
    const double expected = pi_d * 0.01 / (d * d) * cosine * std::max(0.0, 2 * double(away.x));
    EXPECT_NEAR(double(session.patch_direct()[i].y), expected, 1e-5 * expected + 1e-7);
    ++(expected > 0 ? lit : dark);
  }
  EXPECT_GT(lit, 100u);
  EXPECT_GT(dark, 100u);
}

TEST(RelightEmission, BouncesBetweenWallsAndIsStoppedByADoor) {
  const scene::Scene scene = scene::make_builtin("two-rooms");
  const trace::TransportScene source(scene);
  RelightParams params = fine_session();
  params.transport.surfel_size = 0.5f;
  LitSession session(source, places_of(scene), params, 0);
  session.state.group_scales[0] = vec3(0);
  session.shine(0, isotropic(vec3(10)));
  session.update();
  EXPECT_GT(session.reflected()[1][0].y, 0) << "room A";
  for (const int b : {3, 4, 5}) {
    EXPECT_EQ(session.reflected()[b][0], vec3(0)) << "room B, door shut";
    EXPECT_EQ(session.emitted(b)[0], vec3(0));
  }
  session.state.time = 1;
  session.update();
  for (const std::size_t b : {3u, 4u, 5u}) EXPECT_GT(session.reflected()[b][0].y, 0) << "door open";
}

TEST(RelightEmission, SetTwiceReplacesAndEmptyClears) {
  const DarkRoom room;
  LitSession session(room.source, places_of(room.scene), fine_session());
  session.update();
  for (const sh::RadianceSh& dark : session.reflected()) EXPECT_TRUE(dark == sh::RadianceSh(4));

  session.shine(1, isotropic(vec3(1)));
  session.update();
  const std::vector<sh::RadianceSh> once = session.reflected();
  EXPECT_GT(once[0][0].y, 0);
  const std::uint64_t rays = room.source.rays_traced();
  session.shine(1, isotropic(vec3(1)));
  EXPECT_TRUE(session.update().changed_probes.empty()) << "the same again is no change";
  EXPECT_EQ(room.source.rays_traced(), rays);

  session.shine(1, isotropic(vec3(4)));
  session.update();
  for (std::size_t i = 0; i < once.size(); ++i) {
    sh::RadianceSh four = once[i];
    four *= vec3(4);
    EXPECT_TRUE(session.reflected()[i] == four) << "replaced, not added: a power of two scales to the bit";
  }

  // Two emitters add up; clearing one leaves the other; clearing both leaves darkness.
  session.shine(1, isotropic(vec3(1)));
  session.shine(2, isotropic(vec3(1)));
  session.update();
  EXPECT_GT(session.reflected()[0][0].y, 1.1f * once[0][0].y);
  session.shine(2, {});
  session.update();
  EXPECT_TRUE(session.reflected() == once);
  session.shine(1, {});
  session.update();
  for (const sh::RadianceSh& dark : session.reflected()) EXPECT_TRUE(dark == sh::RadianceSh(4));
  EXPECT_TRUE(session.emitted(0) == sh::RadianceSh(4));
}

}  // namespace
}  // namespace ssphh::test
