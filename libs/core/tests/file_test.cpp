#include <csignal>

#include <gmock/gmock.h>
#include <gtest/gtest.h>
#include <sys/resource.h>

#include <ssphh/core/error.h>
#include <ssphh/core/file.h>

#include "temp_dir.h"

namespace ssphh {
namespace {

using testing::HasSubstr;

std::string failure(const std::function<void()>& action) {
  try {
    action();
  } catch (const Error& e) {
    return e.what();
  }
  return "no error";
}

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
  EXPECT_THAT(failure([&] { read_file(dir / "none"); }), HasSubstr("none: cannot open: No such file"));
  EXPECT_THAT(failure([&] { read_file(dir.path()); }), HasSubstr("Is a directory"));
  EXPECT_THAT(failure([&] { read_file(dir / "five", 4); }), HasSubstr("too large: 5 bytes, the limit is 4"));
  EXPECT_THAT(failure([&] { write_file(dir / "no/such/file", "x"); }),
              HasSubstr("cannot write: No such file"));
  EXPECT_THAT(failure([&] { write_file(dir.path(), "x"); }), HasSubstr("Is a directory"));
}

TEST(File, FullDeviceIsAnError) {
  EXPECT_THAT(failure([] { write_file("/dev/full", "x"); }), HasSubstr("No space left on device"));
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
  const std::string message = failure([&] { write_file(dir / "kept", std::string(1 << 20, 'x')); });
  ASSERT_EQ(setrlimit(RLIMIT_FSIZE, &old), 0);
  EXPECT_THAT(message, HasSubstr("cannot write"));
  EXPECT_EQ(read_text_file(dir / "kept"), "precious");
  EXPECT_EQ(file_count(dir.path()), 1);
}

}  // namespace
}  // namespace ssphh
