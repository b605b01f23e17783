/// What rays leave in a ddgi probe's maps, in closed form.

#include "blend.h"

#include <cmath>

#include <gtest/gtest.h>

#include <ssphh/core/octahedral.h>
#include <ssphh/core/sphere.h>

namespace ssphh::methods::ddgi {
namespace {

const vec3 before(1, 4, 2), now(3, 1, 2.2f);

/// A probe whose every ray brings radiance now / π and ends 0.7 m away.
struct OneProbe {
  DdgiField field{[] {
    ProbeGrid grid;
    grid.spacing = {1, 2, 2};  // diagonal: 3 m
    return grid;
  }()};
  std::vector<vec3> directions = [] {
    std::vector<vec3> all;
    for (int i = 0; i < 128; ++i) all.push_back(spherical_fibonacci(i, 128));
    return all;
  }();
  std::vector<ProbeRay> rays{directions.size(), {now / pi, 0.7f}};
  std::vector<std::uint8_t> fresh{0};

  OneProbe() {
    std::ranges::fill(field.irradiance_texel, before);
    std::ranges::fill(field.moment_texel, vec2(2, 5));
  }
  void blend(const DdgiBlend& params) { blend_rays(field, rays, directions, params, fresh); }
  void expect_all(const vec3& expected) const {
    for (const vec3& e : field.irradiance_texel)
      for (int c = 0; c < 3; ++c) ASSERT_NEAR(e[c], expected[c], 1e-5f) << "channel " << c;
  }
};

TEST(DdgiBlend, KeepsItsShareOfTheLastFrame) {
  OneProbe probe;
  probe.blend({.hysteresis = 0.8f});
  probe.expect_all(0.8f * before + 0.2f * now);
  for (const vec2& m : probe.field.moment_texel) {
    EXPECT_NEAR(m.x, 0.8f * 2 + 0.2f * 0.7f, 1e-5f);
    EXPECT_NEAR(m.y, 0.8f * 5 + 0.2f * 0.49f, 1e-5f);
  }
}

TEST(DdgiBlend, OfAFreshProbeNothingStays) {
  OneProbe probe;
  probe.fresh[0] = 1;
  probe.blend({.hysteresis = 0.8f});
  probe.expect_all(now);
  EXPECT_NEAR(probe.field.moment_texel[17].x, 0.7f, 1e-5f);
  EXPECT_EQ(probe.fresh[0], 0);
}

TEST(DdgiBlend, LightThatChangesLeavesAQuarterAndThatChangesMuchNothing) {
  // The largest change of a channel is 3 of 4 there are.
  struct Case {
    float change, stays;
  };
  for (const Case& c : {Case{0.76f, 0.8f}, Case{0.74f, 0.2f}, Case{0.26f, 0.2f}, Case{0.24f, 0}}) {
    OneProbe probe;
    probe.blend({.hysteresis = 0.8f, .change = c.change});
    probe.expect_all(glm::mix(now, before, c.stays));
    EXPECT_NEAR(probe.field.moment_texel[0].x, 0.8f * 2 + 0.2f * 0.7f, 1e-5f) << "distances stay as they are";
  }
}

TEST(DdgiBlend, MixesPowersWhereAGammaIsGiven) {
  OneProbe probe;
  probe.blend({.hysteresis = 0.5f, .gamma = 2});
  const vec3 root = 0.5f * (glm::sqrt(before) + glm::sqrt(now));
  probe.expect_all(root * root);
}

TEST(DdgiBlend, WeighsRadianceByTheCosineAndDistanceByItsFiftiethPower) {
  OneProbe probe;
  const vec3 aside = glm::normalize(vec3(0.2f, 0.1f, 1));
  probe.directions = {{0, 0, 1}, aside, {1, 0, 0}};
  probe.rays = {{vec3(1, 2, 3), 0.5f}, {vec3(4, 1, 2), 1}, {vec3(0, 9, 1), 2}};
  probe.blend({.hysteresis = 0});
  for (std::size_t t = 0; t < probe.field.irradiance_texel.size(); ++t) {
    const glm::dvec3 d(octahedral_texel(static_cast<int>(t), DdgiField::irradiance_size));
    glm::dvec3 sum(0);
    double weights = 0;
    for (std::size_t r = 0; r < 3; ++r) {
      const double cosine = std::max(0.0, glm::dot(d, glm::dvec3(probe.directions[r])));
      sum += cosine * glm::dvec3(probe.rays[r].radiance);
      weights += cosine;
    }
    const glm::dvec3 expected = weights > 0 ? pi_d / weights * sum : glm::dvec3(before);
    for (int c = 0; c < 3; ++c) ASSERT_NEAR(double(probe.field.irradiance_texel[t][c]), expected[c], 1e-4);
  }
  for (std::size_t t = 0; t < probe.field.moment_texel.size(); ++t) {
    const glm::dvec3 d(octahedral_texel(static_cast<int>(t), DdgiField::moment_size));
    double sum = 0, squares = 0, weights = 0;
    for (std::size_t r = 0; r < 3; ++r) {
      const double cosine = std::max(0.0, glm::dot(d, glm::dvec3(probe.directions[r])));
      const double weight = std::pow(cosine, 50), distance = double(probe.rays[r].distance);
      sum += weight * distance, squares += weight * distance * distance, weights += weight;
    }
    if (weights < 2e-6) continue;
    ASSERT_NEAR(double(probe.field.moment_texel[t].x), sum / weights, 1e-4);
    ASSERT_NEAR(double(probe.field.moment_texel[t].y), squares / weights, 1e-4);
  }
}

TEST(DdgiBlend, DistancesEndAtOneAndAHalfDiagonals) {
  OneProbe probe;
  for (ProbeRay& ray : probe.rays) ray.distance = std::numeric_limits<float>::infinity();
  probe.blend({.hysteresis = 0});
  EXPECT_NEAR(probe.field.moment_texel[5].x, 4.5f, 1e-5f);
  EXPECT_NEAR(probe.field.moment_texel[5].y, 20.25f, 1e-4f);
}

TEST(DdgiBlend, RaysAreOfTheActiveProbesInTheirOrder) {
  ProbeGrid grid;
  grid.count = {3, 1, 1};
  DdgiField field(grid);
  std::ranges::fill(field.irradiance_texel, before);
  field.active[1] = 0;
  const std::vector<vec3> directions{{0, 0, 1}, {0, 0, -1}};
  const std::vector<ProbeRay> rays{{vec3(1), 1}, {vec3(1), 1}, {vec3(2), 1}, {vec3(2), 1}};
  std::vector<std::uint8_t> fresh{1, 1, 1};
  blend_rays(field, rays, directions, {}, fresh);
  EXPECT_NEAR(field.irradiance_of(0)[0].x, pi, 1e-5f);
  EXPECT_EQ(field.irradiance_of(1)[0], before);
  EXPECT_NEAR(field.irradiance_of(2)[0].x, 2 * pi, 1e-5f);
  EXPECT_EQ(fresh, (std::vector<std::uint8_t>{0, 1, 0}));
}

}  // namespace
}  // namespace ssphh::methods::ddgi
