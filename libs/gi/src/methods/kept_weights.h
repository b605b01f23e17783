#pragma once

#include <ssphh/gi/lookup_weights.h>

namespace ssphh::gi::methods {

/// Weights that outlive the lookups of single frames, which own theirs.
class KeptWeights final : public LookupWeights {
 public:
  explicit KeptWeights(const LookupWeights& weights) : weights_(weights) {}
  ProbeWeights at(const scene::SurfacePoint& point) const override { return weights_.at(point); }
  std::size_t bytes() const override { return weights_.bytes(); }

 private:
  const LookupWeights& weights_;
};

}  // namespace ssphh::gi::methods
