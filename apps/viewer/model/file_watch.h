#pragma once
/// Whether a file changes on the disk while it is open.

#include <cstdint>
#include <filesystem>
#include <optional>
#include <string>

namespace ssphh::viewer {

/// By which a file on the disk is known to have changed.
struct FileState {
  std::filesystem::file_time_type written;
  std::uintmax_t size = 0;
  friend bool operator==(const FileState&, const FileState&) = default;
};

/// When the file was written last and how large it is; none: there is no file.
std::optional<FileState> file_state(const std::string& file);

/// Looks at a file once a second.
class FileWatch {
 public:
  enum class News {
    none,
    gone,     ///< told once
    changed,  ///< and has not gone on changing for a second; told until taken()
  };

  FileWatch() = default;  ///< of no file
  /// `loaded`: as it was when it was read; none: there is no file to be watched.
  FileWatch(std::optional<FileState> loaded, double seconds)
      : loaded_(loaded), seen_(loaded), looked_(seconds) {}

  /// What there is to tell at this time.
  News look(const std::string& file, double seconds);
  /// The change that was told is known from now on.
  void taken() { loaded_ = seen_; }

 private:
  std::optional<FileState> loaded_, seen_;
  double looked_ = 0;
  bool told_ = false;  ///< that it is gone
};

}  // namespace ssphh::viewer
