#include <fmt/format.h>
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

/// By the definition of UTF-8: as many bytes as the first one's leading ones, the shortest that the number
/// needs, no surrogate, nothing beyond 10FFFF.
bool utf8_by_definition(const std::string& text) {
  for (std::size_t i = 0; i < text.size();) {
    const auto first = static_cast<unsigned char>(text[i++]);
    int more = 0;
    while (more < 7 && (first << more & 0x80) != 0) ++more;
    if (more == 1 || more > 4) return false;
    std::uint32_t number = more == 0 ? first : first & (0x7fu >> more);
    for (int k = 1; k < more; ++k) {
      if (i == text.size() || (static_cast<unsigned char>(text[i]) & 0xc0) != 0x80) return false;
      number = number << 6 | (static_cast<unsigned char>(text[i++]) & 0x3fu);
    }
    const std::uint32_t least[] = {0, 0, 0x80, 0x800, 0x10000};
    if (number < least[more] || number > 0x10ffff || (number >= 0xd800 && number < 0xe000)) return false;
  }
  return true;
}

TEST(Printable, TellsUtf8FromLatin1AsItIsDefined) {
  const std::string edges =
      "A\x1f\x20\x7e\x7f\x80\x8f\x90\x9f\xa0\xbf\xc0\xc1\xc2\xdf\xe0\xe1\xec\xed\xee\xef\xf0\xf1\xf3\xf4\xf5"
      "\xf8\xff";
  const auto check = [](const std::string& bytes) {
    std::string expected;
    const bool utf8 = utf8_by_definition(bytes);
    for (const char c : bytes) {
      const auto code = static_cast<unsigned char>(c);
      if (code < 0x20 || code == 0x7f)
        expected += '?';
      else if (utf8 || code < 0x80)
        expected += c;
      else
        expected += {static_cast<char>(0xc0 | code >> 6), static_cast<char>(0x80 | (code & 0x3f))};
    }
    ASSERT_EQ(printable(bytes), expected)
        << testing::PrintToString(std::vector<int>(bytes.begin(), bytes.end()));
  };
  for (const char a : edges) {
    check({a});
    for (const char b : edges) {
      check({a, b});
      for (const char c : edges) {
        check({a, b, c});
        if (static_cast<unsigned char>(a) < 0xf0) continue;
        for (const char d : {'A', '\x80', '\xbf', '\xc0'}) check({a, b, c, d});
      }
    }
  }
  EXPECT_EQ(printable(std::string(300, 'x')).size(), 200u);
}

TEST(Uri, EveryEscapeIsTheByteItNames) {
  for (int byte = 0; byte < 256; ++byte) {
    for (const char* format : {"data:,a%{:02x}b", "data:,a%{:02X}b"}) {
      const std::string decoded =
          text(decode_data_uri(fmt::format(fmt::runtime(format), byte), "here").value());
      EXPECT_EQ(decoded, (std::string{'a', static_cast<char>(byte), 'b'})) << byte;
    }
  }
  for (const char* other : {"%", "%4", "%g1", "%1g", "%/0", "%:0", "%@0", "%`0", "%G0", "a%"})
    EXPECT_EQ(text(decode_data_uri(std::string("data:,") + other, "here").value()), other);
}

TEST(Uri, AllBytesGoThroughBase64) {
  // 0, 1, 2 … 255 as `base64` writes them, and the digits 62 and 63.
  std::string all;
  for (int i = 0; i < 256; ++i) all += static_cast<char>(i);
  const std::string digits = "ABCDEFGHIJKLMNOPQRSTUVWXYZabcdefghijklmnopqrstuvwxyz0123456789+/";
  std::string encoded;
  for (std::size_t bit = 0; bit < 8 * all.size(); bit += 6) {
    int digit = 0;
    for (std::size_t k = bit; k < bit + 6; ++k)
      digit =
          2 * digit + (k < 8 * all.size() ? static_cast<unsigned char>(all[k / 8]) >> (7 - k % 8) & 1 : 0);
    encoded += digits[digit];
  }
  EXPECT_EQ(text(decode_data_uri("data:;base64," + encoded, "here").value()), all);
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
