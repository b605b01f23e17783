#pragma once

#include <filesystem>

namespace ssphh::test {

/// Parent of a TempDir in memory, where the system has that: for tests that write hundreds of files, which
/// would wait for the disk most of their time.
inline std::filesystem::path memory_dir() {
  const std::filesystem::path memory = "/dev/shm";
  return std::filesystem::exists(memory) ? memory : std::filesystem::temp_directory_path();
}

}  // namespace ssphh::test
