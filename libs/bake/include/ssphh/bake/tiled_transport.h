#pragma once
/// Transport in scenes with more probes than one network of surfels serves well: tile by tile, each in the
/// midst of what is around it, which is seen more coarsely with its distance. Light is as fine, and memory no
/// more, than if the scene ended there.

#include <functional>
#include <memory>

#include <ssphh/bake/transport_bake.h>
#include <ssphh/probes/tile_folder.h>

namespace ssphh::bake {

/// Probes of a tile at most, where nobody says: four furnished houses.
inline constexpr std::size_t most_probes_in_tile = 512;

/// Tiles of at most so many probes, by halving where these are farthest apart within the middle half: in
/// streets rather than in rooms. Puts the set's probes in the tiles' order; one tile keeps theirs. The same
/// for the same set. Throws Error for tiles of no probe, and for a place that is not finite.
std::vector<probes::Tile> make_tiles(probes::ProbeSet& set, std::size_t most_probes);

struct TiledParams {
  TransportBakeParams transport;
  bool light_known = false;  ///< something else finds it: add_transport() in place of bake_transport()
  /// What is left to do with each baked tile.
  std::function<void(probes::ProbeSet&)> finish = {};
};

/// Bakes a set_of_tile(), all of it there but its light: bake_transport(), or where that is known
/// add_transport(), as `params` of params_of_tile() say. What a crew does for each tile.
void bake_tile(const rays::TransportSource& source, probes::ProbeSet& tile, const TransportBakeParams& params,
               bool light_known, TransportBakeReport& report, const Control& control = {});
/// For a tile that is all there is they are the same, but for what it names.
TransportBakeParams params_of_tile(TransportBakeParams params, const probes::Tile& tile);

/// Does tiles elsewhere: on a farm.
class TileCrew {
 public:
  virtual ~TileCrew() = default;
  /// Does bake_tile() for those of `which`, in any order, and hands each to `done`, from one thread at a
  /// time. Throws Cancelled, or Error when a tile cannot be done.
  virtual void run_tiles(
      const probes::ProbeSet& set, std::span<const probes::Tile> tiles, std::span<const std::size_t> which,
      const TiledParams& params,
      const std::function<void(std::size_t tile, probes::ProbeSet baked, TransportBakeReport took)>& done,
      const Control& control) = 0;
};

/// Fills the set as bake_transport() or add_transport() do, in these tiles of make_tiles(). With a `folder`
/// of the tiles each that is baked is kept in there, and none that it holds is baked again; the caller
/// removes it once the set is safe on disk. A `crew` does the tiles, to the same bits. Throws as these do;
/// Error when the folder cannot be written.
void transport_in_tiles(const rays::TransportSource& source, probes::ProbeSet& set,
                        std::span<const probes::Tile> tiles, const TiledParams& params,
                        probes::TileFolder* folder, TransportBakeReport& report, const Control& control = {},
                        TileCrew* crew = nullptr);

/// The same into the folder alone, for sets that memory is too small for: of `set` the places are read.
void transport_into_folder(const rays::TransportSource& source, const probes::ProbeSet& set,
                           std::span<const probes::Tile> tiles, const TiledParams& params,
                           probes::TileFolder& folder, TransportBakeReport& report,
                           const Control& control = {}, TileCrew* crew = nullptr);

/// update_transport() of a set that transport_in_tiles() filled, in tiles of at most so many probes: those in
/// which the scope names no probe keep their bits. A set that stands in no such tiles is updated as a whole.
TransportUpdate update_in_tiles(const rays::TransportSource& source, probes::ProbeSet& set,
                                const TransportBakeParams& params, std::size_t most_probes,
                                const LightScope& scope, float edge_change, TransportBakeReport& report,
                                const Control& control = {});

/// Of all that a bake in tiles depends on.
Hash128 tiled_key(const rays::TransportSource& source, const probes::ProbeSet& set,
                  std::span<const probes::Tile> tiles, const TiledParams& params);

}  // namespace ssphh::bake
