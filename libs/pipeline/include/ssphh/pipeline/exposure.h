#pragma once

#include <ssphh/image/tonemap.h>

namespace ssphh::pipeline {

/// image::automatic_exposure() of the picture made small: noise of few samples would count as darkness and
/// lamps.
float suitable_exposure(const image::Image& linear, image::ToneCurve curve = image::ToneCurve::clip);

}  // namespace ssphh::pipeline
