#pragma once
/// Where this build's sources and its tool stand.

#include <filesystem>
#include <string>

namespace ssphh::test {

/// The root of the source tree.
std::filesystem::path source_dir();

/// The tool `ssphh` of this build.
const std::string& tool_path();

}  // namespace ssphh::test
