#pragma once
/// How large surfels are: one size where probes are near, and twice, four times, ... as large where they are
/// far or far apart, so that a plain of ten kilometres costs little more than the house that stands on it.

#include <memory>
#include <span>

#include <ssphh/geometry/nearest.h>
#include <ssphh/transport/gbuffer.h>

namespace ssphh::transport {

class SurfelSizes {
 public:
  static constexpr int most_level = 15;  ///< doublings: surfels of a millimetre grow to 33 m at most

  /// Surfels are of one `size` [m] everywhere.
  explicit SurfelSizes(float size) : finest_(size) {}
  /// `finest` [m], or the largest of its doublings that is no more than `share` of the local distance: that
  /// of the nearest probe, or of this probe's nearest neighbour where that is more.
  SurfelSizes(float finest, std::span<const vec3> probes, float share);

  float finest() const { return finest_; }
  /// The size of a level [m].
  float size(int level) const { return finest_ * static_cast<float>(1 << level); }
  /// Doublings of the finest size at a place, 0..most_level.
  int level(const vec3& position) const;
  /// The smallest level within a box.
  int level(const scene::Bounds& box) const;

 private:
  struct Probes;

  float finest_;
  float share_ = 0;
  std::shared_ptr<const Probes> probes_;  ///< null: one size
};

/// About how many surfels the surfaces have that probes see: a ray stands for as much surface as its share of
/// the sphere cuts out, where no other probe is nearer.
double estimated_surfels(const ProbeGBuffer& gbuffer, const SurfelSizes& sizes);

/// `finest` [m] everywhere if that makes about `most` surfels or fewer, else as much larger far from probes
/// as it takes to come down to a sixth of that (clutter makes more of them than its area tells).
SurfelSizes sizes_within(const ProbeGBuffer& gbuffer, float finest, std::size_t most);

}  // namespace ssphh::transport
