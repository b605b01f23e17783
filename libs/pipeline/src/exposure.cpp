#include <algorithm>

#include <ssphh/image/exposure.h>
#include <ssphh/image/resample.h>
#include <ssphh/pipeline/exposure.h>

namespace ssphh::pipeline {

float suitable_exposure(const image::Image& linear, image::ToneCurve curve) {
  constexpr int enough = 160;  // pixels
  const int shrink = std::max(1, std::max(linear.width, linear.height) / enough);
  if (shrink == 1) return image::automatic_exposure(linear, curve);
  return image::automatic_exposure(
      image::resize(linear, std::max(1, linear.width / shrink), std::max(1, linear.height / shrink)), curve);
}

}  // namespace ssphh::pipeline
