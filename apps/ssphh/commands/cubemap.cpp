#include "commands/cubemap.h"

#include <fmt/format.h>

#include <ssphh/image/io.h>

#include "commands/command.h"

namespace ssphh::app {

CubemapResult run_cubemap_convert(const CubemapOptions& options, const Control& control) {
  image::format_of_extension(options.output);  // before the work
  const image::Image input = image::read_image(options.input);
  try {
    image::layout_size(input, options.from);
  } catch (const Error& e) {
    throw Error(options.input, e.problem(), e.hint());
  }
  CubemapResult result{image::convert_layout(input, options.from, options.to, options.size, control)};
  image::write_image(options.output, result.picture);
  return result;
}

json::Value to_json(const CubemapResult& result, const CubemapOptions& options) {
  return {{"output", options.output},
          {"from", name_of(options.from)},
          {"to", name_of(options.to)},
          {"width", result.picture.width},
          {"height", result.picture.height}};
}

std::string to_text(const CubemapResult& result, const CubemapOptions& options) {
  return fmt::format("{}: {} x {}, {}", options.output, result.picture.width, result.picture.height,
                     name_of(options.to));
}

void add_cubemap_commands(Command app, Context& context) {
  Command group = add_group(app, "cubemap", "Images of the whole sphere: cube maps and other layouts");
  auto [command, o] =
      add_command(group, context, "convert", "Convert between layouts of the sphere", run_cubemap_convert);
  command.option("IN", o.input, "Image: .exr .hdr .png .jpg (8-bit and 16-bit are decoded from sRGB)")
      .required();
  command.option("-o,--output", o.output, "Image to write, by extension: .exr .hdr .png .jpg").required();
  command.choice("--from", o.from, "Layout of IN").required();
  command.choice("--to", o.to, "Layout of the output").required();
  command
      .option("--size", o.size,
              "Pixels: side of a face (strips, crosses), height (equirect), diameter (angular); "
              "default: the resolution of IN")
      .range(1, 8192);
  command.footer(
      "Faces are ordered +X -X +Y -Y +Z -Z with OpenGL's orientation; cross-v stores -Z turned by 180 "
      "degrees.\n"
      "equirect: the centre looks to +X, u = 0.75 to +Z, the top row to +Y. angular: the centre looks to "
      "-Z.\n"
      "Strips and crosses of the same face size convert into each other exactly; all else is resampled.");
}

}  // namespace ssphh::app
