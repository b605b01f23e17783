#pragma once

#include <ssphh/probes/lookup_weights.h>

namespace ssphh::methods {

/// Weights that outlive the lookups of single frames, which own theirs.
class KeptWeights final : public probes::LookupWeights {
 public:
  explicit KeptWeights(const probes::LookupWeights& weights) : weights_(weights) {}
  probes::ProbeWeights at(const rays::SurfacePoint& point) const override { return weights_.at(point); }
  std::size_t bytes() const override { return weights_.bytes(); }

 private:
  const probes::LookupWeights& weights_;
};

}  // namespace ssphh::methods
