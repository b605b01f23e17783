#pragma once
/// How a lookup finds the weights of probes, as people choose it.

#include <optional>
#include <string>

#include <ssphh/core/enum_names.h>
#include <ssphh/probes/weight_list.h>

namespace ssphh::probes {

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

struct WeightParams {
  /// None: the best by measurement (docs/methods/transport-results.md) of what is given: `surface` where
  /// there are records, `fitted` where points have weights, else `fallback`.
  std::optional<WeightMethod> method;
  /// What stands in for `fitted` and `surface` where no point is near, and for what moves.
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

}  // namespace ssphh::probes
