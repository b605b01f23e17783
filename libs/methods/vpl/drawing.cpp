#include "drawing.h"

#include <algorithm>
#include <cmath>

namespace ssphh::methods::vpl {

sketch::Sketch photons_drawing(std::span<const Vpl> lights, float size) {
  double sum = 0;
  for (const Vpl& light : lights) sum += static_cast<double>(luminance(light.power));
  const float mean = static_cast<float>(sum / static_cast<double>(std::max<std::size_t>(lights.size(), 1)));
  sketch::Sketch marks;
  for (const Vpl& light : lights) {
    const float brightest = max_component(light.power);
    if (!(brightest > 0) || !(mean > 0)) continue;
    const float radius = size * std::clamp(std::sqrt(luminance(light.power) / mean), 0.5f, 2.0f);
    const vec3 color = light.power / brightest;
    marks.balls.push_back({.center = light.position, .radius = radius, .color = color});
    marks.lines.push_back({light.position, light.position + 3 * radius * light.normal, color, 1});
  }
  return marks;
}

}  // namespace ssphh::methods::vpl
