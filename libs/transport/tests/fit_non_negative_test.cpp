/// Non-negative least squares against all active sets, one by one.

#include <algorithm>
#include <cmath>
#include <optional>

#include <gtest/gtest.h>

#include <ssphh/core/random.h>
#include <ssphh/transport/fitted_weights.h>

namespace ssphh::transport {
namespace {

struct Problem {
  std::vector<double> rows, targets, prior;
  double ridge = 0;

  std::size_t n() const { return prior.size(); }
  std::size_t m() const { return targets.size(); }
  double pull() const {
    double trace = 0;
    for (const double a : rows) trace += a * a;
    return ridge * trace / static_cast<double>(n());
  }
  double objective(const std::vector<double>& v) const {
    double sum = 0;
    for (std::size_t r = 0; r < m(); ++r) {
      double e = -targets[r];
      for (std::size_t i = 0; i < n(); ++i) e += rows[r * n() + i] * v[i];
      sum += e * e;
    }
    for (std::size_t i = 0; i < n(); ++i) sum += pull() * (v[i] - prior[i]) * (v[i] - prior[i]);
    return sum;
  }
};

/// Least squares over the variables in `set` alone, the others zero; none where the set is singular.
std::optional<std::vector<double>> solve_on(const Problem& p, unsigned set) {
  std::vector<std::size_t> free;
  for (std::size_t i = 0; i < p.n(); ++i) {
    if (set >> i & 1) free.push_back(i);
  }
  const std::size_t k = free.size();
  std::vector<std::vector<double>> a(k, std::vector<double>(k + 1, 0));
  for (std::size_t i = 0; i < k; ++i) {
    for (std::size_t r = 0; r < p.m(); ++r) {
      for (std::size_t j = 0; j < k; ++j)
        a[i][j] += p.rows[r * p.n() + free[i]] * p.rows[r * p.n() + free[j]];
      a[i][k] += p.rows[r * p.n() + free[i]] * p.targets[r];
    }
    a[i][i] += p.pull();
    a[i][k] += p.pull() * p.prior[free[i]];
  }
  for (std::size_t c = 0; c < k; ++c) {
    std::size_t best = c;
    for (std::size_t i = c + 1; i < k; ++i) {
      if (std::abs(a[i][c]) > std::abs(a[best][c])) best = i;
    }
    std::swap(a[c], a[best]);
    if (std::abs(a[c][c]) < 1e-12) return std::nullopt;
    for (std::size_t i = 0; i < k; ++i) {
      if (i == c) continue;
      const double f = a[i][c] / a[c][c];
      for (std::size_t j = c; j <= k; ++j) a[i][j] -= f * a[c][j];
    }
  }
  std::vector<double> v(p.n(), 0);
  for (std::size_t i = 0; i < k; ++i) v[free[i]] = a[i][k] / a[i][i];
  return v;
}

/// The best of all sets of free variables with a feasible answer: 2ⁿ solves.
std::vector<double> brute_force(const Problem& p) {
  std::vector<double> best(p.n(), 0);
  for (unsigned set = 0; set < 1u << p.n(); ++set) {
    const auto v = solve_on(p, set);
    if (!v || std::any_of(v->begin(), v->end(), [](double x) { return x < 0; })) continue;
    if (p.objective(*v) < p.objective(best)) best = *v;
  }
  return best;
}

Problem random_problem(std::size_t m, std::size_t n, double ridge, std::uint64_t seed) {
  Pcg32 random(seed);
  Problem p;
  p.ridge = ridge;
  for (std::size_t i = 0; i < m * n; ++i) p.rows.push_back(double(random.uniform()));
  for (std::size_t r = 0; r < m; ++r) p.targets.push_back(double(random.uniform()));
  p.prior.assign(n, 1.0 / static_cast<double>(n));
  return p;
}

TEST(FitNonNegative, EqualsTheBestOfAllActiveSets) {
  int bounded = 0;
  for (std::uint64_t seed = 0; seed < 60; ++seed) {
    for (const std::size_t n : {std::size_t{1}, std::size_t{3}, std::size_t{5}, std::size_t{7}}) {
      const Problem p = random_problem(12, n, seed % 2 ? 1e-2 : 1e-3, seed);
      const std::vector<double> v = fit_non_negative(p.rows, p.targets, p.prior, p.ridge);
      const std::vector<double> best = brute_force(p);
      for (std::size_t i = 0; i < n; ++i) {
        EXPECT_GE(v[i], 0);
        EXPECT_NEAR(v[i], best[i], 1e-9) << "seed " << seed << ", n " << n;
        bounded += best[i] == 0;
      }
    }
  }
  EXPECT_GT(bounded, 100) << "the bounds must matter in these problems";
}

TEST(FitNonNegative, GrowsAsWhatItIsFittedTo) {
  for (std::uint64_t seed = 0; seed < 40; ++seed) {
    Problem p = random_problem(40, 8, 1e-3, seed);
    if (seed % 2) {  // much alike: weights that were free meet their bounds on the way
      for (double& a : p.rows) a = 1 + 0.1 * (a - 0.5);
      for (double& b : p.targets) b = 1 + 0.1 * (b - 0.5);
    }
    const std::vector<double> v = fit_non_negative(p.rows, p.targets, p.prior, p.ridge);
    for (const double scale : {1e-4, 1e4}) {
      Problem other = p;
      for (double& t : other.targets) t *= scale;
      for (double& t : other.prior) t *= scale;
      const std::vector<double> scaled =
          fit_non_negative(other.rows, other.targets, other.prior, other.ridge);
      for (std::size_t i = 0; i < p.n(); ++i)
        EXPECT_NEAR(scaled[i], scale * v[i], 1e-9 * scale) << "seed " << seed << ", scale " << scale;
    }
  }
}

TEST(FitNonNegative, EqualsTheBestWhereProbesAreMuchAlike) {
  // Neighbours see nearly the same light: rows of 1 ± 5 %, for which descent along axes hardly moves.
  for (std::uint64_t seed = 0; seed < 20; ++seed) {
    Problem p = random_problem(40, 8, 1e-3, seed);
    for (double& a : p.rows) a = 1 + 0.1 * (a - 0.5);
    for (double& b : p.targets) b = 1 + 0.1 * (b - 0.5);
    const std::vector<double> v = fit_non_negative(p.rows, p.targets, p.prior, p.ridge);
    const std::vector<double> best = brute_force(p);
    for (std::size_t i = 0; i < p.n(); ++i) EXPECT_NEAR(v[i], best[i], 1e-8) << seed;
  }
}

TEST(FitNonNegative, RecoversKnownWeightsAndFollowsThePriorWhereNothingIsKnown) {
  Problem p = random_problem(24, 6, 0, 99);
  const std::vector<double> known{0.3, 0, 0.25, 0.05, 0, 0.4};
  for (std::size_t r = 0; r < p.m(); ++r) {
    p.targets[r] = 0;
    for (std::size_t i = 0; i < p.n(); ++i) p.targets[r] += p.rows[r * p.n() + i] * known[i];
  }
  const std::vector<double> v = fit_non_negative(p.rows, p.targets, p.prior, 0);
  for (std::size_t i = 0; i < p.n(); ++i) EXPECT_NEAR(v[i], known[i], 1e-9);

  // Two probes that always agree: only their sum is known; the ridge shares it equally.
  const std::vector<double> rows{1, 1, 2, 2, 0.5, 0.5}, targets{0.8, 1.6, 0.4}, prior{0.5, 0.5};
  const std::vector<double> shared = fit_non_negative(rows, targets, prior, 0.1);
  // What the ridge of 0.1 · 5.25 takes from 10.5 · 0.8 toward the prior's 1.
  EXPECT_NEAR(shared[0], shared[1], 1e-9);
  EXPECT_NEAR(shared[0] + shared[1], (10.5 * 0.8 + 0.525) / (10.5 + 0.525), 1e-9);

  // Dark probes and no lights at all leave the prior.
  EXPECT_EQ(fit_non_negative(std::vector<double>{0, 0}, std::vector<double>{1}, prior, 1e-3), prior);
  EXPECT_EQ(fit_non_negative({}, {}, prior, 1e-3), prior);
}

}  // namespace
}  // namespace ssphh::transport
