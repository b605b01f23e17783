#include "lamp_aim.h"

#include <cmath>

#include <ssphh/scene/area_lamp.h>

namespace ssphh::viewer {
bool has_turn(const Lamp& lamp) {
  return lamp.type == scene::LightType::rectangle || !lamp.profile.empty();
}

float turn_of(const mat4& world) {
  const mat3 axes = scene::emission_axes(world);
  const Frame frame = Frame::around(axes[2]);
  return std::atan2(glm::dot(axes[0], frame.y), glm::dot(axes[0], frame.x));
}

mat4 with_turn(const mat4& world, float turn) {
  const mat4 straight = with_direction(world, light_direction(world));
  const float c = std::cos(turn), s = std::sin(turn);
  return {c * straight[0] + s * straight[1], c * straight[1] - s * straight[0], straight[2], straight[3]};
}

mat4 aimed(const Lamp& lamp, const mat4& world, const vec3& direction) {
  if (lamp.type == scene::LightType::rectangle) return scene::aimed_area_lamp(world, direction);
  const mat4 straight = with_direction(world, direction);
  return lamp.profile.empty() ? straight : with_turn(straight, turn_of(world));
}

}  // namespace ssphh::viewer
