#pragma once
/// Parameters and accumulated result of a progressive render: plain data.

#include <filesystem>
#include <functional>
#include <span>
#include <vector>

#include <ssphh/core/enum_names.h>
#include <ssphh/core/hash.h>
#include <ssphh/image/image.h>
#include <ssphh/rays/radiance_source.h>

namespace ssphh::trace {

enum class Projection { pinhole, orthographic, equirect, cube_strip };
constexpr auto enum_table(Projection) {
  using enum Projection;
  return std::to_array<EnumName<Projection>>({{pinhole, "pinhole"},
                                              {orthographic, "orthographic"},
                                              {equirect, "equirect"},
                                              {cube_strip, "cube_strip"}});
}

/// A rectangle of a picture's pixels; width 0: the whole picture.
struct Tile {
  int x = 0, y = 0, width = 0, height = 0;

  friend bool operator==(const Tile&, const Tile&) = default;
};

struct RenderParams {
  int width = 1280, height = 720;
  /// The pixels to render: images of a RenderState have the tile's size and hold the same bits as those
  /// pixels of the whole picture.
  Tile tile;
  scene::CameraPose camera;
  /// From the scene's camera, or the whole sphere around its position: equirect, or a 6×1 cube strip (height
  /// = face size, width = 6·height) in world axes.
  Projection projection = Projection::pinhole;
  rays::PathParams path;
  bool per_group = false;  ///< keep one image per light group as well
};

/// Sums over the finished passes; divide by `passes_done` (see the functions below).
struct RenderState {
  int passes_done = 0;
  std::uint64_t paths = 0;
  std::uint64_t rays = 0;
  image::Image color;             ///< radiance
  image::Image direct, indirect;  ///< split of color: depth ≤ 1, depth ≥ 2
  image::Image albedo, normal;    ///< of the first hit; normal in world space, −1..1
  /// 1 channel [m]: mean distance along the view axis (from the eye for whole-sphere projections) of the
  /// samples that hit; 0 where none did.
  image::Image depth;
  image::Image coverage;  ///< 1 channel: share of the samples that hit a surface
  /// Radiance by light group, when asked for: their sum in order is `color`, bit by bit. A render with probes
  /// keeps the direct light of each group only.
  std::vector<image::Image> groups;
  Hash128 key;  ///< of scene and parameters without `passes`: guards a resumed state; set by the first render
                ///< if zero
};

/// Told of a render's finished passes after each, from the thread that renders.
using SeePass = std::function<void(const RenderState&)>;

/// An image of a RenderState, or, as `groups`, one for each light group: in the order of the state.
enum class RenderLayer : std::uint8_t { color, direct, indirect, albedo, normal, depth, coverage, groups };
constexpr auto enum_table(RenderLayer) {
  using enum RenderLayer;
  return std::to_array<EnumName<RenderLayer>>({{color, "color"},
                                               {direct, "direct"},
                                               {indirect, "indirect"},
                                               {albedo, "albedo"},
                                               {normal, "normal"},
                                               {depth, "depth"},
                                               {coverage, "coverage"},
                                               {groups, "groups"}});
}

/// All layers, in their order.
std::span<const RenderLayer> render_layers();
/// The images of a layer: one, but of `groups` as many as the state keeps.
std::span<image::Image> images_of(RenderState& state, RenderLayer layer);
std::span<const image::Image> images_of(const RenderState& state, RenderLayer layer);
/// Numbers of a pixel of that layer: 1 or 3.
int channels_of(RenderLayer layer);

/// The tile that `params` asks for, or that of the whole picture.
Tile tile_of(const RenderParams& params);

/// Identity of a render: everything that decides its pixels but the number of passes and the tile.
/// `scene_hash` as scene::scene_hash. Who renders with probes folds their hash into `scene_hash`.
Hash128 render_key(const Hash128& scene_hash, float time, const RenderParams& params);

/// A state without passes, its images black and of the tile's size.
RenderState empty_state(const RenderParams& params, std::size_t light_groups);

/// Copies the pixels of `part`, which was rendered with `tile`, into `whole`. Counts of paths and rays add
/// up; passes_done is left alone. Throws Error unless the tile lies inside and both keep the same images.
void paste(RenderState& whole, const RenderState& part, const Tile& tile);

/// Mean of an accumulated image; zeros when no pass is done.
image::Image resolve(const image::Image& sum, int passes_done);

/// Checkpoint files: everything above at full precision. Loading throws Error for a damaged file or another
/// `key`.
void save_state(const RenderState& state, const std::filesystem::path& path);
RenderState load_state(const std::filesystem::path& path, const Hash128& key);

}  // namespace ssphh::trace
