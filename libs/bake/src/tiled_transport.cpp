#include <algorithm>
#include <array>
#include <iterator>
#include <numeric>

#include <fmt/format.h>

#include <ssphh/bake/tiled_transport.h>
#include <ssphh/core/require.h>
#include <ssphh/geometry/nearest.h>
#include <ssphh/probes/probe_file.h>

namespace ssphh::bake {
namespace {

using probes::Tile;
using probes::TileBox;

/// Probes around a probe that stand in for those beyond.
constexpr std::size_t halo_neighbors = 8;

/// Splits places, and notes the order in which tiles have them.
class Splitter {
 public:
  Splitter(std::span<const vec3> places, std::size_t most) : places_(places), most_(most) {}

  void split(std::vector<std::uint32_t> probes, const TileBox& box) {
    if (probes.size() <= most_) {
      std::ranges::sort(probes);
      tiles.push_back(
          {static_cast<std::uint32_t>(order.size()), static_cast<std::uint32_t>(probes.size()), {}, box});
      order.insert(order.end(), probes.begin(), probes.end());
      return;
    }
    const int axis = longest_axis(probes);
    const auto along = [&](std::uint32_t i) { return places_[i][axis]; };
    std::ranges::sort(probes, {}, [&](std::uint32_t i) { return std::pair(along(i), i); });
    const std::size_t n = probes.size();
    std::size_t cut = n / 2;
    float widest = 0;
    for (std::size_t k = std::max<std::size_t>(n / 4, 1); k < n - n / 4; ++k) {
      const float gap = along(probes[k]) - along(probes[k - 1]);
      if (gap > widest) widest = gap, cut = k;
    }
    const float border = 0.5f * (along(probes[cut - 1]) + along(probes[cut]));
    TileBox below = box, above = box;
    below.max[axis] = above.min[axis] = border;
    split({probes.begin(), probes.begin() + static_cast<std::ptrdiff_t>(cut)}, below);
    split({probes.begin() + static_cast<std::ptrdiff_t>(cut), probes.end()}, above);
  }

  std::vector<Tile> tiles;
  std::vector<std::uint32_t> order;

 private:
  int longest_axis(const std::vector<std::uint32_t>& probes) const {
    scene::Bounds bounds;
    for (const std::uint32_t i : probes) bounds.add(places_[i]);
    const vec3 extent = bounds.max - bounds.min;
    return extent.x >= extent.y && extent.x >= extent.z ? 0 : extent.z >= extent.y ? 2 : 1;
  }

  std::span<const vec3> places_;
  std::size_t most_;
};

std::vector<vec3> places_of_probes(const probes::ProbeSet& set) {
  std::vector<vec3> places;
  for (const probes::Probe& probe : set.probes) places.push_back(probe.position);
  return places;
}

void add_halo(std::span<const vec3> places, const geometry::NearestPoints& nearest, Tile& tile) {
  std::array<geometry::Near, halo_neighbors + 1> found;
  for (std::uint32_t k = 0; k < tile.own; ++k) {
    const int count = nearest.find(places[tile.first + k], found);
    for (const geometry::Near& near : std::span(found).first(static_cast<std::size_t>(count))) {
      const auto i = static_cast<std::uint32_t>(near.index);
      if (i < tile.first || i >= tile.first + tile.own) tile.halo.push_back(i);
    }
  }
  std::ranges::sort(tile.halo);
  tile.halo.erase(std::unique(tile.halo.begin(), tile.halo.end()), tile.halo.end());
}

/// Names the tile before each of its stages.
class TileProgress final : public Progress {
 public:
  TileProgress(Progress& to, std::size_t tile, std::size_t count)
      : to_(to), prefix_(fmt::format("tile {} of {}: ", tile + 1, count)) {}

  void begin(const std::string& stage, std::uint64_t total, const std::string& unit) override {
    to_.begin(prefix_ + stage, total, unit);
  }
  void advance(std::uint64_t count) override { to_.advance(count); }
  void end() override { to_.end(); }

 private:
  Progress& to_;
  std::string prefix_;
};

/// What is largest stays the largest.
void add_report(const TransportBakeReport& tile, TransportBakeReport& all) {
  const auto lost = [](const TransportBakeReport& r) { return static_cast<double>(r.surfels) * r.lost; };
  const double lost_of_both = lost(tile) + lost(all);
  all.finest_surfel = all.surfels == 0 ? tile.finest_surfel : std::min(all.finest_surfel, tile.finest_surfel);
  all.surfels += tile.surfels;
  all.links += tile.links;
  all.lost = all.surfels > 0 ? lost_of_both / static_cast<double>(all.surfels) : 0;
  all.coarsest_surfel = std::max(all.coarsest_surfel, tile.coarsest_surfel);
  all.iterations = std::max(all.iterations, tile.iterations);
  all.contraction = std::max(all.contraction, tile.contraction);
  all.error = std::max(all.error, tile.error);
  all.records += tile.records;
  all.seconds += tile.seconds;
  all.viz_seconds += tile.viz_seconds;
  all.fit_seconds += tile.fit_seconds;
  all.record_seconds += tile.record_seconds;
  all.rays += tile.rays;
  std::ranges::copy(tile.warnings, std::back_inserter(all.warnings));
}

Control control_of_tile(const Control& control, std::size_t tile, std::size_t count,
                        std::optional<TileProgress>& progress) {
  Control result = control;
  if (control.progress && count > 1) result.progress = &progress.emplace(*control.progress, tile, count);
  return result;
}

/// Those of the tile's own, as its set has them.
std::vector<std::uint32_t> within_tile(std::span<const std::uint32_t> probes, const Tile& tile) {
  std::vector<std::uint32_t> within;
  for (const std::uint32_t i : probes)
    if (i >= tile.first && i < tile.first + tile.own) within.push_back(i - tile.first);
  return within;
}

/// Bakes those that the folder lacks, and hands each on.
template <class Take>
void bake_each(const rays::TransportSource& source, const probes::ProbeSet& set, std::span<const Tile> tiles,
               const TiledParams& params, const probes::TileFolder* folder, TransportBakeReport& report,
               const Control& control, TileCrew* crew, const Take& take) {
  report = {};
  report.tiles = tiles.size();
  std::vector<std::size_t> left;
  for (std::size_t t = 0; t < tiles.size(); ++t)
    if (!folder || !folder->has(t)) left.push_back(t);
  report.resumed = tiles.size() - left.size();
  const auto finish = [&](std::size_t t, probes::ProbeSet baked, const TransportBakeReport& took) {
    if (params.finish) params.finish(baked);
    add_report(took, report);
    take(t, std::move(baked));
  };
  if (crew) return crew->run_tiles(set, tiles, left, params, finish, control);
  for (const std::size_t t : left) {
    std::optional<TileProgress> progress;
    probes::ProbeSet baked = probes::set_of_tile(set, tiles[t]);
    TransportBakeReport took;
    bake_tile(source, baked, params_of_tile(params.transport, tiles[t]), params.light_known, took,
              control_of_tile(control, t, tiles.size(), progress));
    finish(t, std::move(baked), took);
  }
}

}  // namespace

std::vector<Tile> make_tiles(probes::ProbeSet& set, std::size_t most_probes) {
  require(most_probes > 0, "tiles", "a tile has one probe at least");
  std::vector<vec3> places = places_of_probes(set);
  std::vector<std::uint32_t> all(places.size());
  std::iota(all.begin(), all.end(), 0u);
  Splitter splitter(places, most_probes);
  splitter.split(std::move(all), {});
  std::vector<probes::Probe> ordered;
  for (const std::uint32_t i : splitter.order) ordered.push_back(std::move(set.probes[i]));
  set.probes = std::move(ordered);
  if (splitter.tiles.size() > 1) {
    places = places_of_probes(set);
    const geometry::NearestPoints nearest(places);
    for (Tile& tile : splitter.tiles) add_halo(places, nearest, tile);
  }
  return std::move(splitter.tiles);
}

TransportBakeParams params_of_tile(TransportBakeParams params, const Tile& tile) {
  params.own_probes = tile.own;
  params.records.within = tile.box;
  params.transport.grow = tile.box != probes::TileBox();
  return params;
}

void bake_tile(const rays::TransportSource& source, probes::ProbeSet& tile, const TransportBakeParams& params,
               bool light_known, TransportBakeReport& report, const Control& control) {
  if (light_known) {
    add_transport(source, tile, params, report, control);
  } else {
    tile = bake_transport(source, std::move(tile), params, report, control);
  }
}

void transport_in_tiles(const rays::TransportSource& source, probes::ProbeSet& set,
                        std::span<const Tile> tiles, const TiledParams& params, probes::TileFolder* folder,
                        TransportBakeReport& report, const Control& control, TileCrew* crew) {
  const std::vector<int> places = probes::places_of(tiles);
  // Light and edges go into a set of their own: tiles see the places of all, and nothing else of each other
  probes::ProbeSet whole = set;
  whole.surface.reset(), whole.fitted.reset(), whole.hierarchy.reset();
  // A crew is done with them in any order: records stand in the tiles' own
  std::vector<std::optional<probes::ProbeSet>> kept(folder ? 0 : tiles.size());
  bake_each(source, set, tiles, params, folder, report, control, crew,
            [&](std::size_t t, probes::ProbeSet&& baked) {
              if (folder) {
                folder->write(t, baked);
              } else {
                kept[t] = std::move(baked);
              }
            });
  for (std::size_t t = 0; t < tiles.size(); ++t)
    probes::put_tile(tiles[t], folder ? folder->read(t) : std::move(*kept[t]), places, whole);
  probes::merge_groups(whole);
  set = std::move(whole);
}

void transport_into_folder(const rays::TransportSource& source, const probes::ProbeSet& set,
                           std::span<const Tile> tiles, const TiledParams& params, probes::TileFolder& folder,
                           TransportBakeReport& report, const Control& control, TileCrew* crew) {
  bake_each(source, set, tiles, params, &folder, report, control, crew,
            [&](std::size_t t, probes::ProbeSet&& baked) { folder.write(t, baked); });
}

TransportUpdate update_in_tiles(const rays::TransportSource& source, probes::ProbeSet& set,
                                const TransportBakeParams& params, std::size_t most_probes,
                                const LightScope& scope, float edge_change, TransportBakeReport& report,
                                const Control& control) {
  probes::ProbeSet ordered;
  ordered.probes = set.probes;
  const std::vector<Tile> tiles = make_tiles(ordered, most_probes);
  const bool whole = set.fitted || params.op != probes::LightOperator::surfel;
  if (whole || tiles.size() < 2 ||
      !std::ranges::equal(ordered.probes, set.probes, {}, &probes::Probe::name, &probes::Probe::name))
    return update_transport(source, set, params, scope, edge_change, report, control);
  scope.require_within(set.probes.size(), set.light_groups.size());
  report = {};
  report.tiles = tiles.size();
  TransportUpdate all{std::vector<float>(set.probes.size(), 0), {}};
  probes::ProbeSet updated = set;
  updated.surface.reset(), updated.hierarchy.reset();
  const std::vector<int> places = probes::places_of(tiles);
  for (std::size_t t = 0; t < tiles.size(); ++t) {
    const Tile& tile = tiles[t];
    probes::ProbeSet part = probes::set_of_tile(set, tile);
    LightScope of_tile{{}, scope.groups};
    if (scope.probes) of_tile.probes = within_tile(*scope.probes, tile);
    if (!of_tile.probes || !of_tile.probes->empty()) {
      std::optional<TileProgress> progress;
      TransportBakeReport took;
      const TransportUpdate found =
          update_transport(source, part, params_of_tile(params, tile), of_tile, edge_change, took,
                           control_of_tile(control, t, tiles.size(), progress));
      add_report(took, report);
      std::copy_n(found.changed.begin(), tile.own,
                  all.changed.begin() + static_cast<std::ptrdiff_t>(tile.first));
      for (const std::uint32_t i : found.probes)
        if (i < tile.own) all.probes.push_back(tile.first + i);
    }
    probes::put_tile(tile, std::move(part), places, updated);
  }
  probes::merge_groups(updated);
  set = std::move(updated);
  return all;
}

Hash128 tiled_key(const rays::TransportSource& source, const probes::ProbeSet& set,
                  std::span<const Tile> tiles, const TiledParams& params) {
  const probes::GeneratorInfo& g = set.generator;
  const TransportBakeParams& p = params.transport;
  Hasher hasher;
  hasher.value(probes::probe_file_version).value(set.degree).value(g.scene_hash.high).value(g.scene_hash.low);
  hasher.value(g.time).value(params.light_known).value(p.op);
  const transport::TransportParams& t = p.transport;
  hasher.value(t.directions).value(t.surfel_size).value(t.link_rays).value(t.samples);
  hasher.value(t.surfels_per_radius).value(t.most_surfels);
  hasher.value(p.solve.tolerance).value(p.solve.max_iterations).value(p.solve.settle);
  const transport::LinkVizParams& viz = p.viz_params;
  hasher.value(p.viz).value(viz.neighbors).value(viz.threshold).value(viz.source).value(viz.solve.tolerance);
  hasher.value(p.records.points).value(p.records.rays);
  for (const int group : p.records.baked) hasher.value(group);
  for (const std::string& group : source.light_groups()) hasher.text(group);
  for (const probes::Probe& probe : set.probes) {
    hasher.text(probe.name).value(probe.radius);
    for (int axis = 0; axis < 3; ++axis) hasher.value(probe.position[axis]);
  }
  for (const Tile& tile : tiles) hasher.value(tile.own).value(tile.halo.size());
  return hasher.finish();
}

}  // namespace ssphh::bake
