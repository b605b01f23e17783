#pragma once
/// How much each probe counts at a surface point: E(x, n) = Σ_j v_j(x, n) E_j(n). Visibility is the factor
/// that matters; the rest is measured in docs/methods/transport.md.

#include <algorithm>
#include <array>
#include <functional>
#include <memory>
#include <optional>
#include <span>
#include <string>
#include <vector>

#include <ssphh/core/math.h>

namespace ssphh::gi {

enum class WeightMethod {
  distance,   ///< inverse squared distance and wrapped cosine, 8 nearest visible of 16
  trilinear,  ///< tent of one spacing along each axis: trilinear interpolation where probes stand on a grid
  mls         ///< moving least squares: the value at x of a linear fit to the visible probes around
};

const char* to_string(WeightMethod method);
std::optional<WeightMethod> parse_weight_method(const std::string& name);

struct ProbeWeight {
  int probe;
  float weight;

  friend bool operator==(const ProbeWeight&, const ProbeWeight&) = default;
};
inline constexpr int max_weights = 16;
/// The first `count` entries hold.
struct ProbeWeights {
  std::array<ProbeWeight, max_weights> entries;
  int count = 0;

  std::span<const ProbeWeight> used() const { return {entries.data(), static_cast<std::size_t>(count)}; }
  friend bool operator==(const ProbeWeights& a, const ProbeWeights& b) {
    return std::ranges::equal(a.used(), b.used());
  }
};

/// Whether nothing blocks the way from a point just above a surface to a probe.
using SeesProbe = std::function<bool(const vec3& from, const vec3& probe)>;

struct WeightParams {
  WeightMethod method = WeightMethod::distance;
  int nearest = 8;          ///< distance: so many visible probes, 1..16
  float spacing = 0;        ///< metres between probes; 0: the median distance to the nearest neighbour
  float normal_offset = 0;  ///< metres that visibility rays start off the surface; 0: 1 % of the distance to
                            ///< the probe, at most 1 % of the spacing
};

class LookupWeights {
 public:
  virtual ~LookupWeights() = default;
  /// Weights at a surface point: never empty, finite, with a sum of 1 (fitted weights: about 1); `mls` may
  /// have negative ones. When no probe sees the point, the nearest ones serve. Safe to call from several
  /// threads.
  virtual ProbeWeights at(const vec3& x, const vec3& n) const = 0;
};

/// Throws Error without positions.
std::unique_ptr<LookupWeights> make_weights(std::span<const vec3> positions, SeesProbe sees,
                                            const WeightParams& params = {});

/// Median distance of a probe to its nearest neighbour [m]; infinite for one probe.
float median_spacing(std::span<const vec3> positions);

}  // namespace ssphh::gi
