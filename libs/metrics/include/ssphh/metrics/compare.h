#pragma once
/// Errors between a reference image and a test image of the same size, scene-linear.
///
/// Let d = test − reference per pixel and colour channel, over the N·C values of N pixels that are finite in
/// both images (C = 3, or 1 when both images have one channel; alpha is not compared). Pixels with an
/// infinite or NaN channel in either image are left out of every number and counted. Sums run in double
/// precision and in a fixed order, so they do not depend on the number of threads.

#include <array>
#include <cstdint>

#include <ssphh/core/enum_names.h>
#include <ssphh/image/image.h>

namespace ssphh::metrics {

/// Added to the squared reference in relMSE, so that black pixels do not decide it.
inline constexpr double relative_epsilon = 1e-2;

/// What a map of errors shows: |d|, d with its sign, the sum of |d| in each block, d² over the reference's,
/// FLIP, false edges.
enum class ErrorMap { absolute, with_sign, pixelated, relmse, flip, edges };
constexpr auto enum_table(ErrorMap) {
  using enum ErrorMap;
  return std::to_array<EnumName<ErrorMap>>({{absolute, "absolute"},
                                            {with_sign, "signed"},
                                            {pixelated, "pixelated"},
                                            {relmse, "relmse"},
                                            {flip, "flip"},
                                            {edges, "edges"}});
}

struct ImageError {
  int width = 0, height = 0;
  std::uint64_t pixels = 0;            ///< N: compared pixels
  std::uint64_t nonfinite_pixels = 0;  ///< left out
  double sum = 0;                      ///< Σ|d|
  double mae = 0;                      ///< Σ|d| / NC
  double bias = 0;                     ///< Σd / NC: positive when the test image is too bright
  double max = 0;                      ///< max |d|
  double mse = 0;                      ///< Σd² / NC
  double rmse = 0;                     ///< √mse
  double relmse = 0;                   ///< Σ d²/(ref² + ε) / NC, ε = relative_epsilon
  double mape = 0;                     ///< Σ |d|/(|ref| + ε) / NC, a fraction, not per cent
  double smape = 0;                    ///< Σ |d|/(|ref| + |test| + ε) / NC, in [0, 1]
  /// mean(test)/mean(reference) per channel; NaN where the reference's mean is 0. Channels repeat for grey
  /// images.
  std::array<double, 3> mean_ratio{};
};

/// Throws Error when the sizes differ or an image is empty. Everything is 0 (ratios NaN) when no pixel is
/// finite.
ImageError compare(const image::Image& reference, const image::Image& test);

/// |d|, d, or d²/(ref² + ε) per pixel and channel; pixels that are not finite in both images become NaN.
image::Image absolute_error_map(const image::Image& reference, const image::Image& test);
image::Image signed_error_map(const image::Image& reference, const image::Image& test);
image::Image relative_squared_error_map(const image::Image& reference, const image::Image& test);

/// The paper's pixelated map: one pixel per block of block×block pixels, holding the *sum* (not the mean) of
/// |d| in it per channel, so that a block says how much energy is wrong there. Blocks at the right and bottom
/// edge may be ragged and hold fewer pixels. Pixels that are not finite count nothing.
image::Image pixelated_error_map(const image::Image& reference, const image::Image& test, int block);

/// Statistics over the blocks of a pixelated map, each block's channels added up.
struct BlockError {
  int block = 0, columns = 0, rows = 0;
  double max = 0, mean = 0;
  int max_column = 0, max_row = 0;  ///< the first block that has the maximum
};

BlockError block_error(const image::Image& pixelated, int block);

}  // namespace ssphh::metrics
