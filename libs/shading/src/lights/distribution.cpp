#include "distribution.h"

#include <algorithm>
#include <cmath>

namespace ssphh::shading {
namespace {

double usable(float weight) {
  return std::isfinite(weight) && weight > 0 ? static_cast<double>(weight) : 0.0;
}

}  // namespace

void Distribution::assign(std::span<const float> weights) {
  cdf_.clear();
  double total = 0;
  for (const float w : weights) total += usable(w);
  if (!(total > 0)) return;
  cdf_.reserve(weights.size() + 1);
  cdf_.push_back(0);
  double sum = 0;
  std::size_t last = 0;
  for (const float w : weights) {
    sum += usable(w);
    cdf_.push_back(static_cast<float>(sum / total));
    if (w > 0) last = cdf_.size() - 1;
  }
  std::fill(cdf_.begin() + static_cast<std::ptrdiff_t>(last), cdf_.end(), 1.0f);
}

Distribution::Choice Distribution::sample(float u) const {
  // The first entry above u belongs to an interval that is not empty
  const auto above = std::upper_bound(cdf_.begin() + 1, cdf_.end() - 1, u);
  const auto index = static_cast<std::size_t>(above - cdf_.begin()) - 1;
  const float share = probability(index);
  constexpr float below_one = 0x1.fffffep-1f;
  return {index, std::clamp((u - cdf_[index]) / share, 0.0f, below_one), share};
}

Distribution::Choice choose_weighted(std::span<const float> weights, float total, float u) {
  const float at = u * total;
  std::size_t chosen = 0;
  float below = 0, next = 0;
  for (std::size_t i = 0; i < weights.size(); ++i) {
    if (!(weights[i] > 0)) continue;
    chosen = i, below = next, next += weights[i];
    if (at < next) break;  // else rounding at the end of the sum falls to the last one
  }
  const float w = weights[chosen];
  return {chosen, std::clamp((at - below) / w, 0.0f, 0x1.fffffep-1f), w / total};
}

}  // namespace ssphh::shading
