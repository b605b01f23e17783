#include "results/moving_camera.h"

#include <cmath>

#include <glm/gtc/matrix_transform.hpp>
#include <glm/gtc/quaternion.hpp>

namespace ssphh::app {

scene::CameraPose turned(scene::CameraPose pose, float share) {
  const mat4 turn(glm::mat3_cast(glm::angleAxis(2 * pi * share, vec3(0, 1, 0))));
  const vec4 position = pose.world[3];
  pose.world[3] = vec4(0, 0, 0, 1);
  pose.world = turn * pose.world;
  pose.world[3] = position;
  return pose;
}

scene::CameraPose orbit(const scene::Bounds& box, float yfov, float aspect, float elevation, float turn) {
  scene::CameraPose pose;
  pose.camera.yfov = yfov;
  const float narrow = std::atan(std::tan(0.5f * yfov) * glm::min(aspect, 1.0f));
  const float distance = 1.05f * glm::max(box.radius(), 1e-3f) / std::sin(narrow);
  const vec3 away(std::cos(elevation) * std::sin(turn), std::sin(elevation),
                  std::cos(elevation) * std::cos(turn));
  pose.world = glm::translate(mat4(1), box.center() + distance * away) *
               mat4(glm::mat3_cast(glm::quatLookAt(-away, vec3(0, 1, 0))));
  return pose;
}

float forth_and_back(int frame) {
  return 0.5f - 0.5f * std::cos(2 * pi * static_cast<float>(frame % 100) / 100);
}

}  // namespace ssphh::app
