#pragma once
/// How much each probe counts at a surface point: E(x, n) = Σ_j v_j(x, n) E_j(n). Visibility is the factor
/// that matters; the rest is measured in docs/methods/transport.md.

#include <functional>
#include <memory>
#include <span>
#include <string>

#include <ssphh/probes/weight_list.h>
#include <ssphh/probes/weight_params.h>
#include <ssphh/rays/surface_point.h>

namespace ssphh::probes {

struct FittedPoints;

/// Whether nothing blocks the way between two points, the first just above a surface. Asked by several
/// threads at once.
using SeesProbe = std::function<bool(const vec3& from, const vec3& probe)>;

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

/// Weights by the probes around and what a point sees of them, for those who say that of each point apart.
class VisibleWeights {
 public:
  virtual ~VisibleWeights() = default;
  /// As LookupWeights::at. `sees` is asked by this call alone.
  virtual ProbeWeights at(const rays::SurfacePoint& point, const SeesProbe& sees) const = 0;
  virtual std::size_t bytes() const = 0;
};

/// By params.method; where that needs more than probes, by what stands in for it. Throws Error as
/// make_weights does.
std::unique_ptr<VisibleWeights> make_visible_weights(std::span<const vec3> positions,
                                                     const WeightParams& params = {});

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
