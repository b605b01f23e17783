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

#include <ssphh/core/enum_names.h>
#include <ssphh/core/require.h>
#include <ssphh/rays/transport_source.h>

namespace ssphh::probes {

struct FittedPoints;

enum class WeightMethod {
  distance,   ///< inverse squared distance and wrapped cosine, 8 nearest visible of 16
  trilinear,  ///< tent of one spacing along each axis: trilinear interpolation where probes stand on a grid
  mls,        ///< moving least squares: the value at x of a linear fit to the visible probes around
  fitted,     ///< fitted to light transport beforehand, at points of surfaces that stand still
  surface     ///< none: surfaces that stand still have records of their own light (SurfaceRecords)
};

constexpr auto enum_table(WeightMethod) {
  using enum WeightMethod;
  return std::to_array<EnumName<WeightMethod>>({{distance, "distance"},
                                                {trilinear, "trilinear"},
                                                {mls, "mls"},
                                                {fitted, "fitted"},
                                                {surface, "surface"}});
}

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
    entries[static_cast<std::size_t>(count++)] = {probe, weight};
  }
  std::span<const ProbeWeight> used() const& { return {entries.data(), static_cast<std::size_t>(count)}; }
  std::span<ProbeWeight> used() & { return {entries.data(), static_cast<std::size_t>(count)}; }
  void used() const&& = delete;  // the list would be gone
  friend bool operator==(const WeightList& a, const WeightList& b) {
    return std::ranges::equal(a.used(), b.used());
  }
};
/// Probes among which one point chooses.
inline constexpr int max_weights = 16;
using PointWeights = WeightList<max_weights>;
/// Probes that light one point by the method `distance`, unless said otherwise.
inline constexpr int blended_probes = 8;
/// What a lookup returns: `fitted` joins the weights of several points.
using ProbeWeights = WeightList<48>;

/// Whether nothing blocks the way between two points, the first just above a surface.
using SeesProbe = std::function<bool(const vec3& from, const vec3& probe)>;

struct WeightParams {
  /// None: the best by measurement (docs/methods/transport-results.md) of what is given: `surface` where
  /// there are records, `fitted` where points have weights, else `fallback`.
  std::optional<WeightMethod> method;
  /// Of `fitted` and `surface`, for what moves and where no point is near.
  WeightMethod fallback = WeightMethod::mls;
  int nearest = blended_probes;  ///< distance: so many visible probes, 1..16
  float spacing = 0;             ///< metres between probes; 0: the median distance to the nearest neighbour
  float normal_offset = 0;  ///< metres that visibility rays start off the surface; 0: 1 % of the distance to
                            ///< the probe, at most 1 % of the spacing

  /// What a lookup takes for surfaces that stand still.
  WeightMethod chosen(bool has_fitted, bool has_records = false) const {
    return method.value_or(has_records  ? WeightMethod::surface
                           : has_fitted ? WeightMethod::fitted
                                        : fallback);
  }
};

/// Defaults with the method of that name; empty: none. Throws Error for an unknown name.
WeightParams weights_named(const std::string& name);

class LookupWeights {
 public:
  virtual ~LookupWeights() = default;
  /// Weights at a surface point: never empty, finite, with a sum of 1 (fitted weights: about 1); `mls` and
  /// `fitted` may have negative ones. When no probe sees the point, the nearest ones serve, less those that
  /// stand below its tangent plane: the sum is then from 0 to 1. Safe to call from several threads.
  virtual ProbeWeights at(const rays::SurfacePoint& point) const = 0;
  /// Memory of what at() reads, without the scene that its rays meet.
  virtual std::size_t bytes() const = 0;
};

/// `fitted` is copied; the method of that name needs it, and with `surface` it serves what the records do
/// not, as `fallback` does without it. Throws Error without positions or `sees`, for positions and parameters
/// that are not finite, for the method `fitted` without points, and for points that name a probe which there
/// is not. `nearest` is clamped.
std::unique_ptr<LookupWeights> make_weights(std::span<const vec3> positions, SeesProbe sees,
                                            const WeightParams& params = {},
                                            const FittedPoints* fitted = nullptr);

/// Median distance of a probe to its nearest neighbour [m]; infinite for one probe.
float median_spacing(std::span<const vec3> positions);

}  // namespace ssphh::probes
