#include <cmath>

#include <gtest/gtest.h>

#include <ssphh/core/sphere.h>

namespace ssphh {
namespace {

TEST(Sphere, TexelSolidAnglesSumToTheSphere) {
  for (const int size : {1, 2, 7, 64}) {
    double sum = 0;
    for (int y = 0; y < size; ++y) {
      for (int x = 0; x < size; ++x) sum += 6 * texel_solid_angle(x, y, size);
    }
    EXPECT_NEAR(sum, 4 * pi_d, 1e-10) << "size " << size;
  }
}

TEST(Sphere, FaceCentresPointAlongTheAxesInStorageOrder) {
  const vec3 axes[] = {{1, 0, 0}, {-1, 0, 0}, {0, 1, 0}, {0, -1, 0}, {0, 0, 1}, {0, 0, -1}};
  for (int face = 0; face < 6; ++face) EXPECT_EQ(cube_direction({face, 0.5f, 0.5f}), axes[face]);
}

// OpenGL 4.5 core specification, table 8.19: sc and tc per face.
TEST(Sphere, FacesHaveOpenGlOrientation) {
  const vec3 right[] = {{0, 0, -1}, {0, 0, 1}, {1, 0, 0}, {1, 0, 0}, {1, 0, 0}, {-1, 0, 0}};
  const vec3 down[] = {{0, -1, 0}, {0, -1, 0}, {0, 0, 1}, {0, 0, -1}, {0, -1, 0}, {0, -1, 0}};
  for (int face = 0; face < 6; ++face) {
    const vec3 centre = cube_direction_unnormalized({face, 0.5f, 0.5f});
    EXPECT_EQ(cube_direction_unnormalized({face, 1.0f, 0.5f}) - centre, right[face]) << "face " << face;
    EXPECT_EQ(cube_direction_unnormalized({face, 0.5f, 1.0f}) - centre, down[face]) << "face " << face;
  }
}

TEST(Sphere, CubePointInvertsCubeDirection) {
  for (int i = 0; i < 1000; ++i) {
    const vec3 d = spherical_fibonacci(i, 1000);
    const CubePoint p = cube_point(d);
    EXPECT_GE(p.s, 0);
    EXPECT_LE(p.s, 1);
    EXPECT_GE(p.t, 0);
    EXPECT_LE(p.t, 1);
    EXPECT_LT(glm::length(cube_direction(p) - d), 3e-7f);  // a few roundings of unit-size floats
  }
}

TEST(Sphere, FibonacciPointsTurnByTheGoldenRatioFromTheTopDown) {
  // Point i of 5 lies at z = 1 - (2 i + 1) / 5, turned by i of the golden ratio's turns from +x toward +y.
  for (int i = 0; i < 5; ++i) {
    const double z = 1 - (2.0 * i + 1) / 5, turn = 2 * pi_d * i * (std::sqrt(5.0) + 1) / 2;
    const glm::dvec3 point(std::sqrt(1 - z * z) * std::cos(turn), std::sqrt(1 - z * z) * std::sin(turn), z);
    EXPECT_LT(glm::distance(glm::dvec3(spherical_fibonacci(i, 5)), point), 1e-6)
        << "float rounding; point " << i;
  }
}

TEST(Sphere, FibonacciPointsIntegrateLowPolynomials) {
  const int n = 1024;
  double first = 0, second = 0, height = 0;
  for (int i = 0; i < n; ++i) {
    const vec3 d = spherical_fibonacci(i, n);
    EXPECT_NEAR(glm::length(d), 1, 1e-6);
    first += d.x + d.y + d.z;
    height += d.z;
    second += d.x * d.x;
  }
  EXPECT_NEAR(first / n, 0, 1e-3);
  EXPECT_NEAR(height / n, 0, 1e-7) << "as many above as below: only rounding to floats is left";
  EXPECT_NEAR(second / n, 1.0 / 3, 1e-3);
}

TEST(Sphere, UnitCircleFollowsSineAndCosine) {
  double worst = 0;
  for (int i = 0; i <= 100000; ++i) {
    const float t = static_cast<float>(i) / 100000;
    const vec2 p = unit_circle(t);
    const double angle = 2 * pi_d * static_cast<double>(t);
    worst = std::max(worst, std::abs(static_cast<double>(p.x) - std::cos(angle)));
    worst = std::max(worst, std::abs(static_cast<double>(p.y) - std::sin(angle)));
  }
  EXPECT_LT(worst, 2e-7);
}

TEST(Sphere, FrameIsRightHandedAndOrthonormal) {
  for (int i = 0; i < 100; ++i) {
    const vec3 n = spherical_fibonacci(i, 100);
    const Frame f = Frame::around(n);
    EXPECT_LT(glm::length(glm::cross(f.x, f.y) - f.z), 1e-6f);
    EXPECT_LT(glm::length(f.to_world(f.to_local({1, 2, 3})) - vec3(1, 2, 3)), 2e-6f);
  }
}

}  // namespace
}  // namespace ssphh
