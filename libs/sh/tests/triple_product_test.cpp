#include <map>

#include <gtest/gtest.h>

#include <ssphh/sh/evaluate.h>
#include <ssphh/sh/project.h>
#include <ssphh/sh/reconstruct.h>
#include <ssphh/sh/triple_product.h>

#include "random_sh.h"

namespace ssphh::sh {
namespace {

using test::largest_difference;
using test::random_sh;

TEST(TripleProduct, EqualsBruteForceQuadratureForEveryIndex) {
  constexpr int degree = 3, count = coefficient_count(degree);
  std::map<std::array<int, 3>, double> entries;
  const TripleProductTensor tensor(degree, degree, degree);
  for (const auto& e : tensor.entries()) {
    const bool added =
        entries.emplace(std::array<int, 3>{e.i, e.j, e.k}, static_cast<double>(e.value)).second;
    EXPECT_TRUE(added) << "listed twice";
  }
  const SphereQuadrature rule = sphere_quadrature(3 * degree);
  std::vector<double> truth(count * count * count, 0.0);
  std::array<double, count> y{};
  for (std::size_t q = 0; q < rule.directions.size(); ++q) {
    eval_basis(degree, rule.directions[q], y);
    for (std::size_t t = 0; t < truth.size(); ++t) {
      truth[t] += rule.weights[q] * y[t / (count * count)] * y[t / count % count] * y[t % count];
    }
  }
  std::size_t nonzero = 0;
  for (int t = 0; t < count * count * count; ++t) {
    const auto found = entries.find({t / (count * count), t / count % count, t % count});
    const double exact = truth[t];
    nonzero += std::abs(exact) > 1e-12 ? 1 : 0;
    // Stored in single precision.
    EXPECT_NEAR(found == entries.end() ? 0 : found->second, exact, 1e-7) << t;
  }
  EXPECT_EQ(entries.size(), nonzero);
}

TEST(TripleProduct, ProductEqualsTheProductOfFunctions) {
  const TripleProductTensor tensor(4, 5, 9);
  const RadianceSh f = random_sh(4, 1), g = random_sh(5, 2);
  const RadianceSh product = tensor.product(f, g);
  Pcg32 random(3);
  for (int i = 0; i < 50; ++i) {
    const vec3 d = vec3(test::random_direction(random));
    // 9 bands suffice for degree 4 + 5; single-precision evaluation of values up to ~50.
    EXPECT_LT(largest_difference(eval(product, d), eval(f, d) * eval(g, d)), 2e-4f);
  }
}

TEST(TripleProduct, TruncatedProductIsTheProjection) {
  const TripleProductTensor tensor(max_degree, max_degree, max_degree);
  const RadianceSh f = random_sh(max_degree, 1), g = random_sh(max_degree, 2);
  const RadianceSh truth = project(max_degree, sphere_quadrature(3 * max_degree),
                                   [&](const vec3& d) { return eval(f, d) * eval(g, d); });
  // Coefficients up to ~60, single-precision functions under the integral: 1e-5 of that.
  EXPECT_LT(largest_difference(tensor.product(f, g), truth), 6e-4f);
}

TEST(TripleProduct, OfAConstantOneIsTheFunction) {
  const RadianceSh f = random_sh(6, 1);
  RadianceSh one(0);
  one[0] = vec3(std::sqrt(4 * pi));
  EXPECT_LT(largest_difference(TripleProductTensor(6, 0, 6).product(f, one), f), 1e-6f);
}

}  // namespace
}  // namespace ssphh::sh
