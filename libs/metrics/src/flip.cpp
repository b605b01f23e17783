#include <algorithm>
#include <cmath>
#include <limits>
#include <numbers>
#include <utility>
#include <vector>

#include <ssphh/core/parallel.h>
#include <ssphh/metrics/flip.h>

#include "check_size.h"

namespace ssphh::metrics {
namespace {

using image::Image;

// Constants of the paper: exponents and break points of the colour pipeline (§4.1.2), width of the edge
// detector in degrees (§4.2), exponent of the feature difference (§4.2.2).
constexpr float color_exponent = 0.7f, color_break = 0.4f, color_break_value = 0.95f;
constexpr double feature_width = 0.082;
constexpr float feature_exponent = 0.5f;

// Reference white D65.
constexpr vec3 white{0.950428545f, 1.0f, 1.088900371f};

vec3 xyz_from_linear(const vec3& c) {
  return {0.412386563f * c.x + 0.357591475f * c.y + 0.180450496f * c.z,
          0.212636821f * c.x + 0.715182981f * c.y + 0.072180197f * c.z,
          0.019330620f * c.x + 0.119197164f * c.y + 0.950372560f * c.z};
}

vec3 linear_from_xyz(const vec3& c) {
  return {3.241003275f * c.x - 1.537398934f * c.y - 0.498615861f * c.z,
          -0.969224334f * c.x + 1.875930071f * c.y + 0.041554224f * c.z,
          0.055639423f * c.x - 0.204011202f * c.y + 1.057148933f * c.z};
}

// YCxCz: CIELAB without its cube root, so that filtering is linear.
vec3 ycxcz_from_linear(const vec3& c) {
  const vec3 n = xyz_from_linear(c) / white;
  return {116 * n.y - 16, 500 * (n.x - n.y), 200 * (n.y - n.z)};
}

vec3 linear_from_ycxcz(const vec3& c) {
  const float y = (c.x + 16) / 116;
  return linear_from_xyz(vec3(y + c.y / 500, y, y - c.z / 200) * white);
}

// CIELAB with Hunt's effect: colours are told apart less well in the dark.
vec3 hunt_lab_from_linear(const vec3& c) {
  constexpr float delta = 6.0f / 29;
  vec3 n = xyz_from_linear(c) / white;
  for (int k = 0; k < 3; ++k)
    n[k] = n[k] > delta * delta * delta ? std::cbrt(n[k]) : n[k] / (3 * delta * delta) + 4.0f / 29;
  const float l = 116 * n.y - 16;
  return {l, 0.01f * l * 500 * (n.x - n.y), 0.01f * l * 200 * (n.y - n.z)};
}

float hyab(const vec3& a, const vec3& b) {
  return std::abs(a.x - b.x) + std::hypot(a.y - b.y, a.z - b.z);
}

float largest_color_difference() {
  return std::pow(hyab(hunt_lab_from_linear({0, 1, 0}), hunt_lab_from_linear({0, 0, 1})), color_exponent);
}

using Kernel = std::vector<float>;  // taps −r..r

// Contrast sensitivity of one channel as Gaussians in degrees: a·√(π/b)·exp(−π²x²/b) along one axis, or the
// square root of its factor where two Gaussians are summed (`root`).
Kernel sensitivity(double a, double b, bool root, int radius, double ppd) {
  const double pi = std::numbers::pi;
  Kernel kernel(static_cast<std::size_t>(2 * radius + 1));
  for (int i = -radius; i <= radius; ++i) {
    const double x = i / ppd, factor = root ? std::sqrt(a * std::sqrt(pi / b)) : a * std::sqrt(pi / b);
    kernel[i + radius] = static_cast<float>(factor * std::exp(-pi * pi * x * x / b));
  }
  return kernel;
}

double sum(const Kernel& kernel) {
  double total = 0;
  for (const float w : kernel) total += double{w};
  return total;
}

void scale(Kernel& kernel, double factor) {
  for (float& w : kernel) w = static_cast<float>(double{w} * factor);
}

// Table 1: achromatic, red-green and (two Gaussians) blue-yellow sensitivity.
struct SpatialFilters {
  Kernel y, cx, cz1, cz2;
};

SpatialFilters spatial_filters(double ppd) {
  const double widest = 0.04;
  const int radius =
      static_cast<int>(std::ceil(3 * std::sqrt(widest / (2 * std::numbers::pi * std::numbers::pi)) * ppd));
  SpatialFilters f{sensitivity(1, 0.0047, false, radius, ppd), sensitivity(1, 0.0053, false, radius, ppd),
                   sensitivity(34.1, 0.04, true, radius, ppd), sensitivity(13.5, 0.025, true, radius, ppd)};
  scale(f.y, 1 / sum(f.y)), scale(f.cx, 1 / sum(f.cx));
  const double cz = 1 / std::hypot(sum(f.cz1), sum(f.cz2));
  scale(f.cz1, cz), scale(f.cz2, cz);
  return f;
}

// A Gaussian and its first and second derivative; the derivatives' positive and negative taps sum to ±1.
struct FeatureFilters {
  Kernel gauss, first, second;
};

void normalize_signs(Kernel& kernel) {
  double positive = 0, negative = 0;
  for (const float w : kernel) (w > 0 ? positive : negative) += std::abs(double{w});
  for (float& w : kernel) w = static_cast<float>(double{w} / (w > 0 ? positive : negative));
}

FeatureFilters feature_filters(double ppd) {
  const double sigma = 0.5 * feature_width * ppd;
  const int radius = static_cast<int>(std::ceil(3 * sigma));
  FeatureFilters f;
  for (int i = -radius; i <= radius; ++i) {
    const double x = i, g = std::exp(-x * x / (2 * sigma * sigma));
    f.gauss.push_back(static_cast<float>(g));
    f.first.push_back(static_cast<float>(-x * g));
    f.second.push_back(static_cast<float>((x * x / (sigma * sigma) - 1) * g));
  }
  scale(f.gauss, 1 / sum(f.gauss));
  normalize_signs(f.first), normalize_signs(f.second);
  return f;
}

struct Plane {
  int width = 0, height = 0;
  std::vector<float> values;

  Plane(int w, int h)
      : width(w), height(h), values(static_cast<std::size_t>(w) * static_cast<std::size_t>(h)) {}
  float* row(int y) { return values.data() + static_cast<std::ptrdiff_t>(y) * width; }
  const float* row(int y) const { return values.data() + static_cast<std::ptrdiff_t>(y) * width; }
};

template <class Row>
void for_rows(int height, const Row& row) {
  parallel_for(static_cast<std::size_t>(height), 4, [&](std::size_t begin, std::size_t end) {
    for (auto y = static_cast<int>(begin); y < static_cast<int>(end); ++y) row(y);
  });
}

// Pixels beyond the border repeat the border's.
Plane filter_x(const Plane& in, const Kernel& kernel) {
  const int radius = static_cast<int>(kernel.size() / 2);
  Plane out(in.width, in.height);
  for_rows(in.height, [&](int y) {
    std::vector<float> padded(static_cast<std::size_t>(in.width + 2 * radius));
    for (int x = -radius; x < in.width + radius; ++x)
      padded[x + radius] = in.row(y)[std::clamp(x, 0, in.width - 1)];
    for (std::size_t i = 0; i < kernel.size(); ++i) {
      for (int x = 0; x < in.width; ++x) out.row(y)[x] += kernel[i] * padded[static_cast<std::size_t>(x) + i];
    }
  });
  return out;
}

Plane filter_y(const Plane& in, const Kernel& kernel) {
  const int radius = static_cast<int>(kernel.size() / 2);
  Plane out(in.width, in.height);
  for_rows(in.height, [&](int y) {
    for (int i = -radius; i <= radius; ++i) {
      const float* source = in.row(std::clamp(y + i, 0, in.height - 1));
      const float weight = kernel[i + radius];
      for (int x = 0; x < in.width; ++x) out.row(y)[x] += weight * source[x];
    }
  });
  return out;
}

Plane filter(const Plane& in, const Kernel& along_x, const Kernel& along_y) {
  return filter_y(filter_x(in, along_x), along_y);
}

// What the eye makes of a picture: filtered colour, and the strength of edges and points in its luminance.
struct Seen {
  std::vector<vec3> lab;
  std::vector<float> edges, points;
};

Seen see(const std::vector<vec3>& linear, int width, int height, const SpatialFilters& spatial,
         const FeatureFilters& feature) {
  Plane y(width, height), cx(width, height), cz(width, height), grey(width, height);
  for_rows(height, [&](int row) {
    for (int x = 0; x < width; ++x) {
      const std::size_t i =
          static_cast<std::size_t>(row) * static_cast<std::size_t>(width) + static_cast<std::size_t>(x);
      const vec3 c = ycxcz_from_linear(linear[i]);
      y.values[i] = c.x, cx.values[i] = c.y, cz.values[i] = c.z, grey.values[i] = (c.x + 16) / 116;
    }
  });
  Seen seen;
  seen.lab.resize(linear.size()), seen.edges.resize(linear.size()), seen.points.resize(linear.size());

  y = filter(y, spatial.y, spatial.y), cx = filter(cx, spatial.cx, spatial.cx);
  const Plane cz1 = filter(cz, spatial.cz1, spatial.cz1), cz2 = filter(cz, spatial.cz2, spatial.cz2);
  const Plane dx = filter(grey, feature.first, feature.gauss),
              dy = filter(grey, feature.gauss, feature.first);
  const Plane ddx = filter(grey, feature.second, feature.gauss),
              ddy = filter(grey, feature.gauss, feature.second);
  for_rows(height, [&](int row) {
    for (int x = 0; x < width; ++x) {
      const std::size_t i =
          static_cast<std::size_t>(row) * static_cast<std::size_t>(width) + static_cast<std::size_t>(x);
      const vec3 filtered(y.values[i], cx.values[i], cz1.values[i] + cz2.values[i]);
      seen.lab[i] = hunt_lab_from_linear(glm::clamp(linear_from_ycxcz(filtered), 0.0f, 1.0f));
      seen.edges[i] = std::hypot(dx.values[i], dy.values[i]);
      seen.points[i] = std::hypot(ddx.values[i], ddy.values[i]);
    }
  });
  return seen;
}

// Error per pixel of pictures in [0, 1].
std::vector<float> difference(const std::vector<vec3>& reference, const std::vector<vec3>& test, int width,
                              int height, const SpatialFilters& spatial, const FeatureFilters& feature) {
  const Seen a = see(reference, width, height, spatial, feature),
             b = see(test, width, height, spatial, feature);
  const float largest = largest_color_difference(), at_break = color_break * largest;
  std::vector<float> error(reference.size());
  for (std::size_t i = 0; i < error.size(); ++i) {
    float color = std::pow(hyab(a.lab[i], b.lab[i]), color_exponent);
    color = color < at_break
                ? color * color_break_value / at_break
                : color_break_value + (color - at_break) / (largest - at_break) * (1 - color_break_value);
    const float change = std::max(std::abs(a.edges[i] - b.edges[i]), std::abs(a.points[i] - b.points[i]));
    const float features = std::pow(change / std::numbers::sqrt2_v<float>, feature_exponent);
    error[i] = std::pow(color, 1 - features);
  }
  return error;
}

// Pixels in order of rows; one that is not finite in either image is black in both.
struct Pair {
  int width, height;
  std::vector<vec3> reference, test;
  std::vector<std::size_t> nonfinite;
};

Pair pixels_of(const Image& reference, const Image& test) {
  check_same_size(reference, test);
  Pair pair{reference.width, reference.height, {}, {}, {}};
  for (int y = 0; y < pair.height; ++y) {
    for (int x = 0; x < pair.width; ++x) {
      const vec3 r = reference.rgb(x, y), t = test.rgb(x, y);
      const bool finite = is_finite(r) && is_finite(t);
      if (!finite) pair.nonfinite.push_back(pair.reference.size());
      pair.reference.push_back(finite ? r : vec3(0)), pair.test.push_back(finite ? t : vec3(0));
    }
  }
  return pair;
}

FlipError finish(const Pair& pair, std::vector<float> error) {
  for (const std::size_t i : pair.nonfinite) error[i] = std::numeric_limits<float>::quiet_NaN();
  double total = 0;
  for (const float e : error) {
    if (!std::isnan(e)) total += double{e};
  }
  const std::size_t finite = error.size() - pair.nonfinite.size();
  FlipError result;
  result.map = Image(pair.width, pair.height, 1);
  result.map.pixels = std::move(error);
  result.mean = finite > 0 ? total / static_cast<double>(finite) : 0;
  return result;
}

std::vector<vec3> clamped(const std::vector<vec3>& pixels) {
  std::vector<vec3> out(pixels);
  for (vec3& c : out) c = glm::clamp(c, 0.0f, 1.0f);
  return out;
}

// The ACES curve (Narkowicz's fit, its 0.6 of exposure undone) as (n2 x² + n1 x) / (d2 x² + d1 x + d0).
constexpr double n2 = 0.6 * 0.6 * 2.51, n1 = 0.6 * 0.03, d2 = 0.6 * 0.6 * 2.43, d1 = 0.6 * 0.59, d0 = 0.14;

std::vector<vec3> exposed(const std::vector<vec3>& pixels, double exposure) {
  const auto factor = static_cast<float>(std::exp2(exposure));
  std::vector<vec3> out(pixels.size());
  for (std::size_t i = 0; i < out.size(); ++i) {
    const vec3 x = glm::max(pixels[i], 0.0f) * factor;
    const vec3 curve = (x * x * static_cast<float>(n2) + x * static_cast<float>(n1)) /
                       (x * x * static_cast<float>(d2) + x * static_cast<float>(d1) + static_cast<float>(d0));
    for (int c = 0; c < 3; ++c) out[i][c] = std::isfinite(curve[c]) ? std::clamp(curve[c], 0.0f, 1.0f) : 1.0f;
  }
  return out;
}

// First and last exposure of the reference: its brightest pixel and its median shown at 85 %.
std::pair<double, double> exposure_range(const std::vector<vec3>& reference) {
  constexpr double shown = 0.85;
  const double a = n2 - shown * d2, b = n1 - shown * d1, c = -shown * d0;
  const double level = (-b + std::sqrt(b * b - 4 * a * c)) / (2 * a);
  std::vector<float> luminance;
  for (const vec3& p : reference) luminance.push_back(0.2126f * p.x + 0.7152f * p.y + 0.0722f * p.z);
  const auto median_of = [](std::vector<float>& values) {
    const auto middle = values.begin() + static_cast<std::ptrdiff_t>(values.size() / 2);
    std::nth_element(values.begin(), middle, values.end());
    return double{*middle};
  };
  const double brightest = double{*std::ranges::max_element(luminance)};
  if (!(brightest > 0)) return {0, 0};
  double median = median_of(luminance);
  if (!(median > 0)) {
    std::erase_if(luminance, [](float y) { return !(y > 0); });
    median = median_of(luminance);
  }
  return {std::log2(level / brightest), std::log2(level / median)};
}

/// Filters of more pixels than a screen has are no use, and take forever.
void check(const FlipParams& params) {
  require(params.pixels_per_degree > 0 && params.pixels_per_degree <= 1e4, "FLIP",
          "pixels per degree must lie in 0..10000");
}

}  // namespace

FlipError flip(const Image& reference, const Image& test, const FlipParams& params) {
  check(params);
  const Pair pair = pixels_of(reference, test);
  return finish(
      pair, difference(clamped(pair.reference), clamped(pair.test), pair.width, pair.height,
                       spatial_filters(params.pixels_per_degree), feature_filters(params.pixels_per_degree)));
}

FlipError hdr_flip(const Image& reference, const Image& test, const FlipParams& params) {
  check(params);
  const Pair pair = pixels_of(reference, test);
  const SpatialFilters spatial = spatial_filters(params.pixels_per_degree);
  const FeatureFilters feature = feature_filters(params.pixels_per_degree);
  const auto [first, last] = exposure_range(pair.reference);
  const int exposures = last > first ? std::max(2, static_cast<int>(std::ceil(last - first))) : 1;
  std::vector<float> worst(pair.reference.size(), 0.0f);
  for (int i = 0; i < exposures; ++i) {
    const double exposure = exposures > 1 ? first + i * (last - first) / (exposures - 1) : first;
    const std::vector<float> error =
        difference(exposed(pair.reference, exposure), exposed(pair.test, exposure), pair.width, pair.height,
                   spatial, feature);
    for (std::size_t p = 0; p < worst.size(); ++p) worst[p] = std::max(worst[p], error[p]);
  }
  FlipError result = finish(pair, std::move(worst));
  result.first_exposure = first, result.last_exposure = last, result.exposures = exposures;
  return result;
}

}  // namespace ssphh::metrics
