#pragma once
/// Where a lamp may be moved to, and at which places its light is found so that any other is blended of them.

#include <array>
#include <cstdint>
#include <span>
#include <vector>

#include <ssphh/core/control.h>
#include <ssphh/rays/transport_source.h>

namespace ssphh::pipeline {

struct LampLatticeParams {
  float spacing = 1;  ///< most between neighbouring places along an axis [m]
  float reach = 2;    ///< how far places are from the lamp's own, at most, along each axis [m]
  float radius = 0;   ///< of the lamp [m]: its surface meets no other one
};

/// So many boxes lie along an axis in one spacing: what the lamp sees is told for each.
inline constexpr int boxes_per_spacing = 5;
inline constexpr double most_lamp_places = 4096;

/// Boxes in space, and planes on their borders whose crossings are the corners of cells. The lamp may be in
/// boxes that see a corner of their cell; there its light is blended of the corners that are seen.
struct LampLattice {
  vec3 origin{0};       ///< least corner of the first box
  float box = 0;        ///< edge of a box [m]
  glm::ivec3 boxes{0};  ///< number along each axis
  /// Along each axis the planes, rising, in boxes from the origin; the first is 0, the last `boxes`, and the
  /// lamp's own place is on one.
  std::array<std::vector<int>, 3> planes;
  std::vector<std::uint8_t> seen;  ///< of each box, x fastest: bit x + 2y + 4z for the corner on that side
  std::vector<vec3> places;        ///< at which light is needed [m]
  std::vector<std::int32_t> place_of;  ///< of each crossing, x fastest: index into `places`; −1: not needed
};

/// How much the light of a place counts.
struct LampShare {
  std::int32_t place = -1;
  float weight = 0;
};

/// The lattice in what can be reached from `home`: boxes one after another through whose middles a way leads
/// that meets no surface in the pose of any of `times` [s], and in which the lamp touches none. Those beside
/// `home` that it sees count in any case. Throws Error for a spacing, reach or radius that cannot be, for
/// more places than most_lamp_places, before any ray, and where the lamp cannot move at all; Cancelled when
/// asked to stop.
LampLattice lamp_lattice(const rays::TransportSource& source, std::span<const float> times, const vec3& home,
                         const LampLatticeParams& params = {}, const Control& control = {});

/// The shares of places at `at`, with a sum of 1: trilinear among the corners that its box sees. Places of −1
/// where the lamp may not be.
std::array<LampShare, 8> lamp_shares(const LampLattice& lattice, const vec3& at);

}  // namespace ssphh::pipeline
