#include <limits>

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <ssphh/core/bytes.h>

#include "error_message.h"

namespace ssphh {
namespace {

using test::message_of;
using testing::HasSubstr;

ByteReader reader(const ByteWriter& writer) {
  return {writer.bytes(), "file"};
}

TEST(Bytes, AreReadAsTheyWereWritten) {
  ByteWriter writer;
  writer.value<std::uint16_t>(0x1234);
  writer.vector3({1, -2, 0.5f});
  writer.text("three");
  writer.array(std::span<const std::uint32_t>(std::array{7u, 8u}));
  EXPECT_EQ(writer.bytes()[0], std::byte{0x34}) << "little-endian";
  EXPECT_EQ(writer.bytes().size(), 2u + 12 + 4 + 5 + 8);
  ByteReader in = reader(writer);
  EXPECT_EQ(in.value<std::uint16_t>("number"), 0x1234);
  EXPECT_EQ(in.vector3("vector"), vec3(1, -2, 0.5f));
  EXPECT_EQ(in.text("text", 5), "three");
  EXPECT_EQ(in.left(), 8u);
  EXPECT_THAT(message_of([&] { in.expect_end(); }), HasSubstr("file at byte 23: end has 8 bytes too many"));
  std::array<std::uint32_t, 2> array{};
  in.raw("array", std::span<std::uint32_t>(array));
  EXPECT_EQ(array, (std::array{7u, 8u}));
  in.expect_end();
}

TEST(Bytes, AreCutOffBeforeTheLastOne) {
  ByteWriter writer;
  writer.value<std::uint8_t>(1);
  writer.value<std::uint16_t>(2);
  ByteReader in = reader(writer);
  in.value<std::uint8_t>("first");
  EXPECT_THAT(message_of([&] { in.view("three", 3); }), HasSubstr("file at byte 1: three is cut off"));
  EXPECT_EQ(in.view("two", 2).size(), 2u);
}

TEST(Bytes, OfATextAreBounded) {
  ByteWriter writer;
  writer.text("12345");
  EXPECT_THAT(message_of([&] { reader(writer).text("name", 4); }), HasSubstr("name is too long"));
  EXPECT_EQ(reader(writer).text("name", 5), "12345");
}

TEST(Bytes, CountIsOfThingsThatFitInWhatIsLeft) {
  ByteWriter writer;
  writer.value<std::uint32_t>(3);
  writer.array(std::span<const char>("123456", 6));
  EXPECT_EQ(reader(writer).count("things", 3, 2), 3u);
  EXPECT_THAT(message_of([&] { reader(writer).count("things", 2, 2); }),
              HasSubstr("things is over the limit of 2"));
  EXPECT_THAT(message_of([&] { reader(writer).count("things", 3, 3); }),
              HasSubstr("needs more bytes than the file has"));
}

TEST(Bytes, NumberInARangeIncludesItsEnds) {
  const float nan = std::numeric_limits<float>::quiet_NaN();
  for (const auto& [value, good] :
       {std::pair(1.0f, true), {2.0f, true}, {0.999f, false}, {2.001f, false}, {nan, false}}) {
    ByteWriter writer;
    writer.value(value);
    const std::string told = message_of([&] { reader(writer).value_in("number", 1.0f, 2.0f); });
    EXPECT_EQ(told == "no error", good) << value << told;
  }
}

TEST(Bytes, OfVectorsAreFiniteInEveryComponent) {
  const float infinite = std::numeric_limits<float>::infinity();
  for (const vec3& bad : {vec3(infinite, 0, 0), vec3(0, -infinite, 0), vec3(0, 0, infinite)}) {
    ByteWriter writer;
    writer.vector3({1, 2, 3});
    writer.vector3(bad);
    std::array<vec3, 2> two;
    EXPECT_THAT(message_of([&] { reader(writer).array("vectors", two); }), HasSubstr("not finite"));
  }
}

}  // namespace
}  // namespace ssphh
