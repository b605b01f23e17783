#include <algorithm>
#include <array>
#include <limits>

#include <ssphh/image/sphere_map.h>

#include "bilinear.h"

namespace ssphh::image {
namespace {

// (1 − cos πr)/r² for r in [0, 1].
double enclosed_over_r2(double r2) {
  const double half = 0.5 * pi_d * std::sqrt(r2);
  const double sinc = half > 1e-8 ? std::sin(half) / half : 1;
  return 0.5 * pi_d * pi_d * sinc * sinc;
}

// ∫ (1 − cos πr) dφ along the line from (a, c) to (b, c): the solid angle between it and the centre, signed
// as x dy − y dx of that direction, −c dx. For the whole boundary of a region this is the region's solid
// angle (Green), and nothing outside the disc counts, since there the integrand is the differential 2 dφ.
double line_integral(double a, double b, double c) {
  const auto inside = [&](double from, double to) {
    // Gauss–Legendre, 8 points.
    static constexpr std::array<double, 4> node{0.1834346424956498, 0.5255324099163290, 0.7966664774136267,
                                                0.9602898564975363};
    static constexpr std::array<double, 4> weight{0.3626837833783620, 0.3137066458778873, 0.2223810344533745,
                                                  0.1012285362903763};
    const double middle = 0.5 * (from + to), half = 0.5 * (to - from);
    double sum = 0;
    for (std::size_t i = 0; i < node.size(); ++i) {
      for (const double x : {middle - half * node[i], middle + half * node[i]}) {
        sum += weight[i] * enclosed_over_r2(x * x + c * c);
      }
    }
    return -c * half * sum;
  };
  const auto outside = [&](double from, double to) { return 2 * (std::atan2(c, to) - std::atan2(c, from)); };
  if (c == 0) return 0;  // along a ray through the centre, φ stays
  const double edge = c * c < 1 ? std::sqrt(1 - c * c) : 0;
  // Split where the line enters and leaves the disc.
  double sum = 0;
  const double in = std::clamp(-edge, a, b), out = std::clamp(edge, a, b);
  if (in > a) sum += outside(a, in);
  if (out > in) sum += inside(in, out);
  if (b > out) sum += outside(out, b);
  return sum;
}

bool centre_in_disc(int x, int y, int size) {
  const double px = (2.0 * x + 1) / size - 1, py = (2.0 * y + 1) / size - 1;
  return x >= 0 && y >= 0 && x < size && y < size && px * px + py * py <= 1;
}

}  // namespace

std::optional<vec3> angular_direction(float u, float v) {
  const float x = 2 * u - 1, y = 1 - 2 * v;
  const float r2 = x * x + y * y;
  if (r2 > 1) return std::nullopt;
  const float r = std::sqrt(r2);
  const float scale = r > 0 ? std::sin(pi * r) / r : 0.0f;
  return vec3(scale * x, scale * y, -std::cos(pi * r));
}

vec2 angular_uv(const vec3& d) {
  const float side = std::hypot(d.x, d.y);
  const float r = std::atan2(side, -d.z) / pi;
  const vec2 p = side > 0 ? vec2(d.x, d.y) * (r / side) : vec2(r, 0);
  return {0.5f * (1 + p.x), 0.5f * (1 - p.y)};
}

double angular_solid_angle(int x, int y, int size) {
  const double x0 = 2.0 * x / size - 1, x1 = 2.0 * (x + 1) / size - 1;
  const double y0 = 2.0 * y / size - 1, y1 = 2.0 * (y + 1) / size - 1;
  // Once around the pixel; a vertical line is a horizontal one with x and y exchanged, which reverses the
  // sense.
  return line_integral(x0, x1, y0) - line_integral(x0, x1, y1) - line_integral(y0, y1, x1) +
         line_integral(y0, y1, x0);
}

vec3 sample_angular(const Image& image, const vec3& direction) {
  require(!image.empty() && image.width == image.height, "angular map", "it must be a square with pixels");
  if (!is_finite(direction)) return vec3(std::numeric_limits<float>::quiet_NaN());
  const vec2 uv = angular_uv(direction);
  const int size = image.width;
  const BilinearTap tap(uv.x * static_cast<float>(size), uv.y * static_cast<float>(size));
  // Texels outside the disc hold nothing: share their weight among the others.
  vec3 sum(0);
  float weights = 0;
  for (int j = 0; j < 2; ++j) {
    for (int i = 0; i < 2; ++i) {
      if (!centre_in_disc(tap.x + i, tap.y + j, size)) continue;
      const float weight = (i ? tap.fx : 1 - tap.fx) * (j ? tap.fy : 1 - tap.fy);
      sum += weight * image.rgb(tap.x + i, tap.y + j);
      weights += weight;
    }
  }
  if (weights > 1e-6f) return sum / weights;
  // A pixel cut by the disc's edge with its centre outside: the nearest one inward.
  const vec2 inward = vec2(0.5f) + (uv - vec2(0.5f)) * (1 - 2.0f / static_cast<float>(size));
  const auto texel = [&](float t) {
    return std::clamp(static_cast<int>(t * static_cast<float>(size)), 0, size - 1);
  };
  return image.rgb(texel(inward.x), texel(inward.y));
}

}  // namespace ssphh::image
