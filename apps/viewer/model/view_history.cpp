#include "view_history.h"

namespace ssphh::viewer {

void ViewHistory::note(const View& view, double seconds) {
  constexpr double moment = 0.3;
  if (view == views_.now()) return;
  if (!(view == seen_)) {
    seen_ = view;
    since_ = seconds;
  } else if (seconds - since_ >= moment) {
    keep(view);
  }
}

void ViewHistory::keep(const View& view) {
  views_.seal();
  if (!(view == views_.now())) views_.change(view, "view");
}

std::optional<View> ViewHistory::back(const View& view) {
  keep(view);
  if (!views_.undo()) return {};
  return views_.now();
}

std::optional<View> ViewHistory::forward(const View& view) {
  if (!(view == views_.now()) || !views_.redo()) return {};
  return views_.now();
}

}  // namespace ssphh::viewer
