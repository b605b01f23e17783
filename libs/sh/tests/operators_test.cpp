#include <gtest/gtest.h>

#include <ssphh/sh/operators.h>
#include <ssphh/sh/project.h>
#include <ssphh/sh/reconstruct.h>

#include "random_sh.h"

namespace ssphh::sh {
namespace {

using test::largest_difference;
using test::random_sh;

RadianceSh constant(int degree, const vec3& level) {
  RadianceSh sh(degree);
  sh[0] = level * std::sqrt(4 * pi);
  return sh;
}

TEST(Operators, MeanIsTheAverageOverTheSphere) {
  const RadianceSh sh = random_sh(5, 1);
  const SphereQuadrature rule = sphere_quadrature(5);
  glm::dvec3 sum(0);
  for (std::size_t i = 0; i < rule.directions.size(); ++i) {
    sum += rule.weights[i] / (4 * pi_d) * glm::dvec3(eval(sh, vec3(rule.directions[i])));
  }
  EXPECT_LT(largest_difference(mean(sh), vec3(sum)), 1e-5f);  // single-precision evaluation
}

TEST(Operators, AddIsTheSumOfFunctions) {
  const RadianceSh a = random_sh(4, 1), b = random_sh(4, 2);
  const vec3 d = glm::normalize(vec3(1, -2, 3));
  EXPECT_LT(largest_difference(eval(add(a, b), d), eval(a, d) + eval(b, d)), 1e-5f);
}

TEST(Operators, CoefficientProductOfConstantsIsTheirProduct) {
  RadianceSh sum(3);
  add_coefficient_product(sum, constant(3, {0.5f, 0.25f, 1}), constant(3, {2, 3, 4}));
  EXPECT_LT(largest_difference(sum, constant(3, {1, 0.75f, 4})), 1e-5f);
}

TEST(Operators, CoefficientProductMultipliesEachCoefficient) {
  const RadianceSh h = random_sh(10, 1), s = random_sh(10, 2), start = random_sh(10, 3);
  RadianceSh sum = start;
  add_coefficient_product(sum, h, s);
  for (int k = 0; k < max_coefficient_count; ++k) {
    EXPECT_LT(largest_difference(sum[k], start[k] + h[k] * s[k] / std::sqrt(4 * pi)), 1e-6f);
  }
}

TEST(Operators, RawProductLeavesTheFactorOut) {
  const RadianceSh h = random_sh(10, 4), s = random_sh(10, 5), start = random_sh(10, 6);
  RadianceSh sum = start;
  add_raw_product(sum, h, s);
  for (int k = 0; k < max_coefficient_count; ++k)
    EXPECT_LT(largest_difference(sum[k], start[k] + h[k] * s[k]), 1e-6f);
}

// The weakness that theory states: two lobes toward −z give one toward +z.
TEST(Operators, CoefficientProductTurnsTwoLobesAround) {
  RadianceSh down(1), sum(1);
  down[2] = vec3(-1);
  add_coefficient_product(sum, down, down);
  EXPECT_GT(sum[2].x, 0);
}

TEST(Operators, MeanProductKeepsTheDirectionsOfTheResponse) {
  const RadianceSh h = random_sh(4, 1), s = random_sh(4, 2);
  RadianceSh sum(4);
  add_mean_product(sum, h, s);
  for (int k = 0; k < coefficient_count(4); ++k) EXPECT_LT(largest_difference(sum[k], h[k] * mean(s)), 1e-6f);
}

TEST(Operators, MeanAndCoefficientAgreeForAConstantSource) {
  RadianceSh response(2), a(2), b(2);
  response[0] = vec3(1, 2, 3);
  add_mean_product(a, response, constant(2, vec3(0.7f)));
  add_coefficient_product(b, response, constant(2, vec3(0.7f)));
  EXPECT_LT(largest_difference(a, b), 1e-6f);
}

TEST(TransferMatrix, IsTheSumOfItsPaths) {
  // A path brings throughput · L(emitted) from direction `arriving`: compare with projecting that.
  Pcg32 random(5);
  const RadianceSh source = random_sh(3, 6);
  TransferMatrix transfer(4, 3);
  std::vector<vec3> directions, radiance;
  for (int i = 0; i < 20; ++i) {
    const vec3 arriving = vec3(test::random_direction(random)),
               emitted = vec3(test::random_direction(random));
    const vec3 throughput = random.uniform3();
    add_path(transfer, throughput, arriving, emitted);
    directions.push_back(arriving);
    radiance.push_back(throughput * eval(source, emitted));
  }
  const std::vector<float> ones(directions.size(), 1.0f);
  RadianceSh sum(4);
  add_matrix_product(sum, transfer, source);
  EXPECT_LT(largest_difference(sum, project(4, directions, ones, radiance)),
            2e-5f);  // rounding of 20 · 16 terms

  TransferMatrix twice = transfer;
  twice += transfer;
  RadianceSh doubled(4);
  add_matrix_product(doubled, twice, source);
  sum *= vec3(2);
  EXPECT_LT(largest_difference(doubled, sum), 1e-5f);
}

}  // namespace
}  // namespace ssphh::sh
