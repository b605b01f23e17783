#pragma once
/// The folder of real scenes, which is no part of the project: $SSPHH_SCENES or ../shared/scenes.

#include <cstdlib>
#include <filesystem>
#include <optional>
#include <string>

#include <gtest/gtest.h>

#include "places.h"

namespace ssphh::test {

inline std::optional<std::filesystem::path> shared_scenes() {
  namespace fs = std::filesystem;
  const char* named = std::getenv("SSPHH_SCENES");
  const fs::path folder = named ? fs::path(named) : source_dir() / "../shared/scenes";
  if (!fs::is_directory(folder)) return std::nullopt;
  return fs::canonical(folder);
}

}  // namespace ssphh::test

/// Declares `variable` as the path of a real scene, or skips the test and says so.
#define SSPHH_SHARED_SCENE(variable, relative)                                                  \
  const auto variable##_folder = ::ssphh::test::shared_scenes();                                \
  if (!variable##_folder || !std::filesystem::exists(*variable##_folder / (relative)))          \
    GTEST_SKIP() << "real scene absent: " << (relative) << " (set SSPHH_SCENES to the folder)"; \
  const std::filesystem::path variable = *variable##_folder / (relative)
