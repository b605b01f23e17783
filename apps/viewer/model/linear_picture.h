#pragma once
/// The picture in the window as linear light, for a file.

#include <optional>

#include "reference.h"
#include "settings.h"

namespace ssphh::viewer {

/// The mean of pictures of one size.
class LinearMean {
 public:
  void add(const image::Image& picture);
  int count() const { return count_; }
  /// Of all, at least one.
  image::Image mean() const;

 private:
  image::Image sum_;
  int count_ = 0;
};

/// What the settings show of a real-time picture and a truth, as linear radiance: one of them, both beside
/// each other, or their difference. None where the truth that it takes is not there yet in that size.
std::optional<image::Image> linear_shown(const Settings& settings, const image::Image& realtime,
                                         const ReferenceImage& truth);

}  // namespace ssphh::viewer
