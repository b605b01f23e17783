#include <algorithm>
#include <cmath>
#include <vector>

#include <ssphh/core/sphere.h>
#include <ssphh/sh/evaluate.h>
#include <ssphh/sh/irradiance.h>
#include <ssphh/sh/window.h>

namespace ssphh::sh {
namespace {

// About 4° apart: degree 10 has 18° from a crest to a trough, so no trough lies between the samples unseen.
constexpr int sample_count = 2562;
// Descents per channel, from the lowest samples.
constexpr int descent_count = 8;

using Channel = std::array<double, max_coefficient_count>;

double eval_channel(const Channel& values, int degree, const glm::dvec3& direction) {
  std::array<double, max_coefficient_count> basis;
  eval_basis(degree, direction, basis);
  double sum = 0;
  for (std::size_t k = 0; k < static_cast<std::size_t>(coefficient_count(degree)); ++k)
    sum += basis[k] * values[k];
  return sum;
}

// Compass search: step to the lowest of four neighbours, halve the step when none is lower.
double descend(const Channel& values, int degree, glm::dvec3 at, double value) {
  for (double step = 0.05; step > 1e-4;) {
    const glm::dvec3 side =
        glm::normalize(glm::cross(at, std::abs(at.x) < 0.5 ? glm::dvec3(1, 0, 0) : glm::dvec3(0, 1, 0)));
    const glm::dvec3 up = glm::cross(at, side);
    glm::dvec3 best = at;
    for (const glm::dvec3& move : {side, -side, up, -up}) {
      const glm::dvec3 next = glm::normalize(at + step * move);
      const double next_value = eval_channel(values, degree, next);
      if (next_value < value) best = next, value = next_value;
    }
    if (best == at) step *= 0.5;
    at = best;
  }
  return value;
}

double channel_minimum(const Channel& values, int degree) {
  static const auto directions = [] {
    std::vector<glm::dvec3> points;
    for (int i = 0; i < sample_count; ++i)
      points.push_back(glm::normalize(glm::dvec3(spherical_fibonacci(i, sample_count))));
    return points;
  }();
  std::vector<std::pair<double, std::size_t>> samples;
  samples.reserve(directions.size());
  for (std::size_t i = 0; i < directions.size(); ++i)
    samples.emplace_back(eval_channel(values, degree, directions[i]), i);
  std::partial_sort(samples.begin(), samples.begin() + descent_count, samples.end());
  double lowest = samples.front().first;
  for (int i = 0; i < descent_count; ++i) {
    const auto& [value, index] = samples[static_cast<std::size_t>(i)];
    lowest = std::min(lowest, descend(values, degree, directions[index], value));
  }
  return lowest;
}

template <class Sh>
Channel channel_values(const Sh& sh, int c) {
  Channel values{};
  for (std::size_t k = 0; k < sh.values.size(); ++k) values[k] = static_cast<double>(sh.values[k][c]);
  return values;
}

template <class Sh>
glm::dvec3 minima(const Sh& sh) {
  const int degree = sh.degree();
  if (degree <= 0) return degree < 0 ? glm::dvec3(0) : glm::dvec3(sh[0]) * std::sqrt(1 / (4 * pi_d));
  glm::dvec3 result;
  for (int c = 0; c < 3; ++c) result[c] = channel_minimum(channel_values(sh, c), degree);
  return result;
}

glm::dvec3 goal_minima(const RadianceSh& radiance, NonNegative goal) {
  return goal == NonNegative::radiance ? minima(radiance) : minima(irradiance_from_radiance(radiance));
}

template <class Shape>
BandScales window(double width, const Shape& shape) {
  SSPHH_CHECK(width > 0);
  BandScales scales{};
  for (int l = 0; l <= max_degree; ++l) {
    scales[static_cast<std::size_t>(l)] = l == 0      ? 1.0f
                                          : l < width ? static_cast<float>(shape(pi_d * l / width))
                                                      : 0.0f;
  }
  return scales;
}

}  // namespace

BandScales hanning_window(double width) {
  return window(width, [](double x) { return 0.5 * (1 + std::cos(x)); });
}

BandScales lanczos_window(double width) {
  return window(width, [](double x) { return x == 0 ? 1 : std::sin(x) / x; });
}

RadianceSh apply_window(const RadianceSh& sh, const BandScales& scales) {
  RadianceSh result = sh;
  for (int l = 0; l <= sh.degree(); ++l) {
    const float scale = scales[static_cast<std::size_t>(l)];
    if (scale == 1) continue;
    for (int k = coefficient_index(l, -l); k <= coefficient_index(l, l); ++k) result[k] *= scale;
  }
  return result;
}

vec3 minimum(const RadianceSh& radiance) {
  return vec3(minima(radiance));
}
vec3 minimum(const IrradianceSh& irradiance) {
  return vec3(minima(irradiance));
}

AutoWindow choose_window(const RadianceSh& radiance, NonNegative goal) {
  AutoWindow result;
  if (radiance.empty()) return result;
  const auto lowest = [](const glm::dvec3& v) { return std::min({v.x, v.y, v.z}); };
  if (lowest(goal_minima(radiance, goal)) >= 0) return result;

  // Keep a little above 0, so that single-precision evaluation does not fall below.
  const glm::dvec3 margin = 1e-5 * glm::abs(glm::dvec3(radiance[0]));
  const auto good = [&](double inverse_width) {
    return lowest(goal_minima(apply_window(radiance, lanczos_window(1 / inverse_width)), goal) - margin) >= 0;
  };

  // Bisect 1/width between no window (0, known to fail) and the mean alone (1).
  double fails = 0, works = 1;
  if (!good(works)) return {1, lowest(glm::dvec3(radiance[0])) >= 0};
  for (int i = 0; i < 20; ++i) {
    const double middle = 0.5 * (fails + works);
    (good(middle) ? works : fails) = middle;
  }
  result.width = 1 / works;
  return result;
}

RadianceSh dering(const RadianceSh& radiance, NonNegative goal) {
  return apply_window(radiance, lanczos_window(choose_window(radiance, goal).width));
}

}  // namespace ssphh::sh
