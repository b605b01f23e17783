#pragma once
/// `ssphh sh`: spherical harmonics, evaluated, projected, rotated and converted. A `file` to read is one of
/// sh_file.h, "-" stdin; an `output` is such a file to write, empty: none. No command is long enough to tell
/// of its progress, but those of images can be cancelled.

#include <optional>
#include <string>
#include <vector>

#include <ssphh/core/control.h>
#include <ssphh/core/json.h>
#include <ssphh/image/cube_layout.h>
#include <ssphh/sh/convert.h>
#include <ssphh/sh/window.h>

namespace ssphh::app {

/// What the commands give that write such files.
struct ShCoefficients {
  std::vector<vec3> values;  ///< as the convention stores them
  int degree = 0;
  std::optional<sh::Convention> convention;  ///< of `convert`; none: this project's, and not told
};

struct ShEvalOptions {
  int degree = 9;                 ///< highest band, 0..10
  std::vector<double> direction;  ///< three finite numbers, not all 0, of any length
};
struct ShEvalResult {
  std::vector<double> values;  ///< of all Y_lm, by sh::coefficient_index()
};
/// Throws Error for what is no direction.
ShEvalResult run_sh_eval(const ShEvalOptions& options, const Control& control = {});

struct ShProjectOptions {
  std::string image;  ///< file that holds the radiance of the whole sphere
  image::Layout layout = image::Layout::equirect;
  int degree = 9;  ///< highest band, 0..10
  std::string output;
};
/// Throws Error for files that cannot be read or written, for pixels that are not finite or too large, and
/// for images whose size the layout cannot have.
ShCoefficients run_sh_project(const ShProjectOptions& options, const Control& control = {});

struct ShIrradianceOptions {
  std::string file;
  std::vector<double> normal;  ///< three finite numbers, not all 0, of any length
};
struct ShIrradianceResult {
  vec3 irradiance{0};  ///< [W/m²]
};
/// Throws Error for what is no direction (before anything else) and for files that cannot be read.
ShIrradianceResult run_sh_irradiance(const ShIrradianceOptions& options, const Control& control = {});

struct ShReconstructOptions {
  std::string file;
  std::string output;  ///< image to write: .exr .hdr .png .jpg
  image::Layout layout = image::Layout::equirect;
  int size = 256;           ///< height of a face, or of the whole equirect or angular image, in pixels
  bool irradiance = false;  ///< E(n) in place of radiance
};
struct ShReconstructResult {
  image::Image picture;  ///< as it was written, before the file's format rounds it
};
/// Throws Error for an output of unknown extension (before anything else) and for files that cannot be read
/// or written.
ShReconstructResult run_sh_reconstruct(const ShReconstructOptions& options, const Control& control = {});

struct ShPlotOptions {
  std::string file = {};    ///< whose luminance is drawn; empty: all Y_lm are, row by row
  int degree = 10;          ///< without a file, highest band, 0..10
  int size = 96;            ///< edge of a lobe's cell [pixels]; with a file, of the picture, 4 times that
  std::string output = {};  ///< image to write: .exr .hdr .png .jpg
};
struct ShPlotResult {
  image::Image picture;  ///< as it was written, before the file's format rounds it
  int degree = 0;        ///< of what is drawn
};
/// Lobes: distance from the middle |f(ω)|, blue where f is positive and orange where it is negative
/// (results/lobe_sheet.h). Throws Error for an output of unknown extension (before anything else) and for
/// files that cannot be read or written.
ShPlotResult run_sh_plot(const ShPlotOptions& options, const Control& control = {});

/// What came from d comes from R d then.
struct ShRotateOptions {
  std::string file;
  std::vector<double> axis;  ///< three finite numbers, not all 0
  double angle = 0;          ///< degrees, counter-clockwise about the axis
  std::vector<double>
      quaternion;  ///< x, y, z, w of any length but 0, in place of axis and angle; empty: none
  std::string output;
};
/// Throws Error for what is no rotation (before anything else), for files that cannot be read or written and
/// where the result is not finite.
ShCoefficients run_sh_rotate(const ShRotateOptions& options, const Control& control = {});

struct ShConvertOptions {
  std::string file;
  sh::Convention from = sh::Convention::ssphh, to = sh::Convention::ssphh;
  std::string output;
};
/// Scale and sign of each coefficient; axes stay. Warns in the log about bands that `to` does not hold.
/// Throws Error for files that cannot be read or written.
ShCoefficients run_sh_convert(const ShConvertOptions& options, const Control& control = {});

/// The first that is given counts: lanczos, hanning, automatic.
struct ShWindowOptions {
  std::string file;
  std::optional<double> lanczos, hanning;              ///< widths, over 0 bands
  bool automatic = false;                              ///< the mildest Lanczos window without negative values
  sh::NonNegative goal = sh::NonNegative::irradiance;  ///< what the automatic one keeps from being negative
  std::string output;
};
/// Warns in the log where no window can reach the goal. Throws Error where none is given, for widths that are
/// not over 0, for files that cannot be read or written and where the result is not finite.
ShCoefficients run_sh_window(const ShWindowOptions& options, const Control& control = {});

json::Value to_json(const ShEvalResult& result, const ShEvalOptions& options);
std::string to_text(const ShEvalResult& result, const ShEvalOptions& options);
json::Value to_json(const ShIrradianceResult& result, const ShIrradianceOptions& options);
std::string to_text(const ShIrradianceResult& result, const ShIrradianceOptions& options);
json::Value to_json(const ShReconstructResult& result, const ShReconstructOptions& options);
std::string to_text(const ShReconstructResult& result, const ShReconstructOptions& options);
json::Value to_json(const ShPlotResult& result, const ShPlotOptions& options);
std::string to_text(const ShPlotResult& result, const ShPlotOptions& options);
/// The object that such a file holds.
json::Value to_json(const ShCoefficients& result);
std::string to_text(const ShCoefficients& result);
template <class Options>
json::Value to_json(const ShCoefficients& result, const Options&) {
  return to_json(result);
}
template <class Options>
std::string to_text(const ShCoefficients& result, const Options&) {
  return to_text(result);
}

}  // namespace ssphh::app
