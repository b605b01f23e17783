#include <algorithm>
#include <cmath>

#include <ssphh/transport/fitted_weights.h>

namespace ssphh::transport {
namespace {

/// Gram matrix and right side of the normal equations, with the ridge in them.
struct NormalEquations {
  std::size_t n;
  std::vector<double> gram, right;

  NormalEquations(std::span<const double> rows, std::span<const double> targets,
                  std::span<const double> prior, double ridge)
      : n(prior.size()), gram(n * n, 0), right(n, 0) {
    for (std::size_t r = 0; r < targets.size(); ++r) {
      const double* row = rows.data() + r * n;
      for (std::size_t i = 0; i < n; ++i) {
        right[i] += row[i] * targets[r];
        for (std::size_t j = 0; j < n; ++j) gram[i * n + j] += row[i] * row[j];
      }
    }
    double trace = 0;
    for (std::size_t i = 0; i < n; ++i) trace += gram[i * n + i];
    const double pull = ridge * trace / static_cast<double>(n);
    for (std::size_t i = 0; i < n; ++i) gram[i * n + i] += pull, right[i] += pull * prior[i];
  }

  /// Least squares over the variables in `free` by Cholesky's decomposition; false where they depend on each
  /// other.
  bool solve(std::span<const std::size_t> free, std::vector<double>& x) const {
    const std::size_t k = free.size();
    std::vector<double> l(k * k);
    x.resize(k);
    for (std::size_t i = 0; i < k; ++i) {
      for (std::size_t j = 0; j <= i; ++j) {
        double sum = gram[free[i] * n + free[j]];
        for (std::size_t m = 0; m < j; ++m) sum -= l[i * k + m] * l[j * k + m];
        if (i == j && !(sum > 1e-12 * gram[free[i] * n + free[i]])) return false;
        l[i * k + j] = i == j ? std::sqrt(sum) : sum / l[j * k + j];
      }
      x[i] = right[free[i]];
      for (std::size_t m = 0; m < i; ++m) x[i] -= l[i * k + m] * x[m];
      x[i] /= l[i * k + i];
    }
    for (std::size_t i = k; i-- > 0;) {
      for (std::size_t m = i + 1; m < k; ++m) x[i] -= l[m * k + i] * x[m];
      x[i] /= l[i * k + i];
    }
    return true;
  }

  /// Half the objective's slope against variable i, downhill positive.
  double descent(std::size_t i, const std::vector<double>& v) const {
    double sum = right[i];
    for (std::size_t j = 0; j < n; ++j) sum -= gram[i * n + j] * v[j];
    return sum;
  }
};

}  // namespace

std::vector<double> fit_non_negative(std::span<const double> rows, std::span<const double> targets,
                                     std::span<const double> prior, double ridge) {
  require(!prior.empty() && rows.size() == targets.size() * prior.size(), "least squares",
          "rows, targets and prior are not of matching sizes");
  const NormalEquations equations(rows, targets, prior, ridge);
  const std::size_t n = equations.n;
  std::vector<double> v(n, 0), x;
  std::vector<std::size_t> free;
  std::vector<bool> settled(n, false);  // needs no more looking at: zero, or dependent on others
  for (std::size_t i = 0; i < n; ++i) {
    settled[i] = !(equations.gram[i * n + i] > 0);
    if (settled[i]) v[i] = prior[i];
  }
  double scale = 0;
  for (const double r : equations.right) scale = std::max(scale, std::abs(r));

  // Each round frees the variable that promises most; those that turn negative on the way are bound again.
  for (std::size_t round = 0; round < 4 * n; ++round) {
    std::size_t best = n;
    double steepest = 1e-12 * scale;
    for (std::size_t i = 0; i < n; ++i) {
      if (settled[i] || std::find(free.begin(), free.end(), i) != free.end()) continue;
      const double descent = equations.descent(i, v);
      if (descent > steepest) steepest = descent, best = i;
    }
    if (best == n) break;
    free.push_back(best);
    if (!equations.solve(free, x)) {
      settled[best] = true;
      free.pop_back();
      continue;
    }
    while (std::any_of(x.begin(), x.end(), [](double value) { return !(value > 0); })) {
      double step = 1;
      for (std::size_t k = 0; k < free.size(); ++k) {
        if (!(x[k] > 0)) step = std::min(step, v[free[k]] / (v[free[k]] - x[k]));
      }
      std::vector<std::size_t> still_free;
      for (std::size_t k = 0; k < free.size(); ++k) {
        double& value = v[free[k]];
        const bool binds = !(x[k] > 0) && value / (value - x[k]) <= step;
        value = binds ? 0 : value + step * (x[k] - value);
        if (!binds) still_free.push_back(free[k]);
      }
      free.swap(still_free);
      equations.solve(free, x);
    }
    for (std::size_t k = 0; k < free.size(); ++k) v[free[k]] = x[k];
  }
  return v;
}

}  // namespace ssphh::transport
