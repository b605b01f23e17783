#pragma once

#include <ssphh/scene_io/renderer_export.h>

namespace ssphh::scene_io {

/// Makes the folder. Throws Error when that fails, for a scene that scene::check_indices refuses, and for
/// settings that no renderer takes.
void begin_export(const scene::Scene& scene, const ExportSettings& settings,
                  const std::filesystem::path& directory);

}  // namespace ssphh::scene_io
