/// What is meant where nobody says anything, and what is said of what cannot be.

#include <gtest/gtest.h>

#include <ssphh/image/cube_layout.h>
#include <ssphh/image/resample.h>
#include <ssphh/image/sphere_map.h>
#include <ssphh/image/tonemap.h>

#include "error_message.h"
#include "test_images.h"

namespace ssphh::image {
namespace {

using ssphh::test::message_of;

TEST(ImageDefaults, AreNamed) {
  const Image none;
  EXPECT_EQ(none.width, 0);
  EXPECT_EQ(none.height, 0);
  EXPECT_EQ(none.channels, 3);
  EXPECT_EQ(Image(2, 3).channels, 3);
  const CubeMap cube;
  EXPECT_EQ(cube.size, 0);
  EXPECT_EQ(CubeMap(2).faces[5].channels, 3);
  const Rgba8 codes;
  EXPECT_EQ(codes.width, 0);
  EXPECT_EQ(codes.height, 0);
  const DecodeLimits limits;
  EXPECT_EQ(limits.side, 65536);
  EXPECT_EQ(limits.pixels, 268435456u);
  const ToneMap tone;
  EXPECT_EQ(tone.exposure, 0);
  EXPECT_EQ(tone.curve, ToneCurve::clip);
  EXPECT_EQ(tone.gamma, 0);
  const Image image = test::noise_image(12, 9, 3, 1);
  EXPECT_EQ(encode_jpeg(image), encode_jpeg(image, 95));
  EXPECT_NE(encode_jpeg(image), encode_jpeg(image, 94));
  EXPECT_EQ(resize(image, 5, 4).pixels, resize(image, 5, 4, Filter::box).pixels);
}

TEST(ImageFormats, AreToldByExtensionAndContent) {
  for (const auto& [name, format] : {std::pair{"a.exr", FileFormat::exr},
                                     {"a.hdr", FileFormat::hdr},
                                     {"a.PIC", FileFormat::hdr},
                                     {"a.png", FileFormat::png},
                                     {"a.JPG", FileFormat::jpeg},
                                     {"a.b.jpeg", FileFormat::jpeg}})
    EXPECT_EQ(format_of_extension(name), format) << name;
  EXPECT_EQ(message_of([] { format_of_extension("dir/a.Bmp"); }),
            "dir/a.Bmp: unknown image extension '.bmp' (use .exr, .hdr, .png or .jpg)");
  const auto format_of = [](const std::string& text) {
    return format_of_content(std::as_bytes(std::span(text)));
  };
  EXPECT_EQ(format_of("\x76\x2f\x31\x01"), FileFormat::exr);
  EXPECT_EQ(format_of("#?"), FileFormat::hdr);
  EXPECT_EQ(format_of("\x89PNG\r\n\x1a\n"), FileFormat::png);
  EXPECT_EQ(format_of("\xff\xd8\xff"), FileFormat::jpeg);
  EXPECT_EQ(format_of("RIFFsizeWEBP"), FileFormat::webp);
  for (const char* other : {"", "#", "\x76\x2f\x31\x02", "\x76\x2f\x31", "\x89PNG\r\n\x1a\r", "\xff\xd8\xfe",
                            "\xff\xd8", "RIFFsizeWEB", "RIFFsizeWAVE"})
    EXPECT_FALSE(format_of(other)) << other;
}

TEST(ImageMessages, OfFilesThatAreNoImages) {
  const auto read = [](const std::string& text) {
    return message_of([&] { decode_image(std::as_bytes(std::span(text)), "f"); });
  };
  EXPECT_EQ(read(""), "f: is empty");
  EXPECT_EQ(read("hello"), "f: is no image that can be read (OpenEXR, Radiance HDR, PNG, JPEG and WebP are)");
  EXPECT_EQ(message_of([] { decode_rgba8(encode_hdr(Image(1, 1)), "f"); }),
            "f: is not an 8-bit image (use PNG, JPEG or WebP)");
  EXPECT_EQ(message_of([] { decode_rgba8(encode_exr(Image(1, 1)), "f"); }),
            "f: is not an 8-bit image (use PNG, JPEG or WebP)");
}

TEST(ImageMessages, OfImagesThatAreNotWhole) {
  EXPECT_EQ(message_of([] { Image(-1, 1); }), "image: its size must not be negative");
  EXPECT_EQ(message_of([] { Image(1, -1); }), "image: its size must not be negative");
  EXPECT_EQ(message_of([] { Image(1, 1, 0); }), "image: its size must not be negative");
  EXPECT_EQ(message_of([] { Image(0, 0, 1); }), "no error");
  Image image(2, 2);
  const auto whole = [&] { return message_of([&] { require_whole(image, "here"); }); };
  EXPECT_EQ(whole(), "no error");
  image.pixels.resize(13);
  EXPECT_EQ(whole(), "here: the image's size and its number of pixels do not agree");
  for (const int channels : {2, 5}) {
    image = Image(2, 2, channels);
    EXPECT_EQ(whole(), "here: an image must have 1, 3 or 4 channels");
  }
  image = Image(0, 2);
  EXPECT_EQ(whole(), "here: the image is empty");
  image = Image(2, 0);
  EXPECT_EQ(whole(), "here: the image is empty");

  const Image none;
  EXPECT_EQ(message_of([&] { encode_exr(none); }), "OpenEXR: the image is empty");
  EXPECT_EQ(message_of([&] { encode_hdr(none); }), "Radiance HDR: the image is empty");
  EXPECT_EQ(message_of([&] { encode_png(none); }), "PNG: the image is empty");
  EXPECT_EQ(message_of([&] { encode_jpeg(none); }), "JPEG: the image is empty");
  EXPECT_EQ(message_of([&] { tone_map(none, ToneMap()); }), "tone mapping: the image is empty");
  EXPECT_EQ(message_of([&] { to_display(none, {}); }), "tone mapping: the image is empty");
  EXPECT_EQ(message_of([&] { layout_size(none, Layout::angular); }), "layout: the image is empty");
  EXPECT_EQ(message_of([&] { sample_bilinear(none, 0, 0); }), "image: it is empty");
  EXPECT_EQ(message_of([&] { sample_equirect(none, vec3(1)); }), "equirectangular image: it is empty");
  for (const Image& other : {none, Image(2, 3)}) {
    EXPECT_EQ(message_of([&] { sample_angular(other, vec3(1)); }),
              "angular map: it must be a square with pixels");
  }
}

TEST(ImageMessages, OfCubes) {
  const CubeMap none, cube(2);
  EXPECT_EQ(message_of([&] { cube_texel(none, 0, 0, 0); }), "cube map: there is no such face");
  for (const int face : {-1, 6})
    EXPECT_EQ(message_of([&] { cube_texel(cube, face, 0, 0); }), "cube map: there is no such face");
  EXPECT_EQ(message_of([&] { cube_texel(cube, 5, 0, 0); }), "no error");
  EXPECT_EQ(message_of([&] { sample_cube(none, vec3(1)); }), "cube map: it is empty");
  EXPECT_EQ(message_of([&] { from_cube(none, Layout::equirect); }), "cube map: it is empty");
  const std::string squares = "cube map: its faces are not all squares of its size";
  for (const Image& other : {Image(2, 3), Image(3, 2), Image(2, 2, 4)}) {
    CubeMap broken(2);
    broken.faces[3] = other;
    EXPECT_EQ(message_of([&] { from_cube(broken, Layout::strip_h); }), squares);
  }
  CubeMap small(2);
  small.size = 1;
  EXPECT_EQ(message_of([&] { from_cube(small, Layout::strip_h); }), squares);
}

TEST(ImageMessages, OfLayouts) {
  EXPECT_EQ(message_of([] { enum_named<Layout>("layout", "sphere"); }),
            "layout: \"sphere\" is none of: equirect, strip-h, strip-v, cross-h, cross-v, angular");
  const auto size = [](Layout layout) { return message_of([&] { layout_size(Image(5, 3), layout); }); };
  EXPECT_EQ(size(Layout::equirect),
            "layout: an image of 5 x 3 pixels cannot be of layout equirect (its shape is 2 : 1)");
  EXPECT_EQ(size(Layout::strip_h),
            "layout: an image of 5 x 3 pixels cannot be of layout strip-h (its shape is 6 : 1)");
  EXPECT_EQ(size(Layout::strip_v),
            "layout: an image of 5 x 3 pixels cannot be of layout strip-v (its shape is 1 : 6)");
  EXPECT_EQ(size(Layout::cross_h),
            "layout: an image of 5 x 3 pixels cannot be of layout cross-h (its shape is 4 : 3)");
  EXPECT_EQ(size(Layout::cross_v),
            "layout: an image of 5 x 3 pixels cannot be of layout cross-v (its shape is 3 : 4)");
  EXPECT_EQ(size(Layout::angular),
            "layout: an image of 5 x 3 pixels cannot be of layout angular (its shape is 1 : 1)");
}

// Sizes that nobody gave keep the resolution at the horizon and the centre.
TEST(ImageLayouts, KeepTheResolution) {
  CubeMap cube(8);
  EXPECT_EQ(from_cube(cube, Layout::equirect).height, 16);
  EXPECT_EQ(from_cube(cube, Layout::equirect).width, 32);
  EXPECT_EQ(from_cube(cube, Layout::angular).height, 32);
  EXPECT_EQ(from_cube(cube, Layout::cross_h).height, 24);
  EXPECT_EQ(to_cube(Image(32, 16), Layout::equirect).size, 8);
  EXPECT_EQ(to_cube(Image(32, 32), Layout::angular).size, 8);
  EXPECT_EQ(to_cube(Image(48, 8), Layout::strip_h).size, 8);
  EXPECT_EQ(to_cube(Image(2, 1), Layout::equirect).size, 1) << "never nothing";
  EXPECT_EQ(to_cube(Image(3, 3), Layout::angular).size, 1);
  EXPECT_EQ(convert_layout(Image(32, 16), Layout::equirect, Layout::angular).height, 32);
  EXPECT_EQ(convert_layout(Image(32, 32), Layout::angular, Layout::equirect).height, 16);
  EXPECT_EQ(convert_layout(Image(32, 16), Layout::equirect, Layout::strip_v, 3).height, 18);
}

TEST(ImageMessages, OfWritersAndSizes) {
  Rgba8 codes{2, 1, std::vector<std::uint8_t>(8)};
  EXPECT_EQ(message_of([&] { encode_png(codes); }), "no error");
  const std::string disagree = "PNG: the image's size and its bytes do not agree";
  for (const std::size_t bytes : {7, 9}) {
    codes.rgba.resize(bytes);
    EXPECT_EQ(message_of([&] { encode_png(codes); }), disagree);
  }
  EXPECT_EQ(message_of([&] { encode_png(Rgba8{0, 1, {}}); }), disagree);
  EXPECT_EQ(message_of([&] { encode_png(Rgba8{1, 0, {}}); }), disagree);
  EXPECT_EQ(message_of([&] { encode_png(Rgba8{-1, -1, {1, 2, 3, 4}}); }), disagree);

  for (const int quality : {0, 101})
    EXPECT_EQ(message_of([&] { encode_jpeg(Image(1, 1), quality); }), "JPEG: the quality must be 1..100");
  for (const int quality : {1, 100})
    EXPECT_EQ(message_of([&] { encode_jpeg(Image(1, 1), quality); }), "no error");
  EXPECT_EQ(message_of([] { encode_jpeg(Image(65536, 1, 1)); }), "JPEG: 65536 x 1 pixels are too many");
  EXPECT_EQ(message_of([] { encode_jpeg(Image(1, 65536, 1)); }), "JPEG: 1 x 65536 pixels are too many");

  const std::vector<float> values(4, 1.0f);
  const auto exr = [&](const std::string& name, std::size_t count) {
    const NamedChannel extra{name, std::span(values).first(count)};
    return message_of([&] { encode_exr(Image(3, 1), std::span(&extra, 1)); });
  };
  EXPECT_EQ(exr("Z", 3), "no error");
  EXPECT_EQ(exr("Z", 2), "OpenEXR: channel Z has not one value for each pixel");
  EXPECT_EQ(exr("Z", 4), "OpenEXR: channel Z has not one value for each pixel");
  EXPECT_EQ(exr("G", 3), "OpenEXR: there are two channels G");

  EXPECT_EQ(message_of([] { resize(Image(2, 3), 0, 4); }), "resize: cannot resize 2 x 3 to 0 x 4 pixels");
  EXPECT_EQ(message_of([] { resize(Image(2, 3), 4, 0); }), "resize: cannot resize 2 x 3 to 4 x 0 pixels");
  EXPECT_EQ(message_of([] { resize(Image(), 1, 1); }), "resize: cannot resize 0 x 0 to 1 x 1 pixels");
  Image image(2, 3);
  image.pixels.push_back(0);
  EXPECT_EQ(message_of([&] { resize(image, 1, 1); }),
            "resize: the image's size and its number of pixels do not agree");
}

}  // namespace
}  // namespace ssphh::image
