#pragma once
/// What a bake leaves for the next one, so that it can tell what a change of the scene reaches
/// (ssphh/bake/update.h).

#include <array>
#include <vector>

#include <ssphh/scene/scene_items.h>
#include <ssphh/sh/coefficients.h>

namespace ssphh::probes {

/// Bands of a probe's trial light.
inline constexpr int trial_degree = 2;

/// Light of one probe, emitted and reflected, of trial_degree, as few paths of fixed random numbers find it:
/// two halves that know nothing of each other, each [light group].
struct Trial {
  std::array<std::vector<sh::RadianceSh>, 2> halves;

  friend bool operator==(const Trial&, const Trial&) = default;
};

struct Baseline {
  int viz_neighbors = -1;     ///< most edges that a probe was to keep; −1: all
  float viz_threshold = 0;    ///< P above which an edge was kept
  int records = 0;            ///< most surface records that were asked for; 0: none
  int most_surfels = 100000;  ///< beyond about so many, surfels grew with the distance of probes
  std::vector<scene::SceneItem> items;
  std::vector<Trial> trials;  ///< of each probe, when its light was baked; of light by transport none

  friend bool operator==(const Baseline&, const Baseline&) = default;
};

}  // namespace ssphh::probes
