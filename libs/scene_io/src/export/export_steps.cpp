#include "export_steps.h"

#include <cmath>

#include <ssphh/core/require.h>

namespace ssphh::scene_io {

void begin_export(const scene::Scene& scene, const ExportSettings& settings,
                  const std::filesystem::path& directory) {
  scene::check_indices(scene);
  require(settings.width >= 1 && settings.height >= 1, "export", "width and height must be positive");
  require(settings.max_depth >= 0 && settings.spp >= 1, "export",
          "max depth must not be negative, and there must be a sample");
  require(std::isfinite(settings.time), "export", "the time must be a finite number of seconds");
  std::error_code error;
  std::filesystem::create_directories(directory, error);
  if (error) throw Error(directory.string(), "the folder cannot be made: " + error.message());
}

ExportReport end_export(std::vector<std::filesystem::path> files, const TextureFiles& textures,
                        const Differences& differences, const std::string& command) {
  files.insert(files.end(), textures.written().begin(), textures.written().end());
  return {std::move(files), command, differences.lines()};
}

}  // namespace ssphh::scene_io
