// Which channels, parts and pixels of an OpenEXR file become the image, written by OpenEXR itself.

#include <ImfChannelList.h>
#include <ImfChromaticitiesAttribute.h>
#include <ImfFrameBuffer.h>
#include <ImfHeader.h>
#include <ImfOutputFile.h>
#include <ImfStandardAttributes.h>
#include <gtest/gtest.h>

#include <ssphh/core/log.h>
#include <ssphh/image/io.h>

#include "error_message.h"
#include "memory_dir.h"
#include "temp_dir.h"

namespace ssphh::image {
namespace {

using ssphh::test::message_of;

class ExrChannels : public testing::Test {
 protected:
  void SetUp() override {
    set_log_sink([this](LogLevel, const std::string& message) { warnings_.push_back(message); });
  }
  void TearDown() override { set_log_sink({}); }

  /// A file of these channels, in which channel number c has 10·c + x + 100·y at (x, y) of the data window.
  Image read(const std::vector<std::string>& channels, Imf::Header header, Imf::PixelType type = Imf::FLOAT) {
    const Imath::Box2i window = header.dataWindow();
    const int width = window.max.x - window.min.x + 1, height = window.max.y - window.min.y + 1;
    std::vector<std::vector<float>> values;
    std::vector<std::vector<std::uint32_t>> whole;
    Imf::FrameBuffer buffer;
    for (std::size_t c = 0; c < channels.size(); ++c) {
      auto& reals = values.emplace_back();
      auto& numbers = whole.emplace_back();
      for (int y = window.min.y; y <= window.max.y; ++y) {
        for (int x = window.min.x; x <= window.max.x; ++x) {
          reals.push_back(static_cast<float>(10 * static_cast<int>(c) + x + 100 * y));
          numbers.push_back(static_cast<std::uint32_t>(reals.back()));
        }
      }
    }
    for (std::size_t c = 0; c < channels.size(); ++c) {
      header.channels().insert(channels[c], Imf::Channel(type));
      void* first = type == Imf::FLOAT ? static_cast<void*>(values[c].data()) : whole[c].data();
      buffer.insert(channels[c],
                    Imf::Slice::Make(type, first, window, 4, 4 * static_cast<std::size_t>(width)));
    }
    const auto path = dir_ / "f.exr";
    {
      Imf::OutputFile file(path.c_str(), header);
      file.setFrameBuffer(buffer);
      file.writePixels(height);
    }
    name_ = path.string();
    warnings_.clear();
    return read_image(path);
  }

  ssphh::test::TempDir dir_{ssphh::test::memory_dir()};
  std::string name_;
  std::vector<std::string> warnings_;
};

TEST_F(ExrChannels, OfTheRootComeBeforeThoseOfLayers) {
  const Image rgb = read({"R", "G", "B"}, {2, 1});
  EXPECT_EQ(rgb.pixels, (std::vector<float>{0, 10, 20, 1, 11, 21}));
  const Image rgba = read({"B", "A", "R", "G"}, {1, 1});
  EXPECT_EQ(rgba.pixels, (std::vector<float>{20, 30, 0, 10}));
  EXPECT_EQ(rgba.channels, 4);
  const Image both = read({"a.R", "a.G", "a.B", "Y"}, {1, 1});
  EXPECT_EQ(both.pixels, (std::vector<float>{30})) << "luminance";
  EXPECT_EQ(read({"Y", "R", "G", "B"}, {1, 1}).pixels, (std::vector<float>{10, 20, 30}));
  EXPECT_TRUE(warnings_.empty());
}

TEST_F(ExrChannels, OfTheFirstLayerThatHasAllAreTakenWithAWarning) {
  const Image image = read({"R", "deep.a.B", "z.R", "deep.R", "deep.a.R", "deep.a.G", "deep.a.A"}, {1, 1});
  EXPECT_EQ(image.pixels, (std::vector<float>{40, 50, 10, 60}));
  EXPECT_EQ(warnings_, (std::vector<std::string>{name_ + ": no channels R, G, B; layer 'deep.a' is used"}));
}

TEST_F(ExrChannels, OneAloneIsGreyAndOthersAreNamed) {
  EXPECT_EQ(read({"depth"}, {2, 1}).pixels, (std::vector<float>{0, 1}));
  EXPECT_EQ(message_of([&] {
              read({"u", "v"}, {1, 1});
            }),
            name_ + ": has no channels R, G, B or Y, only u, v");
  std::vector<std::string> many;
  for (char c = 'a'; c < 'z'; ++c) many.emplace_back(1, c);
  EXPECT_EQ(
      message_of([&] {
        read(many, {1, 1});
      }),
      name_ +
          ": has no channels R, G, B or Y, only a, b, c, d, e, f, g, h, i, j, k, l, m, n, o, p, q, r, s, t");
}

TEST_F(ExrChannels, OfIntegersAreTheirNumbers) {
  EXPECT_EQ(read({"Y"}, {3, 2}, Imf::UINT).pixels, (std::vector<float>{0, 1, 2, 100, 101, 102}));
}

Imf::Header windows(const Imath::Box2i& display, const Imath::Box2i& data) {
  return {display, data};
}

TEST_F(ExrChannels, PixelsStandWhereTheDisplayWindowSays) {
  // Data beyond the left and upper edge, none at the right and lower.
  const Image image = read({"Y"}, windows({{2, 1}, {5, 3}}, {{1, 0}, {3, 2}}));
  EXPECT_EQ(image.width, 4);
  EXPECT_EQ(image.height, 3);
  EXPECT_EQ(image.pixels, (std::vector<float>{102, 103, 0, 0, 202, 203, 0, 0, 0, 0, 0, 0}));
  const Image inside = read({"Y"}, windows({{0, 0}, {2, 2}}, {{1, 1}, {1, 1}}));
  EXPECT_EQ(inside.pixels, (std::vector<float>{0, 0, 0, 0, 101, 0, 0, 0, 0}));
  EXPECT_TRUE(warnings_.empty());
  for (const Imath::Box2i& data : {Imath::Box2i{{4, 0}, {6, 1}}, Imath::Box2i{{0, 4}, {1, 6}}}) {
    const Image black = read({"Y"}, windows({{0, 0}, {3, 3}}, data));
    EXPECT_EQ(black.pixels, std::vector<float>(16));
    EXPECT_EQ(warnings_,
              (std::vector<std::string>{
                  name_ + ": its data window lies outside its display window: the image is black"}));
  }
  const Image corner = read({"Y"}, windows({{0, 0}, {3, 3}}, {{3, 3}, {5, 5}}));
  EXPECT_EQ(corner.pixels[15], 303) << "a single pixel inside";
  EXPECT_TRUE(warnings_.empty());
}

TEST_F(ExrChannels, OfOtherPrimariesAreKeptWithAWarning) {
  const Imf::Chromaticities rec709;
  const auto warns = [&](const Imf::Chromaticities& primaries) {
    Imf::Header header(1, 1);
    Imf::addChromaticities(header, primaries);
    EXPECT_EQ(read({"R", "G", "B"}, header).pixels, (std::vector<float>{0, 10, 20}));
    return warnings_ ==
           std::vector<std::string>{name_ + ": its primaries are not Rec.709; colours are kept as they are"};
  };
  EXPECT_FALSE(warns(rec709));
  for (Imath::V2f Imf::Chromaticities::*point : {&Imf::Chromaticities::red, &Imf::Chromaticities::green,
                                                 &Imf::Chromaticities::blue, &Imf::Chromaticities::white}) {
    Imf::Chromaticities other = rec709;
    (other.*point).x += 0.9e-3f;
    EXPECT_FALSE(warns(other)) << "rounded";
    (other.*point).x = (rec709.*point).x;
    (other.*point).y -= 1.1e-3f;
    EXPECT_TRUE(warns(other));
  }
}

TEST_F(ExrChannels, PixelsThatAreNoNumbersAreCounted) {
  Image image(3, 1);
  image.pixels = {INFINITY, 2, 3, 4, NAN, -INFINITY, 7, 8, 9};
  warnings_.clear();
  decode_image(encode_exr(image), "f");
  EXPECT_EQ(warnings_, (std::vector<std::string>{"f: 2 of 3 pixels are infinite or NaN"}));
  warnings_.clear();
  write_image(dir_ / "f.exr", image);
  EXPECT_TRUE(warnings_.empty());
  write_image(dir_ / "f.hdr", image);
  EXPECT_EQ(warnings_,
            (std::vector<std::string>{(dir_ / "f.hdr").string() +
                                      ": 2 pixels are infinite or NaN, which this format cannot hold"}));
}

}  // namespace
}  // namespace ssphh::image
