#include "commands/sh.h"

#include <memory>

#include <fmt/format.h>

#include "commands/command.h"

namespace ssphh::app {
namespace {

constexpr const char* file_help = "JSON object as `ssphh sh project` prints it; - reads stdin";

void add_output(Command command, std::string& output) {
  command.option("-o,--output", output, "Also write the JSON object to this file");
}

Option direction_option(Command command, const std::string& name, std::vector<double>& value,
                        const std::string& help) {
  return command.option(name, value, help).values(3).kind("X Y Z");
}

void add_eval(Command group, Context& context) {
  auto [command, o] = add_command(group, context, "eval", "Values of all Y_lm in a direction", run_sh_eval);
  command.option("--degree", o.degree, "Highest band l, 0..10").range(0, sh::max_degree);
  direction_option(command, "--direction", o.direction, "Any length but 0; y is up").required();
}

void add_project(Command group, Context& context) {
  auto [command, o] =
      add_command(group, context, "project", "Coefficients of the radiance in an image", run_sh_project);
  command.option("image", o.image, "EXR, HDR, PNG or JPEG of the whole sphere").required();
  command.choice("--layout", o.layout, "How it lays the sphere out").required();
  command.option("--degree", o.degree, "Highest band l, 0..10").range(0, sh::max_degree);
  add_output(command, o.output);
}

void add_irradiance(Command group, Context& context) {
  auto [command, o] =
      add_command(group, context, "irradiance",
                  "Irradiance E(n) [W/m²] on a surface with a normal; no hidden 1/π", run_sh_irradiance);
  command.option("file", o.file, file_help).required();
  direction_option(command, "--normal", o.normal, "Any length but 0; y is up").required();
}

void add_reconstruct(Command group, Context& context) {
  auto [command, o] = add_command(group, context, "reconstruct", "The radiance (or irradiance) as an image",
                                  run_sh_reconstruct);
  command.option("file", o.file, file_help).required();
  command.option("-o,--output", o.output, ".exr, .hdr, .png or .jpg (EXR keeps negative values)").required();
  command.choice("--layout", o.layout, "How it lays the sphere out");
  command.option("--size", o.size, "Height [pixels] of a face, or of the whole equirect or angular image")
      .range(1, 8192);
  command.flag("--irradiance", o.irradiance, "Show irradiance E(n) instead of radiance");
}

void add_plot(Command group, Context& context) {
  auto [command, o] =
      add_command(group, context, "plot", "Draws lobes: every Y_lm, or the function of a file", run_sh_plot);
  const Option file = command.option("file", o.file, file_help);
  command.option("--degree", o.degree, "Highest band l, 0..10; of every Y_lm")
      .range(0, sh::max_degree)
      .excludes(file);
  command.option("--size", o.size, "Edge of a lobe's cell [pixels]; a file's picture has 4 times that")
      .range(8, 1024);
  command.option("-o,--output", o.output, ".png, .jpg, .exr or .hdr").required();
  command.footer(
      "A lobe's surface is |f| from its middle, the largest as far as the cell lets it be; blue: positive, "
      "orange:\n"
      "negative. Row l from the top, m from -l to l, the pole (+z) up; a file's luminance stands in the "
      "world, +y up.");
}

void add_rotate(Command group, Context& context) {
  auto [command, o] = add_command(group, context, "rotate",
                                  "Turns the light: what came from d then comes from R d", run_sh_rotate);
  command.option("file", o.file, file_help).required();
  Option axis = direction_option(command, "--axis", o.axis, "Rotation axis");
  Option angle =
      command.option("--angle", o.angle, "Counter-clockwise about the axis [degrees]").shown_default("");
  axis.needs(angle);
  angle.needs(axis);
  command.option("--quaternion", o.quaternion, "Instead of axis and angle; any length but 0")
      .values(4)
      .kind("X Y Z W")
      .excludes(axis);
  add_output(command, o.output);
}

sh::Convention convention_option(const char* option, const std::string& name) {
  const auto convention = parse_enum<sh::Convention>(name);
  if (!convention) {
    throw Error(option, fmt::format("no convention is called \"{}\"", name),
                "ssphh, d3dx (unreal), unity, three (godot), filament, filament-mirrored");
  }
  return *convention;
}

void add_convert(Command group, Context& context) {
  struct Words {
    std::string from = "ssphh", to;
  };
  const auto words = std::make_shared<Words>();
  auto [command, o] = add_command<ShConvertOptions>(
      group, context, "convert", "Coefficients for and from other programs (scale and sign; not the axes)",
      [&context, words](ShConvertOptions& given) {
        given.from = convention_option("--from", words->from);
        given.to = convention_option("--to", words->to);
        run_and_print(context, given, run_sh_convert);
      });
  command.option("file", o.file, file_help).required();
  const char* names = "ssphh, d3dx (unreal), unity, three (godot), filament or filament-mirrored";
  command.option("--from", words->from, names);
  command.option("--to", words->to, names).required();
  add_output(command, o.output);
  command.footer(
      "three, godot and filament use this project's axes (right-handed, y up). unity is left-handed, unreal "
      "also has z\n"
      "up: mirror or rotate the light as your importer does with geometry (`ssphh sh rotate`).");
}

void add_window(Command group, Context& context) {
  auto [command, o] =
      add_command(group, context, "window", "Damps high bands against ringing", run_sh_window);
  command.option("file", o.file, file_help).required();
  Option automatic = command.flag(
      "--auto", o.automatic, "The mildest Lanczos window without negative values; none if there are none");
  Option lanczos = command.option("--lanczos", o.lanczos, "Lanczos window of this width [bands]");
  Option hanning = command.option("--hanning", o.hanning, "Hanning window of this width [bands]");
  automatic.excludes(lanczos).excludes(hanning);
  lanczos.excludes(hanning);
  command.choice("--goal", o.goal, "What --auto keeps from being negative: irradiance or radiance");
  add_output(command, o.output);
}

}  // namespace

void add_sh_commands(Command app, Context& context) {
  Command group = add_group(app, "sh", "Spherical harmonics: evaluate, project, rotate, convert …");
  add_eval(group, context);
  add_project(group, context);
  add_irradiance(group, context);
  add_reconstruct(group, context);
  add_plot(group, context);
  add_rotate(group, context);
  add_convert(group, context);
  add_window(group, context);
}

}  // namespace ssphh::app
