/// Photometric files: hand-made ones against what they say, broken ones, and there and back.

#include <filesystem>

#include <fmt/format.h>
#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <ssphh/core/file.h>
#include <ssphh/scene_io/ies.h>

#include "error_message.h"
#include "temp_dir.h"

namespace ssphh::scene_io {
namespace {

using scene::PhotometricTable;
using scene::Photometry;
using test::message_of;

/// `numbers`: all after "multiplier".
std::string file(const std::string& numbers,
                 const std::string& head = "IESNA:LM-63-2002\n[TEST] hand\nTILT=NONE\n",
                 const std::string& multiplier = "1") {
  return head + "1 1000 " + multiplier + " " + numbers;
}
PhotometricTable read(const std::string& text) {
  return ies_from_text(text, "f.ies");
}
std::string said(const std::string& text) {
  return message_of([&] { read(text); });
}

using Floats = std::vector<float>;

TEST(Ies, ReadsAnglesAndIntensitiesTimesAllFactors) {
  const auto table = read(
      file("3 1 1 2 0 0 0\n0.5 2 100\n0 45 90\n0\n100 50 0\n", "IESNA91\n[TEST] hand\nTILT=NONE\r\n", "3"));
  EXPECT_EQ(table.type, Photometry::c);
  EXPECT_EQ(table.polar, (Floats{0, 45, 90}));
  EXPECT_EQ(table.turn, (Floats{0}));
  EXPECT_EQ(table.candela, (Floats{300, 150, 0}));
}

// 1986 has no first line; numbers break anywhere, and commas part them, too.
TEST(Ies, ReadsEveryEditionAndLayout) {
  const std::string numbers = "2,1,1\n2 0 0 0 1 1 0 0\n180 0 7\n\n 5 \n";
  for (const char* head : {"A lamp of 1986\nTILT=NONE\n", "IESNA:LM-63-1995\nTILT = NONE \n",
                           "IES:LM-63-2019\n[ISSUEDATE] today\nTILT=other.tlt\n",
                           "IESNA:LM-63-2002\nTILT=INCLUDE\n1\n3\n0 45 90\n1 0.9 0.8\n"}) {
    EXPECT_EQ(read(file(numbers, head)).candela, (Floats{7, 5})) << head;
  }
  EXPECT_EQ(read(file(numbers + "\x1a")).candela, (Floats{7, 5})) << "the end mark of old systems";
}

TEST(Ies, FillsInWhatSymmetryLeavesOut) {
  const auto turns = [](const std::string& horizontals, int count, const std::string& values) {
    return read(file(fmt::format("2 {} 1 2 0 0 0 1 1 0\n0 90\n{}\n{}", count, horizontals, values)));
  };
  // Of each column, the value at 90 degrees
  const auto sides = [](const PhotometricTable& table) {
    Floats out;
    for (std::size_t i = 1; i < table.candela.size(); i += 2) out.push_back(table.candela[i]);
    return out;
  };
  const auto quadrant = turns("0 30 90", 3, "9 1 9 2 9 3");
  EXPECT_EQ(quadrant.turn, (Floats{0, 30, 90, 150, 180, 210, 270, 330, 360}));
  EXPECT_EQ(sides(quadrant), (Floats{1, 2, 3, 2, 1, 2, 3, 2, 1}));
  const auto half = turns("0 60 180", 3, "9 1 9 2 9 3");
  EXPECT_EQ(half.turn, (Floats{0, 60, 180, 300, 360}));
  EXPECT_EQ(sides(half), (Floats{1, 2, 3, 2, 1}));
  const auto other_half = turns("90 150 180 270", 4, "9 1 9 2 9 3 9 4");
  EXPECT_EQ(other_half.turn, (Floats{0, 30, 90, 150, 180, 270, 360}));
  EXPECT_EQ(sides(other_half), (Floats{3, 2, 1, 2, 3, 4, 3}));
  const auto whole = turns("0 120 240 360", 4, "9 1 9 2 9 3 9 1");
  EXPECT_EQ(whole.turn, (Floats{0, 120, 240, 360}));
  const auto open = turns("0 120 240", 3, "9 1 9 2 9 3");
  EXPECT_EQ(open.turn, (Floats{0, 120, 240, 360})) << "the way back to 0 is there";
  EXPECT_EQ(sides(open), (Floats{1, 2, 3, 1}));
}

// B: 3 vertical by 2 horizontal angles, the left side as the right one; A the same with all angles.
TEST(Ies, ReadsTypesBAndA) {
  const auto b = read(file("3 2 2 2 0 0 0 1 1 0\n-30 0 60\n0 45\n1 2 3 4 5 6"));
  EXPECT_EQ(b.type, Photometry::b);
  EXPECT_EQ(b.polar, (Floats{45, 90, 135}));
  EXPECT_EQ(b.turn, (Floats{-30, 0, 60}));
  EXPECT_EQ(b.candela, (Floats{4, 1, 4, 5, 2, 5, 6, 3, 6}));
  const auto a = read(file("3 2 3 2 0 0 0 1 1 0\n-30 0 60\n-20 45\n1 2 3 4 5 6"));
  EXPECT_EQ(a.type, Photometry::a);
  EXPECT_EQ(a.polar, (Floats{60, 90, 150}));
  EXPECT_EQ(a.turn, (Floats{-20, 45}));
  EXPECT_EQ(a.candela, (Floats{1, 2, 3, 4, 5, 6}));
}

TEST(Ies, SaysWhatIsWrongAndInWhichLine) {
  const std::string hint = " (photometric files of IES LM-63 have one before their numbers)";
  EXPECT_EQ(said(""), "f.ies: is empty" + hint);
  EXPECT_EQ(said("{\"scene\": 1}\n"), "f.ies: has no line that begins with TILT=" + hint);
  EXPECT_EQ(said("IESNA91\nTILT=NONE\n"), "f.ies:3: the file ends where the number of lamps should be");
  EXPECT_EQ(said(file("2 1 1 2 0 0 0 1 1 0\n0 x 1 2")), "f.ies:5: \"x\" is not a vertical angle");
  EXPECT_EQ(said(file("2 1 1 2 0 0 0 1 1 0\n0 90 0 1 nan")), "f.ies:5: \"nan\" is not an intensity");
  EXPECT_EQ(said(file("2 1 1 2 0 0 0 1 1 0\n0 90 0 1 inf")), "f.ies:5: \"inf\" is not an intensity");
  EXPECT_EQ(said(file("2 1 1 2 0 0 0 1 1 0\n0 90 0 1 -2")), "f.ies: its profile has an intensity of -2 cd");
  EXPECT_EQ(said(file("2 1 1 2 0 0 0 1 1 0\n0 90 0 0 0")), "f.ies: its profile is dark in every direction");
  EXPECT_EQ(said(file("2 1 1 2 0 0 0 1 1 0\n0 90 0 1 2 3")),
            "f.ies:5: numbers follow the 2 by 1 intensities (the numbers of angles do not suit the table)");
  EXPECT_EQ(said(file("1 1 1 2 0 0 0 1 1 0\n0 0 1")),
            "f.ies:4: the number of vertical angles is 1, it must be a whole number from 2 to 262144");
  EXPECT_EQ(said(file("2 0 1 2 0 0 0 1 1 0\n0 90")),
            "f.ies:4: the number of horizontal angles is 0, it must be a whole number from 1 to 262144");
  EXPECT_EQ(said(file("2.5 1 1 2 0 0 0 1 1 0\n0 90")),
            "f.ies:4: the number of vertical angles is 2.5, it must be a whole number from 2 to 262144");
  EXPECT_EQ(said(file("1000 1000 1 2 0 0 0 1 1 0\n")),
            "f.ies:4: 1000 by 1000 angles are too many (262144 intensities are the most)");
  EXPECT_EQ(said(file("200000 1 1 2 0 0 0 1 1 0\n0 90")),
            "f.ies:4: the file is too short for 200000 of a vertical angle");
  EXPECT_EQ(said(file("2 1 4 2 0 0 0 1 1 0\n0 90 0 1 1")),
            "f.ies:4: the photometric type is 4, it must be a whole number from 1 to 3");
  EXPECT_EQ(said(file("2 1 1 2 0 0 0 1 1 0\n0 90 0 1 1", "TILT=NONE\n", "-1")),
            "f.ies:2: its multiplier times its ballast factors is -1 (it must be above 0)");
  EXPECT_EQ(said(file("2 1 1 2 0 0 0 1 1 0\n90 0 0 1 1")),
            "f.ies:5: vertical angles do not rise: 0 follows 90");
  EXPECT_EQ(said(file("2 1 1 2 0 0 0 1 1 0\n-10 90 0 1 1")),
            "f.ies:5: a vertical angle is -10, it must be from 0 to 180 degrees");
  EXPECT_EQ(said(file("2 2 1 2 0 0 0 1 1 0\n0 90 0 100 1 1 1 1")),
            "f.ies:5: horizontal angles of type C go from 0 to 100 degrees (they go from 0 to 0, 90, 180 or "
            "360, or "
            "from 90 to 270)");
  EXPECT_EQ(said(file("2 2 1 2 0 0 0 1 1 0\n0 90 90 270 1 1 1 1")),
            "f.ies:5: horizontal angles from 90 to 270 degrees have no 180 among them");
  EXPECT_EQ(said(file("2 1 2 2 0 0 0 1 1 0\n0 90 0 1 1")),
            "f.ies:5: photometry of type A or B has one horizontal angle (at least 2 are needed)");
  EXPECT_EQ(said(file("2 1 1 2 0 0 0 1 1 0\n0 90 0 1e38 1", "TILT=NONE\n", "1e10")),
            "f.ies: its profile has an intensity of inf cd");
}

TEST(Ies, CutOffAnywhereIsAnErrorAndNothingElse) {
  const std::string whole = file("3 2 1 2 0 0 0\n1 1 0\n0 45 90\n0 90\n10 20 30\n40 50 60\n");
  EXPECT_EQ(said(whole), "no error");
  for (std::size_t size = 0; size + 3 < whole.size(); ++size)
    EXPECT_NE(said(whole.substr(0, size)), "no error") << size;
}

TEST(Ies, WritesWhatItReads) {
  const std::string thirds = "0.333333 1.1 2.7182818 3e-20 123456.7 8";
  const std::vector<std::string> all = {"3 2 1 2 0 0 0 0.7 1 0\n0 33.3333 90.1\n0 90\n" + thirds,
                                        "3 1 1 2 0 0 0 1 1 0\n0 33.3333 180\n0\n0.1 0.2 0.3",
                                        "3 2 2 2 0 0 0 1 1 0\n-90 0.1 77.7\n0 33.3\n" + thirds,
                                        "3 2 3 2 0 0 0 1 1 0\n-90 0.1 77.7\n-12.3 33.3\n" + thirds};
  for (const std::string& numbers : all) {
    const PhotometricTable once = read(file(numbers));
    const auto profile = std::make_shared<const PhotometricTable>(once);
    const std::string text = ies_to_text({"a \"name\"\nof two lines", profile});
    const PhotometricTable again = read(text);
    EXPECT_EQ(again, once) << text;
    EXPECT_NE(text.find("[LUMINAIRE] a \"name\" of two lines\n"), text.npos);
  }
}

TEST(Ies, TakesFilesOfSixteenMebibytesAndNoMore) {
  const test::TempDir folder;
  const std::string path = folder / "long.ies";
  write_file(path, file("2 1 1 2 0 0 0 1 1 0\n0 90 0 1 1"));
  const auto said_of = [&](std::uintmax_t size) {
    std::filesystem::resize_file(path, size);
    return message_of([&] { read_ies(path); });
  };
  EXPECT_EQ(said_of(16777217), path + ": is too large: 16777217 bytes, the limit is 16777216");
  EXPECT_THAT(said_of(16777216), testing::Not(testing::HasSubstr("too large")))
      << "that is not what is wrong";
}

TEST(Ies, IsNamedAsItsFile) {
  const test::TempDir folder;
  write_file(folder / "spot.ies", file("2 1 1 2 0 0 0 1 1 0\n0 90 0 1 1"));
  EXPECT_EQ(read_ies(folder / "spot.ies").name, "spot.ies");
  EXPECT_NE(message_of([&] { read_ies(folder / "none.ies"); }), "no error");
}

}  // namespace
}  // namespace ssphh::scene_io
