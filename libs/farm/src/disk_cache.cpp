#include <algorithm>
#include <cstring>

#include <fcntl.h>
#include <fmt/format.h>
#include <sys/stat.h>

#include <ssphh/core/error.h>
#include <ssphh/core/file.h>
#include <ssphh/core/log.h>
#include <ssphh/core/user_folder.h>
#include <ssphh/farm/disk_cache.h>

namespace ssphh::farm {
namespace {

namespace fs = std::filesystem;

struct Entry {
  fs::path path;
  fs::file_time_type used;
  std::uint64_t size = 0;
};

/// Other processes may remove entries while this looks.
std::vector<Entry> list(const fs::path& dir) {
  std::vector<Entry> entries;
  std::error_code error;
  for (fs::recursive_directory_iterator it(dir, error), end; !error && it != end; it.increment(error)) {
    std::error_code gone;
    Entry entry{it->path(), it->last_write_time(gone), 0};
    if (gone || !it->is_regular_file(gone) || gone) continue;
    entry.size = it->file_size(gone);
    if (!gone) entries.push_back(std::move(entry));
  }
  return entries;
}

}  // namespace

DiskCache::DiskCache(fs::path dir, std::uint64_t max_bytes) : dir_(std::move(dir)), max_bytes_(max_bytes) {
  std::error_code error;
  fs::create_directories(dir_, error);
  if (error) throw Error(dir_.string(), "the cache cannot be made: " + error.message());
  for (const Entry& entry : list(dir_)) bytes_ += entry.size;
}

fs::path DiskCache::path(const Hash128& key) const {
  const std::string name = key.hex();
  return dir_ / name.substr(0, 2) / name;
}

bool DiskCache::contains(const Hash128& key) const {
  std::error_code error;
  return fs::exists(path(key), error);
}

std::optional<std::vector<std::byte>> DiskCache::get(const Hash128& key) {
  const fs::path file = path(key);
  std::vector<std::byte> data;
  try {
    if (!contains(key)) {
      const std::lock_guard lock(mutex_);
      ++counts_.misses;
      return std::nullopt;
    }
    data = read_file(file, max_bytes_ + sizeof(Hash128));
  } catch (const Error&) {
    const std::lock_guard lock(mutex_);
    ++counts_.misses;  // evicted by another process in this moment
    return std::nullopt;
  }
  Hash128 stored;
  const bool whole = data.size() >= sizeof(Hash128);
  if (whole) std::memcpy(&stored, data.data() + data.size() - sizeof(Hash128), sizeof(Hash128));
  const std::lock_guard lock(mutex_);
  if (!whole || Hasher().bytes(std::span(data).first(data.size() - sizeof(Hash128))).finish() != stored) {
    std::error_code ignored;
    fs::remove(file, ignored);
    ++counts_.damaged;
    log_warning("{}: the cached value was damaged and is removed", file.string());
    return std::nullopt;
  }
  ++counts_.hits;
  ::utimensat(AT_FDCWD, file.c_str(), nullptr, 0);
  data.resize(data.size() - sizeof(Hash128));
  return data;
}

void DiskCache::put(const Hash128& key, std::span<const std::byte> value) {
  if (value.size() > max_bytes_) {
    throw Error(dir_.string(),
                fmt::format("the cache holds at most {} bytes; {} are to be kept", max_bytes_, value.size()),
                "give it a larger --cache-size");
  }
  std::vector<std::byte> data(value.size() + sizeof(Hash128));
  if (!value.empty()) std::memcpy(data.data(), value.data(), value.size());
  const Hash128 hash = Hasher().bytes(value).finish();
  std::memcpy(data.data() + value.size(), &hash, sizeof(hash));
  {
    const std::lock_guard lock(mutex_);
    make_room(data.size());
    bytes_ += data.size(), put_since_ += data.size();
  }
  const fs::path file = path(key);
  std::error_code error;
  fs::create_directories(file.parent_path(), error);
  if (error) throw Error(file.string(), "cannot be written: " + error.message());
  write_file(file, data);
}

void DiskCache::make_room(std::uint64_t size) {
  if (bytes_ + size <= max_bytes_ && put_since_ <= max_bytes_ / 8) return;
  std::vector<Entry> entries = list(dir_);
  put_since_ = 0, bytes_ = 0;
  for (const Entry& entry : entries) bytes_ += entry.size;
  if (bytes_ + size <= max_bytes_) return;
  // A tenth more than needed, so that not every call has to look.
  std::ranges::sort(entries, {}, &Entry::used);
  const std::uint64_t aim = max_bytes_ - std::min(max_bytes_, std::max(size, max_bytes_ / 10));
  for (const Entry& entry : entries) {
    if (bytes_ <= aim) break;
    std::error_code error;
    if (fs::remove(entry.path, error)) ++counts_.evicted;
    bytes_ -= entry.size;
  }
}

DiskCache::Counts DiskCache::counts() const {
  const std::lock_guard lock(mutex_);
  return counts_;
}

fs::path default_cache_dir(const std::string& name) {
  return user_folder("XDG_CACHE_HOME", ".cache") / name;
}

}  // namespace ssphh::farm
