#pragma once
/// Names of the pictures of an exported camera path, and those that an older, longer export left behind.

#include <filesystem>
#include <string>

namespace ssphh::viewer {

/// "frame-0007.png" of 7; as many digits as it takes, four at least.
std::string frame_name(int frame);

/// Removes the files frame_name(n) of n ≥ count from a folder, and nothing else; how many there were. Throws
/// Error for one that cannot be removed.
int remove_frames_from(const std::filesystem::path& folder, int count);

}  // namespace ssphh::viewer
