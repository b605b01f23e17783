#include <algorithm>
#include <cerrno>
#include <cstring>

#include <fcntl.h>
#include <fmt/format.h>
#include <sys/file.h>
#include <sys/stat.h>
#include <unistd.h>

#include <ssphh/core/file.h>
#include <ssphh/core/require.h>
#include <ssphh/farm/scene_package.h>
#include <ssphh/farm/scene_store.h>

namespace ssphh::farm {
namespace {

constexpr std::uint64_t chunk_bytes = std::uint64_t{1} << 20;

/// DIR/KEY.part, locked against other processes that fetch the same.
class PartFile {
 public:
  explicit PartFile(std::filesystem::path path) : path_(std::move(path)) {
    fd_ = ::open(path_.c_str(), O_RDWR | O_CREAT | O_CLOEXEC, 0666);
    if (fd_ < 0) fail("open");
    while (::flock(fd_, LOCK_EX) != 0)
      if (errno != EINTR) fail("lock");
  }
  ~PartFile() { ::close(fd_); }
  PartFile(const PartFile&) = delete;
  PartFile& operator=(const PartFile&) = delete;

  std::uint64_t size() const {
    struct stat status {};
    if (::fstat(fd_, &status) != 0) fail("read");
    return static_cast<std::uint64_t>(status.st_size);
  }
  void truncate() const {
    if (::ftruncate(fd_, 0) != 0) fail("empty");
  }
  void write(std::span<const std::byte> data, std::uint64_t offset) const {
    while (!data.empty()) {
      const ssize_t put = ::pwrite(fd_, data.data(), data.size(), static_cast<off_t>(offset));
      if (put < 0 && errno == EINTR) continue;
      if (put <= 0) fail("write");
      data = data.subspan(static_cast<std::size_t>(put)), offset += static_cast<std::uint64_t>(put);
    }
  }
  /// Removed while locked: who waits for the lock looks into the cache next.
  void remove() const { ::unlink(path_.c_str()); }

 private:
  [[noreturn]] void fail(const char* action) const {
    throw BlobUnavailable(fmt::format("{}: cannot {}: {}", path_.string(), action, std::strerror(errno)));
  }
  std::filesystem::path path_;
  int fd_;
};

}  // namespace

std::vector<std::byte> fetch_blob(DiskCache& cache, const Hash128& package, const Hash128& blob,
                                  std::uint64_t size, const FetchChunk& fetch, const Control& control) {
  if (auto kept = cache.get(blob)) return std::move(*kept);
  if (size > cache.max_bytes()) {
    throw BlobUnavailable(fmt::format("{}: the cache of {} bytes is too small for a blob of {}",
                                      cache.dir().string(), cache.max_bytes(), size));
  }
  require(fetch != nullptr, "blob", "nothing fetches it");
  const PartFile part(cache.dir() / (blob.hex() + ".part"));
  if (auto kept = cache.get(blob)) return std::move(*kept);  // while this process waited for the lock
  if (part.size() > size) part.truncate();
  for (std::uint64_t done = part.size(); done < size;) {
    control.check();
    const std::vector<std::byte> chunk = fetch(package, blob, done, std::min(chunk_bytes, size - done));
    if (chunk.empty() || chunk.size() > size - done) {
      throw BlobUnavailable(fmt::format("blob {}: a chunk of {} bytes came at byte {} of {}", blob.hex(),
                                        chunk.size(), done, size));
    }
    part.write(chunk, done);
    done += chunk.size();
  }
  std::vector<std::byte> bytes = read_file(cache.dir() / (blob.hex() + ".part"), size);
  if (content_hash(bytes) != blob) {
    part.remove();
    throw BlobUnavailable(fmt::format("blob {}: what arrived has another hash", blob.hex()));
  }
  try {
    cache.put(blob, bytes);
  } catch (const Error& e) {
    throw BlobUnavailable(e.what());
  }
  part.remove();
  return bytes;
}

}  // namespace ssphh::farm
