#include <algorithm>
#include <array>
#include <cmath>
#include <limits>
#include <optional>

#include <fmt/format.h>

#include <ssphh/core/parallel.h>
#include <ssphh/metrics/false_edges.h>

#include "one_surface.h"

namespace ssphh::metrics {
namespace {

using image::Image;

constexpr int terms = 4;        ///< of the fit: 1, x, y, step
constexpr double sharp = 0.6;   ///< share of its step that the test makes within two pixels of the pair
constexpr double filled = 0.4;  ///< least share of each side of a window that must be of the surface
constexpr double scales[] = {1, 1.5, 2, 3};  ///< of windows: larger ones for noisier truths
constexpr int sample = 4;                    ///< every so many pixels the noise is looked at
constexpr float least_albedo = 0.01f;
constexpr double albedo_step = 0.1;  ///< of its logarithm, beside which no eye sees a step of light

using Column = std::array<double, terms>;
/// Log luminance, red against green, blue against both.
using Opponent = std::array<double, 3>;

struct Pixel {
  Opponent error, test;  ///< of test / truth, and of the test
  double albedo = 0;     ///< log of the truth's
  std::uint32_t surface = 0;
};

void check(const SurfacePicture& truth, const SurfacePicture& test, const FalseEdgeParams& p) {
  const auto sized = [&](const Image& picture, const char* name, bool optional, int channels) {
    if (optional && picture.empty()) return;
    require_whole(picture, name);
    require(picture.width == truth.indirect.width && picture.height == truth.indirect.height, name,
            "its size is not that of the truth's indirect light");
    require(picture.channels >= channels, name, "it has too few channels");
  };
  sized(truth.indirect, "the truth's indirect light", false, 1);
  sized(test.indirect, "the test's indirect light", false, 1);
  sized(truth.albedo, "the truth's albedo", true, 1);
  sized(test.albedo, "the test's albedo", true, 1);
  sized(truth.normal, "the normals", true, 3);
  sized(truth.depth, "the depth", true, 1);
  const bool positive = p.threshold > 0 && p.opponent_threshold > 0 && p.sigmas >= 0 && p.floor > 0;
  if (!positive || !std::isfinite(p.threshold + p.opponent_threshold + p.sigmas + p.floor))
    throw Error("false edges", "thresholds and floor must be over 0, standard errors at least 0");
  if (p.across < 3 || p.across > 32 || p.along < 0 || p.along > 32)
    throw Error("false edges", fmt::format("windows of {} and {} pixels are none", p.across, p.along));
}

/// Irradiance but for a factor; none where it cannot be told.
std::optional<vec3> irradiance(const SurfacePicture& picture, int x, int y) {
  vec3 light = picture.indirect.rgb(x, y);
  if (!picture.albedo.empty()) {
    const vec3 albedo = picture.albedo.rgb(x, y);
    if (!glm::all(glm::greaterThanEqual(albedo, vec3(least_albedo)))) return {};
    light /= albedo;
  }
  if (!std::isfinite(light.x + light.y + light.z)) return {};
  return glm::max(light, vec3(0));
}

Opponent opponent(const vec3& light, double floor) {
  const auto level = [&](float x) { return std::log(static_cast<double>(x) + floor); };
  const double r = level(light.x), g = level(light.y), b = level(light.z);
  return {level(luminance(light)), r - g, b - (r + g) / 2};
}

std::vector<Pixel> pixels_of(const SurfacePicture& truth, const SurfacePicture& test, double floor_share) {
  const int width = truth.indirect.width, height = truth.indirect.height;
  const auto count = static_cast<std::size_t>(width) * static_cast<std::size_t>(height);
  std::vector<std::uint8_t> usable(count);
  double sum = 0, of = 0;
  for (std::size_t i = 0; i < count; ++i) {
    const int x = static_cast<int>(i) % width, y = static_cast<int>(i) / width;
    const std::optional<vec3> light = irradiance(truth, x, y);
    usable[i] = light && irradiance(test, x, y);
    if (usable[i]) sum += static_cast<double>(luminance(*light)), ++of;
  }
  std::vector<Pixel> pixels(count);
  if (!(sum > 0)) return pixels;
  const double floor = floor_share * sum / of;
  const std::vector<std::uint32_t> surface = one_surface(usable, width, height, truth.normal, truth.depth);
  for (std::size_t i = 0; i < count; ++i) {
    if (surface[i] == 0) continue;
    const int x = static_cast<int>(i) % width, y = static_cast<int>(i) / width;
    const Opponent t = opponent(*irradiance(truth, x, y), floor),
                   e = opponent(*irradiance(test, x, y), floor);
    pixels[i] = {{e[0] - t[0], e[1] - t[1], e[2] - t[2]}, e, 0, surface[i]};
    if (!truth.albedo.empty())
      pixels[i].albedo = std::log(static_cast<double>(luminance(truth.albedo.rgb(x, y))));
  }
  return pixels;
}

/// A window's orientation: edges run down the picture, leaning by `lean` pixels a row, or (turned) across it.
struct Orientation {
  bool turned;
  double lean;
};
constexpr Orientation orientations[] = {{false, 0},  {false, 0.5}, {false, -0.5}, {false, 1},
                                        {false, -1}, {true, 0},    {true, 0.5},   {true, -0.5}};

/// Inverse of a symmetric positive matrix by Gauss and Jordan; none where it is singular.
std::optional<std::array<Column, terms>> inverse(std::array<Column, terms> m) {
  std::array<Column, terms> result{};
  for (std::size_t i = 0; i < terms; ++i) result[i][i] = 1;
  for (std::size_t i = 0; i < terms; ++i) {
    if (!(m[i][i] > 1e-9)) return {};
    const double by = 1 / m[i][i];
    for (std::size_t j = 0; j < terms; ++j) m[i][j] *= by, result[i][j] *= by;
    for (std::size_t k = 0; k < terms; ++k) {
      if (k == i) continue;
      const double factor = m[k][i];
      for (std::size_t j = 0; j < terms; ++j) {
        m[k][j] -= factor * m[i][j];
        result[k][j] -= factor * result[i][j];
      }
    }
  }
  return result;
}

/// What a fit found at a pair, for each of the opponent colours.
struct Step {
  Opponent error, deviation;      ///< step of e, and its standard error
  Opponent test, test_deviation;  ///< step of the test, and its standard error
  Opponent slope;                 ///< of the test, across
};

class Windows {
 public:
  Windows(const std::vector<Pixel>& pixels, int width, int height, const FalseEdgeParams& params)
      : pixels_(pixels), width_(width), height_(height), params_(params) {}

  /// Whether enough of one surface is around the pair that begins at (x, y), upright or turned.
  bool testable(int x, int y) const {
    return std::ranges::any_of(orientations,
                               [&](const Orientation& o) { return o.lean == 0 && has_room(x, y, o); });
  }

  /// Size of the largest false step at the pair in any direction, 0 for none.
  double false_step(int x, int y) const {
    double largest = 0;
    for (const Orientation& o : orientations) {
      const Opponent near = near_step(x, y, o);
      bool worth = false;
      for (std::size_t c = 0; c < 3; ++c) worth |= std::abs(near[c]) >= sharp * threshold(c);
      if (!worth || !has_room(x, y, o) || std::abs(albedo_across(x, y, o)) > albedo_step) continue;
      const std::array<bool, 3> steepest = find_steepest(x, y, o, near);
      if (std::ranges::find(steepest, true) == steepest.end()) continue;  // a fit is what costs
      const std::optional<Step> own = fit(x, y, o, 1);
      if (!own) continue;
      for (std::size_t c = 0; c < 3; ++c) {
        const double test = own->test[c];
        if (!steepest[c] || std::abs(test) <= threshold(c) || (near[c] - 2 * own->slope[c]) / test < sharp)
          continue;
        if (const std::optional<double> truth = true_step(x, y, o, c, *own))
          largest = std::max(largest, std::abs(test - *truth));
      }
    }
    return largest;
  }

  /// The step of luminance that would have counted at the pair.
  double least_step(int x, int y) const {
    double least = std::numeric_limits<double>::infinity();
    for (const Orientation& o : orientations) {
      if (o.lean != 0 || !has_room(x, y, o)) continue;
      for (const double scale : scales)
        if (const std::optional<Step> step = fit(x, y, o, scale))
          least = std::min(least, std::max(params_.threshold, params_.sigmas * step->deviation[0]));
    }
    return least;
  }

 private:
  double threshold(std::size_t channel) const {
    return channel == 0 ? params_.threshold : params_.opponent_threshold;
  }

  const Pixel* at(int x, int y) const {
    if (x < 0 || y < 0 || x >= width_ || y >= height_) return nullptr;
    return &pixels_[static_cast<std::size_t>(y) * static_cast<std::size_t>(width_) +
                    static_cast<std::size_t>(x)];
  }

  /// The truth's step at the pair where the test's, given, is false beside it: from the smallest window that
  /// tells the two apart.
  std::optional<double> true_step(int x, int y, const Orientation& o, std::size_t channel,
                                  const Step& own) const {
    const double test = own.test[channel];
    for (const double scale : scales) {
      const std::optional<Step> step = scale == 1 ? own : fit(x, y, o, scale);
      if (!step) continue;
      const double truth = step->test[channel] - step->error[channel];
      const double noise = std::hypot(step->deviation[channel], scale == 1 ? 0 : own.test_deviation[channel]);
      if (std::abs(test - truth) <= params_.sigmas * noise) {
        if (params_.sigmas * noise <= std::abs(test) / 2) return {};  // they are alike
        continue;
      }
      if (std::abs(test - truth) > threshold(channel) && std::abs(truth) < std::abs(test) / 2) return truth;
      return {};
    }
    return {};
  }

  /// body(pixel, i) for pixels of the pair's surface in row j of a window, i from `first` to `last` over the
  /// edge.
  template <class Body>
  void visit_row(int x, int y, const Orientation& o, int j, int first, int last, const Body& body) const {
    const std::uint32_t surface = at(x, y)->surface;
    const int shift = static_cast<int>(std::lround(o.lean * j));
    for (int i = first; i <= last; ++i) {
      const Pixel* pixel = o.turned ? at(x + j, y + i + shift) : at(x + i + shift, y + j);
      if (pixel && pixel->surface == surface) body(*pixel, i);
    }
  }

  /// The same for the rows −along to along of a window, each from 1 − across to across.
  template <class Body>
  void visit(int x, int y, const Orientation& o, int across, int along, const Body& body) const {
    for (int j = -along; j <= along; ++j) visit_row(x, y, o, j, 1 - across, across, body);
  }

  bool has_room(int x, int y, const Orientation& o) const {
    const Pixel *first = at(x, y), *second = o.turned ? at(x, y + 1) : at(x + 1, y);
    if (!second || first->surface == 0 || second->surface != first->surface) return false;
    std::array<int, 2> near{}, all{};
    visit(x, y, o, params_.across, params_.along, [&](const Pixel&, int i) {
      ++all[i > 0];
      near[i > 0] += i >= -1 && i <= 2;
    });
    const double rows = filled * (2 * params_.along + 1);
    return std::min(all[0], all[1]) >= rows * params_.across && std::min(near[0], near[1]) >= 2 * rows;
  }

  /// The test's difference between the two pixels on either side of the edge.
  Opponent near_step(int x, int y, const Orientation& o) const {
    Opponent sums[2] = {};
    double counts[2] = {};
    if (at(x, y)->surface == 0) return {};
    visit(x, y, o, 2, params_.along, [&](const Pixel& pixel, int i) {
      ++counts[i > 0];
      for (std::size_t c = 0; c < 3; ++c) sums[i > 0][c] += pixel.test[c];
    });
    if (!(counts[0] > 0 && counts[1] > 0)) return {};
    Opponent step;
    for (std::size_t c = 0; c < 3; ++c) step[c] = sums[1][c] / counts[1] - sums[0][c] / counts[0];
    return step;
  }

  /// Whether the test steps no more at the pair before and the pair after, colour by colour: an edge is a
  /// line, not a band.
  std::array<bool, 3> find_steepest(int x, int y, const Orientation& o, const Opponent& near) const {
    std::array<bool, 3> steepest = {true, true, true};
    for (const int i : {-1, 1}) {
      const int u = o.turned ? x : x + i, v = o.turned ? y + i : y;
      if (!at(u, v)) continue;
      const Opponent beside = near_step(u, v, o);
      for (std::size_t c = 0; c < 3; ++c) steepest[c] &= !(std::abs(beside[c]) > 1.05 * std::abs(near[c]));
    }
    return steepest;
  }

  /// Step of the albedo's logarithm from one side's two nearest pixels to the other's.
  double albedo_across(int x, int y, const Orientation& o) const {
    double sums[2] = {}, counts[2] = {};
    visit(x, y, o, 2, params_.along,
          [&](const Pixel& pixel, int i) { ++counts[i > 0], sums[i > 0] += pixel.albedo; });
    return sums[1] / counts[1] - sums[0] / counts[0];
  }

  /// Over a window larger by `scale` than asked for.
  std::optional<Step> fit(int x, int y, const Orientation& o, double scale) const {
    std::array<Column, terms> matrix{};
    std::array<Column, 3> error{}, test{};
    Opponent squares{}, test_squares{};
    double count = 0;
    const int across = static_cast<int>(scale * params_.across),
              along = static_cast<int>(scale * params_.along);
    for (int j = -along; j <= along; ++j) {
      for (const double step : {-0.5, 0.5}) {
        // On one side of a row only the second term changes.
        double n = 0, sum_x = 0, sum_xx = 0;
        Opponent sum_e{}, sum_xe{}, sum_t{}, sum_xt{};
        visit_row(x, y, o, j, step < 0 ? 1 - across : 1, step < 0 ? 0 : across,
                  [&](const Pixel& pixel, int i) {
                    const double u = i - 0.5;
                    n += 1, sum_x += u, sum_xx += u * u;
                    for (std::size_t c = 0; c < 3; ++c) {
                      const double e = pixel.error[c], t = pixel.test[c];
                      sum_e[c] += e, sum_xe[c] += u * e, squares[c] += e * e;
                      sum_t[c] += t, sum_xt[c] += u * t, test_squares[c] += t * t;
                    }
                  });
        const Column row = {1, 0, static_cast<double>(j), step};
        for (std::size_t a = 0; a < terms; ++a) {
          for (std::size_t b = 0; b < terms; ++b) matrix[a][b] += n * row[a] * row[b];
          matrix[a][1] += sum_x * row[a], matrix[1][a] += sum_x * row[a];
          for (std::size_t c = 0; c < 3; ++c)
            error[c][a] += row[a] * sum_e[c], test[c][a] += row[a] * sum_t[c];
        }
        matrix[1][1] += sum_xx;
        for (std::size_t c = 0; c < 3; ++c) error[c][1] += sum_xe[c], test[c][1] += sum_xt[c];
        count += n;
      }
    }
    if (params_.along == 0) matrix[2][2] = 1;  // a line has no slope along the edge
    const auto inverted = inverse(matrix);
    if (!inverted || count <= terms) return {};
    const auto term = [&](const Column& right, std::size_t a) {
      double sum = 0;
      for (std::size_t b = 0; b < terms; ++b) sum += (*inverted)[a][b] * right[b];
      return sum;
    };
    const auto deviation = [&](const Column& right, double sum_of_squares) {
      for (std::size_t a = 0; a < terms; ++a) sum_of_squares -= term(right, a) * right[a];
      return std::sqrt(std::max(0.0, sum_of_squares) / (count - terms) * (*inverted)[3][3]);
    };
    Step step;
    for (std::size_t c = 0; c < 3; ++c) {
      step.error[c] = term(error[c], 3);
      step.deviation[c] = deviation(error[c], squares[c]);
      step.test[c] = term(test[c], 3);
      step.test_deviation[c] = deviation(test[c], test_squares[c]);
      step.slope[c] = term(test[c], 1);
    }
    return step;
  }

  const std::vector<Pixel>& pixels_;
  int width_, height_;
  const FalseEdgeParams& params_;
};

}  // namespace

FalseEdges false_edges(const SurfacePicture& truth, const SurfacePicture& test,
                       const FalseEdgeParams& params) {
  check(truth, test, params);
  const int width = truth.indirect.width, height = truth.indirect.height;
  const std::vector<Pixel> pixels = pixels_of(truth, test, params.floor);
  const Windows windows(pixels, width, height, params);
  FalseEdges result;
  result.map = Image(width, height, 1);
  std::vector<double> least(pixels.size(), -1);
  parallel_for(static_cast<std::size_t>(height), 1, [&](std::size_t row) {
    const int y = static_cast<int>(row);
    for (int x = 0; x < width; ++x) {
      float& shown = *result.map.at(x, y);
      shown = std::numeric_limits<float>::quiet_NaN();
      if (!windows.testable(x, y)) continue;
      shown = static_cast<float>(windows.false_step(x, y));
      if (x % sample == 0 && y % sample == 0)
        least[row * static_cast<std::size_t>(width) + static_cast<std::size_t>(x)] = windows.least_step(x, y);
    }
  });
  result.pixels = pixels.size();
  for (const float step : result.map.pixels) {
    result.tested += !std::isnan(step);
    result.edges += step > 0;
  }
  if (result.tested > 0)
    result.share = static_cast<double>(result.edges) / static_cast<double>(result.tested);
  std::erase_if(least, [](double step) { return !(step >= 0) || !std::isfinite(step); });
  if (!least.empty()) {
    const auto middle = least.begin() + static_cast<std::ptrdiff_t>(least.size() / 2);
    std::nth_element(least.begin(), middle, least.end());
    result.least_step = *middle;
  }
  return result;
}

}  // namespace ssphh::metrics
