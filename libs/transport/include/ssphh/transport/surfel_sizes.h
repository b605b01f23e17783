#pragma once
/// How large surfels are: one size, half, a quarter, ... of it near lamps, from where light falls unevenly;
/// where that makes too many, twice, four times, ... as large far from probes, so that a plain of ten
/// kilometres costs little more than the house that stands on it.

#include <cmath>
#include <memory>
#include <span>

#include <ssphh/geometry/nearest.h>
#include <ssphh/transport/gbuffer.h>

namespace ssphh::transport {

class SurfelSizes {
 public:
  static constexpr int most_level = 16;  ///< doublings: surfels of a millimetre grow to 33 m at least

  /// Surfels are of one `size` [m], halved near `lamps`, once or twice, down to half the distance of the
  /// nearest one.
  explicit SurfelSizes(float size, std::span<const vec3> lamps = {});
  /// `size` [m], or the largest of its doublings that is no more than `share` of the local distance: that of
  /// the nearest probe, or of this probe's nearest neighbour where that is more; of the nearest of `lamps`
  /// where that is less, down to half of `size`.
  SurfelSizes(float size, std::span<const vec3> probes, float share, std::span<const vec3> lamps = {});

  float finest() const { return size(0); }
  /// That of surfels which are neither near lamps nor far from probes [m].
  float usual() const { return usual_; }
  /// The size of a level [m].
  float size(int level) const { return std::ldexp(usual_, level - usual_level_); }
  /// Doublings of the finest size at a place, 0..most_level.
  int level(const vec3& position) const;
  /// The same as if there were no lamps.
  int level_by_probes(const vec3& position) const;
  /// Whether surfels grow with the distance of probes.
  bool grow() const { return share_ > 0; }
  /// The smallest level within a box that things move in, whose lamps may move, too: as if there were none.
  int level(const scene::Bounds& box) const;

 private:
  struct Places;

  int level_of(float local) const;  ///< by the local distance of probes [m]

  int usual_level_;
  float usual_;
  float share_ = 0, lamp_share_;
  std::shared_ptr<const Places> places_;  ///< null: one size
};

/// About how many surfels the surfaces have that probes see: a ray stands for as much surface as its share of
/// the sphere cuts out, where no other probe is nearer.
double estimated_surfels(const ProbeGBuffer& gbuffer, const SurfelSizes& sizes);

/// `size` [m] everywhere, halved near `small_lamps`, if that makes about `most` surfels or fewer, else as
/// much larger far from probes and `lamps` as it takes to come down to a quarter of that (clutter makes twice
/// as many of them as its area tells). There surfels near lamps would be several times as large, so `lamps`
/// may be wider. With `grow` they are larger far from probes in any case.
SurfelSizes sizes_within(const ProbeGBuffer& gbuffer, float size, std::size_t most,
                         std::span<const vec3> small_lamps = {}, std::span<const vec3> lamps = {},
                         bool grow = false);

}  // namespace ssphh::transport
