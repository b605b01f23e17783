/// Contracts of libs/core, libs/image and libs/metrics.

#include <ssphh/core/bytes.h>
#include <ssphh/core/file.h>
#include <ssphh/core/nearest_word.h>
#include <ssphh/core/parallel.h>
#include <ssphh/core/sphere.h>
#include <ssphh/image/cube_layout.h>
#include <ssphh/image/exposure.h>
#include <ssphh/image/io.h>
#include <ssphh/image/ktx2.h>
#include <ssphh/image/resample.h>
#include <ssphh/image/sphere_map.h>
#include <ssphh/image/tonemap.h>
#include <ssphh/metrics/compare.h>
#include <ssphh/metrics/flip.h>
#include <ssphh/metrics/heat_map.h>
#include <ssphh/metrics/mask.h>
#include <ssphh/metrics/perceptual.h>

#include "contract.h"

namespace ssphh::test {
namespace {

using image::CubeMap;
using image::Image;

/// An image whose size promises more pixels than it has.
Image torn_image() {
  Image image(4, 4);
  image.pixels.resize(5);
  return image;
}

Image two_channels() {
  return Image(4, 4, 2);
}

/// A file of two bytes.
ByteReader short_file() {
  static const std::array<std::byte, 2> bytes{};
  return {bytes, "x.bin"};
}

std::vector<Contract> of_core() {
  return {
      refuses("ThreadCount", "OfMinusOne", [] { set_thread_count(-1); }, {"thread count"}),
      refuses("ParallelFor", "WithoutGrain", [] { parallel_for(3, 0, [](std::size_t, std::size_t) {}); },
              {"grain"}),
      refuses("ParallelFor", "WithoutABody", [] { parallel_for(3, 1, nullptr); }, {"body"}),
      gives("ParallelFor", "OfNothing",
            [] { parallel_for(0, 1, [](std::size_t, std::size_t) { FAIL() << "called"; }); }),
      refuses("CubeDirection", "OfASeventhFace",
              [] {
                cube_direction({6, 0.5f, 0.5f});
              },
              {"0..5"}),
      refuses("TexelDirection", "OfFaceMinusOne", [] { texel_direction(-1, 0, 0, 4); }, {"0..5"}),
      refuses("ReadFile", "ThatIsAFolder", [] { read_file("/tmp"); }, {"/tmp"}),
      refuses("WriteFile", "IntoNoFolder", [] { write_file("/nowhere/at/all", "x"); }, {"/nowhere/at/all"}),
      refuses("ByteReader", "PastTheEnd", [] { short_file().value<double>("size"); }, {"x.bin", "cut off"}),
      refuses("ByteReader", "ViewPastTheEnd", [] { short_file().view("pixels", 3); }, {"cut off"}),
      gives("NearestWord", "OfNoCandidates", [] { EXPECT_EQ(nearest_word("x", {}), ""); }),
  };
}

std::vector<Contract> of_images() {
  return {
      refuses("Image", "OfANegativeSize", [] { Image(-1, 4); }, {"image", "negative"}),
      refuses("Image", "WithoutChannels", [] { Image(4, 4, 0); }, {"image"}),
      refuses("CubeMap", "OfANegativeSize", [] { CubeMap(-1); }, {"image"}),
      refuses("EncodeExr", "OfAnEmptyImage", [] { image::encode_exr(Image()); }, {"OpenEXR", "empty"}),
      refuses("EncodeExr", "OfATornImage", [] { image::encode_exr(torn_image()); },
              {"OpenEXR", "number of pixels"}),
      refuses("EncodeExr", "OfTwoChannels", [] { image::encode_exr(two_channels()); }, {"1, 3 or 4"}),
      refuses("EncodeExr", "WithAChannelOfAnotherSize",
              [] {
                const std::vector<float> z(3);
                const image::NamedChannel channel{"Z", z};
                image::encode_exr(Image(2, 2), {&channel, 1});
              },
              {"channel Z", "each pixel"}),
      refuses("EncodeExr", "WithAChannelTwice",
              [] {
                const std::vector<float> r(4);
                const image::NamedChannel channel{"R", r};
                image::encode_exr(Image(2, 2), {&channel, 1});
              },
              {"two channels R"}),
      refuses("Ktx2OfHalves", "OfAnotherSize",
              [] {
                image::ktx2_of_halves({2, 2, 2}, {});
              },
              {"KTX2"}),
      refuses("Ktx2OfHalves", "OfANegativeSize",
              [] {
                image::ktx2_of_halves({-2, 2, 2}, {});
              },
              {"KTX2"}),
      refuses("EncodeHdr", "OfATornImage", [] { image::encode_hdr(torn_image()); }, {"number of pixels"}),
      refuses("EncodePng", "OfATornImage", [] { image::encode_png(torn_image()); },
              {"PNG", "number of pixels"}),
      refuses("EncodePng", "OfTwoChannels", [] { image::encode_png(two_channels()); }, {"1, 3 or 4"}),
      refuses("EncodePng", "OfBytesThatAreTooFew",
              [] {
                image::encode_png(image::Rgba8{2, 2, {}});
              },
              {"PNG", "agree"}),
      refuses("EncodeJpeg", "OfQualityZero", [] { image::encode_jpeg(Image(2, 2), 0); }, {"1..100"}),
      refuses("EncodeJpeg", "OfATornImage", [] { image::encode_jpeg(torn_image()); }, {"number of pixels"}),
      refuses("WriteImage", "WithAnUnknownEnding", [] { image::write_image("x.tga", Image(2, 2)); },
              {".tga"}),
      refuses("DecodeImage", "OfNoBytes", [] { image::decode_image({}, "x.png"); }, {"x.png"}),
      refuses("Resize", "ToNothing", [] { image::resize(Image(2, 2), 0, 2); }, {"resize"}),
      refuses("Resize", "OfATornImage", [] { image::resize(torn_image(), 2, 2); }, {"number of pixels"}),
      refuses("SampleBilinear", "OfAnEmptyImage", [] { image::sample_bilinear(Image(), 0, 0); }, {"empty"}),
      gives("SampleBilinear", "AtNoPlace",
            [] { EXPECT_FALSE(is_finite(image::sample_bilinear(Image(3, 2), nan, 1))); }),
      gives("SampleBilinear", "FarOutside",
            [] { EXPECT_EQ(image::sample_bilinear(Image(3, 2), 1e30f, -1e30f), vec3(0)); }),
      refuses("SampleEquirect", "OfAnEmptyImage", [] { image::sample_equirect(Image(), vec3(1)); },
              {"empty"}),
      gives("SampleEquirect", "InNoDirection",
            [] { EXPECT_FALSE(is_finite(image::sample_equirect(Image(4, 2), vec3(nan)))); }),
      refuses("SampleAngular", "OfAnEmptyImage", [] { image::sample_angular(Image(), vec3(1)); }, {"square"}),
      refuses("SampleAngular", "OfAnImageThatIsNoSquare", [] { image::sample_angular(Image(4, 2), vec3(1)); },
              {"square"}),
      gives("SampleAngular", "InNoDirection",
            [] { EXPECT_FALSE(is_finite(image::sample_angular(Image(4, 4), vec3(nan)))); }),
      refuses("SampleCube", "OfAnEmptyCube", [] { image::sample_cube(CubeMap(), vec3(1)); }, {"empty"}),
      gives("SampleCube", "InNoDirection",
            [] { EXPECT_FALSE(is_finite(image::sample_cube(CubeMap(4), vec3(nan)))); }),
      refuses("CubeTexel", "OfASeventhFace", [] { image::cube_texel(CubeMap(4), 6, 0, 0); },
              {"no such face"}),
      refuses("FromCube", "OfAnEmptyCube", [] { image::from_cube(CubeMap(), image::Layout::strip_h); },
              {"empty"}),
      refuses("FromCube", "WithAFaceOfAnotherSize",
              [] {
                CubeMap cube(4);
                cube.faces[3] = Image(2, 2);
                image::from_cube(cube, image::Layout::cross_v);
              },
              {"squares of its size"}),
      refuses("ToCube", "OfAnImageOfAnotherShape",
              [] { image::to_cube(Image(5, 2), image::Layout::strip_h); }, {"layout"}),
      refuses("ToCube", "OfATornImage",
              [] {
                Image image(6, 1);
                image.pixels.pop_back();
                image::to_cube(image, image::Layout::strip_h);
              },
              {"number of pixels"}),
      refuses("ConvertLayout", "OfAnEmptyImage",
              [] { image::convert_layout(Image(), image::Layout::angular, image::Layout::equirect); },
              {"layout"}),
      refuses("EnumNamed", "OfNoLayout", [] { enum_named<image::Layout>("layout", "dome"); },
              {"dome", "equirect"}),
      refuses("ToneMap", "OfATornImage", [] { image::tone_map(torn_image(), {}); }, {"number of pixels"}),
      refuses("AutomaticExposure", "OfATornImage", [] { image::automatic_exposure(torn_image()); },
              {"automatic exposure", "number of pixels"}),
      gives("ToneMap", "OfNoNumber", [] { EXPECT_EQ(image::tone_map(vec3(nan), {}), vec3(0)); }),
      refuses("ToDisplay", "OfTwoChannels", [] { image::to_display(two_channels(), {}); }, {"1, 3 or 4"}),
  };
}

std::vector<Contract> of_metrics() {
  return {
      refuses("Compare", "OfTwoSizes", [] { metrics::compare(Image(4, 2), Image(2, 4)); }, {"sizes differ"}),
      refuses("Compare", "OfATornImage", [] { metrics::compare(Image(4, 4), torn_image()); },
              {"number of pixels"}),
      refuses("Compare", "OfTwoChannels", [] { metrics::compare(two_channels(), two_channels()); },
              {"1, 3 or 4"}),
      gives("Compare", "OfPicturesWithoutANumber",
            [] {
              Image dark(2, 2), none(2, 2);
              std::ranges::fill(none.pixels, nan);
              EXPECT_EQ(metrics::compare(dark, none).nonfinite_pixels, 4u);
            }),
      refuses("AbsoluteErrorMap", "OfAnEmptyImage", [] { metrics::absolute_error_map(Image(), Image()); },
              {"empty"}),
      refuses("PixelatedErrorMap", "OfBlocksWithoutPixels",
              [] { metrics::pixelated_error_map(Image(2, 2), Image(2, 2), 0); }, {"blocks of 0"}),
      refuses("BlockError", "OfAnEmptyMap", [] { metrics::block_error(Image(), 4); }, {"empty"}),
      refuses("EnlargeBlocks", "ThatDoNotCoverThePicture",
              [] { metrics::enlarge_blocks(Image(2, 2), 4, 9, 8); }, {"cover"}),
      refuses("EnlargeBlocks", "ToANegativeSize", [] { metrics::enlarge_blocks(Image(2, 2), 4, -8, 8); },
              {"cover"}),
      refuses("HeatMap", "OfTwoChannels", [] { metrics::heat_map(two_channels(), metrics::ColorRamp::grey); },
              {"1, 3 or 4"}),
      refuses("HeatMap", "OfAScaleThatIsNoNumber",
              [] { metrics::heat_map(Image(2, 2), metrics::ColorRamp::grey, nan); }, {"scale"}),
      gives("RampColor", "OfNoNumber",
            [] { EXPECT_EQ(metrics::ramp_color(metrics::ColorRamp::inferno, nan), vec3(1, 0, 1)); }),
      refuses("AutomaticScale", "OfATornImage", [] { metrics::automatic_scale(torn_image()); },
              {"number of pixels"}),
      refuses("Masked", "ByAnEmptyMask", [] { metrics::masked(Image(2, 2), Image()); }, {"mask", "empty"}),
      refuses("InMask", "BesideThePicture", [] { metrics::in_mask(Image(2, 2), 4, 0, 4, 4); },
              {"mask", "lie"}),
      refuses("PixelsOutside", "AnEmptyMask", [] { metrics::pixels_outside(Image(), 4, 4); }, {"empty"}),
      refuses("Flip", "OfATornImage", [] { metrics::flip(Image(4, 4), torn_image()); }, {"number of pixels"}),
      refuses("Flip", "AtNoPixelsPerDegree", [] { metrics::flip(Image(4, 4), Image(4, 4), {0}); },
              {"pixels per degree"}),
      refuses("HdrFlip", "AtPixelsPerDegreeThatAreNoNumber",
              [] { metrics::hdr_flip(Image(4, 4), Image(4, 4), {double(nan)}); }, {"pixels per degree"}),
      refuses("DisplayError", "OfTwoSizes", [] { metrics::display_error(Image(4, 2), Image(2, 4)); },
              {"sizes differ"}),
  };
}

SSPHH_CONTRACTS(Core, of_core());
SSPHH_CONTRACTS(Image, of_images());
SSPHH_CONTRACTS(Metrics, of_metrics());

}  // namespace
}  // namespace ssphh::test
