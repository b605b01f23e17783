#include <cmath>

#include <fmt/format.h>

#include <ssphh/core/enum_names.h>
#include <ssphh/image/exposure.h>
#include <ssphh/image/io.h>
#include <ssphh/image/tonemap.h>
#include <ssphh/metrics/compare.h>
#include <ssphh/metrics/flip.h>
#include <ssphh/metrics/mask.h>
#include <ssphh/metrics/perceptual.h>
#include <ssphh/pipeline/exposure.h>

#include "arrays.h"
#include "work.h"

namespace ssphh::python {
namespace {

using image::Image;

FloatArray read_image(const py::object& path) {
  const std::string file = path_of(path);
  return array_of(run(py::none(), [&](const Control&) { return image::read_image(file); }));
}

image::ToneMap tone_map_of(const Image& picture, std::optional<float> exposure, const std::string& curve) {
  const auto tone = enum_named<image::ToneCurve>("tonemap", curve);
  return {.exposure = exposure ? *exposure : pipeline::suitable_exposure(picture, tone), .curve = tone};
}

void write_image(const py::object& path, const py::object& array, std::optional<float> exposure,
                 const std::string& curve) {
  const std::string file = path_of(path);
  const Image picture = image_of(array, "picture");
  do_work(py::none(), [&](const Control&) {
    const image::FileFormat format = image::format_of_extension(file);
    const bool shown = format == image::FileFormat::png || format == image::FileFormat::jpeg;
    image::write_image(file,
                       shown ? image::tone_map(picture, tone_map_of(picture, exposure, curve)) : picture);
  });
}

py::array_t<std::uint8_t> tone_map(const py::object& array, std::optional<float> exposure,
                                   const std::string& curve) {
  const Image picture = image_of(array, "picture");
  const image::Rgba8 shown = image::to_display(picture, tone_map_of(picture, exposure, curve));
  py::array_t<std::uint8_t> out({py::ssize_t{shown.height}, py::ssize_t{shown.width}, py::ssize_t{3}});
  std::uint8_t* at = out.mutable_data();
  for (std::size_t i = 0; i < shown.rgba.size(); i += 4) at = std::copy_n(shown.rgba.data() + i, 3, at);
  return out;
}

struct Pair {
  Image reference, test;
};

Pair pair_of(const py::object& reference, const py::object& test, const py::object& mask) {
  Pair pair{image_of(reference, "reference"), image_of(test, "test")};
  if (pair.reference.width != pair.test.width || pair.reference.height != pair.test.height)
    throw Error("test", fmt::format("is {} x {} pixels, but the reference is {} x {}", pair.test.width,
                                    pair.test.height, pair.reference.width, pair.reference.height));
  if (!mask.is_none()) pair.reference = metrics::masked(pair.reference, image_of(mask, "mask"));
  return pair;
}

metrics::FlipError flip_of(const Pair& pair, bool display, const metrics::FlipParams& params) {
  return display ? metrics::flip(pair.reference, pair.test, params)
                 : metrics::hdr_flip(pair.reference, pair.test, params);
}

py::dict compare(const py::object& reference, const py::object& test, const py::object& mask, bool display,
                 double pixels_per_degree) {
  const Pair pair = pair_of(reference, test, mask);
  struct Errors {
    metrics::ImageError linear;
    metrics::DisplayError display;
    double flip;
  };
  const Errors e = run(py::none(), [&](const Control&) {
    return Errors{metrics::compare(pair.reference, pair.test),
                  metrics::display_error(pair.reference, pair.test),
                  flip_of(pair, display, {pixels_per_degree}).mean};
  });
  return py::dict(
      "mae"_a = e.linear.mae, "bias"_a = e.linear.bias, "max"_a = e.linear.max, "mse"_a = e.linear.mse,
      "rmse"_a = e.linear.rmse, "relmse"_a = e.linear.relmse, "mape"_a = e.linear.mape,
      "smape"_a = e.linear.smape,
      "mean_ratio"_a = py::make_tuple(e.linear.mean_ratio[0], e.linear.mean_ratio[1], e.linear.mean_ratio[2]),
      "flip"_a = e.flip, "psnr"_a = e.display.psnr, "ssim"_a = e.display.ssim, "pixels"_a = e.linear.pixels,
      "left_out"_a = e.linear.nonfinite_pixels);
}

FloatArray error_map(const py::object& reference, const py::object& test, const std::string& map,
                     bool display, double pixels_per_degree) {
  const Pair pair = pair_of(reference, test, py::none());
  return array_of(run(py::none(), [&](const Control&) {
    using metrics::ErrorMap;
    const std::optional<ErrorMap> shown = parse_enum<ErrorMap>(map);
    if (shown == ErrorMap::absolute) return metrics::absolute_error_map(pair.reference, pair.test);
    if (shown == ErrorMap::with_sign) return metrics::signed_error_map(pair.reference, pair.test);
    if (shown == ErrorMap::relmse) return metrics::relative_squared_error_map(pair.reference, pair.test);
    if (shown == ErrorMap::flip) return flip_of(pair, display, {pixels_per_degree}).map;
    // The others ask for more than two pictures.
    std::vector<std::string> names = names_of<ErrorMap>();
    for (const ErrorMap more : {ErrorMap::pixelated, ErrorMap::edges}) std::erase(names, name_of(more));
    throw Error("map", none_of(map, names));
  }));
}

}  // namespace

void add_images(py::module_& m) {
  const py::none none;
  const double usual = metrics::FlipParams{}.pixels_per_degree;
  m.def("read_image", &read_image, "Reads EXR, HDR, PNG, JPEG or WebP: linear, height x width (x 3 or 4).",
        "path"_a);
  m.def("write_image", &write_image, "Writes .exr or .hdr (linear), .png or .jpg (tone mapped).", "path"_a,
        "picture"_a, py::kw_only(), "exposure"_a = none, "tonemap"_a = name_of(image::ToneCurve::clip));
  m.def("tone_map", &tone_map,
        "8-bit sRGB of linear radiance, as pyplot.imshow takes it: height x width x 3.", "picture"_a,
        py::kw_only(), "exposure"_a = none, "tonemap"_a = name_of(image::ToneCurve::clip));
  m.def("compare", &compare, "Errors of a picture against a reference, as `ssphh compare` tells them.",
        "reference"_a, "test"_a, py::kw_only(), "mask"_a = none, "display"_a = false,
        "pixels_per_degree"_a = usual);
  m.def("error_map", &error_map, "Where the errors are: absolute, signed, relmse or flip.", "reference"_a,
        "test"_a, "map"_a = name_of(metrics::ErrorMap::absolute), py::kw_only(), "display"_a = false,
        "pixels_per_degree"_a = usual);
}

}  // namespace ssphh::python
