#include "app.h"

#include <algorithm>
#include <cmath>
#include <stdexcept>
#include <utility>

#include <imgui.h>

#include <ssphh/core/file.h>
#include <ssphh/image/exposure.h>
#include <ssphh/image/io.h>
#include <ssphh/rays/posed_world.h>

#include "input.h"
#include "overlay.h"
#include "panels/panels.h"

namespace ssphh::viewer {
App::App(Window& window_, const ViewerOptions& options_, LoadScene load, ShowElsewhere show)
    : window(window_),
      options(options_),
      elsewhere(std::move(show)),
      load_(std::move(load)),
      autosave_(options_.autosave) {
  view = look_at({4, 3, 6}, {0, 1, 0}, 0.9f);
  panels = options.panels;
  report.renderer = window.renderer();
  last_turn_ = last_change_ = last_frame_ = window.seconds();
  try {
    if (!options.preferences.empty()) preferences = read_preferences(options.preferences);
  } catch (const std::exception& e) {
    complain(e.what());
  }
  take_look();
  kept_look_ = look();
  if (by_hand()) light.budget_ms = 30;
  if (options.farm) farm.emplace(*options.farm, options.own_farm);
  for (const auto& [name, value] : options.settings) set_setting(settings, name, value);
  take_quality();
}

double App::turn(const InjectedInput& input) {
  const auto now = window.seconds();
  const double elapsed = now - last_turn_;
  last_turn_ = now;

  // Take over what others did.
  if (window.take_input()) redraw();
  try {
    if (const std::vector<std::string> files = window.take_dropped(); !files.empty()) take_dropped(files);
  } catch (const std::exception& e) {
    complain(e.what());
  }
  take_work();
  if (farm) take_farm_news();
  take_truth();
  take_marks();
  take_shown();
  watch_file();
  note_view();
  keep_unsaved();
  update_time(std::min(elapsed, 0.25));
  take_quality();

  const bool busy = job.running() || reference.status().running || marks.status().running;
  // How far it is
  if (job.running() && now - last_frame_ > 0.2) redraw();
  const bool moving = settings.play || path_plays || frames || applied_.light_stale || drawing() ||
                      light.under_way() || std::ranges::any_of(others, &Pane::drawing);
  if (redraw_ == 0 && !moving) return busy ? 0.1 : 0.5;
  redraw_ = std::max(redraw_ - 1, 0);

  // The user's turn: panels and mouse change the state.
  const auto start = window.seconds();
  window.begin_frame(input);
  handle_input(*this, static_cast<float>(std::min(elapsed, 0.1)));
  draw_panels(*this);
  if (!ImGui::IsAnyMouseDown()) keep_look();
  const double panel_ms = 1e3 * (window.seconds() - start);

  // Bring everything up to date with it.
  if (scene_open()) {
    draw_scene();
    draw_views();
    update_title();
  }
  const auto ui = window.seconds();
  finish_frame();
  continue_frames(*this);
  times.add("panels", panel_ms + 1e3 * (window.seconds() - ui));
  return redraw_ > 0 || moving ? 0 : busy ? 0.05 : 0.5;
}

void App::take_work() {
  std::string error;
  try {
    if (job.poll()) redraw();
    error = job.take_error();
  } catch (const std::exception& e) {
    error = e.what();
  }
  if (error.empty()) return;
  if (failures_end) throw std::runtime_error(error);
  complain(error);
  if (!mended_) return;
  dialog = std::exchange(mended_, std::nullopt);
  dialog->problem = error;
}

void App::take_truth() {
  if (reference.poll()) {
    screen.truth_dirty = true, redraw();
    if (options.show_truth) send_truth();
  }
  const std::string error = reference.take_error();
  if (error.empty()) return;
  redraw();
  settings.show = Show::realtime;  // it would begin anew, and fail again
  if (failures_end) throw std::runtime_error(error);
  complain(error);
}

void App::take_marks() {
  if (marks.poll()) {
    redraw();
    if (marked()) picture.take_instead(marks.picture());
  }
  const std::string error = marks.take_error();
  if (error.empty()) return;
  redraw();
  settings.draw.clear();
  if (failures_end) throw std::runtime_error(error);
  complain(error);
}

void App::take_shown() {
  if (const std::string problem = elsewhere.poll(); !problem.empty()) say(problem);
}

void App::finish_frame() {
  window.end_frame();
  if (!window_shot_.empty()) {
    const std::string file = std::exchange(window_shot_, {});
    try {
      write_file(file, image::encode_png(window.read_frame()));
      written("wrote", file);
    } catch (const std::exception& e) {
      complain(e.what());
    }
  }
  window.show_frame();
  last_frame_ = window.seconds();
  ++report.frames;
}

void App::update_time(double seconds) {
  if (settings.play && document.duration > 0) {
    document.time += settings.speed * static_cast<float>(seconds);
    // There and back again, so that nothing jumps.
    const float period = 2 * document.duration;
    document.time = std::fmod(std::fmod(document.time, period) + period, period);
    if (document.time > document.duration) {
      document.time = period - document.time;
      settings.speed = -settings.speed;
    }
  }
  if (path_plays && !bookmarks.empty()) {
    path_time += static_cast<float>(seconds);
    if (path_time > bookmarks.keys.back().time) path_plays = false;
    go_to(at(bookmarks, path_time));
  }
}

/// What the user changed since the last turn goes to the renderer; places and surfaces make the light stale.
void App::apply_edits() {
  const Edits& edits = document.edits();
  // While somebody drags a cone the renderer keeps the one of before, which lines show beside the new one.
  const bool shapes_alone = applied_.lamps_of->lights.size() == document.scene->lights.size() &&
                            scene::light_groups(*applied_.lamps_of) == scene::light_groups(*document.scene);
  if (applied_.lamps_of != document.scene && !(shapes_alone && ImGui::IsAnyMouseDown())) apply_lamps();
  // Also where lamps changed while the light was on its way; once, so that it can be cancelled.
  const std::pair asked(document.scene, light.live_light());
  if (light.live() && applied_.relit_for != asked && !document.lamps_are_of(light.live_light()->scene())) {
    applied_.relit_for = asked;
    applied_.light_is_stale(window.seconds());
  }
  stop_stale_bake();
  const scene::LightingState lighting = document.lighting();
  if (renderer_->lighting() != lighting) {
    renderer_->set(lighting);
    screen.scene_dirty = true;
  }
  for (std::size_t i = 0; i < edits.materials.size(); ++i) {
    if (same_surface(edits.materials[i], applied_.materials[i])) continue;
    renderer_->set_material(static_cast<int>(i), edits.materials[i]);
    applied_.materials[i] = edits.materials[i];
    screen.scene_dirty = true;
    if (light.live()) applied_.light_is_stale(window.seconds());
  }
  if (!same_places(edits.sphls, applied_.sphls)) {
    applied_.sphls = edits.sphls;
    applied_.light_is_stale(window.seconds());
  }
  // Not while somebody drags: once things have been still for a moment.
  if (applied_.light_stale && window.seconds() - applied_.stale_since > 0.3 && !ImGui::IsAnyMouseDown()) {
    applied_.light_stale = false;
    std::exchange(applied_.bakes_again, false) ? start_gen(baked_->viz_only) : rebuild_light();
  }
}

/// Transport is built for lamps. The picture has them at once, indirect light follows in the background.
void App::apply_lamps() {
  renderer_->set_lamps(with_materials(*document.scene, document.edits()));
  applied_.lamps_of = document.scene;
  screen.drawing.reset();
  screen.outline.reset();
  screen.scene_dirty = true;
}

/// Nobody waits for light that takes long to follow: the window goes on meanwhile.
void App::update_light() {
  const ProbeLight::Update update = light.update(document, settings, *renderer_);
  if (!update.relit && !update.replaced) return;
  screen.scene_dirty = screen.balls_dirty = true;
  if (update.replaced) screen.visible_from.reset();
  times.add("relight", update.relight_ms);
  if (update.hier_ms > 0.01) times.add("hier", update.hier_ms);
  times.add("probe upload", update.upload_ms);
}

bool App::settled() const {
  const auto smooth = [](const Pane& pane) { return pane.picture.averaged() >= smooth_pictures; };
  return current() && (!scene_open() || !smooths() || (smooth(*this) && std::ranges::all_of(others, smooth)));
}

bool App::current() const {
  if (!scene_open()) return job.idle();
  if (!job.idle() || !elsewhere.idle() || screen.to_send || screen.linear_file || applied_.light_stale ||
      light.under_way())
    return false;
  const auto current = [this](const Pane& pane) { return pane.shows(settings); };
  if (!current(*this) || !std::ranges::all_of(others, current)) return false;
  if (static_cast<int>(others.size()) + 1 != settings.views) return false;
  if (draws_marks() && !marked()) return false;
  return !needs_truth(settings) || (reference.image().passes >= settings.truth_passes && !screen.truth_dirty);
}

}  // namespace ssphh::viewer
