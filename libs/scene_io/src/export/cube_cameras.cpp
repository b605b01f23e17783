#include <ssphh/core/sphere.h>
#include <ssphh/scene_io/renderer_export.h>

namespace ssphh::scene_io {

std::array<scene::CameraPose, 6> cube_cameras(const vec3& position) {
  std::array<scene::CameraPose, 6> cameras;
  for (int face = 0; face < 6; ++face) {
    const vec3 ahead = cube_direction(CubePoint{face, 0.5f, 0.5f});
    const vec3 up = glm::normalize(cube_direction_unnormalized(CubePoint{face, 0.5f, 0}) - ahead);
    scene::CameraPose& pose = cameras[static_cast<std::size_t>(face)];
    pose.camera.yfov = pi / 2;
    pose.world = mat4(vec4(glm::cross(ahead, up), 0), vec4(up, 0), vec4(-ahead, 0), vec4(position, 1));
  }
  return cameras;
}

}  // namespace ssphh::scene_io
