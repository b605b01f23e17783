#pragma once
/// One of the views that stand side by side.

#include <algorithm>
#include <memory>
#include <utility>

#include "model/drag.h"
#include "model/view_history.h"
#include "model/walk.h"
#include "outline_gl.h"
#include "picture.h"
#include "screen.h"

namespace ssphh::viewer {

/// What each view has of its own: where it looks from, its picture and its place in the window. Scene, light,
/// selection and settings are the same in all.
struct Pane {
  View view;
  ViewHistory views;
  int camera = -1;  ///< chosen in the list; −1: none
  bool walking = false;
  Walker walker;
  int place = 0;   ///< as cell() counts
  Rect2 viewport;  ///< that place, pixels of the window
  Picture picture;
  Screen screen;
  std::unique_ptr<OutlineGl> outline_gl;
  bool beside = false;  ///< another view is the one at work

  static constexpr int smooth_pictures = 16;  ///< in the mean of a picture that stands still
  /// As place_in_pixel() counts, of the picture that is whole and the last in the mean.
  int last_place() const {
    return (screen.first_place + std::max(picture.averaged() - 1, 0)) % smooth_pictures;
  }
  bool drawing() const { return screen.drawing || screen.waiting_maps > 0; }
  /// Whether the picture is that of now.
  bool shows(const Settings& settings) const {
    const Screen& s = screen;
    return s.drawn && s.drawn->view == view && same_picture(s.drawn->settings, settings) && !s.scene_dirty &&
           s.waiting_maps == 0 && !s.awaits_picture() && !s.coarse;
  }
};

/// While it lives another view is drawn, or looked at, in the place of the one at work.
class PaneTurn {
 public:
  PaneTurn(Pane& at_work, Pane& other) : at_work_(at_work), other_(other) { std::swap(at_work_, other_); }
  ~PaneTurn() { std::swap(at_work_, other_); }
  PaneTurn(const PaneTurn&) = delete;
  PaneTurn& operator=(const PaneTurn&) = delete;

 private:
  Pane &at_work_, &other_;
};

}  // namespace ssphh::viewer
