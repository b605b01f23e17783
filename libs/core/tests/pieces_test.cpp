/// Files on a system that reads and writes in pieces, is interrupted by signals, and fails late.

#include <algorithm>
#include <cerrno>
#include <optional>

#include <gtest/gtest.h>
#include <sys/syscall.h>
#include <unistd.h>

#include <ssphh/core/file.h>

#include "error_message.h"
#include "memory_dir.h"
#include "temp_dir.h"

namespace {

/// What the calls below do, of this thread alone.
struct Calls {
  std::optional<std::size_t> piece;  ///< the most bytes that one takes
  int interrupted = 0;               ///< so many end with EINTR before one does anything
  int sync_error = 0;
};
thread_local Calls calls;

template <class Call>
ssize_t in_pieces(std::size_t size, const Call& call) {
  if (calls.interrupted > 0) {
    --calls.interrupted;
    errno = EINTR;
    return -1;
  }
  return call(calls.piece ? std::min(size, *calls.piece) : size);
}

}  // namespace

// In place of the C library's, for all of this program.
extern "C" ssize_t read(int file, void* data, size_t size) {
  return in_pieces(size, [&](size_t n) { return ::syscall(SYS_read, file, data, n); });
}
extern "C" ssize_t write(int file, const void* data, size_t size) {
  return in_pieces(size, [&](size_t n) { return ::syscall(SYS_write, file, data, n); });
}
extern "C" int fsync(int file) {
  errno = calls.sync_error;
  return calls.sync_error != 0 ? -1 : static_cast<int>(::syscall(SYS_fsync, file));
}

namespace ssphh {
namespace {

using test::message_of;

class Pieces : public testing::Test {
 protected:
  Pieces() {
    for (int i = 0; i < 1000; ++i) text_ += static_cast<char>('a' + i % 26);
    write_file(file_, text_);
  }
  ~Pieces() override { calls = {}; }

  const test::TempDir dir_{test::memory_dir()};
  const std::filesystem::path file_ = dir_ / "file";
  std::string text_;
};

TEST_F(Pieces, AFileIsReadToItsEnd) {
  calls = {.piece = 7, .interrupted = 2};
  EXPECT_EQ(read_text_file(file_), text_);
  EXPECT_EQ(calls.interrupted, 0) << "the calls above were asked";
}

TEST_F(Pieces, AFileIsWrittenToItsEnd) {
  calls = {.piece = 7, .interrupted = 2};
  write_file(dir_ / "other", text_);
  EXPECT_EQ(calls.interrupted, 0) << "the calls above were asked";
  calls = {};
  EXPECT_EQ(read_text_file(dir_ / "other"), text_);
}

TEST_F(Pieces, WhereNothingComesOrGoesItEnds) {
  calls.piece = 0;
  EXPECT_EQ(message_of([&] { read_text_file(file_); }),
            file_.string() + ": became shorter while it was read");
  EXPECT_EQ(message_of([&] { write_file(file_, "new"); }),
            file_.string() + ": cannot write: No space left on device");
  calls = {};
  EXPECT_EQ(read_text_file(file_), text_);
}

TEST_F(Pieces, WhatTheDiskDidNotTakeIsNotKept) {
  calls.sync_error = EIO;
  EXPECT_EQ(message_of([&] { write_file(file_, "new"); }),
            file_.string() + ": cannot write: Input/output error");
  calls = {};
  EXPECT_EQ(read_text_file(file_), text_);
  EXPECT_EQ(std::distance(std::filesystem::directory_iterator(dir_.path()), {}), 1) << "nothing is left over";
}

}  // namespace
}  // namespace ssphh
