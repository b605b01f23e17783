#pragma once
/// What files hold, by their names.

#include <filesystem>
#include <string>

namespace ssphh::viewer {

/// Whether the name ends as a probe file's does.
bool is_probe_file(const std::string& name);
/// Whether a picture of that name holds linear light: .exr.
bool is_linear_picture(const std::filesystem::path& file);

}  // namespace ssphh::viewer
