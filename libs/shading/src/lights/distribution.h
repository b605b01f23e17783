#pragma once
/// Discrete probability distribution, sampled by inversion so that stratified numbers stay stratified.

#include <cstddef>
#include <span>
#include <vector>

namespace ssphh::shading {

class Distribution {
 public:
  Distribution() = default;
  /// Probabilities proportional to `weights`; negative, NaN and infinite ones count as zero. Empty when all
  /// are zero.
  explicit Distribution(std::span<const float> weights) { assign(weights); }
  /// The same in place of what it was, in the memory of that.
  void assign(std::span<const float> weights);

  bool empty() const { return cdf_.empty(); }
  std::size_t size() const { return cdf_.empty() ? 0 : cdf_.size() - 1; }

  struct Choice {
    std::size_t index;
    float u;  ///< the place of u within the chosen one's share, again uniform in [0, 1)
    float probability;
  };
  /// `u` in [0, 1). Not for an empty distribution.
  Choice sample(float u) const;

  /// The probability with which sample() chooses `index`, rounding included.
  float probability(std::size_t index) const { return cdf_[index + 1] - cdf_[index]; }

 private:
  std::vector<float> cdf_;
};

/// A choice with probabilities proportional to `weights`, none negative, whose sum is `total` > 0.
Distribution::Choice choose_weighted(std::span<const float> weights, float total, float u);

}  // namespace ssphh::shading
