#pragma once
/// Weights of the few probes that light one point.

#include <array>
#include <span>

#include <ssphh/core/require.h>

namespace ssphh::probes {

struct ProbeWeight {
  int probe;
  float weight;

  friend bool operator==(const ProbeWeight&, const ProbeWeight&) = default;
};
/// Weights of up to `capacity` probes; the first `count` entries hold.
template <int capacity>
struct WeightList {
  std::array<ProbeWeight, capacity> entries;
  int count = 0;

  /// Throws Error when the list is full.
  void add(int probe, float weight) {
    require(count < capacity, "list of weights", "it is full");
    entries[count++] = {probe, weight};
  }
  std::span<const ProbeWeight> used() const& { return {entries.data(), static_cast<std::size_t>(count)}; }
  std::span<ProbeWeight> used() & { return {entries.data(), static_cast<std::size_t>(count)}; }
  void used() const&& = delete;  // the list would be gone
  friend bool operator==(const WeightList& a, const WeightList& b) {
    if (a.count != b.count) return false;
    for (std::size_t i = 0; i < a.used().size(); ++i)
      if (a.used()[i] != b.used()[i]) return false;
    return true;
  }
};
/// Probes among which one point chooses.
inline constexpr int max_weights = 16;
using PointWeights = WeightList<max_weights>;
/// Probes that light one point by the method `distance`, unless said otherwise.
inline constexpr int blended_probes = 8;
/// What a lookup returns: `fitted` joins the weights of several points.
using ProbeWeights = WeightList<48>;

}  // namespace ssphh::probes
