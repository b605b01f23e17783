#include "file_watch.h"

#include <utility>

namespace ssphh::viewer {
namespace {

namespace fs = std::filesystem;

constexpr double look_every = 1;  // seconds

}  // namespace

std::optional<FileState> file_state(const std::string& file) {
  std::error_code error;
  const auto written = fs::last_write_time(file, error);
  if (error || fs::is_directory(file, error)) return {};
  const auto size = fs::file_size(file, error);
  if (error) return {};
  return FileState{written, size};
}

FileWatch::News FileWatch::look(const std::string& file, double seconds) {
  if (!loaded_ || seconds - looked_ < look_every) return News::none;
  looked_ = seconds;
  const auto before = std::exchange(seen_, file_state(file));
  if (!seen_) return before || std::exchange(told_, true) ? News::none : News::gone;
  told_ = false;
  return seen_ != loaded_ && seen_ == before ? News::changed : News::none;
}

}  // namespace ssphh::viewer
