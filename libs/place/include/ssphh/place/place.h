#pragma once
/// INIT that finds the probes' places itself: a grid that is finer where surfaces are near, without places
/// inside bodies, in the way of doors or out of everybody's sight. What each step is for, and where it fails:
/// docs/methods/placement.md.

#include <cstdint>
#include <string>
#include <vector>

#include <ssphh/core/control.h>
#include <ssphh/probes/probe_set.h>
#include <ssphh/rays/transport_source.h>

namespace ssphh::place {

struct PlaceParams {
  /// Distance of neighbours in the coarse grid [m]; 0: as `count` asks, or such that some 100 to 200 probes
  /// result.
  float spacing = 0;
  /// So many probes, `manual` ones included: the most spread ones of a grid that gives at least as many (the
  /// others are counted as `surplus`). 0: as many as the spacing gives.
  int count = 0;
  float clearance = 0.04f;                ///< from a surface [m]; at most a tenth of the spacing is asked for
  int levels = 1;                         ///< times that the grid may be halved near surfaces, 0..3
  int max_probes = 65536;                 ///< more are an Error, not a long wait
  std::vector<scene::ProbePlace> manual;  ///< kept as they are, first in the placement
  std::vector<vec3> interest;             ///< places that somebody is or light comes from: cameras, lamps
};

/// `manual` from the scene's enabled SPHLs, `interest` from these, its cameras and its lamps that have a
/// place, posed at `time` seconds.
PlaceParams place_params(const scene::Scene& scene, float time = 0);

enum class PlaceKind {
  manual,
  grid,
  refined,  ///< of a halved grid
  passage,  ///< between two probes, where the way from one to the other is narrow
};

struct PlacedProbe {
  std::string name;
  vec3 position{0};     ///< world, metres
  float radius = 0.1f;  ///< of the VIZ emitter [m]
  PlaceKind kind = PlaceKind::grid;
  float spacing = 0;    ///< to its neighbours, as the grid has it here [m]
  float reach = 0;      ///< how far lookups should use it [m]: a probe in a doorway is not for the room
  float clearance = 0;  ///< distance of the nearest surface seen [m]; infinite: none

  friend bool operator==(const PlacedProbe&, const PlacedProbe&) = default;
};

/// Two neighbours that see each other past everything that never moves.
struct PlacedEdge {
  std::uint32_t a = 0, b = 0;  ///< a < b
  bool moving = false;         ///< a moving part is in between at some time

  friend bool operator==(const PlacedEdge&, const PlacedEdge&) = default;
};

/// What became of the candidates.
struct PlaceCounts {
  std::size_t candidates = 0;
  std::size_t relocated = 0;    ///< pushed out of a body, off a surface or out of a moving part's way
  std::size_t inside = 0;       ///< removed: inside a body
  std::size_t too_close = 0;    ///< removed: nearer to a surface than the clearance
  std::size_t open_air = 0;     ///< removed: no surface within reach
  std::size_t redundant = 0;    ///< removed: near another one, or a finer grid is of no use here
  std::size_t swept = 0;        ///< removed: a moving part passes
  std::size_t unreachable = 0;  ///< removed: no camera, SPHL or lamp is to be seen from there, nor from where
                                ///< the probe's neighbours lead
  std::size_t surplus = 0;      ///< removed: more than `count`

  std::size_t removed() const {
    return inside + too_close + open_air + redundant + swept + unreachable + surplus;
  }
  friend bool operator==(const PlaceCounts&, const PlaceCounts&) = default;
};

struct Placement {
  std::vector<PlacedProbe> probes;  ///< manual ones first, then by grid place
  std::vector<PlacedEdge> edges;    ///< ascending (a, b)
  vec3 origin{0};                   ///< of the coarse grid
  float spacing = 0;                ///< of the coarse grid [m]
  float clearance = 0;              ///< that was asked for [m]
  float back_limit = 0;  ///< a place is inside a body when more of the surfaces it sees show their backs
  PlaceCounts counts;
  std::vector<std::string> warnings;

  friend bool operator==(const Placement&, const Placement&) = default;
};

/// The same input gives the same placement, whatever the number of threads. Throws Error for parameters out
/// of range, for a scene without surfaces that stand still, for more than `max_probes`, when fewer than
/// `count` fit, and when no place is left, nor around the surfaces.
Placement place_probes(const rays::TransportSource& source, const PlaceParams& params,
                       const Control& control = {});

}  // namespace ssphh::place
