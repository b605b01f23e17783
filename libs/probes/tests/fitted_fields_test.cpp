/// Fitted weights between points that lie at random, in light that differs by place, direction and colour.

#include <algorithm>

#include <gtest/gtest.h>

#include <ssphh/probes/lookup.h>

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

/// Of the point at x: a linear fit to the twelve nearest within four spacings, whose weights fall to 0 at the
/// farthest or there, with a ridge of 5 % on its slopes; so much of it that no point counts less than -1/4 of
/// its share of the mean. In doubles.
std::vector<double> shares_at(const FittedPoints& fitted, const vec3& x, double spacing) {
  std::vector<std::pair<double, std::size_t>> near;
  for (std::size_t i = 0; i < fitted.points.size(); ++i)
    near.emplace_back(glm::distance(glm::dvec3(fitted.points[i].position), glm::dvec3(x)), i);
  std::ranges::sort(near);
  std::erase_if(near, [&](const auto& n) { return n.first > 4 * spacing; });
  near.resize(std::min<std::size_t>(near.size(), 12));
  const double reach = near.size() == 12 ? near.back().first * 1.0001 : 4 * spacing;
  glm::dmat3 gram(0);
  double total = 0;
  std::vector<std::pair<double, glm::dvec3>> rows;
  for (const auto& [distance, i] : near) {
    const double t = 1 - std::pow(distance / reach, 2), weight = t * t;
    const glm::dvec3 d = (glm::dvec3(fitted.points[i].position) - glm::dvec3(x)) / spacing, row(1, d.x, d.z);
    gram += weight * glm::outerProduct(row, row);
    total += weight;
    rows.emplace_back(weight, row);
  }
  gram[1][1] += 0.05 * total, gram[2][2] += 0.05 * total;
  const glm::dvec3 solution = glm::inverse(gram)[0];
  double most = 1, sum = 0;
  for (const auto& [weight, row] : rows) {
    const double relative = total * glm::dot(solution, row);
    if (relative < -0.25) most = std::min(most, 1.25 / (1 - relative));
  }
  std::vector<double> shares(fitted.points.size(), 0);
  for (std::size_t k = 0; k < rows.size(); ++k) {
    const auto& [weight, row] = rows[k];
    sum += shares[near[k].second] = weight * ((1 - most) / total + most * glm::dot(solution, row));
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
  std::vector<vec3> positions;
  for (const rays::SurfacePoint& p : set.fitted->points) positions.push_back(p.position);
  const auto spacing = static_cast<double>(median_spacing(positions));
  Pcg32 random(5);
  for (int i = 0; i < 60; ++i) {
    const rays::SurfacePoint p{vec3(4 * random.uniform(), 0, 4 * random.uniform()), {0, 1, 0}};
    const std::vector<double> shares = shares_at(*set.fitted, p.position, spacing);
    test::VariedLight light;
    for (std::size_t k = 0; k < shares.size(); ++k) {
      for (const ProbeWeight& entry : set.fitted->weights[k].used())
        light = light + static_cast<float>(shares[k]) * entry.weight *
                            test::light_at(places[static_cast<std::size_t>(entry.probe)]);
    }
    const vec3 found = lookup.irradiance(p), expected = light.irradiance(p.normal);
    // Floats in an ill-conditioned fit; all are 10 to 40
    for (int c = 0; c < 3; ++c) EXPECT_NEAR(found[c] / expected[c], 1, 1e-4) << i << ", channel " << c;
  }
}

}  // namespace
}  // namespace ssphh::probes
