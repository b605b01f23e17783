#include <algorithm>
#include <filesystem>

#include <fmt/format.h>

#include <ssphh/core/file.h>
#include <ssphh/core/log.h>
#include <ssphh/study/default_view.h>

#include "app.h"
#include "model/lengths.h"
#include "model/overlay_file.h"

namespace ssphh::viewer {

void App::say(const std::string& text) {
  message = text;
  message_is_error = false;
  message_since = window.seconds();
  redraw();
}

void App::complain(const std::string& text) {
  say(text);
  message_is_error = true;
  log(LogLevel::error, text);
}

void App::written(const std::string& verb, const std::string& file) {
  report.written.push_back(file);
  say(verb + " " + file);
}

std::string App::picture_name() const {
  std::string stem =
      std::filesystem::path(document.source.substr(document.source.rfind(':') + 1)).stem().stem().string();
  // A built-in scene's name holds its parameters, and not every system takes these signs.
  for (char& c : stem) {
    if (std::string_view("?*=&|<>\"\\/:").find(c) != std::string_view::npos) c = '-';
  }
  return stem.empty() ? "view" : stem;
}

std::string App::free_file(const std::string& ending) const {
  for (int n = 1;; ++n) {
    const std::string name = fmt::format("{}-{:02}", picture_name(), n);
    // An overlay would lie on the scene of its name.
    const bool pair = ending == ".glb" || ending == overlay_ending;
    const auto taken = [&](std::string_view e) { return std::filesystem::exists(name + std::string(e)); };
    if (!taken(ending) && !(pair && (taken(".glb") || taken(overlay_ending)))) return name + ending;
  }
}

void App::save() {
  const bool probes_alone = !document.dirty() && !light.unsaved().empty();
  if (!probes_alone) save_scene(document.file.empty() ? free_file(".glb") : document.file);
  if (!light.unsaved().empty()) save_probes(free_file(".sphl"));
}

void App::save_as(const std::string& file) {
  std::error_code ignored;
  const OpenedFiles files = opened_files(document.source, document.overlay);
  std::vector<std::string> opened = files.overlays;
  opened.push_back(files.scene);
  for (const std::string& below : opened) {
    if (file != document.file && std::filesystem::equivalent(file, below, ignored))
      throw Error(file, "is the scene as it was opened, which stays as it is", "save under another name");
  }
  save_scene(file);
}

void App::save_scene(const std::string& file) {
  save_document(document, file);
  document.history.seal();
  document.saved = document.history.serial();
  document.file = file;
  written("saved", file);
  remember_scene(file);
  const std::filesystem::path path = std::filesystem::absolute(file);
  say(fmt::format("saved {} in {}", path.filename().string(), path.parent_path().string()));
}

void App::save_probes(const std::string& file) {
  if (light.empty()) throw Error(file, "there are no probes to save", "place some, or open a probe file");
  if (light.is_glance())
    throw Error(file, "the probes hold light at a glance",
                job.running() ? "their whole light is on its way"
                              : "“Light them live” in the panel Probes finds the whole of it");
  if (light.live()) {
    const scene::Scene scene = document.edited();
    probes::ProbeSet set = light.bake(scene);
    for (std::size_t i = 0; i < set.probes.size(); ++i) {
      // Edges are of another degree where VIZ ran with one of its own.
      const std::vector<probes::Edge>& edges = light.set().probes[i].edges;
      if (std::ranges::all_of(edges, [&](const probes::Edge& edge) { return edge.h.degree() == set.degree; }))
        set.probes[i].edges = edges;
    }
    probes::write_probe_file(set, file);
  } else {
    probes::write_probe_file(light.set(), file);
  }
  light.saved();
  written("saved", file);
}

void App::save_path(const std::string& file) {
  if (bookmarks.empty()) throw Error(file, "there are no bookmarks to save", "add some with B");
  write_camera_path(file, bookmarks);
  written("saved", file);
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
  written("saved", file);
}

std::vector<std::string> App::camera_names() const {
  std::vector<std::string> names;
  for (const CameraEdit& camera : document.edits().cameras) names.push_back(camera.name);
  return names;
}

View App::view_from(const std::string& camera) const {
  if (!camera.empty() || !document.edits().cameras.empty()) return start_view(document, camera);
  const scene::CameraPose pose = study::default_view(*document.scene, *picking_, document.time);
  const float distance = glm::distance(vec3(pose.world[3]), document.bounds.center());
  return view_of(pose, document.bounds.empty() ? 3 : std::max(distance, lengths_of(document.bounds).least));
}

void App::go_to_camera(const std::string& name) {
  view = view_from(name);
  redraw();
}

void App::save_camera(const std::string& wanted) {
  std::string name = wanted;
  const std::vector<std::string> names = camera_names();
  for (int n = 1; name.empty() || (wanted.empty() && std::ranges::find(names, name) != names.end()); ++n)
    name = fmt::format("view {}", n);
  document.edit_at_once("save camera " + name, [&](Edits& e) { add_camera(e, name, view); });
  camera = static_cast<int>(document.edits().cameras.size()) - 1;
  say(fmt::format("camera \"{}\" saved; it is kept with the scene or its overlay", name));
}

void App::go_to(const CameraKey& key) {
  view = key.view;
  if (key.scene_time) document.time = *key.scene_time;
  redraw();
}

void App::add_bookmark() {
  append(bookmarks, {fmt::format("view {}", bookmarks.keys.size() + 1), 0, document.time, view});
}

std::optional<vec3> App::selected_position() const {
  const auto i = static_cast<std::size_t>(selection.index);
  if (selection.is(Kind::light)) {
    if (document.scene->lights[i].type == scene::LightType::directional) return {};
    return light_position(document.lighting().lights[i].world);
  }
  if (!selection.is(Kind::sphl)) return {};
  return sphl_position(*document.scene, scene::world_matrices(*document.scene, document.time),
                       document.edits().sphls[i]);
}

void App::move_selected(const vec3& position) {
  const auto i = static_cast<std::size_t>(selection.index);
  if (selection.is(Kind::light)) {
    const mat4 world = document.lighting().lights[i].world;
    document.edit("move " + document.scene->lights[i].name,
                  [&](Edits& edits) { edits.lights[i].world = with_position(world, position); });
  } else if (selection.is(Kind::sphl)) {
    document.edit("move " + document.edits().sphls[i].name,
                  [&](Edits& edits) { edits.sphls[i].position = position; });
  }
  redraw();
}

void App::undo() {
  const std::string what = document.history.undo_name();
  const Edits before = document.edits();
  if (!document.undo()) return;
  keep_selection(before);
  say("undone: " + what);
}

void App::redo() {
  const std::string what = document.history.redo_name();
  const Edits before = document.edits();
  if (!document.redo()) return;
  keep_selection(before);
  say("done again: " + what);
}

void App::keep_selection(const Edits& before) {
  const Edits& now = document.edits();
  if (selection.is(Kind::sphl)) selection.index = same_sphl(before.sphls, selection.index, now.sphls);
  if (selection.is(Kind::light)) selection.index = same_lamp(before.lights, selection.index, now.lights);
  if (selection.index < 0) selection = {};
}

void App::delete_selection() {
  if (selection.is(Kind::light)) return delete_lamp();
  if (!selection.is(Kind::sphl)) return;
  const auto i = selection.index;
  document.edit_at_once("delete SPHL", [&](Edits& edits) { edits.sphls.erase(edits.sphls.begin() + i); });
  selection = {};
  redraw();
}

void App::add_sphl(const vec3& position) {
  document.edit_at_once("place SPHL", [&](Edits& edits) {
    edits.sphls.push_back({-1, position, new_sphl_name(edits), lengths_of(document.bounds).least, true});
  });
  selection = {Kind::sphl, static_cast<int>(document.edits().sphls.size()) - 1};
  redraw();
}

}  // namespace ssphh::viewer
