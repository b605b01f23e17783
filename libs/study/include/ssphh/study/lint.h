#pragma once
/// Looks for probes that light nothing or light it wrongly: what a picture shows late and a test can catch
/// early.

#include <string>
#include <vector>

#include <ssphh/core/control.h>
#include <ssphh/core/enum_names.h>
#include <ssphh/probes/probe_set.h>
#include <ssphh/rays/transport_source.h>

namespace ssphh::study {

enum class ProbeProblem {
  not_finite,   ///< a coefficient or the position is no number
  inside,       ///< of a body
  too_close,    ///< to a surface
  swept,        ///< a moving part passes
  unlit,        ///< no light at all
  unlit_room,   ///< probes that see each other, and all of them are unlit
  isolated,     ///< sees no other probe
  negative,     ///< irradiance under zero, from ringing
  unseen_room,  ///< places where somebody may be, and no probe is to be seen from there
};

constexpr auto enum_table(ProbeProblem) {
  using enum ProbeProblem;
  return std::to_array<EnumName<ProbeProblem>>({{not_finite, "not-finite"},
                                                {inside, "inside"},
                                                {too_close, "too-close"},
                                                {swept, "swept"},
                                                {unlit, "unlit"},
                                                {unlit_room, "unlit-room"},
                                                {isolated, "isolated"},
                                                {negative, "negative"},
                                                {unseen_room, "unseen-room"}});
}

struct LintProblem {
  ProbeProblem kind = ProbeProblem::inside;
  int probe = -1;       ///< index; −1: of no single probe
  vec3 position{0};     ///< world, metres
  std::string message;  ///< what is wrong, and what to do
};

struct LintParams {
  /// Least distance from a surface [m]; 0: 0.04, or a twentieth of the median distance of neighbours where
  /// that is less.
  float clearance = 0;
  /// E(n) may be so much under 0, in shares of its mean over all normals. What rings less does not show, and
  /// lookups window it away.
  float negative_tolerance = 0.1f;
  /// Distance of the places that must see a probe [m]; 0: found such that 100 to 200 places result.
  float spacing = 0;
  std::vector<vec3> interest;  ///< as PlaceParams: cameras, lamps, SPHLs
};

/// Problems by kind in the order above, then by probe. `set` is one that was baked in the source's scene.
/// Throws Error for parameters out of range.
std::vector<LintProblem> lint_probes(const probes::ProbeSet& set, const rays::TransportSource& source,
                                     const LintParams& params, const Control& control = {});

/// What does not depend on light, by probe: not finite, inside, too close, swept.
std::vector<LintProblem> lint_places(const probes::ProbeSet& set, const rays::TransportSource& source,
                                     const LintParams& params, const Control& control = {});

}  // namespace ssphh::study
