#include <cmath>

#include <glm/gtc/quaternion.hpp>
#include <gtest/gtest.h>

#include <ssphh/image/sphere_map.h>
#include <ssphh/scene/turn_surroundings.h>

#include "error_message.h"

namespace ssphh::scene {
namespace {

TEST(TurnSurroundings, TurnsTheSunWithItsSky) {
  // A sky of one bright pixel, a sun that shines from there, and a lamp.
  Scene scene;
  scene.nodes.resize(2);
  scene.lights.resize(2);
  scene.environment.emplace().equirect = image::Image(16, 8);
  const vec3 bright = image::equirect_direction(3.5f / 16, 2.5f / 8);
  scene.lights[0].type = LightType::directional, scene.lights[0].node = 0;
  scene.nodes[0].local.rotation = glm::quatLookAt(-bright, vec3(0, 1, 0));
  scene.lights[1].node = 1;
  scene.nodes[1].local.translation = {1, 2, 3};
  const LightingState still = lighting_at(scene);
  LightingState turned = still;
  turn_surroundings(turned, scene, 0.5f);
  turn_surroundings(turned, scene, 0.2f);
  EXPECT_FLOAT_EQ(turned.environment_rotation, 0.7f);
  const float c = std::cos(0.7f), s = std::sin(0.7f);  // counter-clockwise from above: +x goes toward -z
  const vec3 wanted(c * bright.x + s * bright.z, bright.y, c * bright.z - s * bright.x);
  EXPECT_LT(glm::distance(vec3(turned.lights[0].world[2]), wanted), 1e-6f);
  EXPECT_EQ(turned.lights[1], still.lights[1]) << "what is near stays";
  turned.lights.clear();
  EXPECT_EQ(test::message_of([&] { turn_surroundings(turned, scene, 1); }),
            "lighting: it is not of this scene");
}

}  // namespace
}  // namespace ssphh::scene
