#include <memory>

#include <fmt/format.h>

#include <ssphh/image/cube_layout.h>
#include <ssphh/image/io.h>

#include "command.h"

namespace ssphh::app {
namespace {

struct ConvertOptions {
  std::string input, output, from, to;
  int size = 0;
};

void convert(const Context& context, const ConvertOptions& options) {
  const image::Layout from = enum_named<image::Layout>("layout", options.from),
                      to = enum_named<image::Layout>("layout", options.to);
  image::format_of_extension(options.output);  // before the work
  const image::Image input = image::read_image(options.input);
  try {
    image::layout_size(input, from);
  } catch (const Error& e) {
    throw Error(options.input, e.problem(), e.hint());
  }
  const image::Image output = image::convert_layout(input, from, to, options.size, context.control);
  image::write_image(options.output, output);
  context.result({{"output", options.output},
                  {"from", options.from},
                  {"to", options.to},
                  {"width", output.width},
                  {"height", output.height}},
                 fmt::format("{}: {} x {}, {}", options.output, output.width, output.height, options.to));
}

}  // namespace

void add_cubemap_commands(CLI::App& app, Context& context) {
  CLI::App* group = add_group(app, "cubemap", "Images of the whole sphere: cube maps and other layouts");
  auto options = std::make_shared<ConvertOptions>();
  CLI::App* command = add_command(*group, context, "convert", "Convert between layouts of the sphere",
                                  [&context, options] { convert(context, *options); });
  const std::vector<std::string> names = names_of<image::Layout>();
  command
      ->add_option("IN", options->input,
                   "Image: .exr .hdr .png .jpg (8-bit and 16-bit are decoded from sRGB)")
      ->required();
  command->add_option("-o,--output", options->output, "Image to write, by extension: .exr .hdr .png .jpg")
      ->required();
  command->add_option("--from", options->from, "Layout of IN")->required()->check(CLI::IsMember(names));
  command->add_option("--to", options->to, "Layout of the output")->required()->check(CLI::IsMember(names));
  command
      ->add_option("--size", options->size,
                   "Pixels: side of a face (strips, crosses), height (equirect), diameter (angular); "
                   "default: the resolution of IN")
      ->check(CLI::Range(1, 8192));
  command->footer(
      "Faces are ordered +X -X +Y -Y +Z -Z with OpenGL's orientation; cross-v stores -Z turned by 180 "
      "degrees.\n"
      "equirect: the centre looks to +X, u = 0.75 to +Z, the top row to +Y. angular: the centre looks to "
      "-Z.\n"
      "Strips and crosses of the same face size convert into each other exactly; all else is resampled.");
}

}  // namespace ssphh::app
