#include <cerrno>
#include <csignal>
#include <thread>

#include <fcntl.h>
#include <fmt/format.h>
#include <gmock/gmock.h>
#include <gtest/gtest.h>
#include <sys/resource.h>
#include <sys/stat.h>
#include <unistd.h>

#include <ssphh/core/error.h>
#include <ssphh/core/file.h>

#include "error_message.h"
#include "memory_dir.h"
#include "temp_dir.h"

namespace ssphh {
namespace {

using test::message_of;
using testing::HasSubstr;

int file_count(const std::filesystem::path& folder) {
  int count = 0;
  for ([[maybe_unused]] const auto& entry : std::filesystem::directory_iterator(folder)) ++count;
  return count;
}

TEST(File, RoundTripsAndReplaces) {
  const test::TempDir dir;
  write_file(dir / "a", "old");
  write_file(dir / "a", "newer");
  EXPECT_EQ(read_text_file(dir / "a"), "newer");
  EXPECT_EQ(file_count(dir.path()), 1) << "temporary files left over";
}

TEST(File, MissingDirectoryTooLargeAndUnwritableAreErrorsThatNameTheFile) {
  const test::TempDir dir;
  write_file(dir / "five", "12345");
  EXPECT_THAT(message_of([&] { read_file(dir / "none"); }), HasSubstr("none: cannot open: No such file"));
  EXPECT_THAT(message_of([&] { read_file(dir.path()); }), HasSubstr("Is a directory"));
  EXPECT_THAT(message_of([&] { read_file(dir / "five", 4); }),
              HasSubstr("too large: 5 bytes, the limit is 4"));
  EXPECT_EQ(read_file(dir / "five", 5).size(), 5u) << "as long as the limit";
  // Files with nothing in them: their sizes alone are looked at.
  write_file(dir / "hollow", "");
  std::filesystem::resize_file(dir / "hollow", (std::uint64_t{256} << 20) + 1);
  EXPECT_THAT(message_of([&] { read_text_file(dir / "hollow"); }), HasSubstr("the limit is 268435456"));
  std::filesystem::resize_file(dir / "hollow", (std::uint64_t{4} << 30) + 1);
  EXPECT_THAT(message_of([&] { read_file(dir / "hollow"); }), HasSubstr("the limit is 4294967296"));
  EXPECT_THAT(message_of([] { read_file("/dev/null"); }), HasSubstr("/dev/null: is not a regular file"));
  EXPECT_THAT(message_of([&] { write_file(dir / "no/such/file", "x"); }),
              HasSubstr("cannot write: No such file"));
  EXPECT_THAT(message_of([&] { write_file(dir.path(), "x"); }), HasSubstr("Is a directory"));
}

TEST(File, FullDeviceIsAnError) {
  // A link: a write_file at fault that puts a file in its place does not harm the device.
  const test::TempDir dir;
  std::filesystem::create_symlink("/dev/full", dir / "full");
  EXPECT_THAT(message_of([&] { write_file(dir / "full", "x"); }), HasSubstr("No space left on device"));
}

TEST(File, AFailedWriteKeepsTheOldFileAndLeavesNothingBehind) {
  const test::TempDir dir;
  write_file(dir / "kept", "precious");
  // A file-size limit of the process stands in for a full disk.
  std::signal(SIGXFSZ, SIG_IGN);
  rlimit old{};
  ASSERT_EQ(getrlimit(RLIMIT_FSIZE, &old), 0);
  const rlimit small{4096, old.rlim_max};
  ASSERT_EQ(setrlimit(RLIMIT_FSIZE, &small), 0);
  const std::string message = message_of([&] { write_file(dir / "kept", std::string(1 << 20, 'x')); });
  ASSERT_EQ(setrlimit(RLIMIT_FSIZE, &old), 0);
  EXPECT_THAT(message, HasSubstr("cannot write"));
  EXPECT_EQ(read_text_file(dir / "kept"), "precious");
  EXPECT_EQ(file_count(dir.path()), 1);
}

unsigned permissions(const std::filesystem::path& path) {
  return static_cast<unsigned>(std::filesystem::status(path).permissions());
}

/// The umask of the process while a test runs.
class Umask {
 public:
  explicit Umask(mode_t mask) : before_(::umask(mask)) {}
  ~Umask() { ::umask(before_); }
  Umask(const Umask&) = delete;
  Umask& operator=(const Umask&) = delete;

 private:
  mode_t before_;
};

TEST(File, HasThePermissionsAskedForLessTheUmasks) {
  const test::TempDir dir;
  const Umask umask(027);
  write_file(dir / "open", "x");
  write_file(dir / "secret", "x", 0600);
  write_file(dir / "secret", "y", 0600);
  EXPECT_EQ(permissions(dir / "open"), 0640u);
  EXPECT_EQ(permissions(dir / "secret"), 0600u);
}

// The umask is the process's: a thread that sets it, and be it to read it, opens other threads' files to all.
TEST(File, WritingOpensNoFileOfAnotherThread) {
  // A disk's syncs would keep the threads apart.
  const test::TempDir dir(test::memory_dir());
  const Umask umask(027);
  constexpr int threads = 8, files = 2000;
  std::vector<std::thread> writers;
  for (int t = 0; t < threads; ++t)
    writers.emplace_back([&dir, t] {
      for (int i = 0; i < files; ++i) write_file(dir / fmt::format("{}-{}", t, i), "x");
    });
  for (std::thread& writer : writers) writer.join();
  int wrong = 0;
  for (const auto& entry : std::filesystem::directory_iterator(dir.path()))
    wrong += permissions(entry.path()) != 0640;
  EXPECT_EQ(wrong, 0);
  EXPECT_EQ(::umask(027), mode_t{027}) << "of the process, afterwards";
}

// A daemon may have closed its standard input: its next file is number 0, as good as any other.
TEST(File, ThatIsTheProcessesFirstIsOpenedOnce) {
  const test::TempDir dir;
  write_file(dir / "a", "old");
  const int input = ::dup(0);
  ASSERT_GE(input, 0);
  ::close(0);
  errno = EEXIST;  // of whatever came before
  write_file(dir / "a", "x");
  const int next = ::open("/dev/null", O_RDONLY | O_CLOEXEC);
  ::dup2(input, 0);
  ::close(input);
  EXPECT_EQ(next, 0) << "it was closed, too";
  EXPECT_EQ(read_text_file(dir / "a"), "x");
  EXPECT_EQ(file_count(dir.path()), 1);
}

}  // namespace
}  // namespace ssphh
