#pragma once
/// The exposure that a photographer would choose.

#include <ssphh/image/tonemap.h>

namespace ssphh::image {

/// EV at which a scene-linear picture shows well, in steps of a quarter: the geometric mean of what is lit
/// comes to a middle grey, or up to half a stop darker where that keeps highlights from burning out, or three
/// quarters brighter where nothing is near white. A window that would burn out by more than a stop does, and
/// leaves the room as bright as it is. Pixels that are black or not finite do not count, and the
/// darkest and the brightest twentieth only as their bounds: a firefly or a lamp changes nothing. What counts
/// is how often each luminance occurs, not where, nor how many pixels there are; light times 2^k gives k
/// less. A picture without light gives 0. A curve other than clip gets the exposure at which it shows the
/// mean as bright as clip would: filmic brightens middle tones, so it gets a third to half a stop less.
/// Throws Error for an image that require_whole() refuses.
float automatic_exposure(const Image& image, ToneCurve curve = ToneCurve::clip);

}  // namespace ssphh::image
