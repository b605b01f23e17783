#pragma once
/// Which spacing of the coarse grid gives as many probes as wanted.

#include <cstddef>

#include <ssphh/core/math.h>

namespace ssphh::place {

/// Begins with that of as many cells in the bounds, goes finer or coarser by the number found until one was
/// too fine and one too coarse, then halves between these (geometrically).
class SpacingSearch {
 public:
  /// Wanted are low..high probes in bounds of this extent, one axis at least of which is not 0. Where hardly
  /// any place is valid (around a body that fills its bounds), a finer grid soon costs too much: none has
  /// more than `most_places`.
  SpacingSearch(const vec3& extent, std::size_t low, std::size_t high, double most_places);

  float spacing() const { return spacing_; }
  /// Whether `count` probes are a better choice than `best`: at least `low` but as few as may be, else as
  /// many as may be.
  bool prefers(std::size_t count, std::size_t best) const;
  /// Takes note of how many probes the spacing gave and takes the next one. False: these are as wanted, or no
  /// finer spacing may be tried.
  bool go_on(std::size_t count);

 private:
  std::size_t low_, high_;
  float spacing_, finest_;
  float coarse_ = 0, fine_ = 0;  ///< known to give too few, and enough; 0: none yet
};

}  // namespace ssphh::place
