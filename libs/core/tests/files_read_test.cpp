#include <fstream>

#include <gmock/gmock.h>

#include <ssphh/core/error.h>
#include <ssphh/core/file.h>
#include <ssphh/core/files_read.h>
#include <ssphh/core/parallel.h>

#include "temp_dir.h"

namespace ssphh {
namespace {

using testing::ElementsAre;
using testing::IsEmpty;

class ReadFiles : public testing::Test {
 protected:
  std::filesystem::path file(const std::string& name, const std::string& text) const {
    const std::filesystem::path path = dir_ / name;
    std::ofstream(path) << text;
    return path;
  }

  const test::TempDir dir_;
};

TEST_F(ReadFiles, AreNotedOnceAlsoWhereTheyAreMissing) {
  const auto a = file("a", "1"), b = file("b", "22");
  const std::filesystem::path missing = dir_ / "c";
  read_file(a);
  const FilesRead notes;
  EXPECT_THAT(notes.stamps(), IsEmpty()) << "before it lived";
  read_file(b), read_text_file(a), read_file(b);
  EXPECT_THROW(read_file(missing), Error);
  EXPECT_THAT(notes.stamps(), ElementsAre(stamp_of(a), stamp_of(b), stamp_of(missing)));
  EXPECT_FALSE(notes.stamps()[2].exists);
  EXPECT_EQ(notes.stamps()[1].size, 2u);
}

TEST_F(ReadFiles, AreNotedFromAllThreads) {
  std::vector<std::filesystem::path> files;
  for (int i = 0; i < 40; ++i) files.push_back(file(std::to_string(i), "x"));
  const FilesRead notes;
  parallel_for(files.size(), 1, [&](std::size_t i) { read_file(files[i]); });
  EXPECT_EQ(notes.stamps().size(), files.size());
}

TEST_F(ReadFiles, KeepTheStampOfTheirFirstReading) {
  const auto a = file("a", "1");
  const FilesRead notes;
  read_file(a);
  const FileStamp before = stamp_of(a);
  file("a", "longer"), read_file(a);
  EXPECT_THAT(notes.stamps(), ElementsAre(before)) << "what came of the first reading is older than the file";
  EXPECT_NE(stamp_of(a), before);
}

TEST_F(ReadFiles, AreNotedByOneAtATime) {
  {
    const FilesRead notes;
    EXPECT_THROW(FilesRead(), Error);
    read_file(file("a", "1"));
    EXPECT_EQ(notes.stamps().size(), 1u) << "the one before goes on";
  }
  EXPECT_THAT(FilesRead().stamps(), IsEmpty());
}

TEST_F(ReadFiles, AStampTellsTimeSizeAndAbsence) {
  const auto a = file("a", "1");
  const FileStamp stamp = stamp_of(a);
  EXPECT_EQ(stamp_of(a), stamp);
  std::filesystem::last_write_time(a, stamp.time + std::chrono::seconds(1));
  EXPECT_NE(stamp_of(a), stamp) << "time";
  file("a", "12");
  std::filesystem::last_write_time(a, stamp.time);
  EXPECT_NE(stamp_of(a), stamp) << "size";
  std::filesystem::remove(a);
  EXPECT_EQ(stamp_of(a), FileStamp{a});
}

}  // namespace
}  // namespace ssphh
