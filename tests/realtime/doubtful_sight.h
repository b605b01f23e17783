#pragma once
/// What a lookup may be where maps of probes' sight have texels: one texel tells whether a probe is seen, by
/// a ray half a texel aside at most. And OpenGL asks no probe that stands lower than a twentieth of
/// its distance below what stands still, a quarter below what moves, where sight may pass an edge close by.

#include <algorithm>
#include <array>
#include <cmath>
#include <vector>

#include <ssphh/probes/lookup.h>
#include <ssphh/rays/radiance_source.h>

namespace ssphh::test {

/// Sight of probes from places just above surfaces, and which of it a texel decides. For one thread.
class DoubtfulSight {
 public:
  explicit DoubtfulSight(const rays::RadianceSource& source) : source_(source) {}
  DoubtfulSight(const DoubtfulSight&) = delete;
  DoubtfulSight& operator=(const DoubtfulSight&) = delete;

  probes::SeesProbe sees() {
    return [this](const vec3& from, const vec3& probe) { return seen(from, probe); };
  }

  static constexpr int most = 6;

  /// Calls `look_up`, which asks sees() at that point alone, for every choice of what is in doubt, at first
  /// as the source sees it; of more than `most` doubts, the others stay so. Returns how many there are.
  template <class LookUp>
  int for_each_choice(const rays::SurfacePoint& at, const LookUp& look_up) {
    at_ = at, asked_.clear(), doubts_ = 0;
    for (choice_ = 0; choice_ < 1u << std::min(doubts_, most); ++choice_) look_up();
    return doubts_;
  }

 private:
  static constexpr float inner = 254;  ///< texels of a map's face without its border

  struct Asked {
    vec3 probe;
    bool seen;
    int doubt;  ///< −1: none
  };

  bool seen(const vec3& from, const vec3& probe) {
    for (const Asked& a : asked_) {
      if (a.probe == probe) return a.seen != (a.doubt >= 0 && a.doubt < most && (choice_ >> a.doubt & 1));
    }
    const bool exact = source_.visible(from, probe);
    asked_.push_back({probe, exact, in_doubt(from, probe, exact) ? doubts_++ : -1});
    return exact;
  }

  /// Rays through the corners and the middles of the edges of a texel around the place, and through it, that
  /// leave out the 1.5 texels' widths within which depths are taken to be the same.
  bool in_doubt(const vec3& from, const vec3& probe, bool exact) const {
    const vec3 way = probe - at_.position;
    if (exact && glm::dot(way, at_.normal) < (at_.moves ? -0.249f : -0.049f) * glm::length(way)) return true;
    const vec3 d = from - probe, a = glm::abs(d);
    const int axis = a.x >= a.y && a.x >= a.z ? 0 : a.y >= a.z ? 1 : 2;
    vec3 right(0), up(0);
    right[(axis + 1) % 3] = up[(axis + 2) % 3] = a[axis] / inner;
    for (int i = 0; i < 9; ++i) {
      const vec3 aside = d + static_cast<float>(i % 3 - 1) * right + static_cast<float>(i / 3 - 1) * up;
      if (source_.visible(probe + aside / (1 + 1.5f / inner), probe) != exact) return true;
    }
    return false;
  }

  const rays::RadianceSource& source_;
  rays::SurfacePoint at_;
  std::vector<Asked> asked_;
  int doubts_ = 0;
  unsigned choice_ = 0;
};

}  // namespace ssphh::test
