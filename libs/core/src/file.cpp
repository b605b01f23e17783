#include <cerrno>
#include <cstring>
#include <random>

#include <fcntl.h>
#include <fmt/format.h>
#include <sys/stat.h>
#include <unistd.h>

#include <ssphh/core/error.h>
#include <ssphh/core/file.h>

#include "note_file_read.h"

namespace ssphh {
namespace {

[[noreturn]] void fail(const std::filesystem::path& path, const char* action, int error) {
  throw Error(path.string(), fmt::format("cannot {}: {}", action, std::strerror(error)));
}

class Descriptor {
 public:
  explicit Descriptor(int fd) : fd_(fd) {}
  ~Descriptor() {
    if (fd_ >= 0) ::close(fd_);
  }
  Descriptor(const Descriptor&) = delete;
  Descriptor& operator=(const Descriptor&) = delete;
  int get() const { return fd_; }
  int close() {
    const int result = ::close(fd_);
    fd_ = -1;
    return result;
  }

 private:
  int fd_;
};

template <class Container>
Container read_whole(const std::filesystem::path& path, std::uint64_t limit) {
  note_file_read(path);
  Descriptor file(::open(path.c_str(), O_RDONLY | O_CLOEXEC));
  if (file.get() < 0) fail(path, "open", errno);
  struct stat status {};
  if (::fstat(file.get(), &status) != 0) fail(path, "read", errno);
  if (S_ISDIR(status.st_mode)) fail(path, "read", EISDIR);
  if (!S_ISREG(status.st_mode)) throw Error(path.string(), "is not a regular file");
  const auto size = static_cast<std::uint64_t>(status.st_size);
  if (size > limit) {
    throw Error(path.string(), fmt::format("is too large: {} bytes, the limit is {}", size, limit));
  }
  Container data(size, {});
  std::uint64_t done = 0;
  while (done < size) {
    const ssize_t got = ::read(file.get(), data.data() + done, size - done);
    if (got < 0 && errno == EINTR) continue;
    if (got < 0) fail(path, "read", errno);
    if (got == 0) throw Error(path.string(), "became shorter while it was read");
    done += static_cast<std::uint64_t>(got);
  }
  return data;
}

// Returns 0 or the system's error number.
int write_all(int fd, std::span<const std::byte> data) {
  std::size_t done = 0;
  while (done < data.size()) {
    const ssize_t put = ::write(fd, data.data() + done, data.size() - done);
    if (put < 0 && errno == EINTR) continue;
    if (put <= 0) return put < 0 ? errno : ENOSPC;
    done += static_cast<std::size_t>(put);
  }
  return 0;
}

// Opens a new file whose name nobody else has; -1 and errno when it cannot be. mkostemps would make it
// private, and its umask-ed mode could only be found by setting the umask, which all threads share.
int open_beside(const std::filesystem::path& path, unsigned permissions, std::string& name) {
  std::random_device random;
  int fd = -1;
  do {
    name = fmt::format("{}.{:08x}.part", path.string(), random());
    fd = ::open(name.c_str(), O_WRONLY | O_CREAT | O_EXCL | O_CLOEXEC, static_cast<mode_t>(permissions));
  } while (fd < 0 && errno == EEXIST);
  return fd;
}

}  // namespace

std::vector<std::byte> read_file(const std::filesystem::path& path, std::uint64_t limit) {
  return read_whole<std::vector<std::byte>>(path, limit);
}

std::string read_text_file(const std::filesystem::path& path, std::uint64_t limit) {
  return read_whole<std::string>(path, limit);
}

void write_file(const std::filesystem::path& path, std::span<const std::byte> data, unsigned permissions) {
  // A device or pipe has no old content to keep and must not be replaced by a file.
  struct stat status {};
  if (::stat(path.c_str(), &status) == 0 && !S_ISREG(status.st_mode)) {
    Descriptor device(::open(path.c_str(), O_WRONLY | O_CLOEXEC));
    if (device.get() < 0) fail(path, "write", errno);
    if (const int error = write_all(device.get(), data)) fail(path, "write", error);
    return;
  }
  std::string temporary;
  Descriptor file(open_beside(path, permissions, temporary));
  if (file.get() < 0) fail(path, "write", errno);
  const auto abandon = [&](int error) {
    ::unlink(temporary.c_str());
    fail(path, "write", error);
  };
  if (const int error = write_all(file.get(), data)) abandon(error);
  if (::fsync(file.get()) != 0 || file.close() != 0) abandon(errno);
  if (::rename(temporary.c_str(), path.c_str()) != 0) abandon(errno);
}

void write_file(const std::filesystem::path& path, std::string_view text, unsigned permissions) {
  write_file(path, std::as_bytes(std::span(text.data(), text.size())), permissions);
}

}  // namespace ssphh
