#include <algorithm>
#include <cmath>
#include <numeric>
#include <optional>
#include <system_error>

#include <fmt/format.h>

#include <ssphh/core/counted.h>
#include <ssphh/core/file.h>
#include <ssphh/core/json_cursor.h>
#include <ssphh/core/log.h>
#include <ssphh/probes/probe_file.h>
#include <ssphh/probes/probe_limits.h>
#include <ssphh/probes/tile_folder.h>

namespace ssphh::probes {
namespace {

constexpr const char* index_name = "tiles.json";
constexpr std::size_t most_tiles = limits::placed;

/// null where a box has no end.
json::Value corner(const vec3& at) {
  json::Array values;
  for (int axis = 0; axis < 3; ++axis)
    values.push_back(std::isfinite(at[axis]) ? json::Value(at[axis]) : json::Value());
  return values;
}

vec3 read_corner(const json::Cursor& at, float no_end) {
  at.size(3, 3);
  vec3 result(no_end);
  for (int axis = 0; axis < 3; ++axis)
    if (!at[axis].value().is_null()) result[axis] = at[axis].number();
  return result;
}

std::string to_json(const Hash128& key, std::span<const Tile> tiles) {
  json::Value list = json::Value::array();
  for (const Tile& tile : tiles) {
    list.push_back({{"probes", tile.own},
                    {"halo", tile.halo},
                    {"min", corner(tile.box.min)},
                    {"max", corner(tile.box.max)}});
  }
  return json::print({{"ssphh_tiles", tile_folder_version}, {"key", key.hex()}, {"tiles", std::move(list)}}) +
         "\n";
}

struct Index {
  std::string key;
  std::vector<Tile> tiles;
};

Index read_index(const std::filesystem::path& folder) {
  const std::string file = (folder / index_name).string();
  const json::Value document = json::parse(read_text_file(file, limits::json_bytes), file);
  const json::Cursor root(document, file);
  root.members({"ssphh_tiles", "key", "tiles"});
  root["ssphh_tiles"].integer(tile_folder_version, tile_folder_version);
  Index index{root["key"].text(32), {}};
  const json::Cursor list = root["tiles"];
  std::size_t first = 0;
  for (std::size_t t = 0; t < list.size(1, most_tiles); ++t) {
    const json::Cursor at = list[t];
    at.members({"probes", "halo", "min", "max"});
    Tile& tile = index.tiles.emplace_back();
    tile.first = static_cast<std::uint32_t>(first);
    tile.own = static_cast<std::uint32_t>(at["probes"].integer(1, limits::probes));
    tile.box = {read_corner(at["min"], TileBox().min.x), read_corner(at["max"], TileBox().max.x)};
    first += tile.own;
  }
  if (first > limits::placed) list.fail(fmt::format("are of {} probes, over {}", first, limits::placed));
  for (std::size_t t = 0; t < index.tiles.size(); ++t) {
    const json::Cursor halo = list[t]["halo"];
    for (std::size_t k = 0; k < halo.size(0, limits::probes); ++k)
      index.tiles[t].halo.push_back(static_cast<std::uint32_t>(halo[k].index(first, "probes")));
  }
  return index;
}

}  // namespace

bool is_tile_folder(const std::filesystem::path& path) {
  return path.extension() == ".tiles" || (!path.has_filename() && path.parent_path().extension() == ".tiles");
}

TileFolder::TileFolder(std::filesystem::path path, const Hash128& key, std::vector<Tile> tiles)
    : path_(std::move(path)), tiles_(std::move(tiles)) {
  std::error_code error;
  if (std::filesystem::exists(path_ / index_name)) {
    std::optional<Index> there;
    try {
      there = read_index(path_);
    } catch (const Error&) {
      // Of another version, or damaged: nothing to go on with
    }
    if (there && there->key == key.hex() && there->tiles == tiles_) return;
    log_info("{} is of another bake: starting again", path_.string());
    if (there) tiles_.swap(there->tiles);
    remove();
    if (there) tiles_.swap(there->tiles);
  } else if (std::filesystem::exists(path_) &&
             !(std::filesystem::is_directory(path_) && std::filesystem::is_empty(path_))) {
    throw Error(path_.string(), "is there already and holds no tiles", "remove it, or choose another name");
  }
  std::filesystem::create_directories(path_, error);
  if (error) throw Error(path_.string(), "cannot be made: " + error.message());
  write_file(path_ / index_name, to_json(key, tiles_));
}

TileFolder::TileFolder(std::filesystem::path path) : path_(std::move(path)) {
  tiles_ = read_index(path_).tiles;
}

std::filesystem::path TileFolder::file_of(std::size_t tile) const {
  return path_ / fmt::format("{}.sphl", tile);
}

bool TileFolder::has(std::size_t tile) const {
  return std::filesystem::exists(file_of(tile));
}

void TileFolder::write(std::size_t tile, const ProbeSet& set) const {
  write_probe_file(set, file_of(tile));
}

ProbeSet TileFolder::read(std::size_t tile) const {
  if (!has(tile))
    throw Error(file_of(tile).string(), "is missing",
                "an interrupted bake goes on when the same command is given again");
  ProbeSet set = read_probe_file(file_of(tile));
  const std::size_t count = tiles_[tile].own + tiles_[tile].halo.size();
  if (set.probes.size() != count)
    throw Error(file_of(tile).string(),
                fmt::format("has {}, {} lists {}", counted(set.probes.size(), "probe"), index_name, count));
  return set;
}

ProbeSet TileFolder::join(std::span<const std::size_t> which) const {
  std::size_t count = 0;
  for (const std::size_t t : which) count += tiles_[t].own;
  if (which.empty() || count > limits::probes) {
    throw Error(path_.string(), which.empty() ? "no tile of it is asked for"
                                              : fmt::format("{} probes are more than the {} of a set", count,
                                                            limits::probes));
  }
  const std::vector<int> places = places_of(tiles_, which);
  ProbeSet whole;
  for (const std::size_t t : which) {
    ProbeSet set = read(t);
    if (whole.probes.empty()) {
      whole.degree = set.degree;
      whole.probes.resize(count);
    } else if (set.degree != whole.degree || set.light_groups.size() != whole.light_groups.size()) {
      throw Error(file_of(t).string(), "is of another degree or other light groups than the tiles before");
    }
    put_tile(tiles_[t], std::move(set), places, whole);
  }
  merge_groups(whole);
  return whole;
}

ProbeSet TileFolder::join() const {
  std::vector<std::size_t> all(tiles_.size());
  std::iota(all.begin(), all.end(), std::size_t{0});
  return join(all);
}

Hash128 TileFolder::content() const {
  Hasher hasher;
  hasher.bytes(read_file(path_ / index_name));
  for (std::size_t t = 0; t < tiles_.size(); ++t) hasher.bytes(read_file(file_of(t), limits::binary_bytes));
  return hasher.finish();
}

void TileFolder::remove() const {
  std::error_code ignored;
  for (std::size_t t = 0; t < tiles_.size(); ++t) std::filesystem::remove(file_of(t), ignored);
  std::filesystem::remove(path_ / index_name, ignored);
  std::filesystem::remove(path_, ignored);
}

}  // namespace ssphh::probes
