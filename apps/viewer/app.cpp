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
App::App(Window& window_, const ViewerOptions& options_, const Control&)
    : window(window_), options(options_), autosave_(options_.autosave) {
  view = look_at({4, 3, 6}, {0, 1, 0}, 0.9f);
  panels = options.panels;
  report.renderer = window.renderer();
  // For looking at: a twentieth of the work of `ssphh bake`.
  bake_params.path.spp = 8;
  bake_params.face_size = 20;
  last_turn_ = last_change_ = last_frame_ = window.seconds();
  try {
    if (!options.preferences.empty()) preferences = read_preferences(options.preferences);
  } catch (const std::exception& e) {
    complain(e.what());
  }
  take_look();
  kept_look_ = look();
  for (const auto& [name, value] : options.settings) set_setting(settings, name, value);
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
  if (reference.poll()) truth_dirty_ = true, redraw();
  watch_file();
  note_view();
  keep_unsaved();
  update_time(std::min(elapsed, 0.25));

  const bool busy = job.running() || reference.status().running;
  // How far it is
  if (job.running() && now - last_frame_ > 0.2) redraw();
  const bool moving = settings.play || path_plays || light_stale_ || waiting_maps_ > 0 || drawing_;
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
    update_visible();
    draw_picture(*this);
    draw_overlay(*this, visible_);
    update_title();
  }
  const auto ui = window.seconds();
  finish_frame();
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

/// A software renderer takes a second for a large picture: while something moves it gets a small one.
void App::resize_picture() {
  const bool moving = drag.changes_picture() || settings.play || path_plays;
  if (!moving) coarse_ = false;
  if (moving && last_stats.cpu_ms > 80) coarse_ = true;
  const float scale = settings.scale * (coarse_ ? 0.4f : 1.0f);
  picture.resize(std::max(1, static_cast<int>(std::lround(viewport.width * scale))),
                 std::max(1, static_cast<int>(std::lround(viewport.height * scale))));
}

/// What the user changed since the last turn goes to the renderer; places and surfaces make the light stale.
void App::apply_edits() {
  const Edits& edits = document.edits();
  // While somebody drags a cone the renderer keeps the one of before, which lines show beside the new one.
  const bool shapes_alone = lamps_of_->lights.size() == document.scene->lights.size() &&
                            scene::light_groups(*lamps_of_) == scene::light_groups(*document.scene);
  if (lamps_of_ != document.scene && !(shapes_alone && ImGui::IsAnyMouseDown())) renew_renderer();
  // Also where lamps changed while the light was on its way; once, so that it can be cancelled.
  const std::pair asked(document.scene, light.live_light());
  if (light.live() && relit_for_ != asked && !has_lamps(light.live_light()->scene(), edits)) {
    relit_for_ = asked;
    light_stale_ = true;
    stale_since_ = window.seconds();
  }
  const scene::LightingState lighting = document.lighting();
  if (renderer_->lighting() != lighting) {
    renderer_->set(lighting);
    scene_dirty_ = true;
  }
  for (std::size_t i = 0; i < edits.materials.size(); ++i) {
    if (same_surface(edits.materials[i], applied_materials_[i])) continue;
    renderer_->set_material(static_cast<int>(i), edits.materials[i]);
    applied_materials_[i] = edits.materials[i];
    scene_dirty_ = true;
    if (light.live()) light_stale_ = true, stale_since_ = window.seconds();
  }
  if (!same_places(edits.sphls, applied_sphls_)) {
    applied_sphls_ = edits.sphls;
    light_stale_ = true;
    stale_since_ = window.seconds();
  }
  // Not while somebody drags: once things have been still for a moment.
  if (light_stale_ && window.seconds() - stale_since_ > 0.3 && !ImGui::IsAnyMouseDown()) {
    light_stale_ = false;
    rebuild_light();
  }
}

/// Lamps are built into renderers and transport. The picture has them at once, indirect light follows in the
/// background.
void App::renew_renderer() {
  const Edits& edits = document.edits();
  renderer_ = std::make_unique<realtime::Renderer>(*gl_, with_materials(*document.scene, edits),
                                                   realtime::RendererParams{}, document.time);
  lamps_of_ = document.scene;
  applied_materials_ = edits.materials;
  drawing_.reset();
  outlined_.reset();
  scene_dirty_ = true;
  light.renderer_is_new();
}

void App::update_light() {
  const ProbeLight::Update update = light.update(document, settings, *renderer_);
  if (!update.relit && !update.replaced) return;
  scene_dirty_ = balls_dirty_ = true;
  if (update.replaced) visible_seen_.reset();
  times.add("relight", update.relight_ms);
  if (update.hier_ms > 0.01) times.add("hier", update.hier_ms);
  times.add("probe upload", update.upload_ms);
}

/// Whether the picture on the screen, or the one that is being drawn, is not that of now.
bool App::picture_stale() const {
  const bool changed = !drawn_ || !(drawn_->view == view) || !same_picture(drawn_->settings, settings) ||
                       (settings.balls && !(drawn_->selection == selection)) ||
                       needs_truth(drawn_->settings) != needs_truth(settings) ||
                       drawn_->width != picture.width() || drawn_->height != picture.height();
  const bool linear_missing = wants_linear() && picture.linear().empty();
  return changed || scene_dirty_ || waiting_maps_ > 0 || linear_missing;
}

/// A picture that is begun is drawn to its end, however often the view changes meanwhile, so that something
/// moves; one of those for smooth edges is dropped.
void App::draw_scene() {
  if (!awaits_picture()) {
    resize_picture();
    apply_edits();
    update_light();
    if (picture_stale()) {
      begin_picture();
    } else if (!drawing_ && smooths() && picture.averaged() < smooth_pictures) {
      realtime::FrameSettings moved = frame_settings(settings);
      moved.shift = place_in_pixel(picture.averaged());
      picture.begin(*renderer_, pose_of(view), moved);
      drawing_ = Drawing{true, 0};
    }
  }
  if (drawing_) continue_picture();
  if (awaits_picture()) return;
  draw_outline();
  update_truth();
  update_readings();
}

void App::update_readings() {
  const image::Image& linear = picture.linear();
  if (!settings.histogram && !settings.false_color) return histogram.reset(), truth_histogram.reset();
  if (linear.empty()) return;
  const bool traced = needs_truth(settings) && reference.image().color;
  const float exposure = shown_tone(settings).exposure;
  const std::tuple now{pictures_, traced ? reference.image().passes : 0, exposure, settings.false_color};
  if (read_ == now) return;
  read_ = now;
  histogram = stop_histogram(linear, exposure);
  truth_histogram.reset();
  if (traced) truth_histogram = stop_histogram(*reference.image().color, exposure);
  if (settings.false_color) picture.take_false_color(false_color(linear, exposure));
  redraw();
}

void App::begin_picture() {
  const bool light_path_changed = scene_dirty_ || !drawn_ || !(drawn_->view == view) ||
                                  drawn_->width != picture.width() || drawn_->height != picture.height();
  if (light_path_changed) {
    picture.forget_truth();
    reference.clear();
    last_change_ = window.seconds();
  }
  if (!wants_linear()) picture.forget_linear();
  picture.begin(*renderer_, pose_of(view), frame_settings(settings));
  drawing_ = Drawing{false, 0};
  drawn_ = {view, settings, selection, picture.width(), picture.height()};
  scene_dirty_ = false;
}

/// As many pieces as leave time for the interface, at least one; where nobody sits there, all.
void App::continue_picture() {
  const double start = window.seconds(), patience = by_hand() ? 0.02 : 1e30;
  const bool linear = !drawing_->smooth && (wants_linear() || needs_truth(drawn_->settings));
  bool more = true;
  while ((more = picture.step(*renderer_, linear)) && window.seconds() - start < patience) {
  }
  drawing_->seconds += window.seconds() - start;
  if (!more) finish_picture(*std::exchange(drawing_, std::nullopt));
  redraw();
}

void App::finish_picture(const Drawing& done) {
  draw_balls();
  ++pictures_;
  if (done.smooth) return picture.average();
  last_stats = renderer_->stats();
  waiting_maps_ = last_stats.shadow_maps_waiting;
  times.add("frame", 1e3 * done.seconds);
  for (const realtime::PassTime& pass : last_stats.passes)
    times.add(pass.name, std::max(pass.cpu_ms, pass.gpu_ms));
  if (drawn_->settings.antialias && !needs_truth(drawn_->settings)) picture.average();
  truth_dirty_ = true;
  // Not of those that follow for the mean: a moved one may stand on the other side of a quarter.
  suits_ = suitable_exposure();
  if (follows_exposure) follow_exposure();
}

/// Into the picture that is whole now, as it was when that was begun.
void App::draw_balls() {
  const Settings& shown = drawn_->settings;
  if (!shown.balls || light.empty()) return;
  if (balls_dirty_ || balls_are_ != shown.ball) balls_->update(light.set(), shown.ball);
  balls_dirty_ = false;
  balls_are_ = shown.ball;
  const Selection& chosen = drawn_->selection;
  BallsGl::Look look;
  look.view = drawn_->view;
  look.radius = shown.ball_size > 0 ? shown.ball_size : default_ball_size(light.set());
  look.lobes = shown.lobes;
  look.tone = shown_tone(shown);
  look.selected = chosen.is(Kind::sphl) ? probe_of_sphl(*this, chosen.index) : -1;
  balls_->draw(light.set(), look, {renderer_->depth_texture(), renderer_->view_projection()},
               picture.framebuffer(), picture.width(), picture.height());
}

/// Of the frame that was drawn last.
std::optional<float> App::suitable_exposure() const {
  // Of all the light: views of its parts are compared with it.
  if (!settings.auto_exposure || settings.debug != DebugView::none) return {};
  const image::Image some = renderer_->read_some(160, 90);
  if (std::ranges::none_of(some.pixels, [](float x) { return x > 0; })) return {};
  return image::automatic_exposure(some, settings.curve);
}

bool App::show_exposure(float ev) {
  return std::exchange(settings.exposure, ev) != ev;
}

bool App::follow_exposure() {
  return suits_ && show_exposure(exposure_.follow(*suits_));
}

bool App::take_exposure() {
  return suits_ && show_exposure(exposure_.take(*suits_));
}

/// Which probes the eye sees: their names are shown, the others' are not.
void App::update_visible() {
  if (light.empty()) return visible_.clear();
  const std::vector<probes::Probe>& probes = light.set().probes;
  const bool wanted = settings.names || settings.graph || place_mode;
  if (!wanted) {
    visible_seen_.reset();
    return visible_.assign(probes.size(), 1);
  }
  if (visible_seen_ == std::pair(view, document.time)) return;
  visible_seen_ = {view, document.time};
  std::vector<rays::RayQuery> to_eye;
  for (const probes::Probe& probe : probes) to_eye.push_back({probe.position, view.eye - probe.position, 1});
  std::vector<std::uint8_t> blocked(probes.size());
  rays::PosedWorld(*picking_, document.time).occluded(to_eye, blocked);
  visible_.clear();
  for (const std::uint8_t b : blocked) visible_.push_back(b ? 0 : 1);
}

/// Ground truth starts once the picture has been still for a moment, and follows every change.
void App::update_truth() {
  if (!needs_truth(settings)) {
    if (reference.status().running) reference.stop();
    return;
  }
  const auto asked = std::make_pair(settings.against, settings.truth_depth);
  if (asked != truth_asked_) {
    picture.forget_truth();
    reference.clear();
    truth_asked_ = asked;
  }
  const bool started = reference.status().running || reference.image().passes > 0;
  if (!started) {
    redraw();
    if (window.seconds() - last_change_ < 0.25 || light_stale_) return;
    ReferenceParams params;
    params.scene = std::make_shared<const scene::Scene>(document.edited());
    params.geometry = geometry_;
    params.time = document.time;
    params.camera = pose_of(view);
    params.width = picture.width(), params.height = picture.height();
    params.method = settings.against;
    params.max_depth = settings.truth_depth;
    params.passes = settings.truth_passes;
    reference.start(params);
    return;
  }
  if (truth_dirty_ || truth_settings_ != settings) picture.update_truth(reference.image(), settings);
  truth_dirty_ = false;
  truth_settings_ = settings;
}

bool App::settled() const {
  return current() && (!scene_open() || !smooths() || picture.averaged() >= smooth_pictures);
}

bool App::current() const {
  if (!scene_open()) return job.idle();
  if (!job.idle() || light_stale_ || scene_dirty_ || waiting_maps_ > 0 || !drawn_ || awaits_picture())
    return false;
  if (!(drawn_->view == view) || !same_picture(drawn_->settings, settings) || coarse_) return false;
  return !needs_truth(settings) || (reference.image().passes >= settings.truth_passes && !truth_dirty_);
}

}  // namespace ssphh::viewer
