#pragma once
/// Which files a piece of work reads, and whether they have changed since.

#include <cstdint>
#include <filesystem>
#include <memory>
#include <vector>

namespace ssphh {

/// A file as it was at some time: other contents have another time or size.
struct FileStamp {
  std::filesystem::path path;
  bool exists = false;
  std::filesystem::file_time_type time{};
  std::uintmax_t size = 0;

  friend bool operator==(const FileStamp&, const FileStamp&) = default;
};

FileStamp stamp_of(const std::filesystem::path& path);

/// While it lives, notes every file that read_file() and read_text_file() are asked for, in any thread, as it
/// was before it was read; also those that are missing. One at a time. Throws Error for a second one.
class FilesRead {
 public:
  FilesRead();
  ~FilesRead();
  FilesRead(const FilesRead&) = delete;
  FilesRead& operator=(const FilesRead&) = delete;

  /// By path, each once.
  std::vector<FileStamp> stamps() const;

  struct Notes;

 private:
  std::shared_ptr<Notes> notes_;
};

}  // namespace ssphh
