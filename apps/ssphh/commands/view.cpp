#include "commands/view.h"

#include <fmt/format.h>
#include <fmt/ranges.h>

#include <ssphh/core/counted.h>
#include <ssphh/core/user_folder.h>

#include "commands/command.h"
#include "model/settings.h"
#include "options/picture_options.h"
#include "results/geometry_builds.h"
#include "results/tev.h"

namespace ssphh::app {
namespace {

void parse_size(const std::string& text, int& width, int& height) {
  char end = 0;
  if (std::sscanf(text.c_str(), "%dx%d%c", &width, &height, &end) != 2 || width < 64 || height < 64 ||
      width > 16384 || height > 16384)
    throw Error("--size", fmt::format("\"{}\" is no size", text), "WIDTHxHEIGHT, 64 to 16384 pixels each");
}

void add_setting_options(Command command, ViewOptions& o) {
  o.values.resize(viewer::setting_names().size());
  for (std::size_t i = 0; i < o.values.size(); ++i) {
    const viewer::SettingName& setting = viewer::setting_names()[i];
    const Option option = command.under(setting.group)
                              .option("--" + setting.name, o.values[i], setting.help)
                              .shown_default(setting.get(viewer::Settings{}));
    option.check(
        [&setting](const std::string& text) -> std::string {
          try {
            viewer::Settings ignored;
            setting.set(ignored, text);
            return {};
          } catch (const Error& e) {
            return e.what();
          }
        },
        "");
    option.kind(setting.or_auto           ? "auto|NUMBER"
                : setting.choices.empty() ? "NUMBER"
                                          : fmt::format("{{{}}}", fmt::join(setting.choices, ",")));
  }
}

}  // namespace

viewer::ViewerReport run_view(const ViewOptions& o, const Control& control) {
  viewer::ViewerOptions v = o.viewer;
  v.source = o.scene.source;
  v.overlay = o.scene.overlay;
  v.time = o.scene.time;
  v.panels = !o.no_panels;
  parse_size(o.size, v.width, v.height);
  v.preferences = user_folder("XDG_CONFIG_HOME", ".config") / "preferences.json";
  v.autosave = user_folder("XDG_STATE_HOME", ".local/state") / "autosave";
  for (std::size_t i = 0; i < o.values.size(); ++i) {
    if (!o.values[i].empty()) v.settings.emplace_back(viewer::setting_names()[i].name, o.values[i]);
  }
  const auto load = [&o](const std::string& source) {
    SceneOptions scene = o.scene;
    // The overlay was named for the first scene; one that is dropped later has its own.
    if (source != o.scene.source) scene.overlay.clear();
    scene.source = source;
    scene.keep_dark_light = true;
    return load_lit_scene(scene);
  };
  const std::optional<FarmSession> farm = farm_session(o.farm);
  // Bakes wait where a farm of its own has ended: the window offers to start it again.
  farm::FarmOptions at;
  if (farm) {
    at = farm->options();
    at.failure = {};
    v.farm = &at;
    if (farm::LocalFarm* own = farm->local())
      v.own_farm = {[own] { return own->failure(); }, [own] { own->restart(); }};
  }
  TevViewer tev(o.tev.empty() ? usual_tev : o.tev);
  v.show_truth = !o.tev.empty();
  const auto show = [&tev](const std::string& name, const image::Image& picture) {
    return tev.try_show(name, picture);
  };
  const GeometryBuilds builds;
  viewer::ViewerReport report = viewer::run_viewer(v, load, show, control);
  report.geometry_builds = builds.count();
  return report;
}

json::Value to_json(const viewer::ViewerReport& r, const ViewOptions&) {
  json::Value object = {{"frames", r.frames},  {"renderer", r.renderer},
                        {"probes", r.probes},  {"median_ms", r.median_ms},
                        {"p99_ms", r.p99_ms},  {"geometry_builds", r.geometry_builds},
                        {"written", r.written}};
  if (r.farm) object["farm"] = farm_json(*r.farm);
  return object;
}

std::string to_text(const viewer::ViewerReport& r, const ViewOptions&) {
  std::string text =
      fmt::format("{} on {}, {}; a drawn frame took {:.1f} ms (median), {:.1f} ms (p99)",
                  counted(r.frames, "frame"), r.renderer, counted(r.probes, "probe"), r.median_ms, r.p99_ms);
  if (r.farm) text += "\n" + farm_text(*r.farm);
  for (const std::string& file : r.written) text += "\nwrote " + file;
  return text;
}

void add_view_command(Command app, Context& context) {
  auto [command, o] =
      add_command(app, context, "view", "Look at a scene lit by probes, in a window", run_view);
  add_scene_options(command, o.scene);
  command["SCENE"].required(false);
  command.option(
      "--camera", o.viewer.camera,
      "Camera by name, or X,Y,Z:TO_X,TO_Y,TO_Z[:DEGREES] as of `render`; default: the scene's first");
  command.option("--size", o.size, "Of the window, WIDTHxHEIGHT");
  command.flag("--no-panels", o.no_panels, "The picture alone (Tab brings the panels)");
  add_tev_option(
      command, o.tev,
      fmt::format("Shift+F12 shows the picture in the viewer tev that listens there, and each pass "
                  "of a ground truth is shown. Default: {}, for Shift+F12 alone",
                  usual_tev));

  const Command probes = command.under("Probes");
  probes.option("--probes", o.viewer.probes,
                "A probe file, shown as it was baked, or several as keys that play with the animations "
                "(a.sphl@0,b.sphl@1); scene: the scene's SPHLs, kept lit while lamps and "
                "doors move; auto, auto:METRES: find places first; off. Default: scene, if it has SPHLs");
  probes.flag("--live", o.viewer.live, "Light the probes of a file anew and keep them lit");
  probes
      .option("--records", o.viewer.records,
              "Surface points that keep light while it follows lamps and doors, at most: fewer start sooner; "
              "0: none. Default: as --quality has them")
      .range(0, 1 << 16);
  probes.flag("--force", o.viewer.force, "Take a probe file of another scene, with a warning");
  add_setting_options(command, o);

  add_farm_options(command, o.farm);

  const Command output = command.under("Without hands");
  output.option("--path", o.viewer.path, "Camera path (schemas/camera-path.schema.json): the bookmarks");
  output.option("--export", o.viewer.export_dir, "Draw the path as DIR/frame-0000.png and so on, and end");
  output.option("--fps", o.viewer.fps, "Of the exported frames").range(0.001, 10000.0);
  output.option("--screenshot", o.viewer.screenshot,
                "Write the window (or with --no-panels the picture) to this PNG, or the picture's linear "
                "light to this EXR, "
                "once all is lit, and end");
  output.option("--script", o.viewer.script, "Do what this file says (docs/viewer.md)");
  output.option("--stats", o.viewer.stats, "Write the frames' times at the end: .json, or .csv");
  output.option("--frames", o.viewer.frames, "End after so many frames; 0: when the window is closed")
      .range(0, 1 << 30);
  command.footer(
      "F1 in the window lists mouse and keys. Needs a display with OpenGL 4.5: a software renderer will do.");
}

}  // namespace ssphh::app
