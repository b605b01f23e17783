#pragma once
/// `ssphh export`: a scene as input of other renderers, or as one GLB file.

#include <cstdint>
#include <string>
#include <vector>

#include <ssphh/core/control.h>
#include <ssphh/core/hash.h>
#include <ssphh/core/json.h>
#include <ssphh/probes/probe_set.h>
#include <ssphh/scene_io/renderer_export.h>

#include "options/picture_options.h"

namespace ssphh::app {

struct ExportOptions {
  PictureOptions picture;  ///< that the other renderer is to make; gltf reads its scene alone
  std::string to;          ///< one of export_formats()
  std::string output;      ///< folder to write into; for gltf also FILE.glb
  /// camera, or cube: six pictures of a cube map, as GEN and VIZ take at a probe.
  PictureProjection projection = PictureProjection::camera;
  std::string at;      ///< place of the cube: an SPHL by name, or "X,Y,Z"; empty: the camera's
  int face_size = 64;  ///< pixels along a face of the cube
  /// SPHL whose sphere is the only light, as VIZ has it; empty: the scene's own lights.
  std::string viz_from;
  probes::VizSource viz_source = probes::VizSource::intensity;
};

/// The names of scene_io::renderer_formats(), and gltf.
std::vector<std::string> export_formats();

struct ExportResult {
  scene_io::ExportReport report;
  std::uint64_t triangles = 0;  ///< of the scene
  Hash128 hash;                 ///< scene::scene_hash()
};

/// Reads the scene and writes the files. Pictures of a cube are without lamps and sky themselves (GEN's
/// reflected light), unless `viz_from` or a depth of 0 asks for these. Throws Error for an unknown format
/// (before anything else), for an unknown camera or SPHL, a cube within the sphere that shines, for files
/// that cannot be read or written, and as the format's writer does. Too short to be cancelled or to tell of
/// its progress.
ExportResult run_export(const ExportOptions& options, const Control& control = {});

json::Value to_json(const ExportResult& result, const ExportOptions& options);
std::string to_text(const ExportResult& result, const ExportOptions& options);

}  // namespace ssphh::app
