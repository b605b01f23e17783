#include <algorithm>

#include <fmt/format.h>

#include <ssphh/core/file.h>
#include <ssphh/core/log.h>
#include <ssphh/gi/init.h>
#include <ssphh/image/io.h>
#include <ssphh/trace/path_tracer.h>

#include "app.h"

namespace ssphh::viewer {
namespace {

constexpr std::string_view probe_endings[] = {".sphl", ".sphl.json"};

bool is_probe_file(const std::string& name) {
  return std::any_of(std::begin(probe_endings), std::end(probe_endings),
                     [&](std::string_view ending) { return name.ends_with(ending); });
}

std::vector<gi::ProbePlace> places_of(const Document& document) {
  const scene::Scene& scene = *document.scene;
  const std::vector<mat4> world = scene::world_matrices(scene, document.time);
  std::vector<gi::ProbePlace> places;
  for (const SphlEdit& sphl : document.edits().sphls) {
    if (sphl.enabled) places.push_back({sphl.name, sphl_position(scene, world, sphl), sphl.radius});
  }
  return places;
}

}  // namespace

void App::say(const std::string& text) {
  message = text;
  message_is_error = false;
  message_since = std::chrono::steady_clock::now();
  redraw();
}

void App::complain(const std::string& text) {
  say(text);
  message_is_error = true;
  log(LogLevel::error, text);
}

void App::open(const std::string& source) {
  if (source.ends_with(".json") && !source.ends_with(".sphl.json") && !source.ends_with(".ssphh.json"))
    return load_path(source);
  if (is_probe_file(source)) return take_probe_file(source);
  say(fmt::format("loading {} …", source));
  take_scene(source, options.load(source));
  say(fmt::format("{}: {} triangles, lights: {}, SPHLs: {}", source, scene::triangle_count(*document.scene),
                  document.scene->lights.size(), document.scene->sphls.size()));
}

void App::take_scene(std::string source, scene::Scene scene) {
  job.cancel();
  reference.clear();
  Document next = make_document(std::move(source), std::move(scene), 0);
  next.time = std::clamp(document.source.empty() ? options.time : 0, 0.0f, next.duration);
  auto renderer =
      std::make_unique<realtime::Renderer>(gl_, *next.scene, realtime::RendererParams{}, next.time);
  trace::SharedGeometry geometry = trace::geometry_of(next.scene);
  auto picking = std::make_unique<trace::TransportScene>(geometry, *next.scene);
  // Nothing is thrown from here on: a file that is refused leaves the open one alone.
  picking_ = std::move(picking);
  geometry_ = std::move(geometry);
  renderer_ = std::move(renderer);
  document = std::move(next);
  light.clear();
  selection = {};
  view = start_view(document, "");
  applied_lights_.clear();
  applied_scales_.clear();
  applied_materials_ = document.edits().materials;
  applied_sphls_ = document.edits().sphls;
  drawn_.reset();
  visible_view_.reset();
  scene_dirty_ = true;
  light_stale_ = false;
  fly_speed = document.bounds.empty() ? 2 : std::max(0.2f, 0.25f * document.bounds.radius());
  window.set_title(document.source + " – ssphh");
  redraw();
}

void App::save_scene(const std::string& file) {
  save_document(document, file);
  report.written.push_back(file);
  say("saved " + file);
}

void App::save_probes(const std::string& file) {
  if (light.empty()) throw Error(file, "there are no probes to save", "place some, or open a probe file");
  if (light.live()) {
    const scene::Scene scene = edited_scene(*document.scene, document.edits(), document.time);
    gi::ProbeSet set =
        light.live_light()->bake(scene, group_scales(*document.scene, document.edits()), document.time);
    for (std::size_t i = 0; i < set.probes.size(); ++i) {
      // Edges are of another degree where VIZ ran with one of its own.
      const std::vector<gi::Edge>& edges = light.set().probes[i].edges;
      if (std::all_of(edges.begin(), edges.end(),
                      [&](const gi::Edge& edge) { return edge.h.degree() == set.degree; }))
        set.probes[i].edges = edges;
    }
    gi::write_probe_file(set, file);
  } else {
    gi::write_probe_file(light.set(), file);
  }
  report.written.push_back(file);
  say("saved " + file);
}

void App::save_path(const std::string& file) {
  if (bookmarks.empty()) throw Error(file, "there are no bookmarks to save", "add some with B");
  write_camera_path(file, bookmarks);
  report.written.push_back(file);
  say("saved " + file);
}

void App::load_path(const std::string& file) {
  bookmarks = read_camera_path(file);
  path_time = bookmarks.keys.front().time;
  say(fmt::format("{}: {} views", file, bookmarks.keys.size()));
}

void App::save_stats(const std::string& file) {
  if (file.ends_with(".csv")) {
    write_file(file, std::string_view(times.to_csv()));
  } else {
    write_file(file, std::string_view(times.to_json(
                         {{"scene", document.source},
                          {"renderer", report.renderer},
                          {"picture", fmt::format("{}x{}", picture.width(), picture.height())},
                          {"probes", fmt::format("{}", light.empty() ? 0 : light.set().probes.size())}})));
  }
  report.written.push_back(file);
  say("saved " + file);
}

void App::screenshot(const std::string& file, bool with_panels) {
  if (with_panels) {
    window_shot_ = file;
    return redraw();
  }
  image::Rgba8 pixels;
  if (needs_truth(settings) && settings.show != Show::wipe) {
    pixels = picture.truth_pixels();
  } else {
    pixels = picture.pixels();
    if (settings.show == Show::wipe && picture.has_truth()) {
      const image::Rgba8& truth = picture.truth_pixels();
      const auto from = static_cast<int>(settings.wipe * static_cast<float>(pixels.width));
      for (int y = 0; y < pixels.height; ++y) {
        const auto row = 4 * static_cast<std::ptrdiff_t>(y) * pixels.width;
        std::copy(truth.rgba.begin() + row + 4 * from, truth.rgba.begin() + row + 4 * pixels.width,
                  pixels.rgba.begin() + row + 4 * from);
      }
    }
  }
  write_file(file, image::encode_png(pixels));
  report.written.push_back(file);
  say("wrote " + file);
}

std::vector<std::string> App::camera_names() const {
  std::vector<std::string> names;
  for (const scene::Camera& camera : document.scene->cameras) names.push_back(camera.name);
  return names;
}

void App::go_to_camera(const std::string& name) {
  view = start_view(document, name);
  redraw();
}

std::optional<vec3> App::selected_position() const {
  const auto i = static_cast<std::size_t>(selection.index);
  if (selection.is(Kind::light)) {
    if (document.scene->lights[i].type == scene::LightType::directional) return {};
    return light_position(light_states(*document.scene, document.edits(), document.time)[i].world);
  }
  if (!selection.is(Kind::sphl)) return {};
  return sphl_position(*document.scene, scene::world_matrices(*document.scene, document.time),
                       document.edits().sphls[i]);
}

void App::move_selected(const vec3& position) {
  const auto i = static_cast<std::size_t>(selection.index);
  if (selection.is(Kind::light)) {
    const mat4 world = light_states(*document.scene, document.edits(), document.time)[i].world;
    document.edit("move " + document.scene->lights[i].name,
                  [&](Edits& edits) { edits.lights[i].world = with_position(world, position); });
  } else if (selection.is(Kind::sphl)) {
    document.edit("move " + document.edits().sphls[i].name,
                  [&](Edits& edits) { edits.sphls[i].position = position; });
  }
  redraw();
}

void App::frame_selection() {
  scene::Bounds bounds = document.bounds;
  if (const auto position = selected_position()) {
    bounds = {};
    bounds.add(*position - 0.5f), bounds.add(*position + 0.5f);
  }
  view = framed(view, bounds, viewport.aspect());
  redraw();
}

void App::undo() {
  const std::string what = document.history.undo_name();
  if (document.history.undo()) say("undone: " + what);
  selection = {};
}

void App::redo() {
  const std::string what = document.history.redo_name();
  if (document.history.redo()) say("done again: " + what);
  selection = {};
}

void App::delete_selection() {
  if (!selection.is(Kind::sphl)) return;
  const auto i = selection.index;
  document.history.seal();
  document.edit("delete SPHL", [&](Edits& edits) { edits.sphls.erase(edits.sphls.begin() + i); });
  document.history.seal();
  selection = {};
  redraw();
}

void App::add_sphl(const vec3& position) {
  document.history.seal();
  document.edit("place SPHL", [&](Edits& edits) {
    edits.sphls.push_back({-1, position, new_sphl_name(edits), 0.1f, true});
  });
  document.history.seal();
  selection = {Kind::sphl, static_cast<int>(document.edits().sphls.size()) - 1};
  redraw();
}

void App::light_scene_probes() {
  if (places_of(document).empty())
    throw Error("probes", "the scene has no SPHLs", "let them be placed: --probes auto, or the button");
  rebuild_light();
}

void App::use_probes(const std::string& what) {
  constexpr std::string_view automatic = "auto:";
  if (what == "off") {
    light.clear();
  } else if (what == "scene") {
    light_scene_probes();
  } else if (what == "auto") {
    place_probes(0);
  } else if (what.starts_with(automatic)) {
    const float spacing = parse_number("probes", what.substr(automatic.size()));
    if (!(spacing > 0)) throw Error("probes", "a spacing must be over 0", "as in auto:0.7");
    place_probes(spacing);
  } else if (is_probe_file(what)) {
    take_probe_file(what);
    if (options.live) light_scene_probes();
  } else {
    throw Error(
        "probes",
        fmt::format("\"{}\" is none of: off, scene, auto, auto:METRES, a .sphl or .sphl.json file", what));
  }
}

void App::rebuild_light() {
  LiveLightParams params;
  params.geometry = geometry_;
  params.places = places_of(document);
  if (params.places.empty()) {
    light.clear();
    say("there are no SPHLs left: direct light only");
    return;
  }
  auto scene = std::make_shared<const scene::Scene>(with_materials(*document.scene, document.edits()));
  job.start("lighting probes", [this, scene, params, time = document.time](const Control& control) {
    auto live = std::make_shared<LiveLight>(scene, params, time, control);
    return [this, live] { light.take(live); };
  });
}

void App::place_probes(float spacing) {
  auto scene = std::make_shared<const scene::Scene>(with_materials(*document.scene, document.edits()));
  LiveLightParams params;
  params.geometry = geometry_;
  params.spacing = spacing;
  job.start("placing probes", [this, scene, params, time = document.time](const Control& control) {
    auto live = std::make_shared<LiveLight>(scene, params, time, control);
    return [this, live] {
      document.history.seal();
      document.edit("place probes", [&](Edits& edits) {
        edits.sphls.clear();
        for (const gi::ProbePlace& place : live->session().places())
          edits.sphls.push_back({-1, place.position, place.name, place.radius, true});
      });
      document.history.seal();
      selection = {};
      applied_sphls_ = document.edits().sphls;
      light.take(live);
      say(fmt::format("{} probes", live->session().places().size()));
    };
  });
}

void App::start_gen(bool viz_only) {
  const std::vector<gi::ProbePlace> places = places_of(document);
  if (places.empty()) throw Error("GEN", "there are no SPHLs", "place some first");
  auto scene =
      std::make_shared<const scene::Scene>(edited_scene(*document.scene, document.edits(), document.time));
  gi::BakeParams params = bake_params;
  // HIER multiplies edges with light band by band, so they must be of one degree.
  const int degree = viz_only && !light.empty() ? light.set().degree : 9;
  gi::ProbeSet set = gi::init_from_scene(*scene, degree, document.time);
  const float time = document.time;
  if (viz_only) {
    // Edges beside whatever light there is: VIZ alone, in a set of its own.
    params.keep_light = true;
    params.viz = true;
    params.on_probe = [this](std::size_t i, const gi::Probe& probe) {
      job.hand_over([this, i, edges = probe.edges] { light.take_edges(i, edges); });
    };
  } else {
    params.on_probe = [this](std::size_t i, const gi::Probe& probe) {
      job.hand_over([this, i, probe] { light.take_probe(i, probe); });
    };
    gi::ProbeSet dark = set;
    for (const std::string& group : scene::light_groups(*scene))
      dark.light_groups.push_back({group, vec3(1)});
    for (gi::Probe& probe : dark.probes)
      probe.groups.assign(dark.light_groups.size(), {{}, sh::RadianceSh(degree)});
    light.take(std::move(dark), "GEN");
  }
  job.start(viz_only ? "VIZ" : "GEN", [this, geometry = geometry_, scene, set, params,
                                       time](const Control& control) mutable {
    const trace::PathTracer tracer(geometry, *scene, time);
    if (params.keep_light) {
      for (const std::string& group : tracer.light_groups()) set.light_groups.push_back({group, vec3(1)});
      for (gi::Probe& probe : set.probes)
        probe.groups.assign(set.light_groups.size(), {{}, sh::RadianceSh(set.degree)});
    }
    gi::BakeReport bake_report;
    auto baked =
        std::make_shared<gi::ProbeSet>(gi::bake(tracer, std::move(set), params, {}, bake_report, control));
    const bool keep = params.keep_light;
    return [this, baked, keep] {
      if (keep) {
        say(fmt::format("VIZ: {} edges", gi::edge_count(*baked)));
      } else {
        light.take(std::move(*baked), "GEN");
        say("GEN is done");
      }
    };
  });
}

void App::take_probe_file(const std::string& file) {
  if (!scene_open()) throw Error(file, "there is no scene for these probes", "open the scene first");
  gi::ProbeSet set = gi::read_probe_file(file);
  if (set.generator.scene_hash != scene::light_hash(*document.scene)) {
    const std::string problem = fmt::format("was baked in another scene (\"{}\")", set.generator.scene);
    if (!options.force) throw Error(file, problem, "open that scene, or go on with --force");
    log_warning("{}: {}", file, problem);
  }
  document.history.seal();
  document.edit("probes of a file", [&](Edits& edits) {
    edits.sphls.clear();
    for (const gi::Probe& probe : set.probes)
      edits.sphls.push_back({-1, probe.position, probe.name, probe.radius, true});
  });
  document.history.seal();
  applied_sphls_ = document.edits().sphls;
  selection = {};
  say(fmt::format("{}: {} probes", file, set.probes.size()));
  const std::optional<gi::FittedPoints> fitted = set.fitted;
  light.take(std::move(set), file);
  if (fitted) prepare_fitted(*fitted);
}

void App::prepare_fitted(const gi::FittedPoints& fitted) {
  job.start("fitted weights", [this, fitted, geometry = geometry_, scene = document.scene,
                               time = document.time](const Control& control) {
    // What a door hides at any of these times lights nothing behind it at any other
    std::vector<std::unique_ptr<trace::PathTracer>> poses;
    for (const float t : {time, 0.0f, scene::animation_duration(*scene)}) {
      if (poses.empty() || t != time)
        poses.push_back(std::make_unique<trace::PathTracer>(geometry, *scene, t));
    }
    const gi::SeesProbe sees = [&](const vec3& a, const vec3& b) {
      return std::all_of(poses.begin(), poses.end(), [&](const auto& pose) { return pose->visible(a, b); });
    };
    auto prepared = std::make_shared<realtime::FittedSurfaces>(
        realtime::prepare_fitted(*scene, time, fitted, sees, control));
    return [this, prepared] { light.take_fitted(std::move(*prepared)); };
  });
}

}  // namespace ssphh::viewer
