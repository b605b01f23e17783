#pragma once
/// Views at which somebody stayed, to go back to.

#include <optional>

#include "history.h"
#include "view_camera.h"

namespace ssphh::viewer {

class ViewHistory {
 public:
  explicit ViewHistory(const View& first = {}) : views_(first), seen_(first) {}

  /// Keeps a view that has stayed the same for a moment. To be told every turn.
  void note(const View& view, double seconds);
  /// Keeps a view at once, before another takes its place.
  void keep(const View& view);
  /// The view before this one, which is kept; none: it is the first.
  std::optional<View> back(const View& view);
  /// The view from which back() came; none: there is none, or this is another view.
  std::optional<View> forward(const View& view);

 private:
  History<View> views_;
  View seen_;
  double since_ = 0;  ///< when `seen_` was seen first
};

}  // namespace ssphh::viewer
