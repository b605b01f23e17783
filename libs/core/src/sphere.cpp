
#include <ssphh/core/require.h>
#include <ssphh/core/sphere.h>

namespace ssphh {

vec3 cube_direction_unnormalized(const CubePoint& point) {
  const float s = 2 * point.s - 1, t = 2 * point.t - 1;
  switch (static_cast<CubeFace>(point.face)) {
    case CubeFace::positive_x:
      return {1, -t, -s};
    case CubeFace::negative_x:
      return {-1, -t, s};
    case CubeFace::positive_y:
      return {s, 1, t};
    case CubeFace::negative_y:
      return {s, -1, -t};
    case CubeFace::positive_z:
      return {s, -t, 1};
    case CubeFace::negative_z:
      return {-s, -t, -1};
  }
  refuse("cube map", "its faces are 0..5");
}

vec3 cube_direction(const CubePoint& point) {
  return glm::normalize(cube_direction_unnormalized(point));
}

CubePoint cube_point(const vec3& d) {
  const vec3 a = glm::abs(d);
  int face;
  float s, t, major;
  if (a.x >= a.y && a.x >= a.z) {
    face = d.x > 0 ? 0 : 1, s = d.x > 0 ? -d.z : d.z, t = -d.y, major = a.x;
  } else if (a.y >= a.z) {
    face = d.y > 0 ? 2 : 3, s = d.x, t = d.y > 0 ? d.z : -d.z, major = a.y;
  } else {
    face = d.z > 0 ? 4 : 5, s = d.z > 0 ? d.x : -d.x, t = -d.y, major = a.z;
  }
  return {face, 0.5f * (s / major + 1), 0.5f * (t / major + 1)};
}

vec3 texel_direction(int face, int x, int y, int size) {
  const float scale = 1.0f / static_cast<float>(size);
  return cube_direction(
      {face, (static_cast<float>(x) + 0.5f) * scale, (static_cast<float>(y) + 0.5f) * scale});
}

double texel_solid_angle(int x, int y, int size) {
  // Solid angle of the rectangle from the face's centre to (a, b) on the plane at distance 1.
  const auto corner = [](double a, double b) { return std::atan2(a * b, std::sqrt(a * a + b * b + 1)); };
  const double x0 = 2.0 * x / size - 1, x1 = 2.0 * (x + 1) / size - 1;
  const double y0 = 2.0 * y / size - 1, y1 = 2.0 * (y + 1) / size - 1;
  return corner(x1, y1) - corner(x0, y1) - corner(x1, y0) + corner(x0, y0);
}

vec3 spherical_fibonacci(int i, int n) {
  constexpr double golden_fraction = 0.61803398874989484820;  // φ − 1
  const double turns = i * golden_fraction;
  const double azimuth = 2 * pi_d * (turns - std::floor(turns));
  const double z = 1 - (2.0 * i + 1) / n;
  const double r = std::sqrt(std::max(0.0, 1 - z * z));
  return {static_cast<float>(r * std::cos(azimuth)), static_cast<float>(r * std::sin(azimuth)),
          static_cast<float>(z)};
}

}  // namespace ssphh
