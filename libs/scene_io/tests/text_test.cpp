#include <gtest/gtest.h>

#include <ssphh/core/error.h>

#include "printable.h"
#include "text_lines.h"
#include "uri.h"

namespace ssphh::scene_io {
namespace {

std::string text(const std::vector<std::byte>& bytes) {
  return {reinterpret_cast<const char*>(bytes.data()), bytes.size()};
}

TEST(Uri, Base64VectorsOfRfc4648) {
  const auto decoded = [](const std::string& base64) {
    return text(decode_data_uri("data:application/octet-stream;base64," + base64, "here").value());
  };
  EXPECT_EQ(decoded(""), "");
  EXPECT_EQ(decoded("Zg=="), "f");
  EXPECT_EQ(decoded("Zm8="), "fo");
  EXPECT_EQ(decoded("Zm9v"), "foo");
  EXPECT_EQ(decoded("Zm9vYmFy"), "foobar");
  EXPECT_EQ(decoded("Zm9vYg"), "foob") << "without padding";
  EXPECT_THROW(decoded("Z"), Error);
  EXPECT_THROW(decoded("Zm9*"), Error);
}

TEST(Uri, TextDataIsPercentDecoded) {
  EXPECT_EQ(text(decode_data_uri("data:,a%20b%2", "here").value()), "a b%2");
  EXPECT_FALSE(decode_data_uri("file.bin", "here").has_value());
}

TEST(Uri, RelativeNamesStandBesideTheFile) {
  EXPECT_EQ(resolve_uri("tex/a%20b.png", "/scenes/s.gltf", "here"), "/scenes/tex/a b.png");
  EXPECT_EQ(resolve_uri("../b.bin", "/scenes/s.gltf", "here"), "/scenes/../b.bin");
  EXPECT_THROW(resolve_uri("http://example.org/b.bin", "s.gltf", "here"), Error);
  EXPECT_THROW(resolve_uri("file:b.bin", "s.gltf", "here"), Error);
  EXPECT_THROW(resolve_uri("/etc/passwd", "s.gltf", "here"), Error);
  EXPECT_THROW(resolve_uri("%2Fetc/passwd", "s.gltf", "here"), Error);
  EXPECT_THROW(resolve_uri("a%00b", "s.gltf", "here"), Error);
  EXPECT_THROW(resolve_uri("", "s.gltf", "here"), Error);
}

TEST(Printable, KeepsUtf8AndReadsOtherBytesAsLatin1) {
  EXPECT_EQ(printable("Tür"), "Tür");
  EXPECT_EQ(printable("T\xfcr"), "Tür");
  EXPECT_EQ(printable("a\nb\x7f"), "a?b?");
  EXPECT_EQ(printable("\xed\xa0\x80"), "\xc3\xad\xc2\xa0\xc2\x80") << "a surrogate is no UTF-8";
  EXPECT_EQ(printable("äöü", 3), "äö") << "characters stay whole";
}

TEST(TextLines, NumbersCountTheLinesOfTheFile) {
  TextLines lines("a\n\n# comment\nb \\\nc\nd");
  ASSERT_TRUE(lines.next());
  EXPECT_EQ(lines.number(), 1u);
  ASSERT_TRUE(lines.next());
  EXPECT_EQ(lines.line(), "b  c");
  EXPECT_EQ(lines.number(), 5u);
  ASSERT_TRUE(lines.next());
  EXPECT_EQ(lines.line(), "d");
  EXPECT_FALSE(lines.next());
}

TEST(TextLines, NumbersAreWholeWords) {
  EXPECT_EQ(parse_float("+1.5e1"), 15.0f);
  EXPECT_EQ(parse_float("1e-60"), 0.0f) << "too small for a float";
  EXPECT_FALSE(parse_float("1e60").has_value());
  EXPECT_FALSE(parse_float("1.5x").has_value());
  EXPECT_FALSE(parse_float("").has_value());
  EXPECT_EQ(parse_integer("-7"), -7);
  EXPECT_FALSE(parse_integer("7.0").has_value());
}

}  // namespace
}  // namespace ssphh::scene_io
