// Several views side by side: which there are, which one is at work, and how their pictures take turns.

#include <algorithm>

#include "app.h"
#include "model/view_layout.h"
#include "overlay.h"
#include "panels/panels.h"

namespace ssphh::viewer {

void App::arrange_views() {
  const int count = scene_open() ? settings.views : 1;
  const int before = static_cast<int>(others.size()) + 1;
  if (before > count) {
    // The last places go; who is left moves up.
    std::ranges::sort(others, {}, &Pane::place);
    others.resize(static_cast<std::size_t>(count) - 1);
    place = std::min(place, count - 1), rendered_ = -1;
    int next = 0;
    for (Pane& other : others) {
      if (next == place) ++next;
      other.place = next++;
    }
  }
  while (static_cast<int>(others.size()) + 1 < count) {
    Pane pane;
    pane.beside = true;
    const auto taken = [&](int at) {
      return at == place || std::ranges::any_of(others, [at](const Pane& p) { return p.place == at; });
    };
    while (taken(pane.place)) ++pane.place;
    pane.view = section(view, first_direction(pane.place), document.bounds,
                        cell(area, pane.place, count).aspect(), rays::PosedWorld(*picking_, document.time));
    pane.views = ViewHistory(pane.view);
    pane.walker = walker;
    others.push_back(std::move(pane));
    redraw();
  }
  viewport = cell(area, place, count);
  for (Pane& other : others) other.viewport = cell(area, other.place, count);
}

void App::take_view_at(float x, float y) {
  if (frames) return;  // they are of the view at work
  const auto under = std::ranges::find_if(others, [&](const Pane& p) { return p.viewport.contains(x, y); });
  if (under == others.end()) return;
  std::swap<Pane>(*this, *under);
  std::swap(beside, under->beside);
  // Truth, marks and readings are of the view at work: they begin with its next picture.
  under->screen.forget_beside(), screen.forget_beside();
  screen.drawn.reset();
  pinned.reset(), inspection.reset();
  path_plays = false;
  redraw();
}

void App::draw_pictures() {
  for (Pane& other : others) {
    if (screen.scene_dirty) other.screen.scene_dirty = true;
    if (screen.balls_dirty) other.screen.balls_dirty = true;
  }
  for (const bool smooth : {false, true}) {
    bool at_work = work_on_picture(smooth);
    for (Pane& other : others) {
      if (at_work) break;
      const PaneTurn turn(*this, other);
      if (!smooth) resize_picture();
      at_work = work_on_picture(smooth);
      if (!screen.awaits_picture()) draw_outline();
    }
    if (at_work) return;
  }
}

bool App::work_on_picture(bool smooth) {
  if (!smooth && !screen.awaits_picture() && picture_stale()) {
    if (show_tone_again()) return true;
    begin_picture();
  }
  const bool unsmooth = smooths() && !screen.coarse && picture.averaged() < smooth_pictures;
  if (smooth && !screen.drawing && unsmooth) {
    realtime::FrameSettings moved = frame_settings(settings);
    moved.shift = place_in_pixel((last_place() + 1) % smooth_pictures);
    begin_drawing({true, 0}, moved);
  }
  if (!screen.drawing || screen.drawing->smooth != smooth) return false;
  continue_picture();
  return true;
}

void App::begin_drawing(const Drawing& drawing, const realtime::FrameSettings& how) {
  for (Pane& other : others) other.screen.drop_drawing();
  picture.begin(*renderer_, pose_of(view), how, drawing.smooth);
  screen.drawing = drawing;
  rendered_ = place;
}

void App::draw_views() {
  for (Pane& other : others) {
    const PaneTurn turn(*this, other);
    update_visible();
    draw_picture(*this);
    draw_overlay(*this, screen.visible);
  }
  update_visible();
  draw_picture(*this);
  draw_overlay(*this, screen.visible);
}

}  // namespace ssphh::viewer
