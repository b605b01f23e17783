#include "commands/compare.h"

#include <cmath>
#include <filesystem>

#include <fmt/format.h>

#include <ssphh/core/file.h>
#include <ssphh/image/io.h>
#include <ssphh/metrics/heat_map.h>
#include <ssphh/metrics/mask.h>
#include <ssphh/trace/render_state.h>

#include "commands/command.h"
#include "options/picture_options.h"
#include "results/json_values.h"
#include "results/pictures.h"
#include "results/tev.h"

namespace ssphh::app {
namespace {

using image::Image;
using metrics::ErrorMap;
using trace::RenderLayer;

Image read_exposed(const std::string& path, float exposure) {
  Image image = image::read_image(path);
  const float factor = std::exp2(exposure);
  if (factor != 1) {
    for (float& x : image.pixels) x *= factor;
  }
  return image;
}

bool is_display_file(const std::string& path) {
  const image::FileFormat format = image::format_of_extension(path);
  return format == image::FileFormat::png || format == image::FileFormat::jpeg;
}

CompareResult measure(const CompareOptions& options, const Image& reference, const Image& test) {
  CompareResult e;
  e.linear = metrics::compare(reference, test);
  e.blocks =
      metrics::block_error(metrics::pixelated_error_map(reference, test, options.block), options.block);
  e.display = metrics::display_error(reference, test);
  e.hdr = !is_display_file(options.reference) || !is_display_file(options.test);
  const metrics::FlipParams flip{options.pixels_per_degree};
  e.flip = e.hdr ? metrics::hdr_flip(reference, test, flip) : metrics::flip(reference, test, flip);
  return e;
}

/// The picture of a layer, written by `render --aov`, that stands beside another; an optional one is empty
/// where there is none.
Image aov_beside(const std::string& picture, RenderLayer layer, bool optional = false) {
  const std::filesystem::path path = beside(picture, fmt::format("{}.exr", name_of(layer)));
  if (std::filesystem::exists(path)) return image::read_image(path);
  if (optional) return {};
  throw Error(path.string(), "is not there, and false edges are looked for in it",
              "write REF with `ssphh render --aov indirect,albedo,normal,depth` and TEST with `--aov "
              "indirect,albedo`");
}

/// Of the indirect light alone; `test` becomes that of the test.
metrics::FalseEdges edges_between(const CompareOptions& options, const Image& mask, Image& test) {
  metrics::SurfacePicture truth{aov_beside(options.reference, RenderLayer::indirect),
                                aov_beside(options.reference, RenderLayer::albedo),
                                aov_beside(options.reference, RenderLayer::normal),
                                aov_beside(options.reference, RenderLayer::depth)};
  metrics::SurfacePicture found{aov_beside(options.test, RenderLayer::indirect),
                                aov_beside(options.test, RenderLayer::albedo, true),
                                {},
                                {}};
  if (found.albedo.empty()) found.albedo = truth.albedo;
  if (!mask.empty()) truth.indirect = metrics::masked(truth.indirect, mask);
  metrics::FalseEdges edges = metrics::false_edges(truth, found);
  test = std::move(found.indirect);
  return edges;
}

Image error_map(const CompareOptions& options, const Image& reference, const Image& test,
                const CompareResult& errors) {
  if (options.map == ErrorMap::flip) return errors.flip.map;
  if (options.map == ErrorMap::edges) return errors.edges->map;
  if (options.map == ErrorMap::with_sign) return metrics::signed_error_map(reference, test);
  if (options.map == ErrorMap::relmse) return metrics::relative_squared_error_map(reference, test);
  if (options.map == ErrorMap::pixelated) return metrics::pixelated_error_map(reference, test, options.block);
  return metrics::absolute_error_map(reference, test);
}

// Writes the map and returns the error that has the ramp's last colour; 0 when the numbers themselves are
// written.
float write_map(const CompareOptions& options, const Image& reference, const Image& test,
                const CompareResult& errors, const Image& indirect) {
  const image::FileFormat format = image::format_of_extension(options.output);
  Image map = error_map(options, reference, test, errors);
  if (format == image::FileFormat::exr) {
    image::write_image(options.output, map);
    return 0;
  }
  if (options.map == ErrorMap::edges) {
    const float scale = options.scale > 0 ? options.scale : 0.2f;
    write_file(options.output, image::encode_png(metrics::edge_picture(*errors.edges, indirect, scale)));
    return scale;
  }
  const float automatic = options.map == ErrorMap::flip ? 1 : metrics::automatic_scale(map);
  const float scale = options.scale > 0 ? options.scale : automatic;
  if (options.map == ErrorMap::pixelated) {
    map = metrics::enlarge_blocks(map, options.block, reference.width, reference.height);
  }
  const auto ramp =
      options.map == ErrorMap::with_sign ? metrics::ColorRamp::diverging : metrics::ColorRamp::inferno;
  write_file(options.output, image::encode_png(metrics::heat_map(map, ramp, scale)));
  return scale;
}

}  // namespace

CompareResult run_compare(const CompareOptions& options, const Control&) {
  TevViewer viewer(options.tev);
  if (!options.output.empty()) {
    const image::FileFormat format = image::format_of_extension(options.output);
    if (format != image::FileFormat::png && format != image::FileFormat::exr) {
      throw Error(options.output, "an error map is written as .png (colours) or .exr (numbers)");
    }
  }
  Image reference = read_exposed(options.reference, options.exposure);
  const Image test = read_exposed(options.test, options.exposure);
  if (reference.width != test.width || reference.height != test.height) {
    throw Error(options.test, fmt::format("is {} x {} pixels, but {} is {} x {}", test.width, test.height,
                                          options.reference, reference.width, reference.height));
  }
  std::uint64_t outside = 0;
  Image mask, indirect;
  if (!options.mask.empty()) {
    mask = image::read_image(options.mask);
    outside = metrics::pixels_outside(mask, reference.width, reference.height);
    reference = metrics::masked(reference, mask);
  }
  CompareResult result = measure(options, reference, test);
  result.linear.nonfinite_pixels -= outside;
  const bool map_of_edges = (!options.output.empty() || viewer) && options.map == ErrorMap::edges;
  if (options.edges || map_of_edges) result.edges = edges_between(options, mask, indirect);
  if (!options.output.empty()) result.map_scale = write_map(options, reference, test, result, indirect);
  if (viewer) {
    viewer.show(options.reference, reference);
    viewer.show(options.test, test);
    viewer.show(fmt::format("{}: {} error", options.test, name_of(options.map)),
                error_map(options, reference, test, result));
  }
  return result;
}

bool has_failed(const CompareResult& result, const CompareOptions& options) {
  return result.linear.nonfinite_pixels > 0 && !options.allow_nonfinite;
}

json::Value to_json(const CompareResult& result, const CompareOptions& options) {
  const metrics::ImageError& e = result.linear;
  const metrics::BlockError& blocks = result.blocks;
  json::Value flip = {{"mean", result.flip.mean}, {"kind", result.hdr ? "hdr" : "ldr"}};
  if (result.hdr) {
    flip["exposures"] = {{"first", result.flip.first_exposure},
                         {"last", result.flip.last_exposure},
                         {"count", result.flip.exposures}};
  }
  json::Value object = {{"width", e.width},
                        {"height", e.height},
                        {"mae", e.mae},
                        {"rmse", e.rmse},
                        {"mse", e.mse},
                        {"relmse", e.relmse},
                        {"mape", e.mape},
                        {"smape", e.smape},
                        {"mean_ratio", e.mean_ratio},
                        {"bias", e.bias},
                        {"sum", e.sum},
                        {"max", e.max},
                        {"psnr", finite_or_null(result.display.psnr)},
                        {"ssim", result.display.ssim},
                        {"flip", flip},
                        {"pixels", e.pixels},
                        {"nonfinite_pixels", e.nonfinite_pixels},
                        {"blocks",
                         {{"size", blocks.block},
                          {"columns", blocks.columns},
                          {"rows", blocks.rows},
                          {"mean", blocks.mean},
                          {"max", blocks.max},
                          {"max_block", {blocks.max_column, blocks.max_row}}}}};
  if (const auto& edges = result.edges) {
    object["edges"] = {
        {"share", edges->share},
        {"pixels", edges->edges},
        {"tested", edges->tested},
        {"tested_share", static_cast<double>(edges->tested) / static_cast<double>(edges->pixels)},
        {"least_step", edges->least_step}};
  }
  if (result.map_scale)
    object["map"] = {
        {"output", options.output}, {"kind", name_of(options.map)}, {"scale", *result.map_scale}};
  return object;
}

std::string to_text(const CompareResult& result, const CompareOptions& options) {
  const metrics::ImageError& e = result.linear;
  const metrics::BlockError& blocks = result.blocks;
  const std::string flip =
      result.hdr ? fmt::format("largest of {} exposures from {:.2f} to {:.2f} EV", result.flip.exposures,
                               result.flip.first_exposure, result.flip.last_exposure)
                 : "as displayed";
  std::string text = fmt::format(
      "size       {} x {}\n"
      "MAE        {:.6g}   (sum {:.6g}, max {:.6g}, bias {:+.6g})\n"
      "RMSE       {:.6g}   (MSE {:.6g})\n"
      "relMSE     {:.6g}\n"
      "MAPE       {:.6g}\n"
      "SMAPE      {:.6g}\n"
      "mean ratio {:.6g} {:.6g} {:.6g}\n"
      "FLIP       {:.6g}   ({})\n"
      "SSIM       {:.6g}\n"
      "PSNR       {:.6g} dB\n"
      "blocks     {} x {} of {} pixels: mean sum {:.6g}, max {:.6g} in block {}, {}",
      e.width, e.height, e.mae, e.sum, e.max, e.bias, e.rmse, e.mse, e.relmse, e.mape, e.smape,
      e.mean_ratio[0], e.mean_ratio[1], e.mean_ratio[2], result.flip.mean, flip, result.display.ssim,
      result.display.psnr, blocks.columns, blocks.rows, blocks.block, blocks.mean, blocks.max,
      blocks.max_column, blocks.max_row);
  if (const auto& edges = result.edges) {
    text += fmt::format(
        "\nedges      {:.3g} % of the pixels tested lie on a false edge: {} of {}; {:.3g} % could be tested, "
        "for steps of {:.2g} %",
        100 * edges->share, edges->edges, edges->tested,
        100 * static_cast<double>(edges->tested) / static_cast<double>(edges->pixels),
        100 * edges->least_step);
  }
  if (result.map_scale) {
    text += fmt::format("\nmap        {} ({}", options.output, name_of(options.map));
    text += *result.map_scale > 0 ? fmt::format(", last colour at {:.6g})", *result.map_scale) : ")";
  }
  if (e.nonfinite_pixels > 0) {
    text += fmt::format("\n{} pixels are infinite or NaN and were left out", e.nonfinite_pixels);
    if (has_failed(result, options)) text += " (--allow-nonfinite accepts them)";
  }
  return text;
}

void add_compare_command(Command app, Context& context) {
  auto [command, o] =
      add_command(app, context, "compare", "Measure the error of an image against a reference", run_compare);
  command.option("REF", o.reference, "Reference image: .exr .hdr .png .jpg").required();
  command.option("TEST", o.test, "Image of the same size").required();
  command.option("--mask", o.mask,
                 "Picture of any size that is white where to measure; everything else is left out");
  command.option("--block", o.block, "Side of the blocks of the pixelated map, in pixels").range(1, 65536);
  command.option("-o,--output", o.output, "Error map to write: .png (colours) or .exr (numbers)");
  command.choice(
      "--map", o.map,
      "Which map: absolute |d|, signed d, pixelated (sum of |d| in each block), relmse, flip, edges");
  command
      .option(
          "--scale", o.scale,
          "Error shown in the last colour of a .png map; 0: the 99th percentile, for flip 1, for edges 0.2")
      .non_negative();
  add_tev_option(command, o.tev,
                 "Show both images and the map's numbers in the viewer tev that listens there");
  command.option("--exposure", o.exposure, "Multiply both images by 2^EV first").range(-60.0, 60.0);
  command.option("--ppd", o.pixels_per_degree, "Pixels in one degree of the viewer's sight, for FLIP")
      .range(1.0, 500.0);
  command.flag("--edges", o.edges,
               "Also find false edges: steps in the indirect light that the truth has not; of "
               "REF.indirect.exr, .albedo, "
               ".normal, .depth and TEST.indirect.exr beside the pictures (`render --aov`)");
  command.flag("--allow-nonfinite", o.allow_nonfinite,
               "Do not fail when pixels are infinite or NaN (they are left out and counted)");
  command.footer(
      "d = TEST - REF in scene-linear RGB: PNG and JPEG are decoded from sRGB first; alpha is not compared.\n"
      "MAE mean |d|, MSE mean d^2, relMSE mean d^2/(REF^2 + 0.01), MAPE mean |d|/(|REF| + 0.01), SMAPE mean "
      "|d|/(|REF| + |TEST| + 0.01),\n"
      "as fractions, all over pixels and channels; mean ratio: mean TEST / mean REF per channel; bias: mean "
      "d. Block sums add the\n"
      "channels. FLIP: of two PNG or JPEG files as displayed, else HDR-FLIP over the exposures of REF. SSIM "
      "(of luma) and PSNR:\n"
      "sRGB-encoded and clipped to [0, 1] after --exposure; JSON says null for the PSNR of equal images.\n"
      "False edges: steps of log(TEST/REF) of irradiance by over 3 % of luminance or 6 % of colour, and 4 "
      "standard errors.");
}

}  // namespace ssphh::app
