#pragma once
/// Camera bookmarks, and the path that leads through them in the order of their times.

#include <filesystem>
#include <optional>
#include <string>
#include <string_view>
#include <vector>

#include "view_camera.h"

namespace ssphh::viewer {

struct CameraKey {
  std::string name;
  float time = 0;                   ///< seconds along the path
  std::optional<float> scene_time;  ///< pose of the scene's animations there [s]; none: left alone
  View view;

  friend bool operator==(const CameraKey&, const CameraKey&) = default;
};

/// Keys of strictly increasing times.
struct CameraPath {
  std::vector<CameraKey> keys;

  bool empty() const { return keys.empty(); }
  float duration() const { return keys.empty() ? 0 : keys.back().time - keys.front().time; }
  friend bool operator==(const CameraPath&, const CameraPath&) = default;
};

/// View at `time`, clamped to the keys: positions by the Catmull–Rom spline for uneven knots (Barry &
/// Goldman, A recursive evaluation algorithm for a class of Catmull–Rom splines, 1988: the tangent at a key
/// is that of the parabola through it and its neighbours; the ends take their neighbour's parabola),
/// orientations by slerp the short way round, angles and distances linearly. The path must not be empty.
CameraKey at(const CameraPath& path, float time);

/// Appends a key `gap` seconds after the last one, or at 0.
void append(CameraPath& path, CameraKey key, float gap = 2);

/// Camera path files (schemas/camera-path.schema.json). Errors name file and key.
std::string to_json(const CameraPath& path);
CameraPath camera_path_from_json(std::string_view text, const std::string& where);
CameraPath read_camera_path(const std::filesystem::path& file);
void write_camera_path(const std::filesystem::path& file, const CameraPath& path);

}  // namespace ssphh::viewer
