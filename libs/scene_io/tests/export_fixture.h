#pragma once
/// What the tests of the exporters to other renderers share.

#include <cmath>
#include <cstring>
#include <filesystem>
#include <functional>
#include <sstream>
#include <string>
#include <vector>

#include <gtest/gtest.h>

#include <ssphh/core/file.h>
#include <ssphh/image/image.h>
#include <ssphh/scene/scene.h>
#include <ssphh/scene_io/renderer_export.h>

namespace ssphh::test {

/// One of everything, with names that no format likes: quotes, line ends, markup, none at all, the same
/// twice.
scene::Scene scene_of_everything();

/// From a tilted camera, 64 × 36 pixels, depth 3.
scene_io::ExportSettings export_settings();

/// The numbers of a text separated by blanks; a text that holds anything else, or NaN, or infinity, fails the
/// test.
std::vector<float> numbers_of(const std::string& text);

/// Place on the picture, (0, 0) upper left, (1, 1) lower right, by the definition of our own camera.
vec2 place_on_picture(const scene_io::ExportSettings& settings, const vec3& world);

/// World points in front of the camera of export_settings().
std::vector<vec3> visible_points();

/// Radiance from a world direction, by the definition of scene::Environment.
vec3 environment_radiance(const scene::Environment& environment, const vec3& direction);

/// Directions all around.
std::vector<vec3> directions_around();

/// export_settings() of a cube map at (0.5, −0.25, 2), 16 pixels along a face.
scene_io::ExportSettings cube_settings();

/// That a camera is the one for a face of that cube map: docs/conventions.md says where the face looks and
/// what is right and down on it; the camera sees it from inside, mirrored.
void expect_camera_of_face(std::size_t face, const vec3& place, const vec3& ahead, const vec3& right,
                           const vec3& up);

struct Ply {
  std::vector<std::string> properties;  ///< of a vertex
  std::vector<std::vector<float>> vertices;
  std::vector<uvec3> triangles;
};
/// Fails the test unless the file is what its header says, to the byte, with finite numbers and valid
/// indices.
Ply read_ply(const std::filesystem::path& path);

/// The lines that hold `part`.
std::vector<std::string> differences_with(const scene_io::ExportReport& report, const std::string& part);

}  // namespace ssphh::test
