#pragma once

#include <filesystem>

namespace ssphh {

/// Tells the FilesRead that lives now, if any.
void note_file_read(const std::filesystem::path& path);

}  // namespace ssphh
