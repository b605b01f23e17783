#include <algorithm>
#include <cmath>
#include <limits>
#include <numbers>

#include <fmt/format.h>

#include <ssphh/core/require.h>
#include <ssphh/image/io.h>
#include <ssphh/metrics/compare.h>
#include <ssphh/metrics/flip.h>
#include <ssphh/metrics/mask.h>
#include <ssphh/metrics/perceptual.h>
#include <ssphh/report/measure.h>

namespace ssphh::report {
namespace {

namespace fs = std::filesystem;
using image::Image;

constexpr float least_albedo = 0.01f;

fs::path layer_file(const fs::path& file, const std::string& layer) {
  return file.parent_path() / (file.stem().string() + "." + layer + file.extension().string());
}

Image read_layer(const fs::path& file, const std::string& layer) {
  if (layer.empty()) return image::read_image(file);
  if (layer != "irradiance") return image::read_image(layer_file(file, layer));
  Image light = image::read_image(layer_file(file, "indirect"));
  const Image albedo = image::read_image(layer_file(file, "albedo"));
  if (light.width != albedo.width || light.height != albedo.height || light.channels == 1)
    throw Error(file.string(), "indirect light and albedo must be in colour and of one size");
  for (int y = 0; y < light.height; ++y) {
    for (int x = 0; x < light.width; ++x) {
      const vec3 a = albedo.rgb(x, y);
      const bool dark = std::min({a.x, a.y, a.z}) < least_albedo;
      light.set_rgb(x, y,
                    dark ? vec3(std::numeric_limits<float>::quiet_NaN())
                         : std::numbers::pi_v<float> * light.rgb(x, y) / a);
    }
  }
  return light;
}

bool same_shape(const Image& a, const Image& b) {
  return a.width == b.width && a.height == b.height && a.channels == b.channels &&
         a.pixels.size() == b.pixels.size();
}

// Mean of variance/(reference² + ε) over finite values.
double relative_noise(const Image& reference, const Image& variance) {
  double sum = 0;
  std::size_t count = 0;
  for (std::size_t i = 0; i < reference.pixels.size(); ++i) {
    const double r = reference.pixels[i], v = variance.pixels[i];
    if (!std::isfinite(r) || !std::isfinite(v)) continue;
    sum += v / (r * r + metrics::relative_epsilon);
    ++count;
  }
  return count > 0 ? sum / static_cast<double>(count) : 0;
}

// Unbiased variance of one run, per value.
Image variance_between(const std::vector<LayerPicture>& runs) {
  Image variance = runs.front().picture;
  const double n = static_cast<double>(runs.size());
  for (std::size_t i = 0; i < variance.pixels.size(); ++i) {
    double mean = 0, squares = 0;
    for (const LayerPicture& run : runs) mean += run.picture.pixels[i] / n;
    for (const LayerPicture& run : runs) squares += std::pow(run.picture.pixels[i] - mean, 2);
    variance.pixels[i] = static_cast<float>(squares / (n - 1));
  }
  return variance;
}

Image crop(const Image& image, const Inset& inset) {
  const int x0 = static_cast<int>(inset.x0 * image.width), y0 = static_cast<int>(inset.y0 * image.height);
  const int x1 = std::max(x0 + 1, static_cast<int>(inset.x1 * image.width));
  const int y1 = std::max(y0 + 1, static_cast<int>(inset.y1 * image.height));
  Image part(x1 - x0, y1 - y0, image.channels);
  for (int y = y0; y < y1; ++y)
    std::copy(image.at(x0, y), image.at(x0, y) + part.width * part.channels, part.at(0, y - y0));
  return part;
}

double mean_ratio(const metrics::ImageError& e) {
  return (e.mean_ratio[0] + e.mean_ratio[1] + e.mean_ratio[2]) / 3;
}

// 95th percentile of a pixel's mean |d|.
double error_p95(const Image& reference, const Image& test) {
  const Image map = metrics::absolute_error_map(reference, test);
  std::vector<float> errors;
  for (int y = 0; y < map.height; ++y) {
    for (int x = 0; x < map.width; ++x) {
      const vec3 d = map.rgb(x, y);
      if (std::isfinite(d.x + d.y + d.z)) errors.push_back((d.x + d.y + d.z) / 3);
    }
  }
  if (errors.empty()) return 0;
  const auto at = errors.begin() + static_cast<std::ptrdiff_t>(0.95 * static_cast<double>(errors.size() - 1));
  std::nth_element(errors.begin(), at, errors.end());
  return *at;
}

void measure_run(const Image& reference, const Image& test, const MeasureParams& params, LayerMeasure& out) {
  const auto add = [&](const std::string& name, double value) { out.values[name].push_back(value); };
  const metrics::ImageError e = metrics::compare(reference, test);
  add("mae", e.mae), add("rmse", e.rmse), add("mse", e.mse), add("relmse", e.relmse), add("mape", e.mape);
  add("smape", e.smape), add("bias", e.bias), add("max", e.max), add("sum", e.sum);
  add("mean_ratio", mean_ratio(e)), add("nonfinite_pixels", static_cast<double>(e.nonfinite_pixels));
  add("error_p95", error_p95(reference, test));
  const metrics::BlockError blocks =
      metrics::block_error(metrics::pixelated_error_map(reference, test, params.block), params.block);
  add("block_max", blocks.max), add("block_mean", blocks.mean);
  const metrics::DisplayError display = metrics::display_error(reference, test);
  add("psnr", display.psnr), add("ssim", display.ssim);
  metrics::FlipError flip = metrics::hdr_flip(reference, test);
  add("flip", flip.mean);
  if (out.flip.empty()) out.flip = std::move(flip.map);
  for (const Inset& inset : params.insets) {
    const metrics::ImageError part = inset.mask.pixels.empty()
                                         ? metrics::compare(crop(reference, inset), crop(test, inset))
                                         : metrics::compare(metrics::masked(reference, inset.mask), test);
    add("relmse@" + inset.name, part.relmse), add("mean_ratio@" + inset.name, mean_ratio(part));
  }
}

}  // namespace

LayerPicture load_layer(const std::vector<fs::path>& files, const std::string& layer) {
  require(!files.empty(), "layer", "there is no picture");
  LayerPicture result{read_layer(files[0], layer), {}};
  if (files.size() < 2) return result;
  const Image second = read_layer(files[1], layer);
  if (!same_shape(second, result.picture)) throw Error(files[1].string(), "the two halves differ in size");
  result.variance = result.picture;
  for (std::size_t i = 0; i < second.pixels.size(); ++i) {
    const float a = result.picture.pixels[i], b = second.pixels[i];
    result.picture.pixels[i] = 0.5f * (a + b);
    result.variance.pixels[i] = 0.25f * (a - b) * (a - b);
  }
  return result;
}

LayerMeasure measure_layer(const LayerPicture& reference, const std::vector<LayerPicture>& runs,
                           const MeasureParams& params) {
  require(!runs.empty(), "layer", "there is no run to measure");
  const auto check = [](const LayerPicture& layer) {
    require(layer.variance.empty() || same_shape(layer.variance, layer.picture), "layer",
            "the variance is not of the picture's size");
  };
  check(reference);
  for (const LayerPicture& run : runs) {
    check(run);
    require(
        same_shape(run.picture, reference.picture) && run.variance.empty() == runs.front().variance.empty(),
        "layer", "sizes differ between the runs and the reference");
  }
  for (const Inset& inset : params.insets) {
    if (!(inset.x0 >= 0 && inset.x0 < inset.x1 && inset.x1 <= 1 && inset.y0 >= 0 && inset.y0 < inset.y1 &&
          inset.y1 <= 1))
      throw Error("inset " + inset.name, "must be left < right and top < bottom, all within 0..1");
  }
  LayerMeasure out;
  for (const LayerPicture& run : runs) measure_run(reference.picture, run.picture, params, out);
  const bool reference_known = !reference.variance.empty();
  double noise_reference = 0;
  if (reference_known) {
    noise_reference = relative_noise(reference.picture, reference.variance);
    out.values["noise_reference"] = {noise_reference};
    for (const double relmse : out.values["relmse"])
      out.values["relmse_method"].push_back(relmse - noise_reference);
  }
  std::vector<double> noise;
  if (!runs.front().variance.empty()) {
    for (const LayerPicture& run : runs) noise.push_back(relative_noise(reference.picture, run.variance));
  } else if (runs.size() > 1) {
    noise.assign(runs.size(), relative_noise(reference.picture, variance_between(runs)));
  }
  for (std::size_t i = 0; i < noise.size(); ++i)
    out.values["relmse_bias"].push_back(out.values["relmse"][i] - noise_reference - noise[i]);
  if (!noise.empty()) out.values["noise"] = noise;
  return out;
}

}  // namespace ssphh::report
