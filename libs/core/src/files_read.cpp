#include <map>
#include <mutex>
#include <system_error>

#include <ssphh/core/files_read.h>
#include <ssphh/core/require.h>

#include "note_file_read.h"

namespace ssphh {

/// The first stamp of a file is the one that counts: whatever is read later may have changed since.
struct FilesRead::Notes {
  std::mutex mutex;
  std::map<std::filesystem::path, FileStamp> stamps;
};

namespace {

std::mutex notes_mutex;
std::shared_ptr<FilesRead::Notes> notes_of_now;

}  // namespace

FileStamp stamp_of(const std::filesystem::path& path) {
  FileStamp stamp{path};
  std::error_code missing, no_size;
  stamp.time = std::filesystem::last_write_time(path, missing);
  if (missing) return FileStamp{path};
  stamp.exists = true;
  const std::uintmax_t size = std::filesystem::file_size(path, no_size);
  if (!no_size) stamp.size = size;
  return stamp;
}

void note_file_read(const std::filesystem::path& path) {
  std::shared_ptr<FilesRead::Notes> notes;
  {
    const std::lock_guard lock(notes_mutex);
    notes = notes_of_now;
  }
  if (!notes) return;
  FileStamp stamp = stamp_of(path);
  const std::lock_guard lock(notes->mutex);
  notes->stamps.emplace(path, std::move(stamp));
}

FilesRead::FilesRead() : notes_(std::make_shared<Notes>()) {
  const std::lock_guard lock(notes_mutex);
  require(notes_of_now == nullptr, "files read", "they are being noted already");
  notes_of_now = notes_;
}

FilesRead::~FilesRead() {
  const std::lock_guard lock(notes_mutex);
  notes_of_now.reset();
}

std::vector<FileStamp> FilesRead::stamps() const {
  const std::lock_guard lock(notes_->mutex);
  std::vector<FileStamp> result;
  for (const auto& [path, stamp] : notes_->stamps) result.push_back(stamp);
  return result;
}

}  // namespace ssphh
