// How scenes come in: loaded in the background while the window goes on, opened, watched on the disk.

#include <algorithm>
#include <array>
#include <utility>

#include <fmt/format.h>
#include <fmt/ranges.h>

#include "app.h"
#include "model/lengths.h"

namespace ssphh::viewer {
namespace {

namespace fs = std::filesystem;

bool is_path(const std::string& source) {
  return source.ends_with(".json") && !source.ends_with(".sphl.json") && !source.ends_with(".ssphh.json");
}

bool is_scene(const std::string& source) {
  return !is_path(source) && !is_probe_file(source);
}

/// By what it ends with: what is dropped among others may be anything.
bool named_as_scene(const std::string& file) {
  constexpr std::array<std::string_view, 4> endings = {".glb", ".gltf", ".obj", ".ssphh.json"};
  return std::ranges::any_of(endings, [&](std::string_view ending) { return file.ends_with(ending); });
}

bool is_profile(const std::string& file) {
  return file.ends_with(".ies") || file.ends_with(".IES");
}

bool is_sky(const std::string& file) {
  return file.ends_with(".hdr") || file.ends_with(".HDR") || is_linear_picture(file);
}

std::string short_name(const std::string& source) {
  return source.starts_with("builtin:") ? source : fs::path(source).filename().string();
}

}  // namespace

/// A scene with all that is made of it before OpenGL takes it over.
struct App::Loaded {
  Document document;
  trace::SharedGeometry geometry;
  std::unique_ptr<trace::TransportScene> picking;
  std::optional<FileState> file;

  explicit Loaded(Document d)
      : document(std::move(d)),
        geometry(trace::geometry_of(document.scene)),
        picking(std::make_unique<trace::TransportScene>(geometry, *document.scene)),
        file(file_state(document.source)) {}
};

void App::open(const std::string& source) {
  if (is_path(source)) return load_path(source);
  if (is_probe_file(source)) return take_probe_file(source);
  say(fmt::format("loading {} …", source));
  take_loaded(source, Loaded(make_document(source, load_(source), 0)));
}

void App::take_loaded(const std::string& source, Loaded loaded) {
  take_scene(std::move(loaded));
  remember_scene(source);
  say(fmt::format("{}: {} triangles, lights: {}, SPHLs: {}", source, scene::triangle_count(*document.scene),
                  document.scene->lights.size(), document.scene->sphls.size()));
}

void App::take_scene(std::string source, scene::Scene scene) {
  take_scene(Loaded(make_document(std::move(source), std::move(scene), 0)));
}

void App::take_scene(Loaded loaded) {
  job.cancel();
  reference.clear();
  Document& next = loaded.document;
  next.time = std::clamp(document.source.empty() ? options.time : 0, 0.0f, next.duration);
  if (!gl_) gl_.emplace(gl::Context::adopt_current());
  if (!balls_) balls_ = std::make_unique<BallsGl>();
  auto renderer =
      std::make_unique<realtime::Renderer>(*gl_, *next.scene, realtime::RendererParams{}, next.time);
  take_document(std::move(loaded));
  renderer_ = std::move(renderer);
  applied_.lamps_of = document.scene;
}

void App::take_document(Document next) {
  take_document(Loaded(std::move(next)));
}

/// Nothing is thrown here: a file that is refused leaves the open one alone.
void App::take_document(Loaded loaded) {
  picking_ = std::move(loaded.picking);
  geometry_ = std::move(loaded.geometry);
  document = std::move(loaded.document);
  if (document.source == options.source) document.overlay = options.overlay;
  mended_.reset();
  watch_ = FileWatch(loaded.file, window.seconds());
  light.clear();
  autosave_.drop();
  question = {};
  unsaved_since_.reset();
  selection = {};
  camera = -1;
  view = view_from("");
  views = ViewHistory(view);
  others.clear(), place = 0;
  pinned.reset(), inspection.reset();
  applied_.materials = document.edits().materials;
  applied_.sphls = document.edits().sphls;
  screen.forget();
  exposure_.forget();
  applied_.light_stale = applied_.bakes_again = false;
  fly_speed = document.bounds.empty()
                  ? 2
                  : std::max(2 * lengths_of(document.bounds).least, 0.25f * document.bounds.radius());
  walker = walker_for(document.bounds);
  walking = false;
  frames.reset();
  follows_exposure = true;
  update_title();
  redraw();
}

void App::open_then(const std::string& source, std::function<void()> then) {
  if (!is_scene(source) || !by_hand()) {
    open(source);
    return then();
  }
  job.start("loading " + short_name(source),
            [this, source, then = std::move(then), load = load_,
             edits = document.history.serial()](const Control& control) -> BackgroundJob::Finish {
              scene::Scene scene = load(source);
              control.check();
              auto loaded = std::make_shared<Loaded>(make_document(source, std::move(scene), 0));
              return [this, source, loaded, then, edits] {
                // Edits of meanwhile: nobody was asked about them.
                if (scene_open() && edits != document.history.serial() && document.dirty()) {
                  question = {Question::Then::open, source, {}};
                  return redraw();
                }
                take_loaded(source, std::move(*loaded));
                then();
              };
            });
  redraw();
}

void App::open_lit(const std::string& source) {
  if (!is_scene(source)) return open(source);
  open_then(source, [this] { light_opened(); });
}

void App::light_opened() {
  const auto enabled = [](const SphlEdit& sphl) { return sphl.enabled; };
  if (options.probes == "off" || options.probes.starts_with("auto")) {
    use_probes(options.probes);
  } else if (std::ranges::any_of(document.edits().sphls, enabled)) {
    light_scene_probes();
  } else if (options.probes.empty() && by_hand()) {
    place_probes(0);  // direct light alone looks broken in most rooms
  }
  offer_recovery();
}

void App::request_open(const std::string& source) {
  if (!is_scene(source) || what_is_lost().empty()) return open_lit(source);
  question = {Question::Then::open, source, {}};
  redraw();
}

void App::take_dropped(const std::vector<std::string>& files) {
  std::vector<std::string> scenes, rest;
  for (const std::string& file : files) {
    std::error_code ignored;
    if (fs::is_directory(file, ignored)) {
      // What is in it can be chosen.
      return ask_for_file(FileDialog::For::open, file);
    }
    const bool alone = files.size() == 1 && is_scene(file) && !is_profile(file) && !is_sky(file);
    (named_as_scene(file) || alone ? scenes : rest).push_back(file);
  }
  std::vector<std::string> strange;
  bool has_sky = false;
  for (const std::string& file : rest) {
    if (is_profile(file) || is_sky(file)) {
      // There is one sky, and a scene that is dropped with it has its own.
      if (is_sky(file) && (!scenes.empty() || std::exchange(has_sky, true))) continue;
      try {
        is_sky(file) ? take_surroundings(file) : take_profile(file);
      } catch (const std::exception& e) {
        complain(e.what());
      }
    } else if (is_scene(file)) {
      strange.push_back(short_name(file));
    } else if (scenes.empty()) {
      try {
        request_open(file);
      } catch (const std::exception& e) {
        complain(e.what());
      }
    }
  }
  if (!scenes.empty()) request_open(scenes.front());
  if (scenes.size() > 1) {
    say(fmt::format("{} scenes were dropped; a window shows one: {}", scenes.size(),
                    short_name(scenes.front())));
  } else if (!strange.empty()) {
    const std::size_t shown = std::min<std::size_t>(strange.size(), 3);
    complain(
        fmt::format("{}{}: neither a scene (.glb, .gltf, .obj, .ssphh.json) nor probes nor a camera path nor "
                    "a lamp's profile (.ies) nor a sky (.hdr, .exr)",
                    fmt::join(strange.begin(), strange.begin() + static_cast<std::ptrdiff_t>(shown), ", "),
                    strange.size() > shown ? fmt::format(" and {} more", strange.size() - shown) : ""));
  }
}

/// Once the scene's file has changed, and has not gone on changing, the user is asked whether to load it
/// anew; of one that is gone the user is told.
void App::watch_file() {
  if (!by_hand() || !scene_open()) return;
  const FileWatch::News news = watch_.look(document.source, window.seconds());
  if (news == FileWatch::News::gone)
    complain(fmt::format("{} is gone from the disk; it stays open, and can be saved under a name",
                         document.source));
  const bool busy = question.then != Question::Then::nothing || job.running() || dialog;
  if (news != FileWatch::News::changed || busy) return;
  watch_.taken();
  question = {Question::Then::reload, document.source, {}};
  redraw();
}

}  // namespace ssphh::viewer
