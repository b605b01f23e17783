#include <cmath>

#include <ssphh/image/tonemap.h>
#include <ssphh/image/transfer.h>

namespace ssphh::image {
namespace {

float apply(ToneCurve curve, float x) {
  if (!(x > 0)) return 0;  // also NaN
  if (curve == ToneCurve::filmic) {
    if (x > 1e4f) return 1;  // the limit 2.51/2.43 is over 1; avoids inf/inf
    x = (x * (2.51f * x + 0.03f)) / (x * (2.43f * x + 0.59f) + 0.14f);
  }
  return x < 1 ? x : 1;
}

std::uint8_t encode(float x, float gamma) {
  return gamma > 0 ? unit_to_8bit(std::pow(x, 1 / gamma)) : linear_to_srgb8(x);
}

}  // namespace

float light_shown_as(ToneCurve curve, float shown) {
  if (curve == ToneCurve::clip) return shown;
  // y (2.43 x² + 0.59 x + 0.14) = 2.51 x² + 0.03 x
  const double y = static_cast<double>(shown);
  const double a = 2.51 - 2.43 * y, b = 0.59 * y - 0.03, c = 0.14 * y;
  return static_cast<float>((b + std::sqrt(b * b + 4 * a * c)) / (2 * a));
}

vec3 tone_map(const vec3& color, const ToneMap& params) {
  const vec3 exposed = std::exp2(params.exposure) * color;
  return {apply(params.curve, exposed.x), apply(params.curve, exposed.y), apply(params.curve, exposed.z)};
}

Image tone_map(const Image& image, const ToneMap& params) {
  require_whole(image, "tone mapping");
  Image out(image.width, image.height, image.channels);
  const auto channels = static_cast<std::size_t>(image.channels);
  const float scale = std::exp2(params.exposure);
  for (std::size_t i = 0; i < out.pixels.size(); ++i) {
    const bool alpha = channels == 4 && i % 4 == 3;
    out.pixels[i] = alpha ? image.pixels[i] : apply(params.curve, scale * image.pixels[i]);
  }
  return out;
}

Rgba8 to_display(const Image& image, const ToneMap& params) {
  require_whole(image, "tone mapping");
  Rgba8 out{image.width, image.height, {}};
  out.rgba.reserve(std::size_t{4} * static_cast<std::size_t>(image.width) *
                   static_cast<std::size_t>(image.height));
  for (int y = 0; y < image.height; ++y) {
    for (int x = 0; x < image.width; ++x) {
      const vec3 color = tone_map(image.rgb(x, y), params);
      for (int c = 0; c < 3; ++c) out.rgba.push_back(encode(color[c], params.gamma));
      out.rgba.push_back(image.channels == 4 ? unit_to_8bit(image.at(x, y)[3]) : std::uint8_t{255});
    }
  }
  return out;
}

}  // namespace ssphh::image
