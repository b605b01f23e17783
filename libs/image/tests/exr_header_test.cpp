/// The first look at an OpenEXR file, at headers made byte by byte: each limit at its edge and one beyond.

#include "exr_header.h"

#include <gtest/gtest.h>

#include "error_message.h"

namespace ssphh::image {
namespace {

using ssphh::test::message_of;

std::string u32(std::int64_t value) {
  std::string text;
  for (int shift = 0; shift < 32; shift += 8) text += static_cast<char>(value >> shift & 255);
  return text;
}

std::string name(const std::string& text) {
  return text + '\0';
}

std::string attribute(const std::string& which, const std::string& data, const std::string& type = "type") {
  return name(which) + name(type) + u32(static_cast<std::int64_t>(data.size())) + data;
}

std::string window(std::int64_t x0, std::int64_t y0, std::int64_t x1, std::int64_t y1) {
  return u32(x0) + u32(y0) + u32(x1) + u32(y1);
}

std::string channel(const std::string& which, int type = 2, int x = 1, int y = 1) {
  return name(which) + u32(type) + u32(0) + u32(x) + u32(y);
}

/// A part of one kind of everything; an attribute that is given again counts.
std::string part(const std::string& more = "", const std::string& data = window(0, 0, 9, 4),
                 const std::string& channels = channel("Y")) {
  return attribute("dataWindow", data) + attribute("displayWindow", data) +
         attribute("channels", channels + '\0') + attribute("compression", std::string(1, '\0')) + more +
         '\0';
}

constexpr int tiled = 0x200, deep = 0x800, multipart = 0x1000;

struct Look {
  std::vector<ExrHeader> headers;
  std::string said;
};

/// `blocks` bytes follow the headers.
Look look_at(const std::string& parts, int flags = 0, std::size_t blocks = 1 << 12) {
  const std::string file = "\x76\x2f\x31\x01" + u32(2 | flags) + parts + std::string(blocks, '\0'), f = "f";
  const DecodeLimits limits{1 << 24, std::uint64_t{1} << 40};
  Look look;
  look.said = message_of([&] {
    look.headers = check_exr_headers({std::as_bytes(std::span(file)), f, limits});
  });
  return look;
}

/// What is said without its place.
std::string said_of_header(const std::string& parts, int flags = 0, std::size_t blocks = 1 << 12) {
  const std::string said = look_at(parts, flags, blocks).said;
  return said.substr(0, said.rfind(" (byte"));
}

const std::string broken = "f: broken OpenEXR header: ";

TEST(ExrHeaders, TellWhatTheFileAnnounces) {
  const std::string display = attribute("displayWindow", window(-3, -4, 20, 30));
  const Look look = look_at(part(display, window(-1, -2, 9, 7), channel("half", 1) + channel("B", 0, 2, 1)));
  ASSERT_EQ(look.said, "no error");
  ASSERT_EQ(look.headers.size(), 1u);
  const ExrHeader& header = look.headers[0];
  EXPECT_EQ(header.data.min_x, -1);
  EXPECT_EQ(header.data.min_y, -2);
  EXPECT_EQ(header.data.max_x, 9);
  EXPECT_EQ(header.data.max_y, 7);
  EXPECT_EQ(header.data.width(), 11);
  EXPECT_EQ(header.data.height(), 10);
  EXPECT_EQ(header.display.width(), 24);
  EXPECT_EQ(header.display.height(), 35);
  ASSERT_EQ(header.channels.size(), 2u);
  EXPECT_EQ(header.channels[0].name, "half");
  EXPECT_EQ(header.channels[1].name, "B");
  EXPECT_EQ(header.channels[0].bytes, 2);
  EXPECT_EQ(header.channels[1].bytes, 4);
  EXPECT_FALSE(header.channels[0].subsampled);
  EXPECT_TRUE(header.channels[1].subsampled);
  EXPECT_FALSE(header.tiled);
  EXPECT_FALSE(header.deep);
  EXPECT_EQ(header.chunks, 10);
}

TEST(ExrHeaders, ThatAreCutOffEndThereWhateverLiesBehindThem) {
  const std::string file = "\x76\x2f\x31\x01" + u32(2) + part(), f = "f";
  for (std::size_t size = 8; size < file.size(); ++size) {
    const auto cut = std::as_bytes(std::span(file)).first(size);
    const std::string said = message_of([&] { check_exr_headers({cut, f, DecodeLimits{}}); });
    EXPECT_EQ(said.substr(0, said.rfind(" (byte")), broken + "ends too early") << size << ' ' << said;
  }
}

TEST(ExrHeaders, BlocksHaveTheLinesOfTheirCompression) {
  constexpr std::array<int, 10> lines{1, 1, 1, 16, 32, 16, 32, 32, 32, 256};
  for (int c = 0; c < 10; ++c) {
    const std::string compression = attribute("compression", std::string(1, static_cast<char>(c)));
    const int height = lines[c];
    for (const int more : {0, 1}) {
      const Look look = look_at(part(compression, window(0, 0, 9, height + more - 1)));
      ASSERT_EQ(look.headers.size(), 1u) << look.said;
      EXPECT_EQ(look.headers[0].compression, c);
      EXPECT_EQ(look.headers[0].chunks, 1 + more) << "compression " << c;
    }
  }
  EXPECT_EQ(said_of_header(part(attribute("compression", "\x0a"))), broken + "unknown compression");
}

TEST(ExrHeaders, TilesAreCountedInBothDirections) {
  const auto tiles = [](std::int64_t width, std::int64_t height) {
    return attribute("tiles", u32(width) + u32(height) + '\0');
  };
  EXPECT_EQ(look_at(part(tiles(5, 2)), tiled).headers.at(0).chunks, 2 * 3) << "of 10 × 5 pixels";
  EXPECT_EQ(look_at(part(tiles(4, 5)), tiled).headers.at(0).chunks, 3 * 1);
  EXPECT_EQ(said_of_header(part(), tiled), broken + "tiles without a size");
  EXPECT_EQ(said_of_header(part(tiles(0, 1)), tiled), broken + "tiles without a size");
  EXPECT_EQ(said_of_header(part(tiles(1, 0)), tiled), broken + "tiles without a size");
  EXPECT_EQ(said_of_header(part(tiles(65536, 1)), tiled), "no error");
  EXPECT_EQ(said_of_header(part(tiles(1, 65536)), tiled), "no error");
  EXPECT_EQ(said_of_header(part(tiles(65537, 1)), tiled), broken + "tiles beyond all bounds");
  EXPECT_EQ(said_of_header(part(tiles(1, 65537)), tiled), broken + "tiles beyond all bounds");
  EXPECT_EQ(look_at(part(tiles(0, 0))).headers.at(0).chunks, 5) << "of a file that has none";
}

TEST(ExrHeaders, PartsSayThemselvesWhatTheyAre) {
  const std::string flat = part(attribute("type", "scanlineimage")),
                    points = part(attribute("type", "deepscanline"));
  const std::string tiles =
      part(attribute("tiles", u32(5) + u32(5) + '\0') + attribute("type", "tiledimage"));
  const Look look = look_at(flat + points + tiles + '\0', multipart);
  ASSERT_EQ(look.headers.size(), 3u) << look.said;
  for (std::size_t i = 0; i < 3; ++i) {
    EXPECT_EQ(look.headers[i].deep, i == 1) << i;
    EXPECT_EQ(look.headers[i].tiled, i == 2) << i;
  }
  EXPECT_TRUE(look_at(part(), deep).headers.at(0).deep);
  EXPECT_FALSE(look_at(part() + '\0', deep | multipart).headers.at(0).deep) << "its part does not say so";
  EXPECT_EQ(said_of_header(std::string(1, '\0'), multipart), broken + "no parts");
}

TEST(ExrHeaders, WindowsLieWithinTheirBounds) {
  const std::int64_t far = 1 << 30;
  const auto at = [](std::int64_t x, std::int64_t y) { return part("", window(x, y, x, y)); };
  for (const std::int64_t edge : {-far, far}) {
    EXPECT_EQ(said_of_header(at(edge, 0)), "no error");
    EXPECT_EQ(said_of_header(at(0, edge)), "no error");
    const std::int64_t beyond = edge + (edge > 0 ? 1 : -1);
    EXPECT_EQ(said_of_header(at(beyond, 0)), broken + "window beyond all bounds");
    EXPECT_EQ(said_of_header(at(0, beyond)), broken + "window beyond all bounds");
  }
  EXPECT_EQ(said_of_header(part("", window(3, 0, 2, 0))), "f: has no pixels: 0 x 1");
  EXPECT_EQ(said_of_header(part("", window(0, 3, 0, 2))), "f: has no pixels: 1 x 0");
}

TEST(ExrHeaders, ChannelsHaveLimits) {
  const auto with = [](const std::string& channels) {
    return said_of_header(part("", window(0, 0, 9, 4), channels));
  };
  std::string many;
  for (int i = 0; i < 1024; ++i) many += channel("c" + std::to_string(i));
  EXPECT_EQ(with(many), "no error");
  EXPECT_EQ(with(many + channel("last")), broken + "too many channels");
  EXPECT_EQ(with(""), broken + "no channels");
  EXPECT_EQ(with(channel("x", 3)), broken + "channel 'x' of unknown type");
  EXPECT_EQ(with(channel(std::string(255, 'n'))), "no error");
  EXPECT_EQ(with(channel(std::string(256, 'n'))), broken + "name without an end");
  EXPECT_EQ(with(channel("\x1f~\x7f", 3)), broken + "channel '?~?' of unknown type");
  for (const auto& [x, y] : {std::pair{4, 4}, {1, 4}, {4, 1}})
    EXPECT_EQ(with(channel("x", 2, x, y)), "no error");
  for (const auto& [x, y] : {std::pair{5, 1}, {1, 5}, {0, 1}, {1, 0}, {-1, 1}})
    EXPECT_EQ(with(channel("x", 2, x, y)), broken + "channel 'x' has a bad sampling rate");
  EXPECT_TRUE(
      look_at(part("", window(0, 0, 9, 4), channel("x", 2, 1, 2))).headers.at(0).channels.at(0).subsampled);
}

TEST(ExrHeaders, AttributesFitTheFile) {
  EXPECT_EQ(said_of_header(part(attribute("note", std::string(300, 'x')))), "no error");
  EXPECT_EQ(said_of_header(part(attribute("note", "x", ""))), broken + "malformed attribute 'note'");
  EXPECT_EQ(said_of_header(part(name("note") + name("type") + u32(0x80000000))),
            broken + "malformed attribute 'note'");
  EXPECT_EQ(said_of_header(part(name("note") + name("type") + u32(0x7fffffff))), broken + "ends too early");
  EXPECT_EQ(said_of_header(attribute("compression", "")), broken + "attribute 'compression' is too short");
  EXPECT_EQ(said_of_header(attribute("channels", channel("Y") + '\0') + '\0'),
            broken + "no data or display window");
  std::string many;
  for (int i = 0; i < 4092; ++i) many += attribute("n", "");
  EXPECT_EQ(said_of_header(part(many)), "no error") << "4096 with those that every part has";
  EXPECT_EQ(said_of_header(part(many + attribute("n", ""))), broken + "too many attributes");
}

TEST(ExrHeaders, FilesHaveAVersionAndAtMost256Parts) {
  const std::string one = part(), file = "\x76\x2f\x31\x01" + u32(3) + one, f = "f";
  const DecodeLimits limits;
  EXPECT_EQ(message_of([&] {
              check_exr_headers({std::as_bytes(std::span(file)), f, limits});
            }),
            broken + "version 3 is unknown (byte 8)");
  std::string parts;
  for (int i = 0; i < 256; ++i) parts += one;
  EXPECT_EQ(look_at(parts + '\0', multipart, 1 << 16).headers.size(), 256u);
  EXPECT_EQ(said_of_header(parts + one + '\0', multipart, 1 << 16), broken + "too many parts");
}

// Five lines of ten pixels: an entry of the table and a chunk of 8 bytes for each.
TEST(ExrHeaders, BlocksFitTheRestOfTheFile) {
  EXPECT_EQ(said_of_header(part(), 0, 5 * 16), "no error");
  EXPECT_EQ(said_of_header(part(), 0, 5 * 16 - 1),
            broken + "5 blocks of pixels do not fit the rest of the file");
  EXPECT_EQ(said_of_header(part() + part() + '\0', multipart, 10 * 16), "no error");
  EXPECT_EQ(said_of_header(part() + part() + '\0', multipart, 10 * 16 - 1),
            broken + "10 blocks of pixels do not fit the rest of the file");
}

TEST(ExrHeaders, ABlockTakesAtMostHalfAGibibyte) {
  // 2^23 pixels of 4 bytes in lines of 16, and in tiles.
  const std::string zip = attribute("compression", "\3");
  EXPECT_EQ(said_of_header(part(zip, window(0, 0, (1 << 23) - 1, 0))), "no error");
  EXPECT_EQ(said_of_header(part(zip, window(0, 0, 1 << 23, 0))),
            broken + "one block of pixels would take 536870976 bytes");
  EXPECT_EQ(said_of_header(
                part(zip, window(0, 0, (1 << 22), 0), channel("a", 1) + channel("b", 1) + channel("c", 2))),
            broken + "one block of pixels would take 536871040 bytes");
  const auto tiles = [](std::int64_t width) {
    return said_of_header(part(attribute("tiles", u32(width) + u32(16384) + '\0')), tiled);
  };
  EXPECT_EQ(tiles(8192), "no error");
  EXPECT_EQ(tiles(8193), broken + "one block of pixels would take 536936448 bytes");
}

}  // namespace
}  // namespace ssphh::image
