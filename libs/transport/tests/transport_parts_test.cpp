/// Small parts of transport between surfels, by hand.

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <ssphh/rays/posed_world.h>
#include <ssphh/sh/evaluate.h>
#include <ssphh/sh/reconstruct.h>
#include <ssphh/transport/fitted_weights.h>

#include "error_message.h"
#include "network_data.h"
#include "ray_source.h"
#include "relight_data.h"

namespace ssphh::transport {
namespace {

using test::message_of;
using test::RaySource;
using testing::HasSubstr;

TEST(TransportBoxes, AreMetWithinTheRaysLength) {
  const scene::Bounds box{vec3(1, -1, -1), vec3(3, 1, 1)};
  EXPECT_TRUE(meets({vec3(0), vec3(1, 0, 0)}, box));
  EXPECT_TRUE(meets({vec3(0), vec3(1, 0, 0), 1.01f}, box));
  EXPECT_FALSE(meets({vec3(0), vec3(1, 0, 0), 0.99f}, box));
  EXPECT_TRUE(meets({vec3(0), vec3(2, 0, 0), 0.51f}, box)) << "lengths are in units of the direction";
  EXPECT_FALSE(meets({vec3(0), vec3(-1, 0, 0)}, box)) << "behind";
  EXPECT_TRUE(meets({vec3(2, 0, 0), vec3(0, 1, 0), 0.1f}, box)) << "from within";
  EXPECT_TRUE(meets({vec3(0, 0.9f, 0), vec3(1, 0, 0)}, box));
  EXPECT_FALSE(meets({vec3(0, 1.1f, 0), vec3(1, 0, 0)}, box));
  EXPECT_FALSE(meets({vec3(0, 0, -1.1f), vec3(1, 0, 0)}, box));
  EXPECT_FALSE(meets({vec3(0), vec3(1, 1.1f, 0)}, box)) << "leaves the slab of y first";
  EXPECT_TRUE(meets({vec3(0), vec3(1, 0.9f, 0)}, box));
}

TEST(TransportBoxes, WithoutThicknessAreMetAsWell) {
  const scene::Bounds sheet{vec3(1, -1, -1), vec3(1, 1, 1)};
  EXPECT_TRUE(meets({vec3(0), vec3(1, 0, 0)}, sheet));
  EXPECT_TRUE(meets({vec3(0), glm::normalize(vec3(1, 0.3f, -0.2f))}, sheet));
  EXPECT_TRUE(meets({vec3(1, 0, 0), vec3(0, 1, 0)}, sheet)) << "along it";
  EXPECT_FALSE(meets({vec3(0), vec3(1, 1.5f, 0)}, sheet));
}

TEST(TransportBoxes, TurnWithTheirCorners) {
  const mat4 turn = glm::translate(mat4(1), vec3(10, 0, 0)) * glm::rotate(mat4(1), pi / 2, vec3(0, 0, 1));
  const scene::Bounds box = rays::transformed({vec3(1, 2, 3), vec3(2, 4, 6)}, turn);
  for (int c = 0; c < 3; ++c) {
    EXPECT_NEAR(box.min[c], vec3(6, 1, 3)[c], 1e-5f);
    EXPECT_NEAR(box.max[c], vec3(8, 2, 6)[c], 1e-5f);
  }
  EXPECT_TRUE(rays::transformed(scene::Bounds(), turn).empty());
}

TEST(TransportFan, IsCosineDistributedAboveItsPointAndShiftedBySalt) {
  const rays::SurfacePoint point{vec3(1, 2, 3), {0, 0, 1}};
  constexpr std::uint32_t count = 1024;
  for (const std::size_t salt : {0u, 77u}) {
    vec3 mean(0);
    float squares = 0;
    for (std::uint32_t i = 0; i < count; ++i) {
      const rays::RayQuery ray = fan_ray(point, 0.25f, i, salt);
      EXPECT_EQ(ray.origin, vec3(1, 2, 3.25f));
      EXPECT_NEAR(glm::length(ray.direction), 1, 1e-5f);
      EXPECT_GE(ray.direction.z, 0);
      EXPECT_TRUE(std::isinf(ray.t_max));
      mean += ray.direction / float{count}, squares += ray.direction.z * ray.direction.z / float{count};
    }
    // Means 2/3 and 1/2 of cos and its square; random points would err by 0.03 at four deviations.
    EXPECT_NEAR(mean.x, 0, 0.01f);
    EXPECT_NEAR(mean.y, 0, 0.01f);
    EXPECT_NEAR(mean.z, 2.0f / 3, 0.01f);
    EXPECT_NEAR(squares, 0.5f, 0.01f);
  }
  EXPECT_NE(fan_ray(point, 0, 3, 1).direction, fan_ray(point, 0, 3, 2).direction);
  EXPECT_EQ(fan_ray(point, 0, 3, 1).direction, fan_ray(point, 0, 3, 1).direction);
}

TEST(SphlSpheres, TakeUpTheirShareOfAllDirections) {
  const SphlEmitter sphere{vec3(0, 2, 0), 1, {}};
  EXPECT_NEAR(sphere_share(vec3(0), sphere), 0.5f * (1 - std::sqrt(0.75f)), 1e-6f);
  EXPECT_NEAR(sphere_share(vec3(0, 2, 5), sphere), 0.5f * (1 - std::sqrt(0.96f)), 1e-6f);
  EXPECT_EQ(sphere_share(vec3(0, 1, 0), sphere), 1) << "on its surface, as within";
  EXPECT_EQ(sphere_share(vec3(0, 2.5f, 0), sphere), 1);
}

TEST(SphlSpheres, AreSeenAsADiscOfWhatLeavesTowardOne) {
  SphlEmitter sphere{vec3(0, 2, 0), 1, sh::RadianceSh(1)};
  // 3 + y, in red half of that: downward 2.
  sphere.leaving[0] = 3 * std::sqrt(4 * pi) * vec3(0.5f, 1, 1);
  sphere.leaving[1] = std::sqrt(4 * pi / 3) * vec3(0.5f, 1, 1);
  sh::RadianceSh seen(2);
  seen[0] = vec3(10);
  add_seen_emission(vec3(0), sphere, seen);
  // ∫ dω = 4π · share of the constant; of the cosine about y π sin².
  const float share = sphere_share(vec3(0), sphere);
  EXPECT_NEAR(seen[0].g, 10 + 2 * 4 * pi * share / std::sqrt(4 * pi), 1e-5f);
  EXPECT_NEAR(seen[0].r, 10 + 4 * pi * share / std::sqrt(4 * pi), 1e-5f);
  EXPECT_NEAR(seen[1].g, 2 * std::sqrt(3 / (4 * pi)) * pi * 0.25f, 1e-5f);
  EXPECT_NEAR(seen[2].g, 0, 1e-6f);
  EXPECT_NEAR(seen[3].g, 0, 1e-6f);
  sh::RadianceSh dark(2), none(2);
  sphere.leaving = {};
  add_seen_emission(vec3(0), sphere, dark);
  EXPECT_EQ(dark, none);
  sphere.leaving = sh::RadianceSh(0);
  sphere.leaving[0] = vec3(-1);
  add_seen_emission(vec3(0), sphere, dark);
  EXPECT_EQ(dark, none) << "nothing negative leaves";
}

TEST(SeenPatches, ReflectTheirSurfelsIrradiance) {
  const std::vector<Irradiance4> light{{1, 2, 3, 0}, {pi, 2 * pi, 3 * pi, 0}};
  const vec3 seen = radiance_of({1, pack_albedo({1, 0.5f, 0.25f})}, light);
  for (int c = 0; c < 3; ++c) EXPECT_NEAR(seen[c], vec3(1, 1, 0.75f)[c], 3e-3f) << "albedo is kept to 5e-4";
  EXPECT_EQ(radiance_of({no_patch, pack_albedo(vec3(1))}, light), vec3(0));
}

TEST(RelightDifference, IsRelativeToTheLargerMeanInAnyCoefficientAndChannel) {
  sh::RadianceSh a(1);
  a[0] = vec3(2, 1, 0);
  sh::RadianceSh b = a;
  EXPECT_FALSE(differs(a, b, 0));
  b[3].z = 0.19f;
  EXPECT_FALSE(differs(a, b, 0.1f)) << "a tenth of 2";
  EXPECT_TRUE(differs(a, b, 0.09f));
  EXPECT_TRUE(differs(b, a, 0.09f));
  b = a, b[0].x = 4;
  EXPECT_FALSE(differs(a, b, 0.51f)) << "half of the larger one";
  EXPECT_TRUE(differs(a, b, 0.49f));
  EXPECT_TRUE(differs(a, sh::RadianceSh(2), 1e9f));
}

TEST(RelightTotal, AddsWhatIsBounced) {
  const std::vector<Irradiance4> direct{{1, 2, 3, 0}, {4, 5, 6, 0}}, indirect{{10, 20, 30, 0}, {0, 0, 1, 0}};
  EXPECT_EQ(total(direct, indirect), (std::vector<Irradiance4>{{11, 22, 33, 0}, {4, 5, 7, 0}}));
}

TEST(TransportLimits, OfNetworksAreNamedWithWhatWasGiven) {
  const RaySource empty_space([](const vec3&, const vec3&) { return rays::RayHit{}; });
  const std::vector<vec3> one{vec3(0)};
  const auto said = [&](const std::function<void(TransportParams&)>& change, float time = 0) {
    TransportParams params;
    params.directions = 8;
    change(params);
    return message_of([&] { TransportNetwork(empty_space, one, params, time); });
  };
  const auto fine = HasSubstr("no probe sees any surface");
  EXPECT_THAT(said([](TransportParams&) {}), fine);
  EXPECT_THAT(said([](TransportParams& p) { p.directions = 7; }),
              HasSubstr("directions: 7 is outside 8..65536"));
  EXPECT_THAT(said([](TransportParams& p) { p.directions = 65537; }),
              HasSubstr("directions: 65537 is outside"));
  EXPECT_THAT(said([](TransportParams& p) { p.directions = 65536; }), fine);
  EXPECT_THAT(said([](TransportParams& p) { p.link_rays = 4; }), fine);
  EXPECT_THAT(said([](TransportParams& p) { p.link_rays = 3; }),
              HasSubstr("link rays: 3 is outside 4..65536"));
  EXPECT_THAT(said([](TransportParams& p) { p.link_rays = 65537; }), HasSubstr("link rays"));
  EXPECT_THAT(said([](TransportParams& p) { p.samples = 1; }), fine);
  EXPECT_THAT(said([](TransportParams& p) { p.samples = 32; }), fine);
  EXPECT_THAT(said([](TransportParams& p) { p.samples = 0; }), HasSubstr("samples: 0 is outside 1..32"));
  EXPECT_THAT(said([](TransportParams& p) { p.samples = 33; }), HasSubstr("samples"));
  EXPECT_THAT(said([](TransportParams& p) { p.surfel_size = -1; }), HasSubstr("-1 is no length"));
  EXPECT_THAT(said([](TransportParams& p) { p.surfel_size = INFINITY; }), HasSubstr("is no length"));
  EXPECT_THAT(said([](TransportParams&) {}, NAN), HasSubstr("finite number of seconds"));
  EXPECT_THAT(message_of([&] { TransportNetwork(empty_space, {}, {}); }), HasSubstr("there are no probes"));
  const std::vector<vec3> bad{vec3(0), vec3(NAN)};
  EXPECT_THAT(message_of([&] { TransportNetwork(empty_space, bad, {}); }),
              HasSubstr("probe 1: its position"));
}

TEST(TransportLimits, OfFitsAreNamedWithWhatWasGiven) {
  const auto said = [&](const std::function<void(FitParams&)>& change) {
    FitParams params;
    change(params);
    return message_of([&] { WeightFit({{vec3(0)}}, params); });
  };
  const std::vector<std::tuple<int FitParams::*, int, int, std::string>> limits{
      {&FitParams::probes, 1, 16, "fitted probes"},
      {&FitParams::training_lights, 1, 1024, "training lights"},
      {&FitParams::gather_rays, 4, 65536, "gather rays"},
      {&FitParams::degree, 0, 10, "fit degree"}};
  for (const auto& limit : limits) {
    const auto field = std::get<0>(limit);
    const int low = std::get<1>(limit), high = std::get<2>(limit);
    for (const int good : {low, high}) EXPECT_EQ(said([&](FitParams& p) { p.*field = good; }), "no error");
    for (const int bad : {low - 1, high + 1})
      EXPECT_THAT(said([&](FitParams& p) { p.*field = bad; }),
                  HasSubstr(std::get<3>(limit) + ": " + std::to_string(bad) + " is outside " +
                            std::to_string(low) + ".." + std::to_string(high)));
  }
  EXPECT_EQ(said([](FitParams& p) { p.own_weight = 1000; }), "no error");
  EXPECT_THAT(said([](FitParams& p) { p.own_weight = 1001; }),
              HasSubstr("own weight: 1001 is outside 0..1000"));
  EXPECT_THAT(said([](FitParams& p) { p.own_weight = 0; }), HasSubstr("own weight"));
}

}  // namespace
}  // namespace ssphh::transport
