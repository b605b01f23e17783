#include <cmath>

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <ssphh/core/parallel.h>
#include <ssphh/image/cube_layout.h>
#include <ssphh/image/io.h>
#include <ssphh/image/sphere_map.h>

#include "error_message.h"
#include "shared_scenes.h"
#include "test_images.h"

namespace ssphh::image {
namespace {

using dvec3 = glm::dvec3;

constexpr std::array cube_layouts{Layout::strip_h, Layout::strip_v, Layout::cross_h, Layout::cross_v};
constexpr std::array all_layouts{Layout::equirect, Layout::strip_h, Layout::strip_v,
                                 Layout::cross_h,  Layout::cross_v, Layout::angular};

CubeMap noise_cube(int size, int channels = 3) {
  CubeMap cube(size, channels);
  for (std::size_t face = 0; face < 6; ++face)
    cube.faces[face] = test::noise_image(size, size, channels, 1, face + 1);
  return cube;
}

// ∫ L dω of an image in any layout, by its exact pixel solid angles.
dvec3 energy(const Image& image, Layout layout) {
  dvec3 sum(0);
  if (is_cube_layout(layout)) {
    const CubeMap cube = to_cube(image, layout);
    for (const Image& face : cube.faces) {
      for (int y = 0; y < cube.size; ++y) {
        for (int x = 0; x < cube.size; ++x) sum += texel_solid_angle(x, y, cube.size) * dvec3(face.rgb(x, y));
      }
    }
    return sum;
  }
  for (int y = 0; y < image.height; ++y) {
    for (int x = 0; x < image.width; ++x) {
      const double solid_angle = layout == Layout::equirect
                                     ? equirect_solid_angle(y, image.width, image.height)
                                     : angular_solid_angle(x, y, image.height);
      sum += solid_angle * dvec3(image.rgb(x, y));
    }
  }
  return sum;
}

// A smooth field with a different slope along each axis.
vec3 smooth_field(const vec3& d) {
  return {1 + d.x, 1 + 0.5f * d.y * d.z, std::exp(d.z)};
}

CubeMap smooth_cube(int size) {
  CubeMap cube(size);
  for (int face = 0; face < 6; ++face) {
    for (int y = 0; y < size; ++y) {
      for (int x = 0; x < size; ++x) {
        cube.faces[face].set_rgb(x, y, smooth_field(texel_direction(face, x, y, size)));
      }
    }
  }
  return cube;
}

TEST(CubeLayout, NamesAndShapesAreRecognised) {
  for (const Layout layout : all_layouts) EXPECT_EQ(parse_enum<Layout>(name_of(layout)), layout);
  EXPECT_THAT(ssphh::test::message_of([] { enum_named<Layout>("layout", "cross"); }),
              testing::HasSubstr("cross-h"));
  EXPECT_EQ(layout_size(Image(24, 4), Layout::strip_h), 4);
  EXPECT_EQ(layout_size(Image(4, 24), Layout::strip_v), 4);
  EXPECT_EQ(layout_size(Image(16, 12), Layout::cross_h), 4);
  EXPECT_EQ(layout_size(Image(12, 16), Layout::cross_v), 4);
  EXPECT_EQ(layout_size(Image(12, 6), Layout::equirect), 6);
  EXPECT_EQ(layout_size(Image(5, 5), Layout::angular), 5);
  EXPECT_THAT(ssphh::test::message_of([] { layout_size(Image(16, 13), Layout::cross_h); }),
              testing::HasSubstr("4 : 3"));
  EXPECT_THROW(layout_size(Image(6, 4), Layout::angular), Error);
}

TEST(CubeLayout, StripsAndCrossesAreEachOthersPermutations) {
  for (const int channels : {1, 3, 4}) {
    const CubeMap cube = noise_cube(5, channels);
    for (const Layout from : cube_layouts) {
      const Image image = from_cube(cube, from);
      for (const Layout to : cube_layouts) {
        const CubeMap back = to_cube(convert_layout(image, from, to), to);
        for (std::size_t face = 0; face < 6; ++face)
          EXPECT_EQ(back.faces[face].pixels, cube.faces[face].pixels);
      }
    }
  }
}

TEST(CubeLayout, CellsThatTouchInACrossTouchOnTheCube) {
  // Neighbouring pixels of a cross look in neighbouring directions, also across cell borders.
  constexpr int size = 16;
  CubeMap directions(size);
  for (int face = 0; face < 6; ++face) {
    for (int y = 0; y < size; ++y) {
      for (int x = 0; x < size; ++x) {
        directions.faces[face].set_rgb(x, y, texel_direction(face, x, y, size));
      }
    }
  }
  for (const Layout layout : {Layout::cross_h, Layout::cross_v}) {
    const Image image = from_cube(directions, layout);
    int pairs = 0;
    for (int y = 0; y < image.height; ++y) {
      for (int x = 0; x < image.width; ++x) {
        for (const auto& [nx, ny] : {std::pair{x + 1, y}, {x, y + 1}}) {
          if (nx >= image.width || ny >= image.height) continue;
          const vec3 a = image.rgb(x, y), b = image.rgb(nx, ny);
          if (a == vec3(0) || b == vec3(0)) continue;
          ++pairs;
          EXPECT_LT(glm::length(a - b), 2.01f / size) << x << ", " << y;
        }
      }
    }
    EXPECT_EQ(pairs, 6 * 2 * size * (size - 1) + 5 * size);  // within faces, and across five borders
  }
}

TEST(CubeLayout, TheNegativeZFaceOfTheVerticalCrossIsTurned) {
  const CubeMap cube = noise_cube(3);
  const Image cross = from_cube(cube, Layout::cross_v);
  EXPECT_EQ(cross.rgb(3, 9), cube.faces[5].rgb(2, 2));
  EXPECT_EQ(cross.rgb(5, 11), cube.faces[5].rgb(0, 0));
  EXPECT_EQ(cross.rgb(3, 0), cube.faces[2].rgb(0, 0));
}

TEST(CubeLayout, EveryWayKeepsASmoothField) {
  constexpr int size = 32;
  const CubeMap cube = smooth_cube(size);
  for (const Layout from : all_layouts) {
    const Image image = from_cube(cube, from);
    for (const Layout to : all_layouts) {
      const CubeMap back = to_cube(convert_layout(image, from, to), to, size);
      float worst = 0;
      for (std::size_t face = 0; face < 6; ++face) {
        for (std::size_t i = 0; i < back.faces[face].pixels.size(); ++i) {
          worst = std::max(worst, std::abs(back.faces[face].pixels[i] - cube.faces[face].pixels[i]));
        }
      }
      // Bilinear interpolation and averaging err by curvature × texel²: |f''| ≤ e, texels of 1/16, up to
      // three steps; a wrong orientation errs by more than 1.
      EXPECT_LT(worst, 0.02f) << name_of(from) << " to " << name_of(to);
    }
  }
}

TEST(CubeLayout, AConstantStaysConstant) {
  CubeMap cube(8);
  for (Image& face : cube.faces) std::fill(face.pixels.begin(), face.pixels.end(), 0.7f);
  for (const int size : {0, 3, 50}) {
    for (const Layout layout : all_layouts) {
      const Image image = from_cube(cube, layout, size);
      int lit = 0;
      float worst = 0;
      for (int y = 0; y < image.height; ++y) {
        for (int x = 0; x < image.width; ++x) {
          const float value = image.rgb(x, y).x;
          lit += value != 0;
          worst = std::max(worst, value != 0 ? std::abs(value - 0.7f) : 0.0f);
        }
      }
      EXPECT_LT(worst, 1e-5f) << name_of(layout);  // float sums of up to 40² samples
      // All but the empty half of a cross and what lies outside the disc (1 − π/4).
      EXPECT_GE(2 * lit, image.width * image.height) << name_of(layout);
    }
  }
}

TEST(CubeLayout, NoLightIsLostOrGained) {
  // Noise is the hardest content: every texel differs. Means over texels err in the quadrature of the
  // bilinear tents.
  const CubeMap cube = noise_cube(24);
  const Image strip = from_cube(cube, Layout::strip_h);
  const dvec3 expected = energy(strip, Layout::strip_h);
  for (const Layout to : all_layouts) {
    for (const int size : {0, 8, 96}) {
      const dvec3 got = energy(convert_layout(strip, Layout::strip_h, to, size), to);
      EXPECT_LT(glm::length(got - expected), 2e-4 * glm::length(expected)) << name_of(to) << " " << size;
    }
  }
}

TEST(CubeLayout, ASunOfOnePixelKeepsItsEnergy) {
  Image sky(128, 64);
  for (const auto& [x, y] : {std::pair{40, 20}, {64, 32}, {3, 50}, {100, 8}}) {
    std::fill(sky.pixels.begin(), sky.pixels.end(), 0.0f);
    sky.set_rgb(x, y, vec3(1e5f));
    const double expected = energy(sky, Layout::equirect).x;
    for (const Layout to : {Layout::strip_h, Layout::angular, Layout::equirect}) {
      for (const int size : {16, 32, 100}) {
        const double got = energy(convert_layout(sky, Layout::equirect, to, size), to).x;
        // The quadrature of one tent with 9 samples per pixel, at any phase: up to 2 % seen.
        EXPECT_NEAR(got / expected, 1, 0.03) << name_of(to) << " " << size << " at " << x << ", " << y;
      }
    }
  }
}

TEST(CubeLayout, IsTheSameForAnyNumberOfThreads) {
  const CubeMap cube = noise_cube(12);
  set_thread_count(1);
  const Image one = from_cube(cube, Layout::equirect);
  set_thread_count(4);
  const Image four = from_cube(cube, Layout::equirect);
  set_thread_count(0);
  EXPECT_EQ(one.pixels, four.pixels);
}

/// L = the direction itself.
CubeMap direction_cube(int size) {
  CubeMap cube(size);
  for (int f = 0; f < 6; ++f)
    for (int y = 0; y < size; ++y)
      for (int x = 0; x < size; ++x) cube.faces[f].set_rgb(x, y, texel_direction(f, x, y, size));
  return cube;
}

TEST(CubeLayout, WhatIsMirroredInTheCubeIsMirroredInAnEquirect) {
  // Few samples a pixel, so that places aside of the middle would show; 1e-5 is rounding.
  const Image image = from_cube(direction_cube(8), Layout::equirect, 8);
  for (int y = 0; y < 8; ++y) {
    for (int x = 0; x < 16; ++x) {
      const vec3 here = image.rgb(x, y);
      EXPECT_LT(glm::distance(here, image.rgb(15 - x, y) * vec3(1, 1, -1)), 1e-5f) << x << ' ' << y;
      EXPECT_LT(glm::distance(here, image.rgb(x, 7 - y) * vec3(1, -1, 1)), 1e-5f) << x << ' ' << y;
    }
  }
}

TEST(CubeLayout, APixelOfAnEquirectIsTheMeanOverItsSolidAngle) {
  // Over a pixel from (u0, v0), a 16th of a turn wide and an 8th of half a turn
  // high, x is ∫ sin² θ dθ ∫ cos φ dφ over ∫ sin θ dθ ∫ dφ; z has sin φ, and y ∫ sin θ cos θ dθ.
  const Image image = from_cube(direction_cube(64), Layout::equirect, 8);
  for (int y = 0; y < 8; ++y) {
    for (int x = 0; x < 16; ++x) {
      const double t0 = pi_d * y / 8, t1 = pi_d * (y + 1) / 8;
      const double p0 = 2 * pi_d * (x / 16.0 - 0.5), p1 = 2 * pi_d * ((x + 1) / 16.0 - 0.5);
      const double squares = (t1 - t0) / 2 - (std::sin(2 * t1) - std::sin(2 * t0)) / 4;
      const double all = (std::cos(t0) - std::cos(t1)) * (p1 - p0);
      const glm::dvec3 mean(squares * (std::sin(p1) - std::sin(p0)),
                            (std::sin(t1) * std::sin(t1) - std::sin(t0) * std::sin(t0)) / 2 * (p1 - p0),
                            squares * (std::cos(p0) - std::cos(p1)));
      // 2e-3: texels of 1.4°, interpolated, and the midpoint rule of a few samples each way.
      EXPECT_LT(glm::distance(glm::dvec3(image.rgb(x, y)), mean / all), 2e-3) << x << ' ' << y;
    }
  }
}

TEST(SphereMean, IsNotThePixelMean) {
  // L = 1 + sin²θ·3 has the sphere mean 1 + 3·2/3 = 3; over pixels, sin² averages to 1/2: 2.5.
  constexpr int height = 256;
  Image image(2 * height, height);
  double pixel_sum = 0;
  for (int y = 0; y < height; ++y) {
    const float s = std::sin(pi * (static_cast<float>(y) + 0.5f) / height);
    for (int x = 0; x < 2 * height; ++x) image.set_rgb(x, y, vec3(1 + 3 * s * s));
    pixel_sum += 1 + 3.0 * double{s} * double{s};
  }
  EXPECT_NEAR(pixel_sum / height, 2.5, 1e-6);                            // exact for the midpoint rule
  EXPECT_NEAR(energy(image, Layout::equirect).x / (4 * pi_d), 3, 1e-4);  // midpoint values: O(1/height²)
  const Image cube = convert_layout(image, Layout::equirect, Layout::strip_h);
  EXPECT_NEAR(energy(cube, Layout::strip_h).x / (4 * pi_d), 3, 1e-3);
}

TEST(CubeOfViews, MirrorsEachPictureAndRefusesWhatIsNoFace) {
  std::vector<Image> pictures;
  for (int f = 0; f < 6; ++f) {
    Image& picture = pictures.emplace_back(2, 2, f == 3 ? 4 : 3);
    for (int y = 0; y < 2; ++y)
      for (int x = 0; x < 2; ++x) picture.set_rgb(x, y, vec3(f, x, y));
  }
  const CubeMap cube = cube_of_views(pictures);
  EXPECT_EQ(cube.size, 2);
  for (int f = 0; f < 6; ++f)
    for (int y = 0; y < 2; ++y)
      for (int x = 0; x < 2; ++x) EXPECT_EQ(cube.faces[f].rgb(x, y), vec3(f, 1 - x, y));
  for (const Image& wrong : {Image(2, 3, 3), Image(3, 3, 3), Image(2, 2, 1)}) {
    std::vector<Image> others = pictures;
    others[5] = wrong;
    EXPECT_THROW(cube_of_views(others), Error);
  }
  pictures.pop_back();
  EXPECT_THROW(cube_of_views(pictures), Error);
}

}  // namespace
}  // namespace ssphh::image
