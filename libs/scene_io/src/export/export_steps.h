#pragma once

#include <ssphh/scene_io/renderer_export.h>

#include "differences.h"
#include "texture_files.h"

namespace ssphh::scene_io {

/// Makes the folder. Throws Error when that fails, for a scene that scene::check_indices refuses, and for
/// settings that no renderer takes.
void begin_export(const scene::Scene& scene, const ExportSettings& settings,
                  const std::filesystem::path& directory);

/// What there is to tell of an export into `files` and those of its textures.
ExportReport end_export(std::vector<std::filesystem::path> files, const TextureFiles& textures,
                        const Differences& differences, const std::string& command);

}  // namespace ssphh::scene_io
