#include "commands/web.h"

#include <fmt/format.h>
#include <fmt/ranges.h>

#include <ssphh/core/counted.h>

#include "commands/command.h"
#include "options/picture_options.h"
#include "options/probe_options.h"

namespace ssphh::app {
namespace {

std::string size_text(std::size_t bytes) {
  const double size = static_cast<double>(bytes);
  return size < 1e6 ? fmt::format("{:.1f} kB", size / 1e3) : fmt::format("{:.1f} MB", size / 1e6);
}

}  // namespace

json::Value to_json(const WebResult& r, const WebOptions& o) {
  json::Value files = json::Value::array();
  for (const WebFile& file : r.files) files.push_back({{"name", file.name}, {"bytes", file.bytes}});
  json::Value movable = json::Value::array();
  for (const WebMovable& lamp : r.movable) movable.push_back({{"name", lamp.name}, {"places", lamp.places}});
  return {{"output", o.output},
          {"cameras", json::Value(r.cameras)},
          {"light_groups", json::Value(r.groups)},
          {"times", json::Value(r.times)},
          {"movable", std::move(movable)},
          {"width", r.width},
          {"height", r.height},
          {"texels_per_metre", r.density},
          {"files", std::move(files)},
          {"bytes", r.bytes},
          {"bake_seconds", r.bake_seconds},
          {"lamp_seconds", r.lamp_seconds},
          {"seconds", r.seconds},
          {"notes", json::Value(r.notes)}};
}

std::string to_text(const WebResult& r, const WebOptions& o) {
  std::string text = fmt::format("{}: {}, {} ({})", o.output, counted(r.cameras.size(), "camera"),
                                 counted(r.groups.size(), "light group"), fmt::join(r.groups, ", "));
  if (r.times.size() > 1)
    text += fmt::format(", {} poses of what moves, {:.3g} to {:.3g} s", r.times.size(), r.times.front(),
                        r.times.back());
  text += fmt::format("\nlightmaps of {} × {} texels, {:.3g} per metre", r.width, r.height, r.density);
  for (const WebMovable& lamp : r.movable)
    text += fmt::format("\n{} can be dragged: its light was found at {}", lamp.name,
                        counted(lamp.places, "place"));
  for (const WebFile& file : r.files) text += fmt::format("\n{:>10}  {}", size_text(file.bytes), file.name);
  text += fmt::format("\n{:>10}  in all\n", size_text(r.bytes));
  text += o.probes.empty()
              ? fmt::format("light baked in {:.1f} s, the rest took {:.1f} s", r.bake_seconds, r.seconds)
              : fmt::format("{:.1f} s", r.seconds);
  if (!r.movable.empty()) text += fmt::format(", light of lamps elsewhere {:.1f} s", r.lamp_seconds);
  for (const std::string& note : r.notes) text += "\nnote: " + note;
  return text +
         fmt::format("\nany web host serves it; here: python3 -m http.server --directory {}", o.output);
}

void add_web_command(Command app, Context& context) {
  auto [command, o] =
      add_command(app, context, "web",
                  "Write a folder for a web host: the lit scene to walk through in a browser", run_web);
  add_scene_options(command, o.scene);
  const Option probes =
      add_probe_file(command, "--probes", o.probes,
                     "Probe file whose light is taken. Default: it is baked first, by surfels");
  command.choice("--quality", o.quality, "Of that bake: draft, good or best").excludes(probes);
  command.option("-o,--output", o.output, "Folder to write; one that this command wrote is replaced")
      .required();
  command.flag("--replace", o.replace, "Also replace a folder that holds other files, which are lost");

  const Command light = command.under("Light");
  light
      .option("--size", o.layout.size,
              "Texels along the lightmap's width, and the most along its height. Default: 1024, or as far as "
              "4096 "
              "for 8 texels a metre, or what --texels-per-metre needs")
      .range(16, lightmap::most_size);
  light.option("--texels-per-metre", o.layout.density, "Default: as many as fit").range(1e-3, 1e6);
  light.choice("--uvs", o.charts.uvs,
               "Charts of the lightmap, as `ssphh lightmap` has them: own, scene or auto");
  light.option("--direct-samples", o.direct_samples, "Rays to each emitter with an extent, per texel")
      .range(1, 1 << 16);
  const Option merge = light.flag("--merge-groups", o.merge_groups,
                                  "One lightmap of all light: less to load, and no lamp to dim");
  light
      .option("--poses", o.poses,
              "Times that are baked, from the first to the last of the scene's animation; the page blends "
              "neighbours. Default: 5, or 1 with --probes")
      .range(1, 64);

  const Command lamps = command.under("Lamps that are dragged");
  const Option movable = lamps
                             .option("--movable", o.movable,
                                     "Point, spot and sphere lights that the page drags, by name, or `all`")
                             .separated_by(',')
                             .excludes(merge);
  lamps
      .option("--movable-step", o.movable_step,
              "Most metres between the places where their light is found. Default: 1, for spots 0.5")
      .range(1e-3, 1e3)
      .needs(movable);
  lamps
      .option("--movable-reach", o.movable_reach,
              "Metres that they may be moved along each axis, to either side")
      .range(1e-2, 1e4)
      .needs(movable);
  lamps
      .option("--movable-size", o.movable_size,
              "Texels along the width of the lightmaps of their indirect light. Default: a quarter of the "
              "lightmap's")
      .range(16, lightmap::most_size)
      .needs(movable);

  const Command pictures = command.under("Pictures");
  add_exposure_option(pictures, o.exposure, "Exposure in stops; auto: what suits each camera's picture");
  pictures.choice("--tonemap", o.tonemap, "clip at white, or filmic");
  const Option truth =
      pictures
          .option("--truth", o.truth,
                  "Path-traced pictures of the cameras with so many samples a pixel, to wipe over")
          .range(1, 1 << 16);
  pictures.option("--truth-cameras", o.cameras, "Only of these, by name").separated_by(',').needs(truth);
  add_size_options(pictures, o.width, o.height, 8192);

  command.option("--page", o.page,
                 "Folder of the built page; default: share/ssphh/web beside the folder of this program");
  add_force_option(command, o.force);
  command.footer("What the page can do and what its files hold: docs/web.md.");
}

}  // namespace ssphh::app
