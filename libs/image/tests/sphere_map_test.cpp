#include <cmath>
#include <tuple>

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <ssphh/image/cube_layout.h>
#include <ssphh/image/sphere_map.h>

#include "test_images.h"

namespace ssphh::image {
namespace {

// Single-precision directions and coordinates: a few rounding steps of numbers up to 1 (places) and π
// (angles).
constexpr float tolerance = 1e-5f;

void expect_near(const vec3& a, const vec3& b, float within = tolerance) {
  EXPECT_LT(glm::length(a - b), within)
      << a.x << " " << a.y << " " << a.z << " against " << b.x << " " << b.y << " " << b.z;
}

TEST(Equirect, LooksAlongTheNamedAxes) {
  expect_near(equirect_direction(0.5f, 0.5f), {1, 0, 0});
  expect_near(equirect_direction(0.75f, 0.5f), {0, 0, 1});
  expect_near(equirect_direction(0.25f, 0.5f), {0, 0, -1});
  expect_near(equirect_direction(0.0f, 0.5f), {-1, 0, 0});
  expect_near(equirect_direction(1.0f, 0.5f), {-1, 0, 0});
  expect_near(equirect_direction(0.3f, 0.0f), {0, 1, 0});
  expect_near(equirect_direction(0.3f, 1.0f), {0, -1, 0});
}

TEST(Equirect, PlaceAndDirectionAreInverse) {
  for (int i = 0; i < 500; ++i) {
    const vec3 d = spherical_fibonacci(i, 500);
    const vec2 uv = equirect_uv(3.0f * d);
    expect_near(equirect_direction(uv.x, uv.y), d);
  }
  EXPECT_EQ(equirect_uv({0, 1, 0}), vec2(0.5f, 0));
  EXPECT_EQ(equirect_uv({0, -2, 0}), vec2(0.5f, 1));
}

TEST(Equirect, SolidAnglesAreExact) {
  for (const int height : {1, 2, 7, 512, 2048}) {
    double sum = 0;
    for (int y = 0; y < height; ++y) sum += 2 * height * equirect_solid_angle(y, 2 * height, height);
    EXPECT_NEAR(sum, 4 * pi_d, 1e-12 * 4 * pi_d * height) << height;  // rounding of `height` terms
  }
  // The cap of 45° around the pole: 2π(1 − cos 45°).
  EXPECT_NEAR(equirect_solid_angle(0, 1, 4), 2 * pi_d * (1 - std::sqrt(0.5)), 1e-14);
}

TEST(Angular, LooksForwardAlongMinusZ) {
  expect_near(*angular_direction(0.5f, 0.5f), {0, 0, -1});
  expect_near(*angular_direction(0.75f, 0.5f), {1, 0, 0});
  expect_near(*angular_direction(0.5f, 0.25f), {0, 1, 0});
  expect_near(*angular_direction(1.0f, 0.5f), {0, 0, 1});
  EXPECT_FALSE(angular_direction(0.99f, 0.99f));
}

TEST(Angular, PlaceAndDirectionAreInverse) {
  for (int i = 0; i < 500; ++i) {
    const vec3 d = spherical_fibonacci(i, 500);
    const vec2 uv = angular_uv(3.0f * d);
    const auto back = angular_direction(uv.x, uv.y);
    ASSERT_TRUE(back);
    expect_near(*back, d);
  }
}

TEST(Angular, SolidAnglesSumToTheSphere) {
  for (const int size : {1, 2, 3, 8, 65, 300}) {
    double sum = 0;
    for (int y = 0; y < size; ++y) {
      for (int x = 0; x < size; ++x) sum += angular_solid_angle(x, y, size);
    }
    // On the whole image only the outer boundary remains, where the formula is exact; rounding of size² terms
    // is left.
    EXPECT_NEAR(sum, 4 * pi_d, 1e-12 * size * size + 1e-11) << size;
  }
}

TEST(Angular, SolidAnglesMatchBruteForce) {
  constexpr int size = 9, fine = 400;
  for (const auto& [x, y] : {std::pair{4, 4}, {6, 3}, {0, 3}, {7, 7}, {1, 1}, {0, 0}, {8, 4}, {4, 0}}) {
    // ∫ sin(πr)/r · π dA by the midpoint rule.
    double sum = 0;
    for (int j = 0; j < fine; ++j) {
      for (int i = 0; i < fine; ++i) {
        const double px = 2 * (x + (i + 0.5) / fine) / size - 1, py = 2 * (y + (j + 0.5) / fine) / size - 1;
        const double r = std::hypot(px, py);
        if (r < 1) sum += pi_d * std::sin(pi_d * r) / r * 4.0 / (size * size * fine * fine);
      }
    }
    // The midpoint rule's error: the disc's edge, where the integrand vanishes, and its curvature over
    // 1/3600.
    EXPECT_NEAR(angular_solid_angle(x, y, size), sum, 1e-5) << x << ", " << y;
  }
}

TEST(SampleEquirect, IsBilinearAndWraps) {
  Image image(8, 4);
  for (int y = 0; y < 4; ++y) {
    for (int x = 0; x < 8; ++x) image.set_rgb(x, y, vec3(static_cast<float>(8 * y + x)));
  }
  EXPECT_NEAR(sample_equirect(image, equirect_direction(3.5f / 8, 1.5f / 4)).x, 11, 1e-4f);
  EXPECT_NEAR(sample_equirect(image, equirect_direction(4.0f / 8, 2.0f / 4)).x, 0.25f * (11 + 12 + 19 + 20),
              1e-4f);
  EXPECT_NEAR(sample_equirect(image, equirect_direction(0.0f, 1.5f / 4)).x, 0.5f * (8 + 15), 1e-4f);
  EXPECT_NEAR(sample_equirect(image, equirect_direction(0.25f / 8, 1.5f / 4)).x, 0.75f * 8 + 0.25f * 15,
              1e-4f);
  EXPECT_NEAR(sample_equirect(image, equirect_direction(7.75f / 8, 1.5f / 4)).x, 0.25f * 8 + 0.75f * 15,
              1e-4f);
  // At the pole: the mean of the pixel and the one half a turn away.
  EXPECT_NEAR(sample_equirect(image, {0, 1, 0}).x, 0.25f * (3 + 4 + 7 + 0), 1e-4f);
}

TEST(SampleEquirect, LeadsOverThePolesToTheOtherSide) {
  // One bright pixel in the first row and one in the last, a quarter of a turn apart.
  Image image(8, 4);
  image.set_rgb(2, 0, vec3(1, 2, 4)), image.set_rgb(4, 3, vec3(8, 16, 32));
  // A quarter of a pixel from the pole: a quarter of the weight lies half a turn away.
  const float v = 0.25f / 4;
  expect_near(sample_equirect(image, equirect_direction(2.5f / 8, v)), 0.75f * vec3(1, 2, 4));
  expect_near(sample_equirect(image, equirect_direction(6.5f / 8, v)), 0.25f * vec3(1, 2, 4));
  expect_near(sample_equirect(image, equirect_direction(4.5f / 8, 1 - v)), 0.75f * vec3(8, 16, 32), 1e-4f);
  expect_near(sample_equirect(image, equirect_direction(0.5f / 8, 1 - v)), 0.25f * vec3(8, 16, 32), 1e-4f);
}

TEST(SampleAngular, NeverMixesInWhatLiesOutsideTheDisc) {
  for (int size = 2; size < 40; ++size) {
    Image image(size, size);
    for (int y = 0; y < size; ++y) {
      for (int x = 0; x < size; ++x) {
        const double px = (2.0 * x + 1) / size - 1, py = (2.0 * y + 1) / size - 1;
        image.set_rgb(x, y, px * px + py * py <= 1 ? vec3(1, 2, 3) : vec3(1000));
      }
    }
    for (int i = 0; i < 4000; ++i) {
      // Close to the edge.
      const float turn = 2 * pi * static_cast<float>(i) / 4000,
                  r = 0.9999f - 0.05f * static_cast<float>(i % 7);
      const auto d = angular_direction(0.5f + 0.5f * r * std::cos(turn), 0.5f + 0.5f * r * std::sin(turn));
      ASSERT_TRUE(d);
      expect_near(sample_angular(image, *d), vec3(1, 2, 3));
    }
  }
}

TEST(SampleCube, IsContinuousAcrossEveryEdgeAndCorner) {
  CubeMap cube(4);
  for (std::size_t face = 0; face < 6; ++face) cube.faces[face] = test::noise_image(4, 4, 3, 1, face + 1);
  // On both sides of an edge: texels are 1/2 apart and differ by at most √3, in two directions, so the slope
  // is below 4√3; a step over the edge changes the value by little more than slope·step.
  constexpr float step = 1e-4f;
  for (int face = 0; face < 6; ++face) {
    for (int i = 0; i <= 200; ++i) {
      const float along = static_cast<float>(i) / 200;
      for (const auto& [s, t, out] : {std::tuple{along, 0.0f, vec2(0, -1)},
                                      {along, 1.0f, vec2(0, 1)},
                                      {0.0f, along, vec2(-1, 0)},
                                      {1.0f, along, vec2(1, 0)}}) {
        const vec3 inside = cube_direction_unnormalized({face, s - step * out.x, t - step * out.y});
        const vec3 outside = cube_direction_unnormalized({face, s + step * out.x, t + step * out.y});
        EXPECT_LT(glm::length(sample_cube(cube, inside) - sample_cube(cube, outside)),
                  2 * 4 * 1.74f * 2 * step)
            << face << ": " << s << ", " << t;
      }
    }
  }
}

TEST(SampleCube, GivesTexelsAtTheirCentres) {
  CubeMap cube(5);
  for (std::size_t face = 0; face < 6; ++face) cube.faces[face] = test::noise_image(5, 5, 3, 1, face + 1);
  for (int face = 0; face < 6; ++face) {
    for (int y = 0; y < 5; ++y) {
      for (int x = 0; x < 5; ++x) {
        expect_near(sample_cube(cube, texel_direction(face, x, y, 5)), cube.faces[face].rgb(x, y));
      }
    }
  }
}

}  // namespace
}  // namespace ssphh::image
