#pragma once
/// Where a ray meets a mark.

#include <optional>

#include <ssphh/core/math.h>
#include <ssphh/sketch/draw.h>

#include "lobe_table.h"

namespace ssphh::sketch {

struct Hit {
  float distance = 0;  ///< along the ray [m]
  vec3 color{0};       ///< shaded
  bool light = false;  ///< the colour is radiance
  float slack = 0;     ///< metres that a surface may lie before it without hiding it
};

/// Of a line the rays within half its width: `pixel` is the angle between neighbouring pixels' rays [rad], or
/// their distance [m] where rays are parallel.
std::optional<Hit> hit(const Line& line, const Ray& ray, float pixel, bool parallel);
std::optional<Hit> hit(const Disc& disc, const Ray& ray);
std::optional<Hit> hit(const Box& box, const Ray& ray);
std::optional<Hit> hit(const Ball& ball, const Ray& ray);
std::optional<Hit> hit(const Lobe& lobe, const LobeTable& table, const Ray& ray);

}  // namespace ssphh::sketch
