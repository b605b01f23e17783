#pragma once
/// A set of probes in tiles, each with the probes and the surface records of a part of space.

#include <cstdint>
#include <limits>
#include <span>
#include <vector>

#include <ssphh/core/math.h>
#include <ssphh/probes/probe_set.h>

namespace ssphh::probes {

/// A box that shares no point with its neighbours: from `min` on, up to `max` and without it. At first all of
/// space.
struct TileBox {
  vec3 min{-std::numeric_limits<float>::infinity()}, max{std::numeric_limits<float>::infinity()};

  bool contains(const vec3& p) const {
    return glm::all(glm::greaterThanEqual(p, min)) && glm::all(glm::lessThan(p, max));
  }
  friend bool operator==(const TileBox&, const TileBox&) = default;
};

/// Probes are counted through all tiles: first all of tile 0, then all of tile 1, and so on.
struct Tile {
  std::uint32_t first = 0, own = 0;  ///< its probes
  std::vector<std::uint32_t> halo;   ///< probes of other tiles around them, ascending
  TileBox box;                       ///< all boxes together are all of space, once

  friend bool operator==(const Tile&, const Tile&) = default;
};

/// Number of probes of all.
std::size_t probe_count(std::span<const Tile> tiles);

/// Where a set made of some of the tiles has each of all probes; −1: their tile is not among these.
std::vector<int> places_of(std::span<const Tile> tiles, std::span<const std::size_t> which);
/// In a set made of all.
std::vector<int> places_of(std::span<const Tile> tiles);

/// What the whole set has of a tile: its own probes, then those of its halo, with the edges between these;
/// its records. Nothing of hierarchy, fitted points and baseline.
ProbeSet set_of_tile(const ProbeSet& whole, const Tile& tile);

/// Puts a set_of_tile() that was baked into `whole`, which has the probes that `places` tells: the light and
/// the edges of the tile's own probes, as far as those that they come from are there, and its records.
/// Whoever has put all calls merge_groups().
void put_tile(const Tile& tile, ProbeSet&& baked, std::span<const int> places, ProbeSet& whole);

}  // namespace ssphh::probes
