#pragma once
/// A set in a folder, NAME.tiles: `tiles.json`, which lists the tiles, and a probe file for each, `0.sphl`,
/// `1.sphl` and so on, with the tile's own probes, then those of its halo (docs/probe-files.md#tiles).
/// Whoever streams a city reads the tiles that are near.

#include <filesystem>
#include <string>

#include <ssphh/core/hash.h>
#include <ssphh/probes/tiles.h>

namespace ssphh::probes {

inline constexpr int tile_folder_version = 1;

/// Whether the name is that of a folder of tiles.
bool is_tile_folder(const std::filesystem::path& path);

class TileFolder {
 public:
  /// A folder to fill. One that is there is gone on with where it has the same key and the same tiles; else
  /// its tiles are removed. Throws Error where it cannot be written, and where something else is there.
  TileFolder(std::filesystem::path path, const Hash128& key, std::vector<Tile> tiles);
  /// One that is there. Throws Error that names the file and the place where it is not as it should be.
  explicit TileFolder(std::filesystem::path path);

  const std::filesystem::path& path() const { return path_; }
  const std::vector<Tile>& tiles() const { return tiles_; }

  bool has(std::size_t tile) const;
  /// Writes atomically. Throws Error as write_probe_file() does.
  void write(std::size_t tile, const ProbeSet& set) const;
  /// Throws Error as read_probe_file() does, and for a set of other probes than the list says.
  ProbeSet read(std::size_t tile) const;
  /// The set of some tiles, their probes one tile after the other, without the edges that lead to others.
  /// Throws Error as read() does, for no tile, and for more than limits::probes.
  ProbeSet join(std::span<const std::size_t> which) const;
  ProbeSet join() const;  ///< of all

  /// Of the index and of each tile's file.
  Hash128 content() const;

  /// Removes what the folder holds of tiles, and itself where nothing else is in it.
  void remove() const;

 private:
  std::filesystem::path file_of(std::size_t tile) const;

  std::filesystem::path path_;
  std::vector<Tile> tiles_;
};

}  // namespace ssphh::probes
