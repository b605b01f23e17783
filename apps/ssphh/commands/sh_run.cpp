#include <algorithm>
#include <cmath>

#include <fmt/format.h>

#include <ssphh/core/file.h>
#include <ssphh/core/log.h>
#include <ssphh/core/parallel.h>
#include <ssphh/image/io.h>
#include <ssphh/sh/evaluate.h>
#include <ssphh/sh/irradiance.h>
#include <ssphh/sh/project.h>
#include <ssphh/sh/reconstruct.h>
#include <ssphh/sh/rotate.h>

#include "commands/sh.h"
#include "commands/sh_file.h"
#include "results/lobe_sheet.h"

namespace ssphh::app {
namespace {

vec3 unit_vector(const char* option, const std::vector<double>& v) {
  const glm::dvec3 d = v.size() == 3 ? glm::dvec3(v[0], v[1], v[2]) : glm::dvec3(0);
  const double length = glm::length(d);
  if (!(length > 0) || !std::isfinite(length)) {
    throw Error(option, "is not a direction", "give three finite numbers that are not all 0");
  }
  return vec3(d / length);
}

/// Writes the file, if there is to be one.
ShCoefficients written(ShCoefficients result, const std::string& output) {
  if (!output.empty()) write_file(output, json::print(to_json(result), 1) + "\n");
  return result;
}

ShCoefficients written(const sh::RadianceSh& sh, const std::string& output) {
  for (int k = 0; k < static_cast<int>(sh.values.size()); ++k) {
    if (!is_finite(sh[k]))
      throw Error("coefficients", "the result is not finite", "the input's values are too large");
  }
  return written(ShCoefficients{{sh.values.begin(), sh.values.end()}, sh.degree(), {}}, output);
}

glm::dquat rotation_of(const ShRotateOptions& o) {
  if (!o.quaternion.empty()) {
    const glm::dquat q = o.quaternion.size() == 4
                             ? glm::dquat(o.quaternion[3], o.quaternion[0], o.quaternion[1], o.quaternion[2])
                             : glm::dquat(0, 0, 0, 0);
    const double length = glm::length(q);
    if (!(length > 0) || !std::isfinite(length)) {
      throw Error("--quaternion", "is not a rotation", "give four finite numbers that are not all 0");
    }
    return q;
  }
  if (o.axis.empty())
    throw Error("sh rotate", "no rotation given", "use --axis with --angle, or --quaternion");
  if (!std::isfinite(o.angle)) throw Error("--angle", "is not finite");
  return glm::angleAxis(glm::radians(o.angle), glm::normalize(glm::dvec3(unit_vector("--axis", o.axis))));
}

double checked_width(const char* option, double width) {
  if (!(width > 0)) throw Error(option, "must be a width above 0 bands");
  return width;
}

}  // namespace

ShEvalResult run_sh_eval(const ShEvalOptions& o, const Control&) {
  const glm::dvec3 d = glm::normalize(glm::dvec3(unit_vector("--direction", o.direction)));
  ShEvalResult result;
  result.values.resize(static_cast<std::size_t>(sh::coefficient_count(o.degree)));
  sh::eval_basis(o.degree, d, result.values);
  return result;
}

ShCoefficients run_sh_project(const ShProjectOptions& o, const Control& control) {
  const image::Image picture = image::read_image(o.image);
  for (const float value : picture.pixels) {
    if (!std::isfinite(value)) throw Error(o.image, "has pixels that are NaN or infinite");
  }
  const image::CubeMap cube = image::to_cube(picture, o.layout, 0, control);
  // Grey images become RGB.
  sh::CubeFaces faces;
  std::array<image::Image, 6> colour;
  for (std::size_t f = 0; f < 6; ++f) {
    const image::Image& face = cube.faces[f];
    if (face.channels == 1) {
      colour[f] = image::Image(cube.size, cube.size, 3);
      for (std::size_t i = 0; i < colour[f].pixels.size(); ++i) colour[f].pixels[i] = face.pixels[i / 3];
    }
    faces[f] = face.channels == 1 ? colour[f].pixels : face.pixels;
  }
  const int channels = cube.faces[0].channels == 4 ? 4 : 3;
  return written(sh::project_cube(o.degree, cube.size, faces, channels), o.output);
}

ShIrradianceResult run_sh_irradiance(const ShIrradianceOptions& o, const Control&) {
  const vec3 n = unit_vector("--normal", o.normal);
  return {sh::irradiance(read_radiance_sh(o.file), n)};
}

ShReconstructResult run_sh_reconstruct(const ShReconstructOptions& o, const Control& control) {
  image::format_of_extension(o.output);
  const sh::RadianceSh radiance = read_radiance_sh(o.file);
  const sh::IrradianceSh irradiance = sh::irradiance_from_radiance(radiance);

  // Evaluate at the texels of a cube of like resolution, then lay it out.
  const int face = image::is_cube_layout(o.layout) ? o.size : std::max(1, o.size / 2);
  image::CubeMap cube(face);
  parallel_for(
      static_cast<std::size_t>(6 * face), 8,
      [&](std::size_t row) {
        const int f = static_cast<int>(row) / face, y = static_cast<int>(row) % face;
        for (int x = 0; x < face; ++x) {
          const vec3 d = texel_direction(f, x, y, face);
          cube.faces[f].set_rgb(x, y, o.irradiance ? sh::eval(irradiance, d) : sh::eval(radiance, d));
        }
      },
      control);
  ShReconstructResult result{image::from_cube(cube, o.layout, o.size, control)};
  image::write_image(o.output, result.picture);
  return result;
}

ShPlotResult run_sh_plot(const ShPlotOptions& o, const Control& control) {
  image::format_of_extension(o.output);
  ShPlotResult result;
  if (o.file.empty()) {
    result = {basis_sheet(o.degree, o.size, control), o.degree};
  } else {
    const sh::RadianceSh light = read_radiance_sh(o.file);
    result = {lobe_picture(light, 4 * o.size, control), light.degree()};
  }
  image::write_image(o.output, result.picture);
  return result;
}

ShCoefficients run_sh_rotate(const ShRotateOptions& o, const Control&) {
  const glm::dquat q = rotation_of(o);
  const sh::RadianceSh radiance = read_radiance_sh(o.file);
  const glm::dmat3 matrix = glm::mat3_cast(glm::normalize(q));
  return written(sh::Rotation(radiance.degree(), matrix).apply(radiance), o.output);
}

ShCoefficients run_sh_convert(const ShConvertOptions& o, const Control&) {
  const sh::RadianceSh radiance = sh::from_convention(read_sh_values(o.file, o.from), o.from);
  const int degree = std::min(radiance.degree(), sh::convention_max_degree(o.to));
  ShCoefficients result{sh::to_convention(radiance, o.to), degree, o.to};
  if (degree < radiance.degree()) {
    log_warning("{}: bands {}..{} are dropped, {} holds degree {}", o.file, degree + 1, radiance.degree(),
                name_of(o.to), degree);
  }
  return written(std::move(result), o.output);
}

ShCoefficients run_sh_window(const ShWindowOptions& o, const Control&) {
  const sh::RadianceSh radiance = read_radiance_sh(o.file);
  sh::BandScales scales;
  if (o.lanczos) {
    scales = sh::lanczos_window(checked_width("--lanczos", *o.lanczos));
  } else if (o.hanning) {
    scales = sh::hanning_window(checked_width("--hanning", *o.hanning));
  } else if (o.automatic) {
    const sh::AutoWindow window = sh::choose_window(radiance, o.goal);
    if (!window.reached)
      log_warning("{}: the mean is negative; no window can make {} positive", o.file, name_of(o.goal));
    scales = sh::lanczos_window(window.width);
  } else {
    throw Error("sh window", "no window chosen", "use --auto, --lanczos W or --hanning W");
  }
  return written(sh::apply_window(radiance, scales), o.output);
}

json::Value to_json(const ShEvalResult& result, const ShEvalOptions& o) {
  return {{"degree", o.degree}, {"values", result.values}};
}

std::string to_text(const ShEvalResult& result, const ShEvalOptions& o) {
  std::string text;
  for (int l = 0; l <= o.degree; ++l) {
    for (int m = -l; m <= l; ++m) {
      text += fmt::format("{}{:3} {:4}  {:>12.8f}", text.empty() ? "" : "\n", l, m,
                          result.values[sh::coefficient_index(l, m)]);
    }
  }
  return text;
}

json::Value to_json(const ShIrradianceResult& result, const ShIrradianceOptions&) {
  return {{"irradiance", rgb_to_json(result.irradiance)}};
}

std::string to_text(const ShIrradianceResult& result, const ShIrradianceOptions&) {
  const vec3& e = result.irradiance;
  return fmt::format("{:.6g} {:.6g} {:.6g}", e.x, e.y, e.z);
}

json::Value to_json(const ShReconstructResult& result, const ShReconstructOptions& o) {
  return {{"output", o.output}, {"width", result.picture.width}, {"height", result.picture.height}};
}

std::string to_text(const ShReconstructResult& result, const ShReconstructOptions& o) {
  return fmt::format("{}: {} × {}", o.output, result.picture.width, result.picture.height);
}

json::Value to_json(const ShPlotResult& result, const ShPlotOptions& o) {
  return {{"output", o.output},
          {"width", result.picture.width},
          {"height", result.picture.height},
          {"degree", result.degree}};
}

std::string to_text(const ShPlotResult& result, const ShPlotOptions& o) {
  const char* shown = o.file.empty() ? "Y_lm: row l from the top, m from -l to l" : "luminance";
  return fmt::format("{}: {} × {}, degree {}, {}; blue positive, orange negative", o.output,
                     result.picture.width, result.picture.height, result.degree, shown);
}

json::Value to_json(const ShCoefficients& result) {
  json::Value object = sh_to_json(result.values, result.degree);
  if (result.convention) object["convention"] = name_of(*result.convention);
  return object;
}

std::string to_text(const ShCoefficients& result) {
  return sh_text(to_json(result));
}

}  // namespace ssphh::app
