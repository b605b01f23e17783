#pragma once
/// Scenes as input of other renderers, so that their pictures can stand beside ours as an independent truth
/// (docs/export.md).

#include <array>
#include <filesystem>
#include <optional>
#include <string>
#include <string_view>
#include <vector>

#include <ssphh/scene/query.h>
#include <ssphh/scene/scene.h>

namespace ssphh::scene_io {

/// One picture of a scene at one time, or six of a cube map.
struct ExportSettings {
  scene::CameraPose camera;
  float time = 0;  ///< pose of animated nodes [s]
  int width = 1280, height = 720;
  int max_depth = 25;  ///< scattering events (docs/conventions.md), translated to the renderer's own count
  int spp = 64;        ///< samples per pixel
  std::optional<vec3> cube_at = {};  ///< pictures of cube_cameras() there [m] in place of the camera's
  /// Whether lamps and sky are seen directly, as GEN's reflected light has them not. A renderer that cannot
  /// hide them shows them, and the report says so.
  bool shows_emitters = true;
};

/// Six cameras of 90 degrees at a place, for the faces of a cube map in their order and with their down
/// (docs/conventions.md#cube-maps). Faces are as seen from outside: each is its camera's picture mirrored
/// left to right.
std::array<scene::CameraPose, 6> cube_cameras(const vec3& position);

struct ExportReport {
  std::vector<std::filesystem::path> files;  ///< written; the first is the one that the renderer is given
  std::string command;                       ///< how to render it from a shell
  /// What the other renderer computes differently, one line each with the objects' names: empty when all of
  /// the scene has the same meaning there.
  std::vector<std::string> differences;
};

struct RendererFormat {
  std::string_view name, description;
  ExportReport (*write)(const scene::Scene&, const ExportSettings&, const std::filesystem::path& directory);
};

/// All formats there are: cycles, mitsuba, pbrt, corona.
const std::vector<RendererFormat>& renderer_formats();

/// Blender's Cycles: `render.py` with `specular_albedo.py`, `scene.json`, `scene.bin` and textures beside it.
/// The script takes
/// "-- --output FILE.exr [--seed N] [--spp N] [--threads N]" after Blender's own arguments and builds the
/// scene from the files; for a cube map "--cube cube.json", which stands beside it, and a folder; it was
/// written for Blender 3.4. Materials of Lambert, Oren–Nayar, emission, textures and coverage, all lights,
/// environments and cameras have the same meaning there; specular lobes have the same albedo at every view
/// angle. See the report for others.
ExportReport export_cycles(const scene::Scene& scene, const ExportSettings& settings,
                           const std::filesystem::path& directory);

/// Mitsuba 3 (an RGB variant): `scene.xml`, a binary PLY file per mesh, textures. Lambert, point lights,
/// delta suns, one-sided area lights and environments have the same meaning there; see the report for others.
ExportReport export_mitsuba(const scene::Scene& scene, const ExportSettings& settings,
                            const std::filesystem::path& directory);

/// pbrt-v4: `scene.pbrt`, a binary PLY file per mesh, textures. As Mitsuba, but pbrt computes with spectra:
/// colours of surfaces multiply differently after several bounces.
ExportReport export_pbrt(const scene::Scene& scene, const ExportSettings& settings,
                         const std::filesystem::path& directory);

/// Corona Standalone, the paper's ground truth: `scene.scn`, `scene.mtl`, `scene.conf`, an OBJ file per mesh,
/// textures. Lamps become glowing geometry. Throws Error for an orthographic camera.
ExportReport export_corona(const scene::Scene& scene, const ExportSettings& settings,
                           const std::filesystem::path& directory);

}  // namespace ssphh::scene_io
