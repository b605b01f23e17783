#pragma once

#include <ssphh/scene_io/renderer_export.h>

#include "differences.h"
#include "flat_scene.h"
#include "texture_files.h"

namespace ssphh::scene_io {

/// Makes the folder. Throws Error when that fails, for a scene that scene::check_indices refuses, and for
/// settings that no renderer takes. Returns the scene as the others know lamps: flat ones are glowing meshes.
scene::Scene begin_export(const scene::Scene& scene, const ExportSettings& settings,
                          const std::filesystem::path& directory);

/// Tells of the flat lamps of the scene that was given.
void note_area_lamps(const scene::Scene& given, Differences& differences);

/// The camera, or those of the cube map's faces.
std::vector<scene::CameraPose> cameras_of(const ExportSettings& settings);

/// A shell's line that does the command for each face of a cube map, in which $f is the face.
std::string for_each_face(const std::string& command);

/// Of a renderer that shows emitters where the settings do not want them: names those that a ray can see.
void note_shown_emitters(const scene::Scene& scene, const FlatScene& flat, const ExportSettings& settings,
                         Differences& differences);

/// What there is to tell of an export into `files` and those of its textures.
ExportReport end_export(std::vector<std::filesystem::path> files, const TextureFiles& textures,
                        const Differences& differences, const std::string& command);

}  // namespace ssphh::scene_io
