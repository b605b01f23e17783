// The picture: drawn piece by piece, and with it what lies over and beside it.

#include <algorithm>
#include <cmath>
#include <utility>

#include <fmt/format.h>
#include <imgui.h>

#include <ssphh/image/exposure.h>
#include <ssphh/rays/posed_world.h>

#include "app.h"
#include "overlay.h"

namespace ssphh::viewer {
namespace {

bool change(float& value, float now) {
  return std::exchange(value, now) != now;
}

}  // namespace

bool App::holds_slider() const {
  return by_hand() && ImGui::IsAnyItemActive() && ImGui::IsAnyMouseDown();
}

/// A software renderer takes a second for a large picture: while something moves it gets a small one, and
/// what nobody saw yet, a scene or its light, is shown small first, until its exposure is there.
void App::resize_picture() {
  constexpr float large = 2e5f;  // pixels
  const bool slides = holds_slider() && (screen.coarse || renderer_->lighting() != document.lighting());
  const bool moving = drag.changes_picture() || settings.play || path_plays || slides || light.under_way();
  const bool waits = light.empty() && job.running();  // its light will be there soon
  const bool soon = (screen.is_new || waits) && by_hand() && viewport.width * viewport.height > large;
  const bool slow = screen.drawn ? last_stats.cpu_ms > 80 : gl_->info().software;
  const bool glides = screen.drawn && !same_picture(screen.drawn->settings, settings) &&
                      same_but_for_tone(screen.drawn->settings, settings);
  if (!moving && !soon && !glides) screen.coarse = false;
  if ((moving || soon) && slow) screen.coarse = true;
  const float scale = settings.scale * (screen.coarse ? 0.4f : 1.0f);
  picture.resize(std::max(1, static_cast<int>(std::lround(viewport.width * scale))),
                 std::max(1, static_cast<int>(std::lround(viewport.height * scale))));
}

/// Whether the picture on the screen, or the one that is being drawn, is not that of now.
bool App::picture_stale() const {
  const bool changed = !screen.drawn || !(screen.drawn->view == view) ||
                       !same_picture(screen.drawn->settings, settings) ||
                       (settings.balls && !(screen.drawn->selection == selection)) ||
                       needs_truth(screen.drawn->settings) != needs_truth(settings) ||
                       screen.drawn->width != picture.width() || screen.drawn->height != picture.height();
  const bool linear_missing = wants_linear() && picture.linear().empty();
  const bool to_file = screen.linear_file && !screen.linear_file->begun;
  return changed || screen.scene_dirty || screen.waiting_maps > 0 || linear_missing || to_file;
}

/// A picture that is begun is drawn to its end, however often the view changes meanwhile, so that something
/// moves; one of those for smooth edges is dropped.
void App::draw_scene() {
  if (!screen.awaits_picture()) {
    update_light();
    resize_picture();
    apply_edits();
  }
  draw_pictures();
  if (screen.awaits_picture()) return;
  send_picture();
  draw_outline();
  update_truth();
  write_linear();
  update_readings();
  update_marks();
}

trace::SharedGeometry App::geometry_of_methods(const scene::Scene& edited) const {
  return edited.nodes.size() == document.opened->nodes.size() ? geometry_ : nullptr;
}

MarkedFor App::marks_key() const {
  return {screen.pictures, settings.draw, shown_tone(settings)};
}

bool App::marked() const {
  return draws_marks() && marks.done() && screen.marked == marks_key();
}

bool App::shows_instead() const {
  return (settings.false_color || marked()) && picture.instead_texture().width() > 0;
}

void App::update_marks() {
  if (!draws_marks()) {
    if (std::exchange(screen.marked, std::nullopt)) marks.clear();
    return;
  }
  if (picture.linear().empty() || !geometry_ || applied_.light_stale || light.under_way()) return;
  if (screen.marked == marks_key()) return;
  screen.marked = marks_key();
  MarksParams params;
  params.scene = std::make_shared<const scene::Scene>(document.edited());
  params.geometry = geometry_of_methods(*params.scene);
  params.time = document.time;
  for (const methods::Drawing what : settings.draw) {
    // What lights the window is shown as it is; other methods are made for the marks.
    if (what == methods::Drawing::hierarchy && !light.empty())
      params.own += methods::hierarchy_drawing(light.set());
    else if (what == methods::Drawing::surfels && light.live())
      params.own += methods::surfels_drawing(light.live_light()->session().network());
    else if (what == methods::Drawing::links && light.live())
      params.own += methods::links_drawing(light.live_light()->session().network());
    else
      params.what.push_back(what);
  }
  params.camera = pose_of(screen.drawn->view);
  params.picture = picture.linear();
  params.tone = shown_tone(settings);
  marks.draw(std::move(params));
}

void App::update_readings() {
  const image::Image& linear = picture.linear();
  if (!reads()) return histogram.reset(), truth_histogram.reset(), waveform.reset();
  if (linear.empty()) return;
  const bool traced = needs_truth(settings) && reference.image().color;
  const float exposure = shown_tone(settings).exposure;
  const ReadFor now{screen.pictures,
                    traced ? reference.image().passes : 0,
                    exposure,
                    settings.waveform,
                    settings.false_color,
                    settings.show,
                    settings.wipe};
  if (screen.readings == now) return;
  screen.readings = now;
  histogram = stop_histogram(linear, exposure);
  truth_histogram.reset();
  if (traced) truth_histogram = stop_histogram(*reference.image().color, exposure);
  waveform.reset();
  if (settings.waveform) {
    const bool wipes = settings.show == Show::wipe, alone = settings.show == Show::truth;
    const float line = traced && alone ? 0 : traced && wipes ? settings.wipe : 1;
    waveform = viewer::waveform(linear, exposure);
    if (line < 1) waveform = wiped(*waveform, viewer::waveform(*reference.image().color, exposure), line);
  }
  if (settings.false_color) picture.take_instead(false_color(linear, exposure));
  redraw();
}

void App::begin_picture() {
  const bool light_path_changed = screen.scene_dirty || !screen.drawn || !(screen.drawn->view == view) ||
                                  screen.drawn->width != picture.width() ||
                                  screen.drawn->height != picture.height();
  if (screen.scene_dirty && !beside) marks.forget();
  if (light_path_changed && !beside) {
    picture.forget_truth();
    reference.clear();
    last_change_ = window.seconds();
  }
  if (!wants_linear()) picture.forget_linear();
  if (screen.linear_file) screen.linear_file->begun = true, screen.linear_file->mean = {};
  screen.first_place = 0;
  begin_drawing({false, 0}, frame_settings(settings));
  screen.drawn = {view, settings, selection, picture.width(), picture.height()};
  screen.scene_dirty = screen.is_new = false;
}

/// Shows a picture that lacks no more than the exposure and curve of now with these; false: it lacks more.
bool App::show_tone_again() {
  if (!screen.drawn || screen.drawing || screen.linear_file || rendered_ != place ||
      !same_but_for_tone(screen.drawn->settings, settings))
    return false;
  const Settings before = std::exchange(screen.drawn->settings, settings);
  if (picture_stale()) {
    screen.drawn->settings = before;
    return false;
  }
  screen.first_place = last_place();
  picture.show_again(*renderer_, shown_tone(settings));
  if (!settings.auto_exposure || !screen.suits) screen.suits = suitable_exposure();
  show_finished();
  redraw();
  return true;
}

/// As many pieces as leave time for the interface, at least one; where nobody sits there, all.
void App::continue_picture() {
  const double start = window.seconds(), patience = by_hand() ? 0.02 : 1e30;
  const bool linear = !screen.drawing->smooth && (wants_linear() || needs_truth(screen.drawn->settings));
  bool more = true;
  while ((more = picture.step(*renderer_, linear)) && window.seconds() - start < patience) {
  }
  screen.drawing->seconds += window.seconds() - start;
  if (!more) finish_picture(*std::exchange(screen.drawing, std::nullopt));
  redraw();
}

void App::finish_picture(const Drawing& done) {
  if (screen.linear_file && screen.linear_file->begun) screen.linear_file->mean.add(renderer_->read_back());
  if (done.smooth) {
    draw_balls();
    ++screen.pictures;
    return picture.average();
  }
  screen.waiting_maps = renderer_->stats().shadow_maps_waiting;
  if (!beside) {
    last_stats = renderer_->stats();
    times.add("frame", 1e3 * done.seconds);
    for (const realtime::PassTime& pass : last_stats.passes)
      times.add(pass.name, std::max(pass.cpu_ms, pass.gpu_ms));
    // Not of those that follow for the mean: a moved one may stand on the other side of a quarter.
    screen.suits = suitable_exposure();
    // Drawn before anybody knew what suits it, a scene's first picture is shown as suits it
    if (follows_exposure && exposure_.is_first() && follow_exposure()) {
      renderer_->show_again(shown_tone(settings));
      screen.drawn->settings.exposure = settings.exposure;
    }
  }
  show_finished();
}

/// The picture that is whole in the framebuffer, the first of its mean.
void App::show_finished() {
  draw_balls();
  ++screen.pictures;
  if (screen.drawn->settings.antialias && !needs_truth(screen.drawn->settings)) picture.average();
  if (beside) return;
  screen.truth_dirty = true;
  if (follows_exposure) follow_exposure();
}

/// Into the picture that is whole now, as it was when that was begun.
void App::draw_balls() {
  const Settings& shown = screen.drawn->settings;
  if (!shown.balls || light.empty()) return;
  if (screen.balls_dirty || screen.balls != shown.ball) balls_->update(light.set(), shown.ball);
  screen.balls_dirty = false;
  screen.balls = shown.ball;
  const Selection& chosen = screen.drawn->selection;
  BallsGl::Look look;
  look.view = screen.drawn->view;
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

bool App::follow_exposure() {
  return screen.suits && change(settings.exposure, exposure_.follow(*screen.suits));
}

bool App::take_exposure() {
  return screen.suits && change(settings.exposure, exposure_.take(*screen.suits));
}

void App::show_elsewhere() {
  if (!elsewhere) throw Error("picture", "there is no program that shows it elsewhere");
  screen.to_send = true;
  send_truth();
  say(fmt::format("showing {} in tev", picture_name()));
}

void App::send_picture() {
  if (!screen.to_send || picture.linear().empty()) return;
  screen.to_send = false;
  elsewhere.send(picture_name(), std::make_shared<const image::Image>(picture.linear()));
}

void App::send_truth() {
  if (elsewhere && reference.image().color)
    elsewhere.send(picture_name() + " " + settings.against, reference.image().color);
}

/// Which probes the eye sees: their names are shown, the others' are not.
void App::update_visible() {
  if (light.empty()) return screen.visible.clear();
  const std::vector<probes::Probe>& probes = light.set().probes;
  const bool wanted = settings.names || settings.graph || place_mode;
  if (!wanted) {
    screen.visible_from.reset();
    return screen.visible.assign(probes.size(), 1);
  }
  if (screen.visible_from == std::pair(view, document.time)) return;
  screen.visible_from = {view, document.time};
  std::vector<rays::RayQuery> to_eye;
  for (const probes::Probe& probe : probes) to_eye.push_back({probe.position, view.eye - probe.position, 1});
  std::vector<std::uint8_t> blocked(probes.size());
  rays::PosedWorld(*picking_, document.time).occluded(to_eye, blocked);
  screen.visible.clear();
  for (const std::uint8_t b : blocked) screen.visible.push_back(b ? 0 : 1);
}

/// Ground truth starts once the picture has been still for a moment, and follows every change.
void App::update_truth() {
  if (!needs_truth(settings)) {
    if (reference.status().running) reference.stop();
    return;
  }
  const auto asked = std::make_pair(settings.against, settings.truth_depth);
  if (asked != screen.truth_asked) {
    picture.forget_truth();
    reference.clear();
    screen.truth_asked = asked;
  }
  const bool started = reference.status().running || reference.image().passes > 0;
  if (!started) {
    redraw();
    if (window.seconds() - last_change_ < 0.25 || applied_.light_stale) return;
    ReferenceParams params;
    params.scene = std::make_shared<const scene::Scene>(document.edited());
    params.geometry = settings.against == "path" ? geometry_ : geometry_of_methods(*params.scene);
    params.time = document.time;
    params.camera = pose_of(view);
    params.width = picture.width(), params.height = picture.height();
    params.method = settings.against;
    params.max_depth = settings.truth_depth;
    params.passes = settings.truth_passes;
    reference.start(params);
    return;
  }
  if (screen.truth_dirty || screen.truth_settings != settings)
    picture.update_truth(reference.image(), settings);
  screen.truth_dirty = false;
  screen.truth_settings = settings;
}

}  // namespace ssphh::viewer
