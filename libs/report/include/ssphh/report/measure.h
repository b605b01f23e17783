#pragma once
/// The errors of a method's pictures against the reference's, with noise told apart from bias.

#include <filesystem>
#include <map>
#include <string>
#include <vector>

#include <ssphh/image/image.h>
#include <ssphh/report/plan.h>

namespace ssphh::report {

/// One run's picture of one layer. With halves, of independent random numbers, `picture` is their mean.
struct LayerPicture {
  image::Image picture;
  image::Image variance;  ///< of the mean, estimated from the halves per value: (a − b)²/4; empty without
};

/// Reads OUT.exr, or OUT.LAYER.exr, of one picture or two halves. Layer "" is the picture itself;
/// "irradiance" is π·indirect/albedo [W/m²], NaN (left out everywhere) where a channel of the albedo is
/// below 0.01: exact for Lambertian surfaces seen directly. Throws Error when a file is missing.
LayerPicture load_layer(const std::vector<std::filesystem::path>& files, const std::string& layer);

struct MeasureParams {
  int block = 16;
  std::vector<Inset> insets;
};

/// Per value name one number for each run: those of `ssphh compare` (mae rmse relmse smape bias mean_ratio
/// psnr ssim flip …; docs/report.md lists them), `error_p95`, `block_max`, `block_mean`; `relmse@INSET` and
/// `mean_ratio@INSET`.
/// Noise, each in units of relMSE, the mean of variance/(reference² + ε):
///   `noise_reference`  of the reference, when it has halves
///   `noise`            of one run, from its halves or from two or more runs
///   `relmse_bias`      relmse − noise_reference − noise: what neither explains; only where `noise` is known
///   `relmse_method`    relmse − noise_reference: the method's bias and noise; only where the reference has
///   halves
/// Differences of estimates may fall below 0 by chance.
struct LayerMeasure {
  std::map<std::string, std::vector<double>> values;
  image::Image flip;  ///< of the first run; one channel
};

/// Throws Error when sizes differ. `runs` is not empty.
LayerMeasure measure_layer(const LayerPicture& reference, const std::vector<LayerPicture>& runs,
                           const MeasureParams& params);

}  // namespace ssphh::report
