#include "frame_files.h"

#include <vector>

#include <fmt/format.h>

#include <ssphh/core/error.h>
#include <ssphh/core/parse_number.h>

namespace ssphh::viewer {
namespace {

constexpr std::string_view prefix = "frame-", ending = ".png";

/// Number of a file that frame_name() named; −1: another file.
int frame_of(const std::string& name) {
  if (!name.starts_with(prefix) || !name.ends_with(ending) || name.size() < prefix.size() + ending.size())
    return -1;
  const std::string digits = name.substr(prefix.size(), name.size() - prefix.size() - ending.size());
  const auto frame = parse_number<int>(digits);
  return frame && *frame >= 0 && frame_name(*frame) == name ? *frame : -1;
}

}  // namespace

std::string frame_name(int frame) {
  return fmt::format("{}{:04}{}", prefix, frame, ending);
}

int remove_frames_from(const std::filesystem::path& folder, int count) {
  std::vector<std::filesystem::path> old;
  for (const auto& entry : std::filesystem::directory_iterator(folder)) {
    if (entry.is_regular_file() && frame_of(entry.path().filename().string()) >= count)
      old.push_back(entry.path());
  }
  for (const std::filesystem::path& file : old) {
    std::error_code error;
    std::filesystem::remove(file, error);
    if (error)
      throw Error(file.string(), "this frame of an older export cannot be removed: " + error.message());
  }
  return static_cast<int>(old.size());
}

}  // namespace ssphh::viewer
