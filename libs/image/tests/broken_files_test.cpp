// Every decoder answers every damaged file with an image or an Error.

#include <algorithm>
#include <array>
#include <map>

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <ssphh/core/file.h>
#include <ssphh/core/log.h>
#include <ssphh/image/io.h>

#include "error_message.h"
#include "shared_scenes.h"
#include "test_images.h"

namespace ssphh::image {
namespace {

// Whether an image came out.
bool decodes(std::span<const std::byte> data, const std::string& name) {
  constexpr DecodeLimits limits{8192, std::uint64_t{1} << 24};
  try {
    return !decode_image(data, name, limits).empty();
  } catch (const Error& e) {
    EXPECT_EQ(e.where(), name);
    EXPECT_FALSE(e.problem().empty());
    return false;
  }
}

std::map<std::string, std::vector<std::byte>> valid_files() {
  Image image = test::noise_image(24, 17, 3, 1);
  for (int x = 4; x < 20; ++x) image.set_rgb(x, 3, vec3(0.25f));  // a run
  return {{"a.exr", encode_exr(image)},
          {"a.hdr", encode_hdr(image)},
          {"a.png", encode_png(image)},
          {"a.jpg", encode_jpeg(image, 90)},
          {"16.png", test::png_16bit_grey({1, 2, 3, 4})}};
}

class BrokenFiles : public testing::Test {
 protected:
  BrokenFiles() : previous_(set_log_sink([](LogLevel, const std::string&) {})) {}
  ~BrokenFiles() override { set_log_sink(previous_); }

 private:
  LogSink previous_;
};

TEST_F(BrokenFiles, EveryTruncationIsAnError) {
  for (const auto& [name, data] : valid_files()) {
    ASSERT_TRUE(decodes(data, name)) << name;
    for (std::size_t size = 0; size < data.size(); ++size) {
      ASSERT_FALSE(decodes(std::span(data).first(size), name)) << name << " of " << size << " bytes";
    }
  }
}

TEST_F(BrokenFiles, FlippedBitsNeverCrash) {
  for (const auto& [name, data] : valid_files()) {
    Pcg32 random(7);
    int refused = 0;
    for (int i = 0; i < 1500; ++i) {
      auto damaged = data;
      const int flips = 1 + static_cast<int>(random.next() % 4);
      for (int k = 0; k < flips; ++k) {
        // Half of the damage goes to the header.
        const std::size_t reach = k % 2 ? damaged.size() : std::min<std::size_t>(damaged.size(), 330);
        damaged[random.next() % reach] ^= static_cast<std::byte>(1u << (random.next() % 8));
      }
      refused += decodes(damaged, name) ? 0 : 1;
    }
    EXPECT_GT(refused, 100) << name;
  }
}

TEST_F(BrokenFiles, APngWithOneFlippedBitOfContentIsRefused) {
  const auto data = valid_files().at("a.png");
  for (std::size_t i = 8; i < data.size(); ++i) {
    auto damaged = data;
    damaged[i] ^= std::byte{0x10};
    EXPECT_FALSE(decodes(damaged, "a.png")) << "byte " << i;
  }
}

TEST_F(BrokenFiles, AJpegWithTooManyHuffmanCodesIsRefused) {
  auto data = valid_files().at("a.jpg");
  const std::array<std::byte, 2> marker{std::byte{0xff}, std::byte{0xc4}};
  const auto table = std::search(data.begin(), data.end(), marker.begin(), marker.end());
  ASSERT_NE(table, data.end());
  // Marker, length, class and identity, then the counts: 200 codes each of 15 and 16 bits.
  *(table + 5 + 14) = *(table + 5 + 15) = std::byte{200};
  EXPECT_THAT(ssphh::test::message_of([&] { decode_image(data, "a.jpg"); }),
              testing::HasSubstr("broken JPEG: Bogus Huffman table definition"));
}

TEST_F(BrokenFiles, FilesThatOnceCrashedExrReadersDoNotCrashThisOne) {
  SSPHH_SHARED_SCENE(folder, "broken/exr");
  int count = 0;
  for (const auto& entry : std::filesystem::directory_iterator(folder)) {
    if (!entry.is_regular_file()) continue;
    ++count;
    SCOPED_TRACE(entry.path().filename().string());
    decodes(read_file(entry.path()), entry.path().filename().string());
  }
  EXPECT_GE(count, 85);
}

}  // namespace
}  // namespace ssphh::image
