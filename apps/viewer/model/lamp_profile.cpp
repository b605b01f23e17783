#include "lamp_profile.h"

#include <cmath>

#include <fmt/format.h>

#include <ssphh/core/error.h>

namespace ssphh::viewer {

void set_profile(LightEdit& light, const scene::LampProfile& profile, const mat4& world) {
  Lamp& lamp = light.lamp;
  if (lamp.type != scene::LightType::point && lamp.type != scene::LightType::spot)
    throw Error(lamp.name, fmt::format("a {} lamp has no photometric profile", name_of(lamp.type)),
                "point and spot lamps may have one");
  if (!has_direction(lamp.type, lamp.profile) && !profile.empty())
    light.world = with_direction(world, {0, -1, 0});
  lamp.profile = profile;
}

std::vector<vec3> profile_curve(const scene::LampProfile& profile, float turn) {
  constexpr int steps = 180;
  const scene::PhotometricTable& table = *profile.table;
  const mat3 axes = scene::photometric_axes(table.type);
  const float scale = 1 / scene::greatest_candela(table);
  const vec3 aside(std::cos(turn), std::sin(turn), 0);
  std::vector<vec3> curve;
  for (int i = 0; i <= steps; ++i) {
    const float angle = pi * (2 * static_cast<float>(i) / steps - 1);
    const vec3 direction = std::sin(angle) * aside - std::cos(angle) * vec3(0, 0, 1);
    curve.push_back(scale * scene::eval_candela(table, direction * axes) * direction);
  }
  return curve;
}

}  // namespace ssphh::viewer
