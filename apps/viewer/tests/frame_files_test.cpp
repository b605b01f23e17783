#include "model/frame_files.h"

#include <fstream>
#include <set>

#include <gmock/gmock.h>

#include "temp_dir.h"

namespace ssphh::viewer {
namespace {

TEST(FrameFiles, AreNumberedWithFourDigitsOrMore) {
  EXPECT_EQ(frame_name(0), "frame-0000.png");
  EXPECT_EQ(frame_name(123), "frame-0123.png");
  EXPECT_EQ(frame_name(12345), "frame-12345.png");
}

TEST(FrameFiles, OnlyFramesBeyondTheCountAreRemoved) {
  const test::TempDir dir;
  const std::set<std::string> stay = {
      "frame-0000.png",    "frame-0002.png",  "frame-3.png",           "frame-00004.png",
      "frame-.png",        "frame--005.png",  "frame-0006.PNG",        "frame-0007.png.old",
      "my-frame-0008.png", "frame-0009a.png", "frame-99999999999.png", "frame-0010"};
  for (const std::string& name : stay) std::ofstream(dir / name) << "x";
  for (const char* name : {"frame-0003.png", "frame-0417.png", "frame-12345.png"})
    std::ofstream(dir / name) << "x";
  std::filesystem::create_directory(dir / "frame-0005.png");
  EXPECT_EQ(remove_frames_from(dir.path(), 3), 3);
  std::set<std::string> left;
  for (const auto& entry : std::filesystem::directory_iterator(dir.path()))
    if (!entry.is_directory()) left.insert(entry.path().filename().string());
  EXPECT_EQ(left, stay);
  EXPECT_TRUE(std::filesystem::is_directory(dir / "frame-0005.png"));
  EXPECT_EQ(remove_frames_from(dir.path(), 3), 0);
}

}  // namespace
}  // namespace ssphh::viewer
