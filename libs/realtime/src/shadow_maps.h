#pragma once
/// Shadow maps as tiles of depth arrays: six tiles per cube map, one per parallel map. Tiles are drawn when
/// they are out of date and kept otherwise. Beside depth they may hold what glass leaves of the light on its
/// way to what is nearest.

#include <algorithm>
#include <limits>
#include <memory>
#include <span>
#include <vector>

#include <ssphh/gl/framebuffer.h>
#include <ssphh/gl/program.h>

#include "gpu_scene.h"
#include "tile_layout.h"

namespace ssphh::realtime {

/// A view that a shadow map takes of the scene. A cube face: `right`, `up` unit vectors, depth near/z; a
/// parallel map: `right`, `up` divided by half its extent, `forward` by its depth range.
struct MapView {
  vec3 origin{0}, right{0}, up{0}, forward{0};
  float near_plane = 0;  ///< 0: parallel
  /// Of a cube face, metres: nobody farther away asks, so what stands beyond blocks nothing.
  float reach = std::numeric_limits<float>::infinity();
  float clear_radius = 0;  ///< of a cube face, metres: nothing nearer to the origin blocks

  friend bool operator==(const MapView&, const MapView&) = default;
};

/// Face 0..5 in the order and with the axes of shadow.glsl.
MapView cube_view(const vec3& origin, int face, float near_plane,
                  float reach = std::numeric_limits<float>::infinity());
/// Near plane of cube maps in a scene within `bounds`: what stands nearer blocks nothing. A centimetre in
/// wide scenes, as far as 32 bits of depth bear it for triangles that reach from there to the horizon.
inline float cube_near(const scene::Bounds& bounds) {
  const float radius = bounds.radius();
  return std::max({std::min(5e-4f * radius, 0.01f), 1e-5f * radius, 1e-6f});
}
/// Whether the view can see anything of the box within its reach.
bool sees_box(const MapView& view, const scene::Bounds& box);

class MapAtlas {
 public:
  MapAtlas() = default;
  /// `size` texels along a tile's side. Throws Error when the driver cannot hold so many.
  MapAtlas(int size, int tiles);
  /// What so many tiles would take.
  static std::size_t bytes_of(int size, int tiles);

  int size() const { return size_; }
  const TileLayout& layout() const { return layout_; }
  int count() const { return static_cast<int>(fresh_.size()); }
  std::size_t bytes() const {
    return (texture_.id() ? texture_.bytes() : 0) + (glass_.id() ? glass_.bytes() : 0) +
           (before_ ? before_->bytes() : 0);
  }
  const gl::Texture& texture() const { return texture_; }
  /// Colours, tile by tile; none before an update with a program for glass.
  const gl::Texture& glass() const { return glass_; }

  /// Marks a tile as to be drawn with this view, unless it was; `used` false: nobody looks at it.
  void set_view(int tile, const MapView& view, bool used = true);
  /// Tiles that are not wanted keep their view, and are drawn when they are wanted again.
  void want(int first, int count, bool wanted);
  /// Marks the tiles that see one of the boxes.
  void invalidate(const std::vector<scene::Bounds>& moved);
  void invalidate_all();

  /// Tiles of `before`, of the same scene, that are up to date: those that show what tiles here shall show
  /// are copied by the next update() in place of being drawn.
  void keep(MapAtlas&& before);

  /// Draws tiles that are out of date, at most `most`; returns how many. `waiting` grows by those left. With
  /// a program for `glass` they hold its colours, too.
  int update(const GpuScene& scene, gl::Program& opaque, gl::Program& alpha, int most, int& waiting,
             FrameCounters& counters, gl::Program* glass = nullptr);
  /// Tiles that the last update drew or copied.
  std::span<const int> changed() const { return changed_; }

 private:
  void draw_tile(int tile, const GpuScene& scene, gl::Program& opaque, gl::Program& alpha, gl::Program* glass,
                 FrameCounters& counters);
  void begin_glass(bool absorbs);
  void redraw_all();
  void copy_kept();

  int size_ = 0, stale_ = 0;
  TileLayout layout_;
  gl::Texture texture_, glass_;
  std::vector<gl::Framebuffer> layers_, glass_layers_;
  std::vector<MapView> views_;
  std::vector<int> changed_;
  std::vector<std::uint8_t> fresh_;   ///< 0 stale, 1 fresh, 2 unused, 3 not wanted
  std::unique_ptr<MapAtlas> before_;  ///< until the next update
};

}  // namespace ssphh::realtime
