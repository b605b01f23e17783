#include <algorithm>
#include <iterator>
#include <numeric>

#include <ssphh/core/require.h>
#include <ssphh/probes/tiles.h>

namespace ssphh::probes {
namespace {

template <class Value>
void append(std::vector<Value>&& from, std::vector<Value>& to) {
  std::ranges::move(from, std::back_inserter(to));
}

void append(SurfaceRecords&& from, SurfaceRecords& to) {
  append(std::move(from.points), to.points);
  to.groups.resize(std::max(to.groups.size(), from.groups.size()));
  for (std::size_t g = 0; g < from.groups.size(); ++g) append(std::move(from.groups[g]), to.groups[g]);
  to.direct.resize(std::max(to.direct.size(), from.direct.size()));
  for (std::size_t g = 0; g < from.direct.size(); ++g) append(std::move(from.direct[g]), to.direct[g]);
}

SurfaceRecords records_within(const SurfaceRecords& records, const TileBox& box) {
  SurfaceRecords within;
  within.groups.resize(records.groups.size());
  within.direct.resize(records.direct.size());
  for (std::size_t p = 0; p < records.points.size(); ++p) {
    if (!box.contains(records.points[p].position)) continue;
    within.points.push_back(records.points[p]);
    for (std::size_t g = 0; g < records.groups.size(); ++g) within.groups[g].push_back(records.groups[g][p]);
    for (std::size_t g = 0; g < records.direct.size(); ++g)
      if (records.keeps_direct(g)) within.direct[g].push_back(records.direct[g][p]);
  }
  return within;
}

/// −1: it is neither the tile's nor its halo's.
int place_in_tile(const Tile& tile, std::uint32_t probe) {
  if (probe >= tile.first && probe < tile.first + tile.own) return static_cast<int>(probe - tile.first);
  const auto at = std::ranges::lower_bound(tile.halo, probe);
  if (at == tile.halo.end() || *at != probe) return -1;
  return static_cast<int>(tile.own) + static_cast<int>(at - tile.halo.begin());
}

/// Of the network that made it; its surfels' size is the finest of all tiles.
GeneratorInfo together(const GeneratorInfo& whole, const GeneratorInfo& tile) {
  GeneratorInfo both = tile;
  if (whole.surfel_size > 0) both.surfel_size = std::min(whole.surfel_size, tile.surfel_size);
  return both;
}

}  // namespace

std::size_t probe_count(std::span<const Tile> tiles) {
  return std::accumulate(tiles.begin(), tiles.end(), std::size_t{0},
                         [](std::size_t sum, const Tile& tile) { return sum + tile.own; });
}

std::vector<int> places_of(std::span<const Tile> tiles, std::span<const std::size_t> which) {
  std::vector<int> places(probe_count(tiles), -1);
  int next = 0;
  for (const std::size_t t : which) {
    for (std::uint32_t k = 0; k < tiles[t].own; ++k) places[tiles[t].first + k] = next++;
  }
  return places;
}

std::vector<int> places_of(std::span<const Tile> tiles) {
  std::vector<int> places(probe_count(tiles));
  std::iota(places.begin(), places.end(), 0);
  return places;
}

ProbeSet set_of_tile(const ProbeSet& whole, const Tile& tile) {
  ProbeSet set;
  set.degree = whole.degree;
  set.generator = whole.generator;
  set.light_groups = whole.light_groups;
  const auto first = whole.probes.begin() + static_cast<std::ptrdiff_t>(tile.first);
  set.probes.assign(first, first + static_cast<std::ptrdiff_t>(tile.own));
  for (const std::uint32_t i : tile.halo) set.probes.push_back(whole.probes[i]);
  for (Probe& probe : set.probes) {
    for (Edge& edge : probe.edges) edge.from = place_in_tile(tile, static_cast<std::uint32_t>(edge.from));
    std::erase_if(probe.edges, [](const Edge& edge) { return edge.from < 0; });
    std::ranges::sort(probe.edges, {}, &Edge::from);
  }
  if (whole.surface) set.surface = records_within(*whole.surface, tile.box);
  merge_groups(set);
  return set;
}

void put_tile(const Tile& tile, ProbeSet&& baked, std::span<const int> places, ProbeSet& whole) {
  require(baked.probes.size() == tile.own + tile.halo.size(), "tile", "has other probes than its list says");
  const auto place = [&](std::size_t i) {
    return places[i < tile.own ? tile.first + i : tile.halo[i - tile.own]];
  };
  for (std::uint32_t k = 0; k < tile.own; ++k) {
    Probe& probe = baked.probes[k];
    for (Edge& edge : probe.edges) edge.from = place(static_cast<std::size_t>(edge.from));
    std::erase_if(probe.edges, [](const Edge& edge) { return edge.from < 0; });
    std::ranges::sort(probe.edges, {}, &Edge::from);
    whole.probes[static_cast<std::size_t>(place(k))] = std::move(probe);
  }
  if (baked.surface) {
    if (!whole.surface) whole.surface.emplace();
    append(std::move(*baked.surface), *whole.surface);
  }
  whole.light_groups = std::move(baked.light_groups);
  whole.generator = together(whole.generator, baked.generator);
}

}  // namespace ssphh::probes
