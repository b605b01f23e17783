#pragma once
/// Parameters and accumulated result of a progressive render: plain data.

#include <ssphh/core/hash.h>
#include <ssphh/image/image.h>
#include <ssphh/scene/radiance_source.h>

#include <filesystem>
#include <vector>

namespace ssphh::trace {

enum class Projection { pinhole, orthographic, equirect, cube_strip };

struct RenderParams {
  int width = 1280, height = 720;
  scene::CameraPose camera;
  /// From the scene's camera, or the whole sphere around its position: equirect, or a 6×1 cube strip (height = face
  /// size, width = 6·height) in world axes.
  Projection projection = Projection::pinhole;
  scene::PathParams path;
  bool per_group = false;  ///< keep one image per light group as well
};

/// Sums over the finished passes; divide by `passes_done` (see the functions below).
struct RenderState {
  int passes_done = 0;
  std::uint64_t paths = 0;
  std::uint64_t rays = 0;
  image::Image color;                ///< radiance
  image::Image direct, indirect;     ///< split of color: depth ≤ 1, depth ≥ 2
  image::Image albedo, normal;       ///< of the first hit; normal in world space, −1..1
  image::Image depth;                ///< 1 channel: mean distance along the view axis of the samples that hit
  std::vector<image::Image> groups;  ///< radiance by light group, when asked for
  Hash128 key;                       ///< of scene and parameters without `passes`: guards a resumed state
};

/// Mean of an accumulated image.
image::Image resolve(const image::Image& sum, int passes_done);

/// Checkpoint files: everything above at full precision. Loading throws Error for a damaged file or another `key`.
void save_state(const RenderState& state, const std::filesystem::path& path);
RenderState load_state(const std::filesystem::path& path, const Hash128& key);

}  // namespace ssphh::trace
