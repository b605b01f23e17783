#pragma once
/// Folders of `ssphh web`: what stands in one, and how it takes another's place.

#include <cstddef>
#include <filesystem>
#include <string>
#include <vector>

namespace ssphh::app {

/// What tells that a folder is of this command: names all its other files.
inline constexpr const char* web_manifest = "scene.json";

struct FolderFile {
  std::string name;  ///< below the folder, with slashes
  std::vector<std::byte> data;
};

/// Every file below the folder, by name. Throws Error where the page was not built.
std::vector<FolderFile> read_page(const std::filesystem::path& page);

/// Throws Error for a place where no folder can be, and, unless `replace`, for a folder that holds files
/// which web_manifest does not name.
void check_folder(const std::filesystem::path& folder, bool replace);

/// Writes "FOLDER.XXXXXXXX.part", and gives it the folder's name in place of what had it. Throws Error with
/// the system's reason, and then leaves what there was.
void write_folder(const std::filesystem::path& folder, const std::vector<FolderFile>& files, bool replace);

}  // namespace ssphh::app
