#pragma once
/// How much the window spends on the light of probes, by one word, and what that costs.

#include <string>
#include <vector>

#include <ssphh/bake/bake.h>
#include <ssphh/core/enum_names.h>
#include <ssphh/transport/transport_params.h>

namespace ssphh::viewer {

enum class Quality {
  window,  ///< soon there, for looking at
  draft,   ///< as bake --quality
  good,
  best
};
constexpr auto enum_table(Quality) {
  using enum Quality;
  return std::to_array<EnumName<Quality>>(
      {{window, "window"}, {draft, "draft"}, {good, "good"}, {best, "best"}});
}

struct QualityEffort {
  int spp, face_size;                    ///< of GEN and VIZ, as in bake::BakeParams
  transport::TransportParams transport;  ///< of light that follows lamps and doors
  int records;                           ///< surface points that keep it, at most
};
/// What a quality says nothing of is as in `own`, and with `window` all of it is.
QualityEffort effort_of(Quality quality, const transport::TransportParams& own = {});

/// First a glance at all probes where that is a small part of the work; the bake itself comes last.
std::vector<bake::BakeParams> passes_of(const bake::BakeParams& fine);
/// Paths that GEN follows at each probe in all its passes.
double paths_per_probe(const bake::BakeParams& params);

/// What is known of the window's light, to tell what another quality would cost.
struct LightKnown {
  std::size_t probes = 0;
  double paths_per_second = 0;           ///< of GEN, at each probe; 0: none was done yet
  double surfels = 0;                    ///< of live light; 0: there is none
  transport::TransportParams transport;  ///< that it was made with
  double live_seconds = 0;               ///< that making it took
};

/// What the light of a quality takes at most: a guess, for surfels of half the edge are four times as many.
struct LightCost {
  double paths = 0;    ///< of GEN, or at one probe where there are none
  double seconds = 0;  ///< of that; 0: not known
  double surfels = 0;
  double bytes = 0;         ///< of memory while live light is made; 0: not known
  double live_seconds = 0;  ///< likewise
};
LightCost cost_of(Quality quality, const LightKnown& known);
/// In words, a line for GEN and one for live light.
std::string cost_text(Quality quality, const LightKnown& known);

}  // namespace ssphh::viewer
