/// Fitted weights between points that lie at random, in light that differs by place, direction and colour.

#include <algorithm>
#include <functional>

#include <gtest/gtest.h>

#include <ssphh/probes/lookup.h>
#include <ssphh/probes/surface_spacing.h>

#include "fake_source.h"
#include "varied_light.h"

namespace ssphh::probes {
namespace {

const std::vector<vec3> places{{0, 1, 0}, {4, 1, 0}, {0, 1, 4}};

/// Points on the floor [0, 4]², each with three weights of its own.
FittedPoints scattered() {
  Pcg32 random(12);
  FittedPoints fitted;
  for (int i = 0; i < 120; ++i) {
    fitted.points.push_back({vec3(4 * random.uniform(), 0, 4 * random.uniform()), {0, 1, 0}});
    PointWeights& entry = fitted.weights.emplace_back();
    const vec3 weights = random.uniform3();
    for (int k = 0; k < 3; ++k) entry.add(k, 0.1f + weights[k]);
  }
  return fitted;
}

/// Of the point at x: a linear fit to those within three of their spacings, whose weights fall as
/// (1 − q²/9)⁸ over the spacing, less the least that come to a thousandth of the rest, and as 1/(1 + (d/2.5
/// s)⁴) with the distance in their mean spacing s, harmonic and weighted; with a ridge of 5 % of a squared
/// spacing on its slopes; so much of it that no more than a quarter of the weight is negative. In doubles.
std::vector<double> shares_at(const FittedPoints& fitted, const vec3& x, std::span<const float> spacings) {
  struct Near {
    double weight, spacing;
    std::size_t point;
  };
  std::vector<Near> near;
  double left = 0;
  for (std::size_t i = 0; i < fitted.points.size(); ++i) {
    const double spacing = static_cast<double>(spacings[i]);
    const double q = glm::distance(glm::dvec3(fitted.points[i].position), glm::dvec3(x)) / spacing;
    if (q < 3) near.push_back({std::pow(1 - q * q / 9, 8) / spacing, spacing, i});
    if (q < 3) left += near.back().weight;
  }
  std::ranges::sort(near, std::greater(), &Near::weight);
  double counted = 0, per_spacing = 0;
  std::size_t used = 0;
  for (; used < near.size() && left > 0.001 * counted; ++used) {
    left -= near[used].weight;
    counted += near[used].weight, per_spacing += near[used].weight / near[used].spacing;
  }
  near.resize(used);
  glm::dmat3 gram(0);
  double total = 0, ridge = 0;
  std::vector<std::pair<double, glm::dvec3>> rows;
  for (Near& n : near) {
    const glm::dvec3 d = glm::dvec3(fitted.points[n.point].position) - glm::dvec3(x), row(1, d.x, d.z);
    n.weight /= 1 + std::pow(glm::length(d) * per_spacing / (2.5 * counted), 4);
    gram += n.weight * glm::outerProduct(row, row);
    total += n.weight;
    ridge += 0.05 * n.weight * n.spacing * n.spacing;
    rows.emplace_back(n.weight, row);
  }
  EXPECT_LE(rows.size(), 24u);
  gram[1][1] += ridge, gram[2][2] += ridge;
  const glm::dvec3 solution = glm::inverse(gram)[0];
  double negative = 0, sum = 0;
  for (const auto& [weight, row] : rows) negative += weight * std::max(-glm::dot(solution, row), 0.0);
  const double most = std::min(1.0, 0.25 / negative);
  std::vector<double> shares(fitted.points.size(), 0);
  for (std::size_t k = 0; k < rows.size(); ++k) {
    const auto& [weight, row] = rows[k];
    sum += shares[near[k].point] = weight * ((1 - most) / total + most * glm::dot(solution, row));
  }
  for (double& share : shares) share /= sum;
  return shares;
}

TEST(FittedFields, LightIsThatOfALinearFitToThePointsAround) {
  ProbeSet set = test::varied_set(places, 4, test::light_at);
  set.fitted = scattered();
  const test::FakeSource source;
  LookupParams params;
  params.weights.method = WeightMethod::fitted;
  const IrradianceLookup lookup(set, source, params);
  const std::vector<float> spacings = surface_spacings(set.fitted->points);
  Pcg32 random(5);
  for (int i = 0; i < 60; ++i) {
    const rays::SurfacePoint p{vec3(4 * random.uniform(), 0, 4 * random.uniform()), {0, 1, 0}};
    const std::vector<double> shares = shares_at(*set.fitted, p.position, spacings);
    test::VariedLight light;
    for (std::size_t k = 0; k < shares.size(); ++k) {
      for (const ProbeWeight& entry : set.fitted->weights[k].used())
        light = light + static_cast<float>(shares[k]) * entry.weight * test::light_at(places[entry.probe]);
    }
    const vec3 found = lookup.irradiance(p), expected = light.irradiance(p.normal);
    // Floats in an ill-conditioned fit; all are 10 to 40
    for (int c = 0; c < 3; ++c) EXPECT_NEAR(found[c] / expected[c], 1, 1e-4) << i << ", channel " << c;
  }
}

}  // namespace
}  // namespace ssphh::probes
