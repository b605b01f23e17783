#pragma once
/// Where a program keeps what belongs to its user (XDG Base Directory Specification).

#include <filesystem>

namespace ssphh {

/// The folder "ssphh" in that of an environment variable, as XDG_CACHE_HOME, if it holds an absolute path;
/// else in `below_home`, as .cache, of $HOME, or of the folder for temporary files where there is no home.
/// Makes nothing.
std::filesystem::path user_folder(const char* variable, const char* below_home);

}  // namespace ssphh
