#include <algorithm>
#include <cmath>
#include <memory>
#include <mutex>
#include <span>
#include <thread>
#include <vector>

#include <ssphh/core/sphere.h>
#include <ssphh/sh/evaluate.h>
#include <ssphh/sh/irradiance.h>
#include <ssphh/sh/window.h>

namespace ssphh::sh {
namespace {

// About 4° apart: degree 10 has 18° from a crest to a trough, so no trough lies between the samples unseen.
constexpr int sample_count = 2562;
// No direction is farther than this from a sample [rad]; the test finds 0.048.
constexpr double sample_reach = 0.055;
// Descents per channel, from the lowest samples.
constexpr std::size_t descent_count = 8;

using Channel = std::array<double, max_coefficient_count>;

struct Samples {
  std::vector<glm::dvec3> directions;
  std::vector<Channel> basis;
};

const Samples& samples() {
  static const Samples all = [] {
    Samples made;
    made.basis.resize(sample_count);
    for (int i = 0; i < sample_count; ++i) {
      made.directions.push_back(glm::normalize(glm::dvec3(spherical_fibonacci(i, sample_count))));
      eval_basis(max_degree, made.directions.back(), made.basis[i]);
    }
    return made;
  }();
  return all;
}

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

/// The lowest samples of those that are added, lowest first.
class LowestSamples {
 public:
  struct Sample {
    double value;
    std::size_t index;
  };
  void add(double value, std::size_t index) {
    if (count_ == descent_count && !(value < kept_.back().value)) return;
    std::size_t i = count_ < descent_count ? count_++ : descent_count - 1;
    for (; i > 0 && value < kept_[i - 1].value; --i) kept_[i] = kept_[i - 1];
    kept_[i] = {value, index};
  }
  std::span<const Sample> all() const { return {kept_.data(), count_}; }

 private:
  std::array<Sample, descent_count> kept_;
  std::size_t count_ = 0;
};

double channel_minimum(const Channel& values, int degree) {
  const auto count = static_cast<std::size_t>(coefficient_count(degree));
  LowestSamples found;
  for (std::size_t i = 0; i < sample_count; ++i) {
    const Channel& basis = samples().basis[i];
    double sum = 0;
    for (std::size_t k = 0; k < count; ++k) sum += basis[k] * values[k];
    found.add(sum, i);
  }
  double lowest = found.all().front().value;
  for (const auto& [value, index] : found.all())
    lowest = std::min(lowest, descend(values, degree, samples().directions[index], value));
  return lowest;
}

template <class Sh>
Channel channel_values(const Sh& sh, int c) {
  require_degree(sh.degree(), "window");
  Channel values{};
  const auto count = static_cast<std::size_t>(coefficient_count(sh.degree()));
  for (std::size_t k = 0; k < count; ++k) values[k] = static_cast<double>(sh.values[k][c]);
  return values;
}

template <class Sh>
glm::dvec3 minima(const Sh& sh) {
  const int degree = sh.degree();
  if (degree < 0) return glm::dvec3(0);
  glm::dvec3 result;
  for (int c = 0; c < 3; ++c) result[c] = channel_minimum(channel_values(sh, c), degree);
  return result;
}

/// One channel of a function whose bands are about to be scaled: is it anywhere below a level?
class WindowedChannel {
 public:
  WindowedChannel() { bands_.reserve(std::size_t{sample_count} * (max_degree + 1)); }
  void assign(const Channel& values, int degree) {
    values_ = values;
    degree_ = degree;
    bands_.clear();
    for (int l = 0; l <= degree; ++l) {
      double squares = 0;
      for (int k = coefficient_index(l, -l); k <= coefficient_index(l, l); ++k)
        squares += values[k] * values[k];
      // Addition theorem and Cauchy–Schwarz.
      largest_[l] = std::sqrt(squares * (2 * l + 1) / (4 * pi_d));
    }
  }

  bool below(double level, const BandScales& scales) {
    const double mean = values_[0] / std::sqrt(4 * pi_d);
    double swing = 0, curvature = 0;
    for (int l = 1; l <= degree_; ++l) {
      const double most = static_cast<double>(scales[l]) * largest_[l];
      swing += most;
      curvature += l * l * most;
    }
    if (mean - swing >= level) return false;

    // A trough is at most `hidden` deeper than the sample next to it: along the great circle between them
    // each band is a trigonometric polynomial, whose second derivative Bernstein's inequality bounds.
    const double hidden = 0.5 * sample_reach * sample_reach * curvature;
    sample_bands();
    LowestSamples suspects;
    for (std::size_t i = 0; i < sample_count; ++i) {
      const double* bands = &bands_[i * static_cast<std::size_t>(degree_ + 1)];
      double sum = 0;
      for (int l = 0; l <= degree_; ++l) sum += static_cast<double>(scales[l]) * bands[l];
      if (sum < level) return true;
      if (sum < level + hidden) suspects.add(sum, i);
    }
    Channel scaled = values_;
    for (int l = 0; l <= degree_; ++l) {
      for (int k = coefficient_index(l, -l); k <= coefficient_index(l, l); ++k)
        scaled[k] *= static_cast<double>(scales[l]);
    }
    return std::ranges::any_of(suspects.all(), [&](const LowestSamples::Sample& suspect) {
      return descend(scaled, degree_, samples().directions[suspect.index], suspect.value) < level;
    });
  }

 private:
  /// Every band at every sample, once.
  void sample_bands() {
    if (!bands_.empty()) return;
    for (const Channel& basis : samples().basis) {
      for (int l = 0; l <= degree_; ++l) {
        double sum = 0;
        for (int k = coefficient_index(l, -l); k <= coefficient_index(l, l); ++k)
          sum += basis[k] * values_[k];
        bands_.push_back(sum);
      }
    }
  }

  Channel values_{};
  int degree_ = 0;
  std::array<double, max_degree + 1> largest_{};
  std::vector<double> bands_;
};

/// What is at work in choose_window: enough for every thread of the machine from the first time on, so that a
/// thread that finds its first trough later takes no memory for it.
class Workspaces {
 public:
  using Workspace = std::array<WindowedChannel, 3>;

  static Workspaces& of_all() {
    static Workspaces& all = *new Workspaces;  // threads may outlive statics
    return all;
  }
  std::unique_ptr<Workspace> take() {
    const std::scoped_lock lock(mutex_);
    if (free_.empty()) return std::make_unique<Workspace>();
    std::unique_ptr<Workspace> taken = std::move(free_.back());
    free_.pop_back();
    return taken;
  }
  void give_back(std::unique_ptr<Workspace> taken) {
    const std::scoped_lock lock(mutex_);
    free_.push_back(std::move(taken));
  }

 private:
  Workspaces() {
    for (unsigned i = 0; i < std::max(std::thread::hardware_concurrency(), 1u); ++i)
      free_.push_back(std::make_unique<Workspace>());
  }
  std::mutex mutex_;
  std::vector<std::unique_ptr<Workspace>> free_;
};

/// Of radiance, or of the irradiance that it gives.
Channel channel_values(const RadianceSh& radiance, NonNegative goal, int c) {
  Channel values = channel_values(radiance, c);
  if (goal == NonNegative::radiance) return values;
  for (int l = 0; l <= radiance.degree(); ++l) {
    for (int k = coefficient_index(l, -l); k <= coefficient_index(l, l);
         ++k)  // rounded as irradiance_from_radiance()
      values[k] = static_cast<double>(radiance[k][c] * static_cast<float>(cosine_band_factor(l)));
  }
  return values;
}

template <class Shape>
BandScales window(double width, const Shape& shape) {
  require(width > 0, "window", "its width must be over 0");
  BandScales scales{};
  for (int l = 0; l <= max_degree; ++l) {
    scales[l] = l == 0 ? 1.0f : l < width ? static_cast<float>(shape(pi_d * l / width)) : 0.0f;
  }
  return scales;
}

AutoWindow choose_window(Workspaces::Workspace& wanted, const RadianceSh& radiance, NonNegative goal) {
  AutoWindow result;
  for (int c = 0; c < 3; ++c) wanted[c].assign(channel_values(radiance, goal, c), radiance.degree());
  const auto all_above = [&](const glm::dvec3& levels, const BandScales& scales) {
    for (int c = 0; c < 3; ++c) {
      if (wanted[c].below(levels[c], scales)) return false;
    }
    return true;
  };
  BandScales no_window;
  no_window.fill(1);
  if (all_above(glm::dvec3(0), no_window)) return result;

  // Keep a little above 0, so that single-precision evaluation does not fall below.
  const glm::dvec3 margin = 1e-5 * glm::abs(glm::dvec3(radiance[0]));
  const auto good = [&](double inverse_width) {
    return all_above(margin, lanczos_window(1 / inverse_width));
  };

  // Bisect 1/width between no window (0, known to fail) and the mean alone (1).
  double fails = 0, works = 1;
  if (!good(works)) return {1, std::min({radiance[0].x, radiance[0].y, radiance[0].z}) >= 0};
  for (int i = 0; i < 20; ++i) {
    const double middle = 0.5 * (fails + works);
    (good(middle) ? works : fails) = middle;
  }
  result.width = 1 / works;
  return result;
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
  window_in_place(result, scales);
  return result;
}

void window_in_place(RadianceSh& sh, const BandScales& scales) {
  require_degree(std::max(sh.degree(), 0), "window");
  for (int l = 0; l <= sh.degree(); ++l) {
    const float scale = scales[l];
    if (scale == 1) continue;
    for (int k = coefficient_index(l, -l); k <= coefficient_index(l, l); ++k) sh[k] *= scale;
  }
}

vec3 minimum(const RadianceSh& radiance) {
  return vec3(minima(radiance));
}
vec3 minimum(const IrradianceSh& irradiance) {
  return vec3(minima(irradiance));
}

AutoWindow choose_window(const RadianceSh& radiance, NonNegative goal) {
  if (radiance.empty()) return {};
  std::unique_ptr<Workspaces::Workspace> work = Workspaces::of_all().take();
  const AutoWindow chosen = choose_window(*work, radiance, goal);
  Workspaces::of_all().give_back(std::move(work));
  return chosen;
}

RadianceSh dering(const RadianceSh& radiance, NonNegative goal) {
  return apply_window(radiance, lanczos_window(choose_window(radiance, goal).width));
}

}  // namespace ssphh::sh
