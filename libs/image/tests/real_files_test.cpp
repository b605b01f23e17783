// Files made by others, from the folder of real scenes.

#include <cmath>
#include <functional>

#include <gtest/gtest.h>

#include <ssphh/image/cube_layout.h>
#include <ssphh/image/io.h>
#include <ssphh/image/resample.h>
#include <ssphh/image/sphere_map.h>

#include "shared_scenes.h"

namespace ssphh::image {
namespace {

using dvec3 = glm::dvec3;

// Mean over channels and pixels of |a − b|.
double difference(const Image& a, const Image& b) {
  EXPECT_EQ(a.pixels.size(), b.pixels.size());
  double sum = 0;
  for (std::size_t i = 0; i < a.pixels.size(); ++i)
    sum += std::abs(double{a.pixels[i]} - double{b.pixels[i]});
  return sum / static_cast<double>(a.pixels.size());
}

// Pixel (x, y) of the result is pixel `source(x, y)` of the image; colours only.
Image rearrange(const Image& image, const std::function<std::pair<int, int>(int, int)>& source) {
  Image out(image.width, image.height);
  for (int y = 0; y < image.height; ++y) {
    for (int x = 0; x < image.width; ++x) {
      const auto [sx, sy] = source(x, y);
      out.set_rgb(x, y, image.rgb(sx, sy));
    }
  }
  return out;
}

// OpenEXR's latitude-longitude maps (ImfEnvmap.h) look along +z in the centre and have +x at u = 0.25: ours,
// a quarter of a turn further right.
Image from_openexr_latlong(const Image& image) {
  const int width = image.width;
  return rearrange(image, [&](int x, int y) { return std::pair{(x + width - width / 4) % width, y}; });
}

// OpenEXR's cube maps are vertical strips of faces seen from inside: OpenGL's faces mirrored, ±X and ±Z left
// to right, ±Y top to bottom.
CubeMap from_openexr_cube(const Image& image) {
  CubeMap cube = to_cube(image, Layout::strip_v);
  for (std::size_t face = 0; face < 6; ++face) {
    const bool vertical = face == 2 || face == 3;
    const int last = cube.size - 1;
    cube.faces[face] = rearrange(cube.faces[face], [&](int x, int y) {
      return vertical ? std::pair{x, last - y} : std::pair{last - x, y};
    });
  }
  return cube;
}

TEST(OrientationCharts, ShowTheSameAxesInBothLayouts) {
  SSPHH_SHARED_SCENE(latlong_path, "hdr/OrientationLatLong.exr");
  SSPHH_SHARED_SCENE(cube_path, "hdr/OrientationCube.exr");
  constexpr int size = 32;
  const auto as_strip = [](const Image& equirect) {
    return convert_layout(equirect, Layout::equirect, Layout::strip_v, size);
  };
  const Image latlong = read_image(latlong_path);
  const CubeMap cube = from_openexr_cube(read_image(cube_path));
  CubeMap small(size);
  for (std::size_t face = 0; face < 6; ++face) small.faces[face] = resize(cube.faces[face], size, size);
  const Image expected = from_cube(small, Layout::strip_v);

  const double right = difference(as_strip(from_openexr_latlong(latlong)), expected);
  const int width = latlong.width;
  const double not_turned = difference(as_strip(rearrange(latlong,
                                                          [](int x, int y) {
                                                            return std::pair{x, y};
                                                          })),
                                       expected);
  const double mirrored = difference(as_strip(rearrange(from_openexr_latlong(latlong),
                                                        [&](int x, int y) {
                                                          return std::pair{width - 1 - x, y};
                                                        })),
                                     expected);
  // What is left is half a pixel: OpenEXR's outermost pixel centres lie on the edges.
  EXPECT_LT(right, 0.25 * not_turned);
  EXPECT_LT(right, 0.25 * mirrored);
}

TEST(RealExr, EveryCompressionAndTypeIsRead) {
  SSPHH_SHARED_SCENE(folder, "hdr");
  for (const std::string name : {"example_piz", "example_rle", "example_tiles", "example_zip", "memorial",
                                 "OrientationCube", "OrientationLatLong"}) {
    const Image image = read_image(folder / (name + ".exr"));
    double sum = 0;
    for (const float x : image.pixels) sum += double{x};
    EXPECT_GT(sum, 0) << name;
    EXPECT_TRUE(std::isfinite(sum)) << name;
  }
}

TEST(RealExr, EveryHalfIsThere) {
  // An image of all 65,536 half-precision numbers: 2·2¹⁰ of them are infinite or NaN.
  SSPHH_SHARED_SCENE(path, "hdr/example_halfs.exr");
  const Image image = read_image(path);
  int nonfinite = 0;
  for (int y = 0; y < image.height; ++y) {
    for (int x = 0; x < image.width; ++x) nonfinite += is_finite(image.rgb(x, y)) ? 0 : 1;
  }
  EXPECT_EQ(image.width * image.height, 65536);
  EXPECT_EQ(nonfinite, 2048);
}

TEST(RealHdr, SphereMeanIsNotPixelMeanAndSurvivesConversion) {
  SSPHH_SHARED_SCENE(path, "hdr/venice_sunset_1k.hdr");
  const Image image = read_image(path);
  ASSERT_EQ(image.width, 1024);
  ASSERT_EQ(image.height, 512);
  dvec3 sphere(0), pixel(0);
  for (int y = 0; y < image.height; ++y) {
    const double solid_angle = equirect_solid_angle(y, image.width, image.height);
    for (int x = 0; x < image.width; ++x) {
      sphere += solid_angle * dvec3(image.rgb(x, y));
      pixel += dvec3(image.rgb(x, y));
    }
  }
  sphere /= 4 * pi_d;
  pixel /= static_cast<double>(image.width) * image.height;
  EXPECT_GT(std::abs(sphere.x / pixel.x - 1), 0.02);

  const CubeMap cube = to_cube(image, Layout::equirect, 64);
  dvec3 mean(0);
  for (const Image& face : cube.faces) {
    for (int y = 0; y < cube.size; ++y) {
      for (int x = 0; x < cube.size; ++x)
        mean += texel_solid_angle(x, y, cube.size) / (4 * pi_d) * dvec3(face.rgb(x, y));
    }
  }
  // The sun's few pixels hold a good part of the light: the quadrature of single tents shows (2 %).
  for (int c = 0; c < 3; ++c) EXPECT_NEAR(mean[c] / sphere[c], 1, 0.01) << c;
}

TEST(RealHdr, WritingAndReadingAgainChangesNothing) {
  SSPHH_SHARED_SCENE(path, "hdr/studio_small_03_1k.hdr");
  const Image image = read_image(path);
  // Files may hold mantissas below 128, which are normalised; the numbers stay.
  EXPECT_EQ(decode_image(encode_hdr(image), "memory").pixels, image.pixels);
}

}  // namespace
}  // namespace ssphh::image
