#pragma once
/// Scripts that stand in for other programs.

#include <cstdlib>
#include <filesystem>
#include <string>

#include <ssphh/core/file.h>

namespace ssphh::test {

/// PATH for as long as it lives.
class Path {
 public:
  explicit Path(const std::string& value) {
    const char* path = std::getenv("PATH");
    before_ = path ? path : "";
    ::setenv("PATH", value.c_str(), 1);
  }
  ~Path() { ::setenv("PATH", before_.c_str(), 1); }
  Path(const Path&) = delete;
  Path& operator=(const Path&) = delete;

 private:
  std::string before_;
};

inline void write_script(const std::filesystem::path& file, const std::string& text) {
  std::filesystem::create_directories(file.parent_path());
  write_file(file, "#!/bin/sh\n" + text);
  std::filesystem::permissions(file, std::filesystem::perms::owner_all);
}

}  // namespace ssphh::test
