#pragma once
/// Statistical tests of estimators: a mean against its true value or another mean, with stated significance.
/// Seeds are fixed, so a test that passes once passes always; the significance says how often a correct
/// estimator would fail when somebody changes the sampling.

#include <cmath>
#include <cstddef>

#include <gtest/gtest.h>

namespace ssphh::test {

/// Mean and variance of independent, equally distributed samples (Welford's recurrence).
class Samples {
 public:
  void add(double x) {
    ++count_;
    const double delta = x - mean_;
    mean_ += delta / static_cast<double>(count_);
    squares_ += delta * (x - mean_);
  }
  std::size_t count() const { return count_; }
  double mean() const { return mean_; }
  /// Of one sample, unbiased.
  double variance() const { return count_ > 1 ? squares_ / static_cast<double>(count_ - 1) : 0; }
  double variance_of_mean() const { return count_ > 0 ? variance() / static_cast<double>(count_) : 0; }

 private:
  std::size_t count_ = 0;
  double mean_ = 0, squares_ = 0;
};

/// How strict a family of tests is: `level` is the chance that a correct program fails any of the `tests`
/// comparisons.
struct Significance {
  double level = 1e-3;
  int tests = 1;

  /// Of one comparison (Šidák).
  double single() const { return 1 - std::pow(1 - level, 1.0 / tests); }
};

/// Chance that a normal variable lies at least |z| deviations from its mean.
inline double two_sided_p(double z) {
  return std::erfc(std::abs(z) / std::sqrt(2.0));
}

/// Whether a difference is explained by its variance. `rounding` is what floating-point or a stated
/// approximation may add; it is all that is allowed when the variance is zero.
inline ::testing::AssertionResult difference_is_noise(double difference, double variance,
                                                      Significance significance, double rounding) {
  const double beyond = std::max(0.0, std::abs(difference) - rounding);
  const double deviation = std::sqrt(variance);
  if (!std::isfinite(beyond)) return ::testing::AssertionFailure() << "the mean is not finite";
  if (beyond == 0) return ::testing::AssertionSuccess() << "within rounding";
  const double z = deviation > 0 ? beyond / deviation : INFINITY;
  const double p = two_sided_p(z);
  auto result = p >= significance.single() ? ::testing::AssertionSuccess() : ::testing::AssertionFailure();
  return result << "difference " << difference << ", standard error " << deviation << ", z " << z << ", p "
                << p << ", allowed " << significance.single();
}

/// z-test of a mean against its true value. Wants enough samples for the central limit theorem: 30 at least.
inline ::testing::AssertionResult mean_is(const Samples& samples, double expected,
                                          Significance significance = {}, double rounding = 0) {
  if (samples.count() < 30) return ::testing::AssertionFailure() << "too few samples: " << samples.count();
  return difference_is_noise(samples.mean() - expected, samples.variance_of_mean(), significance, rounding)
         << " (mean " << samples.mean() << ", expected " << expected << ")";
}

/// z-test of two independent estimators of one value.
inline ::testing::AssertionResult means_agree(const Samples& a, const Samples& b,
                                              Significance significance = {}, double rounding = 0) {
  if (a.count() < 30 || b.count() < 30) return ::testing::AssertionFailure() << "too few samples";
  return difference_is_noise(a.mean() - b.mean(), a.variance_of_mean() + b.variance_of_mean(), significance,
                             rounding)
         << " (means " << a.mean() << " and " << b.mean() << ")";
}

}  // namespace ssphh::test
