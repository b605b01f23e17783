#include <glm/gtc/matrix_transform.hpp>

#include <ssphh/core/require.h>
#include <ssphh/scene/turn_surroundings.h>

namespace ssphh::scene {

void turn_surroundings(LightingState& state, const Scene& scene, float radians) {
  require(state.lights.size() == scene.lights.size(), "lighting", "it is not of this scene");
  state.environment_rotation += radians;
  const mat4 turn = glm::rotate(mat4(1), radians, vec3(0, 1, 0));
  for (std::size_t i = 0; i < scene.lights.size(); ++i) {
    if (scene.lights[i].type == LightType::directional) state.lights[i].world = turn * state.lights[i].world;
  }
}

}  // namespace ssphh::scene
