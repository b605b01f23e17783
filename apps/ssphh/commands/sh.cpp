#include <cmath>
#include <memory>
#include <optional>

#include <fmt/format.h>

#include <ssphh/core/file.h>
#include <ssphh/core/log.h>
#include <ssphh/core/parallel.h>
#include <ssphh/image/cube_layout.h>
#include <ssphh/image/io.h>
#include <ssphh/sh/convert.h>
#include <ssphh/sh/evaluate.h>
#include <ssphh/sh/irradiance.h>
#include <ssphh/sh/project.h>
#include <ssphh/sh/reconstruct.h>
#include <ssphh/sh/rotate.h>
#include <ssphh/sh/window.h>

#include "commands/command.h"
#include "commands/sh_file.h"

namespace ssphh::app {
namespace {

// ---- options
// ------------------------------------------------------------------------------------------------------

vec3 unit_vector(const char* option, const std::vector<double>& v) {
  const glm::dvec3 d(v.at(0), v.at(1), v.at(2));
  const double length = glm::length(d);
  if (!(length > 0) || !std::isfinite(length)) {
    throw Error(option, "is not a direction", "give three finite numbers that are not all 0");
  }
  return vec3(d / length);
}

// What the commands that print coefficients share.
struct Output {
  std::string path;

  void option(Command command) {
    command.option("-o,--output", path, "Also write the JSON object to this file");
  }
  void give(const Context& context, const json::Value& object) const {
    if (!path.empty()) write_file(path, json::print(object, 1) + "\n");
    context.result(object, sh_text(object));
  }
  void give(const Context& context, const sh::RadianceSh& sh) const {
    for (int k = 0; k < static_cast<int>(sh.values.size()); ++k) {
      if (!is_finite(sh[k]))
        throw Error("coefficients", "the result is not finite", "the input's values are too large");
    }
    give(context, sh_to_json(sh.values, sh.degree()));
  }
};

constexpr const char* file_help = "JSON object as `ssphh sh project` prints it; - reads stdin";

Option direction_option(Command command, const std::string& name, std::vector<double>& value,
                        const std::string& help) {
  return command.option(name, value, help).values(3).kind("X Y Z");
}

// ---- commands
// -----------------------------------------------------------------------------------------------------

void add_eval(Command group, Context& context) {
  struct Options {
    int degree = 9;
    std::vector<double> direction;
  };
  auto o = std::make_shared<Options>();
  Command command = add_command(group, context, "eval", "Values of all Y_lm in a direction", [&context, o] {
    const glm::dvec3 d = glm::normalize(glm::dvec3(unit_vector("--direction", o->direction)));
    std::vector<double> values(static_cast<std::size_t>(sh::coefficient_count(o->degree)));
    sh::eval_basis(o->degree, d, values);
    std::string text;
    for (int l = 0; l <= o->degree; ++l) {
      for (int m = -l; m <= l; ++m) {
        text += fmt::format("{}{:3} {:4}  {:>12.8f}", text.empty() ? "" : "\n", l, m,
                            values[static_cast<std::size_t>(sh::coefficient_index(l, m))]);
      }
    }
    context.result({{"degree", o->degree}, {"values", values}}, text);
  });
  command.option("--degree", o->degree, "Highest band l, 0..10").range(0, sh::max_degree);
  direction_option(command, "--direction", o->direction, "Any length but 0; y is up").required();
}

void add_project(Command group, Context& context) {
  struct Options {
    std::string image;
    image::Layout layout = image::Layout::equirect;
    int degree = 9;
    Output output;
  };
  auto o = std::make_shared<Options>();
  Command command =
      add_command(group, context, "project", "Coefficients of the radiance in an image", [&context, o] {
        const image::Image picture = image::read_image(o->image);
        for (const float value : picture.pixels) {
          if (!std::isfinite(value)) throw Error(o->image, "has pixels that are NaN or infinite");
        }
        const image::CubeMap cube = image::to_cube(picture, o->layout, 0, context.control);
        // Grey images become RGB.
        sh::CubeFaces faces;
        std::array<image::Image, 6> colour;
        for (std::size_t f = 0; f < 6; ++f) {
          const image::Image& face = cube.faces[f];
          if (face.channels == 1) {
            colour[f] = image::Image(cube.size, cube.size, 3);
            for (std::size_t i = 0; i < colour[f].pixels.size(); ++i)
              colour[f].pixels[i] = face.pixels[i / 3];
          }
          faces[f] = face.channels == 1 ? colour[f].pixels : face.pixels;
        }
        const int channels = cube.faces[0].channels == 4 ? 4 : 3;
        o->output.give(context, sh::project_cube(o->degree, cube.size, faces, channels));
      });
  command.option("image", o->image, "EXR, HDR, PNG or JPEG of the whole sphere").required();
  command.choice("--layout", o->layout, "How it lays the sphere out").required();
  command.option("--degree", o->degree, "Highest band l, 0..10").range(0, sh::max_degree);
  o->output.option(command);
}

void add_irradiance(Command group, Context& context) {
  struct Options {
    std::string file;
    std::vector<double> normal;
  };
  auto o = std::make_shared<Options>();
  Command command = add_command(
      group, context, "irradiance", "Irradiance E(n) [W/m²] on a surface with a normal; no hidden 1/π",
      [&context, o] {
        const vec3 n = unit_vector("--normal", o->normal);
        const vec3 e = sh::irradiance(read_radiance_sh(o->file), n);
        context.result({{"irradiance", rgb_to_json(e)}}, fmt::format("{:.6g} {:.6g} {:.6g}", e.x, e.y, e.z));
      });
  command.option("file", o->file, file_help).required();
  direction_option(command, "--normal", o->normal, "Any length but 0; y is up").required();
}

void add_reconstruct(Command group, Context& context) {
  struct Options {
    std::string file, output;
    image::Layout layout = image::Layout::equirect;
    int size = 256;
    bool irradiance = false;
  };
  auto o = std::make_shared<Options>();
  Command command =
      add_command(group, context, "reconstruct", "The radiance (or irradiance) as an image", [&context, o] {
        image::format_of_extension(o->output);
        const sh::RadianceSh radiance = read_radiance_sh(o->file);
        const sh::IrradianceSh irradiance = sh::irradiance_from_radiance(radiance);

        // Evaluate at the texels of a cube of like resolution, then lay it out.
        const int face = image::is_cube_layout(o->layout) ? o->size : std::max(1, o->size / 2);
        image::CubeMap cube(face);
        parallel_for(
            static_cast<std::size_t>(6 * face), 8,
            [&](std::size_t begin, std::size_t end) {
              for (std::size_t row = begin; row < end; ++row) {
                const int f = static_cast<int>(row) / face, y = static_cast<int>(row) % face;
                for (int x = 0; x < face; ++x) {
                  const vec3 d = texel_direction(f, x, y, face);
                  cube.faces[static_cast<std::size_t>(f)].set_rgb(
                      x, y, o->irradiance ? sh::eval(irradiance, d) : sh::eval(radiance, d));
                }
              }
            },
            context.control);
        const image::Image picture = image::from_cube(cube, o->layout, o->size, context.control);
        image::write_image(o->output, picture);
        context.result({{"output", o->output}, {"width", picture.width}, {"height", picture.height}},
                       fmt::format("{}: {} × {}", o->output, picture.width, picture.height));
      });
  command.option("file", o->file, file_help).required();
  command.option("-o,--output", o->output, ".exr, .hdr, .png or .jpg (EXR keeps negative values)").required();
  command.choice("--layout", o->layout, "How it lays the sphere out");
  command.option("--size", o->size, "Height [pixels] of a face, or of the whole equirect or angular image")
      .range(1, 8192);
  command.flag("--irradiance", o->irradiance, "Show irradiance E(n) instead of radiance");
}

void add_rotate(Command group, Context& context) {
  struct Options {
    std::string file;
    std::vector<double> axis, quaternion;
    double angle = 0;
    Output output;
  };
  auto o = std::make_shared<Options>();
  Command command = add_command(
      group, context, "rotate", "Turns the light: what came from d then comes from R d", [&context, o] {
        glm::dquat q;
        if (!o->quaternion.empty()) {
          q = glm::dquat(o->quaternion[3], o->quaternion[0], o->quaternion[1], o->quaternion[2]);
          const double length = glm::length(q);
          if (!(length > 0) || !std::isfinite(length)) {
            throw Error("--quaternion", "is not a rotation", "give four finite numbers that are not all 0");
          }
        } else {
          if (o->axis.empty())
            throw Error("sh rotate", "no rotation given", "use --axis with --angle, or --quaternion");
          if (!std::isfinite(o->angle)) throw Error("--angle", "is not finite");
          q = glm::angleAxis(glm::radians(o->angle),
                             glm::normalize(glm::dvec3(unit_vector("--axis", o->axis))));
        }
        const sh::RadianceSh radiance = read_radiance_sh(o->file);
        const glm::dmat3 matrix = glm::mat3_cast(glm::normalize(q));
        o->output.give(context, sh::Rotation(radiance.degree(), matrix).apply(radiance));
      });
  command.option("file", o->file, file_help).required();
  Option axis = direction_option(command, "--axis", o->axis, "Rotation axis");
  Option angle =
      command.option("--angle", o->angle, "Counter-clockwise about the axis [degrees]").shown_default("");
  axis.needs(angle);
  angle.needs(axis);
  command.option("--quaternion", o->quaternion, "Instead of axis and angle; any length but 0")
      .values(4)
      .kind("X Y Z W")
      .excludes(axis);
  o->output.option(command);
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
  struct Options {
    std::string file, from = "ssphh", to;
    Output output;
  };
  auto o = std::make_shared<Options>();
  Command command =
      add_command(group, context, "convert",
                  "Coefficients for and from other programs (scale and sign; not the axes)", [&context, o] {
                    const sh::Convention from = convention_option("--from", o->from),
                                         to = convention_option("--to", o->to);
                    const sh::RadianceSh radiance = sh::from_convention(read_sh_values(o->file, from), from);
                    const std::vector<vec3> stored = sh::to_convention(radiance, to);
                    const int degree = std::min(radiance.degree(), sh::convention_max_degree(to));
                    if (degree < radiance.degree()) {
                      log_warning("{}: bands {}..{} are dropped, {} holds degree {}", o->file, degree + 1,
                                  radiance.degree(), name_of(to), degree);
                    }
                    json::Value object = sh_to_json(stored, degree);
                    object["convention"] = std::string(name_of(to));
                    o->output.give(context, object);
                  });
  command.option("file", o->file, file_help).required();
  const char* names = "ssphh, d3dx (unreal), unity, three (godot), filament or filament-mirrored";
  command.option("--from", o->from, names);
  command.option("--to", o->to, names).required();
  o->output.option(command);
  command.footer(
      "three, godot and filament use this project's axes (right-handed, y up). unity is left-handed, unreal "
      "also has z\n"
      "up: mirror or rotate the light as your importer does with geometry (`ssphh sh rotate`).");
}

void add_window(Command group, Context& context) {
  struct Options {
    std::string file;
    sh::NonNegative goal = sh::NonNegative::irradiance;
    bool automatic = false;
    std::optional<double> lanczos, hanning;
    Output output;
  };
  auto o = std::make_shared<Options>();
  Command command = add_command(group, context, "window", "Damps high bands against ringing", [&context, o] {
    const sh::RadianceSh radiance = read_radiance_sh(o->file);
    const auto checked = [](const char* option, double width) {
      if (!(width > 0)) throw Error(option, "must be a width above 0 bands");
      return width;
    };
    sh::BandScales scales;
    if (o->lanczos) {
      scales = sh::lanczos_window(checked("--lanczos", *o->lanczos));
    } else if (o->hanning) {
      scales = sh::hanning_window(checked("--hanning", *o->hanning));
    } else if (o->automatic) {
      const sh::AutoWindow window = sh::choose_window(radiance, o->goal);
      if (!window.reached)
        log_warning("{}: the mean is negative; no window can make {} positive", o->file, name_of(o->goal));
      scales = sh::lanczos_window(window.width);
    } else {
      throw Error("sh window", "no window chosen", "use --auto, --lanczos W or --hanning W");
    }
    o->output.give(context, sh::apply_window(radiance, scales));
  });
  command.option("file", o->file, file_help).required();
  Option automatic = command.flag(
      "--auto", o->automatic, "The mildest Lanczos window without negative values; none if there are none");
  Option lanczos = command.option("--lanczos", o->lanczos, "Lanczos window of this width [bands]");
  Option hanning = command.option("--hanning", o->hanning, "Hanning window of this width [bands]");
  automatic.excludes(lanczos).excludes(hanning);
  lanczos.excludes(hanning);
  command.choice("--goal", o->goal, "What --auto keeps from being negative: irradiance or radiance");
  o->output.option(command);
}

}  // namespace

void add_sh_commands(Command app, Context& context) {
  Command group = add_group(app, "sh", "Spherical harmonics: evaluate, project, rotate, convert …");
  add_eval(group, context);
  add_project(group, context);
  add_irradiance(group, context);
  add_reconstruct(group, context);
  add_rotate(group, context);
  add_convert(group, context);
  add_window(group, context);
}

}  // namespace ssphh::app
