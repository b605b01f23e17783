#pragma once
/// From scene-linear light to a picture.

#include <ssphh/core/enum_names.h>
#include <ssphh/image/io.h>

namespace ssphh::image {

/// How exposed light becomes display-linear light in [0, 1].
enum class ToneCurve {
  clip,    ///< min(x, 1)
  filmic,  ///< shoulder and toe: Narkowicz, "ACES Filmic Tone Mapping Curve", 2016, a rational fit of the
           ///< ACES curve: x(2.51x + 0.03)/(x(2.43x + 0.59) + 0.14); per channel, so bright colours
           ///< desaturate
};
constexpr auto enum_table(ToneCurve) {
  using enum ToneCurve;
  return std::to_array<EnumName<ToneCurve>>({{clip, "clip"}, {filmic, "filmic"}});
}

/// The exposed light that the curve shows as display-linear `shown`, 0 to below 1: its inverse.
float light_shown_as(ToneCurve curve, float shown);

struct ToneMap {
  float exposure = 0;  ///< EV: light is multiplied by 2^exposure first
  ToneCurve curve = ToneCurve::clip;
  float gamma = 0;  ///< encoding exponent of to_display: value^(1/gamma); 0 stands for the sRGB curve

  friend bool operator==(const ToneMap&, const ToneMap&) = default;
};

/// Exposure and curve. Negative values and NaN give 0.
vec3 tone_map(const vec3& color, const ToneMap& params);

/// Display-linear image in [0, 1], as write_image wants it for PNG and JPEG (which add the sRGB curve). Alpha
/// stays.
Image tone_map(const Image& image, const ToneMap& params);

/// Tone-mapped, encoded and rounded to 8 bits. Grey becomes RGB; alpha is 255 where the image has none.
Rgba8 to_display(const Image& image, const ToneMap& params);

}  // namespace ssphh::image
