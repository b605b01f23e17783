/// Photons of given lights, and the virtual lights that they leave.

#include "photons.h"

#include <gtest/gtest.h>

#include "given_light.h"
#include "ray_source.h"

namespace ssphh::methods::vpl {
namespace {

using test::GivenLight;
using test::RaySource;
using test::surface_at;

const vec3 albedo(0.8f, 0.4f, 0.2f);

/// y = 0, lit from above.
const RaySource floor_below([](const vec3& p, const vec3& d) {
  if (!(d.y < 0)) return rays::RayHit{};
  rays::RayHit hit = surface_at(p.y / -d.y, d);
  hit.normal = {0, 1, 0};
  hit.albedo = albedo;
  return hit;
});

/// The inside of a sphere of radius 1 around the origin.
RaySource hollow(const vec3& reflects) {
  return RaySource([=](const vec3& p, const vec3& d) {
    const float b = glm::dot(p, d), root = std::sqrt(std::max(b * b - glm::dot(p, p) + 1, 0.0f));
    rays::RayHit hit;
    hit.distance = root - b;
    hit.normal = -glm::normalize(p + hit.distance * d);
    hit.albedo = reflects;
    return hit;
  });
}

/// Straight down from 2 m, in the group's colour.
GivenLight downward(const std::vector<float>& fluxes) {
  GivenLight light;
  light.fluxes = fluxes;
  light.photon = [](int group, const rays::PhotonNumbers& n) {
    return rays::Photon{
        vec3(n.place.x, 2, n.place.y), {0, -1, 0}, group == 0 ? vec3(5, 3, 1) : vec3(0, 0, 8), 0};
  };
  return light;
}

std::vector<Vpl> trace(const GivenLight& light, const rays::TransportSource& source,
                       const PhotonParams& params, const std::vector<vec3>& scales) {
  return trace_photons(light, scales, rays::PosedWorld(source, 0), params, {});
}

vec3 whole_power(const std::vector<Vpl>& lights) {
  vec3 sum(0);
  for (const Vpl& light : lights) sum += light.power;
  return sum;
}

void expect_power(const vec3& actual, const vec3& expected, float relative) {
  for (int c = 0; c < 3; ++c)
    EXPECT_NEAR(actual[c], expected[c], relative * expected[c] + 1e-6f) << "channel " << c;
}

TEST(VplPhotons, AreSharedOutByScaledFluxAndCarryTheirGroupsPowerTogether) {
  const GivenLight light = downward({10, 15});
  // 10 · 3 to 15 · 2: the largest channel of a scale counts.
  const std::vector<Vpl> lights = trace(light, floor_below, {.photons = 400}, {vec3(3, 1, 2), vec3(0, 0, 2)});
  ASSERT_EQ(lights.size(), 400u);
  EXPECT_EQ(std::count_if(lights.begin(), lights.end(), [](const Vpl& l) { return l.power.r > 0; }), 200);
  expect_power(whole_power(lights), albedo * (vec3(5, 3, 1) * vec3(3, 1, 2) + vec3(0, 0, 8 * 2)), 1e-4f);
  EXPECT_EQ(trace(light, floor_below, {.photons = 400}, {vec3(1), vec3(0)}).size(), 400u)
      << "a group that is off";
  EXPECT_EQ(trace(downward({1e4f, 1e-4f}), floor_below, {.photons = 400}, {vec3(1), vec3(1)}).size(), 401u)
      << "one at least of what shines";
  EXPECT_EQ(trace(downward({1, 0}), floor_below, {.photons = 400}, {vec3(1), vec3(1)}).size(), 400u);
}

TEST(VplPhotons, StandATenThousandthOfTheScenesRadiusAboveWhatTheyMeet) {
  for (const Vpl& light : trace(downward({1}), floor_below, {.photons = 16}, {vec3(1)})) {
    EXPECT_NEAR(light.position.y, 1e-4f * std::sqrt(3.0f), 1e-9f) << "bounds of ±1";
    EXPECT_GE(light.position.x, 0);
    EXPECT_LT(light.position.x, 1);
    EXPECT_EQ(light.normal, vec3(0, 1, 0));
    EXPECT_EQ(light.radius, 0);
    expect_power(light.power, albedo * vec3(5, 3, 1) / 16.0f, 1e-5f);
  }
}

TEST(VplPhotons, LosePowerOverTheRangeOfTheirLight) {
  GivenLight light = downward({1});
  light.photon = [](int, const rays::PhotonNumbers&) {
    return rays::Photon{{0, 2, 0}, {0, -1, 0}, vec3(1), 4};
  };
  // 1 − (2 / 4)⁴
  expect_power(whole_power(trace(light, floor_below, {.photons = 4}, {vec3(1)})), 15.0f / 16 * albedo, 1e-5f);
  light.photon = [](int, const rays::PhotonNumbers&) { return std::optional<rays::Photon>(); };
  EXPECT_TRUE(trace(light, floor_below, {.photons = 4}, {vec3(1)}).empty()) << "fell on darkness";
}

TEST(VplPhotons, SurviveWithTheLargestShareThatIsReflectedUpToTheDepth) {
  const RaySource room = hollow({0.5f, 0.25f, 0});
  constexpr int photons = 4000;
  GivenLight light;
  light.fluxes = {1};
  light.photon = [](int, const rays::PhotonNumbers&) { return rays::Photon{vec3(0), {0, 0, 1}, vec3(8), 0}; };
  const auto trace_to = [&](int depth) {
    return trace(light, room, {.photons = photons, .depth = depth}, {vec3(1)});
  };
  EXPECT_TRUE(trace_to(1).empty());
  const std::vector<Vpl> first = trace_to(2);
  ASSERT_EQ(first.size(), std::size_t{photons});
  expect_power(whole_power(first), 8.0f * vec3(0.5f, 0.25f, 0), 1e-3f);
  // Half of them go on: of a binomial distribution five deviations.
  const std::vector<Vpl> second = trace_to(3);
  const auto deviation = static_cast<float>(std::sqrt(photons * 0.25));
  EXPECT_NEAR(static_cast<float>(second.size()), 1.5f * photons, 5 * deviation);
  // Each arrives with P ρ / 0.5 and leaves ρ of that.
  const vec3 reflected = 8.0f / photons * vec3(0.5f, 0.125f, 0);
  for (std::size_t i = photons; i < second.size(); ++i) {
    expect_power(second[i].power, reflected, 1e-4f);
    EXPECT_NEAR(glm::length(second[i].position), 1, 1e-3f);
    EXPECT_NEAR(glm::dot(second[i].position, second[i].normal), -1, 1e-3f);
  }
  // All bounces: 8 ρ / (1 − ρ) in each channel. Generations are of a geometric law of mean 2 and variance 2.
  const vec3 all = whole_power(trace_to(60));
  const float error = 5 * std::sqrt(2.0f / photons);
  EXPECT_NEAR(all.r, 8, 8 * error);
  EXPECT_NEAR(all.g, 8.0f / 3, 8.0f / 3 * error);
  EXPECT_EQ(all.b, 0);
}

TEST(VplPhotons, OfAGreySphereSpreadEvenlyOverIt) {
  // A cosine lobe from the inside of a sphere lights all of it alike, whatever the place that it leaves.
  const RaySource room = hollow(vec3(1));
  GivenLight light;
  light.fluxes = {1};
  light.photon = [](int, const rays::PhotonNumbers&) { return rays::Photon{vec3(0), {0, 0, 1}, vec3(1), 0}; };
  constexpr int photons = 4000;
  const std::vector<Vpl> lights = trace(light, room, {.photons = photons, .depth = 3}, {vec3(1)});
  ASSERT_EQ(lights.size(), 2u * photons) << "nothing is absorbed";
  vec3 mean(0), squares(0);
  for (std::size_t i = photons; i < lights.size(); ++i) {
    mean += lights[i].position / static_cast<float>(photons);
    squares += lights[i].position * lights[i].position / static_cast<float>(photons);
  }
  // Of independent points: variances 1/3 of a coordinate and 4/45 of its square; five deviations.
  for (int c = 0; c < 3; ++c) {
    EXPECT_NEAR(mean[c], 0, 5 * std::sqrt(1.0f / 3 / photons));
    EXPECT_NEAR(squares[c], 1.0f / 3, 5 * std::sqrt(4.0f / 45 / photons));
  }
}

TEST(VplPhotons, GroupsAndSeedsHaveNumbersOfTheirOwn) {
  std::vector<std::vector<float>> drawn;
  const auto draw = [&](std::uint64_t seed) {
    GivenLight light;
    light.fluxes = {1, 1};
    std::vector<float> numbers[2];
    light.photon = [&](int group, const rays::PhotonNumbers& n) {
      for (const float u : {n.emitter, n.place.x, n.place.y, n.direction.x, n.direction.y}) {
        EXPECT_GE(u, 0);
        EXPECT_LT(u, 1);
        numbers[group].push_back(u);
      }
      return std::optional<rays::Photon>();
    };
    trace(light, floor_below, {.photons = 20, .seed = seed}, {vec3(1), vec3(1)});
    drawn.push_back(numbers[0]), drawn.push_back(numbers[1]);
  };
  draw(0), draw(0), draw(1);
  EXPECT_EQ(drawn[0].size(), 50u);
  EXPECT_EQ(drawn[0], drawn[2]);
  EXPECT_EQ(drawn[1], drawn[3]);
  EXPECT_NE(drawn[0], drawn[1]);
  EXPECT_NE(drawn[0], drawn[4]);
}

}  // namespace
}  // namespace ssphh::methods::vpl
