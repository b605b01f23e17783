#pragma once
/// Scripts that stand in for other programs.

#include <filesystem>
#include <string>

#include <ssphh/core/file.h>

#include "variable.h"

namespace ssphh::test {

/// PATH for as long as it lives.
struct Path : Variable {
  explicit Path(const std::string& value) : Variable("PATH", value.c_str()) {}
};

inline void write_script(const std::filesystem::path& file, const std::string& text) {
  std::filesystem::create_directories(file.parent_path());
  write_file(file, "#!/bin/sh\n" + text);
  std::filesystem::permissions(file, std::filesystem::perms::owner_all);
}

}  // namespace ssphh::test
