#include <algorithm>
#include <cmath>

#include <ssphh/metrics/false_edges.h>
#include <ssphh/metrics/heat_map.h>

namespace ssphh::metrics {

image::Rgba8 edge_picture(const FalseEdges& edges, const image::Image& picture, float scale) {
  require(picture.width == edges.map.width && picture.height == edges.map.height, "edge picture",
          "the picture is not of the map's size");
  if (!(scale > 0)) scale = 0.2f;
  image::Image grey(picture.width, picture.height, 1);
  for (int y = 0; y < grey.height; ++y)
    for (int x = 0; x < grey.width; ++x) *grey.at(x, y) = luminance(picture.rgb(x, y));
  const float white = automatic_scale(grey);
  image::Rgba8 result{picture.width, picture.height, {}};
  for (int y = 0; y < grey.height; ++y) {
    for (int x = 0; x < grey.width; ++x) {
      const float step = *edges.map.at(x, y), level = *grey.at(x, y) / white;
      vec3 color(0.6f * std::pow(std::clamp(std::isfinite(level) ? level : 0.0f, 0.0f, 1.0f), 1 / 2.2f));
      if (std::isnan(step)) color = 0.6f * color + vec3(0, 0, 0.15f);
      if (step > 0) color = ramp_color(ColorRamp::inferno, 0.5f + 0.5f * std::min(step / scale, 1.0f));
      for (const float c : {color.x, color.y, color.z, 1.0f})
        result.rgba.push_back(static_cast<std::uint8_t>(std::lround(255 * std::clamp(c, 0.0f, 1.0f))));
    }
  }
  return result;
}

}  // namespace ssphh::metrics
