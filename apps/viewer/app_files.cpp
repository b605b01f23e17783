// Files that the user chooses, and what is kept of a session beside them.

#include <algorithm>
#include <chrono>
#include <limits>
#include <thread>
#include <utility>

#include <fmt/format.h>

#include <ssphh/core/log.h>
#include <ssphh/scene_io/load.h>

#include "app.h"
#include "model/overlay_file.h"

namespace ssphh::viewer {
namespace {

constexpr double keep_every = 60;  // seconds

/// What is to be written, apart from what the window goes on changing.
Document snapshot(const Document& document) {
  Document out;
  out.source = document.source;
  out.overlay = document.overlay, out.recovered = document.recovered;
  out.opened = document.opened, out.scene = document.scene;
  out.history = History<Edits>(document.edits());
  out.time = document.time;
  return out;
}

}  // namespace

App::~App() {
  keep_at_once();
}

void App::keep_at_once() {
  try {
    if (keeps()) leave();
  } catch (const std::exception& e) {
    log(LogLevel::error, e.what());
  }
}

void App::leave() {
  while (!keeper_.idle()) {
    std::this_thread::sleep_for(std::chrono::milliseconds(1));
    keeper_.poll();
  }
  if (!scene_open() || !unsaved() || closes_) return autosave_.drop();
  if (autosave_.has_name() && kept_ == std::pair(document.history.serial(), light.works())) return;
  const Kept kept{autosave_.name_for(document.source), lasting_name(document.source), document.file, {}};
  write_kept(kept, document.dirty() ? &document : nullptr, light.unsaved().empty() ? nullptr : &light.set());
}

void App::keep_unsaved() {
  if (!keeps() || !scene_open()) return;
  keeper_.poll();
  if (const std::string error = keeper_.take_error(); !error.empty()) complain("autosave: " + error);
  if (keeper_.running()) return;
  if (!unsaved()) {
    unsaved_since_.reset();
    return autosave_.drop();
  }
  const std::pair state(document.history.serial(), light.works());
  if (autosave_.has_name() && state == kept_) return unsaved_since_.reset();
  if (!unsaved_since_) unsaved_since_ = window.seconds();
  if (window.seconds() - *unsaved_since_ < keep_every) return;
  unsaved_since_.reset();
  kept_ = state;
  try {
    Kept kept{autosave_.name_for(document.source), lasting_name(document.source), document.file, {}};
    std::shared_ptr<const Document> scene;
    if (document.dirty()) scene = std::make_shared<const Document>(snapshot(document));
    std::shared_ptr<const probes::ProbeSet> probes;
    if (!light.unsaved().empty()) probes = std::make_shared<const probes::ProbeSet>(light.set());
    keeper_.start("autosave", [kept, scene, probes](const Control&) -> BackgroundJob::Finish {
      write_kept(kept, scene.get(), probes.get());
      return {};
    });
  } catch (const std::exception& e) {
    complain(e.what());
  }
}

void App::offer_recovery() {
  if (!keeps()) return;
  const std::vector<Kept> left = autosave_.left(document.source);
  if (left.empty()) return;
  question = {Question::Then::recover, {}, left.front()};
  redraw();
}

void App::recover(const Kept& kept) {
  job.cancel();
  if (kept.scene) {
    // All that an overlay or options had added is in the file.
    take_scene(kept.source,
               scene_io::load_scene(kept.with_ending(".glb").string(), {.keep_dark_light = true}));
    document.saved = std::numeric_limits<std::uint64_t>::max();  // of no state
    document.file = kept.file;
    document.recovered = true;
  } else if (!scene_open() || lasting_name(document.source) != kept.source) {
    open(kept.source);
  }
  if (kept.probes) {
    probes::ProbeSet set = probes::read_probe_file(kept.with_ending(".sphl").string());
    take_places("probes of a file", set.probes);
    light.take(std::move(set), "GEN");
    light.not_saved("GEN");
    prepare_surfaces();
  } else if (options.probes != "off" && !document.edits().sphls.empty()) {
    light_scene_probes();
  }
  if (!autosave_.adopt(kept)) throw Error(kept.source, "another session has taken it up meanwhile");
  kept_ = {document.history.serial(), light.works()};
  update_title();
  say(fmt::format("recovered {} as it was at {}; not saved yet", kept.source, kept.when));
}

void App::remember_scene(const std::string& source, bool stays) {
  if (options.preferences.empty() || !by_hand() || source.starts_with("builtin:")) return;
  try {
    // Another session may have written it.
    preferences = read_preferences(options.preferences);
    stays ? remember(preferences, source) : forget(preferences, source);
    write_preferences(preferences, options.preferences);
  } catch (const std::exception& e) {
    complain(e.what());
  }
}

WindowLook App::look() const {
  return {side_width,       settings.histogram, settings.waveform,  settings.false_color,
          settings.quality, settings.snap,      settings.snap_angle};
}

void App::take_look() {
  if (!by_hand()) return;
  side_width = preferences.look.side_width;
  settings.histogram = preferences.look.histogram;
  settings.waveform = preferences.look.waveform;
  settings.false_color = preferences.look.false_color;
  settings.quality = preferences.look.quality;
  settings.snap = preferences.look.snap;
  settings.snap_angle = preferences.look.snap_angle;
}

void App::keep_look() {
  const WindowLook now = look();
  if (options.preferences.empty() || !by_hand() || now == kept_look_) return;
  kept_look_ = now;
  try {
    preferences = read_preferences(options.preferences);
    preferences.look = now;
    write_preferences(preferences, options.preferences);
  } catch (const std::exception& e) {
    complain(e.what());
  }
}

void App::ask_for_overlay() {
  ask_for_file(FileDialog::For::scene);
  if (document.file.ends_with(overlay_ending)) return;
  dialog->browser = FileBrowser(dialog->browser.folder(), {".glb", std::string(overlay_ending)},
                                free_file(std::string(overlay_ending)));
}

void App::ask_for_file(FileDialog::For what, const std::filesystem::path& in) {
  using enum FileDialog::For;
  namespace fs = std::filesystem;
  const fs::path own = document.file.empty() ? document.source : document.file;
  const bool in_folder = !document.file.empty() || fs::exists(own);
  const fs::path folder = !in.empty()                          ? in
                          : in_folder && own.has_parent_path() ? own.parent_path()
                                                               : fs::current_path();
  if (what == open) {
    dialog = {what,
              FileBrowser(folder, {".glb", ".gltf", ".obj", ".ssphh.json", ".sphl", ".sphl.json", ".json"}),
              {},
              {}};
  } else if (what == sky) {
    dialog = {what, FileBrowser(folder, {".hdr", ".exr", ".HDR", ".EXR"}), {}, {}};
  } else if (what == profile) {
    dialog = {what, FileBrowser(folder, {".ies", ".IES"}), {}, {}};
  } else if (what == scene) {
    const std::string name =
        document.file.empty() ? free_file(".glb") : fs::path(document.file).filename().string();
    dialog = {what, FileBrowser(folder, {".glb", ".ssphh.json"}, name), {}, {}};
  } else if (what == FileDialog::For::picture) {
    dialog = {what, FileBrowser(fs::current_path(), {".png", ".exr"}, free_file(".png")), {}, {}};
  } else {
    dialog = {what, FileBrowser(folder, {".sphl", ".sphl.json"}, free_file(".sphl")), {}, {}};
  }
  redraw();
}

void App::choose_file() {
  using enum FileDialog::For;
  FileDialog& asked = *dialog;
  redraw();
  try {
    asked.problem.clear();
    auto path = asked.browser.choose();
    if (!path) return asked.replaces.clear();
    if (asked.reads() && !std::filesystem::exists(*path))
      throw Error(path->string(), "there is no such file");
    if (asked.what == profile || asked.what == sky) {
      asked.what == sky ? take_surroundings(path->string()) : take_profile(path->string());
      dialog.reset();
      return;
    }
    if (asked.what == open) {
      request_open(path->string());
      mended_ = std::exchange(dialog, std::nullopt);
      return;
    }
    const std::string ending = asked.what == scene                      ? ".glb"
                               : asked.what == FileDialog::For::picture ? ".png"
                                                                        : ".sphl";
    const bool ends =
        asked.what == scene ? path->extension() == ".glb" || path->string().ends_with(overlay_ending)
        : asked.what == FileDialog::For::picture ? path->extension() == ".png" || is_linear_picture(*path)
                                                 : is_probe_file(path->string());
    if (!ends) *path += ending;
    const bool own = asked.what == scene && *path == document.file;
    if (std::filesystem::exists(*path) && !own && std::exchange(asked.replaces, *path) != *path) return;
    if (asked.what == scene) save_as(path->string());
    if (asked.what == probes) save_probes(path->string());
    if (asked.what == FileDialog::For::picture) screenshot(path->string(), false);
    dialog.reset();
  } catch (const std::exception& e) {
    asked.replaces.clear();
    asked.problem = e.what();
  }
}

}  // namespace ssphh::viewer
