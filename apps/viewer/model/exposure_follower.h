#pragma once
/// The exposure of a view that moves from darkness into the sun and back.

#include <optional>

namespace ssphh::viewer {

/// Holds while what suits the picture is less than half a stop away from what did, else glides there within
/// some 30 frames. Counts frames, not seconds: the same pictures get the same exposures.
class ExposureFollower {
 public:
  /// EV of the next frame, now that one was drawn that `suits` suits. The first is taken at once.
  float follow(float suits);
  /// Without gliding.
  float take(float suits);
  /// The next one is the first.
  void forget() { shown_.reset(); }
  bool is_first() const { return !shown_; }

 private:
  std::optional<float> shown_;
  float aim_ = 0;
};

}  // namespace ssphh::viewer
