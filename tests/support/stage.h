#pragma once
/// A floor and a wall, a box and a ball before a camera, all of them of other colours, and a lamp above.

#include <ssphh/rays/transport_source.h>
#include <ssphh/scene/primitives.h>
#include <ssphh/scene/scene.h>

namespace ssphh::test {

inline const vec3 stage_lamp_place(1.5f, 2.8f, 2);
/// Down and to the left, away from the viewer.
inline const vec3 stage_lamp_axis = glm::normalize(vec3(-0.5f, -0.8f, -0.7f));
inline const vec3 stage_ball(0.8f, 0.6f, 0.2f);
inline constexpr float stage_ball_radius = 0.6f;
inline constexpr std::size_t stage_ball_material = 3;

inline scene::Material matte(const vec3& colour) {
  scene::Material material;
  material.specular = 0;
  material.base_color = colour;
  return material;
}

inline void add_mesh(scene::Scene& scene, scene::Mesh mesh, int material, const vec3& at = vec3(0)) {
  mesh.material = material;
  scene.nodes.emplace_back().local.translation = at;
  scene.meshes.push_back(std::move(mesh));
  scene::Instance& instance = scene.instances.emplace_back();
  instance.mesh = static_cast<int>(scene.meshes.size()) - 1;
  instance.node = static_cast<int>(scene.nodes.size()) - 1;
}

inline scene::Scene stage(const scene::Material& ball) {
  scene::Scene s;
  s.materials = {matte({0.7f, 0.6f, 0.25f}), matte({0.25f, 0.5f, 0.8f}), matte({0.4f, 0.7f, 0.3f}), ball};
  add_mesh(s, scene::make_quad({-3, 0, 3}, {6, 0, 0}, {0, 0, -6}), 0);
  add_mesh(s, scene::make_quad({-3, 0, -2}, {6, 0, 0}, {0, 4, 0}), 1);
  add_mesh(s, scene::make_box({-0.5f, 0, -0.5f}, {0.5f, 1, 0.5f}), 2, {-1, 0, -0.5f});
  add_mesh(s, scene::make_sphere(stage_ball_radius), static_cast<int>(stage_ball_material), stage_ball);
  scene::Node& eye = s.nodes.emplace_back();
  eye.local.translation = {0.013f, 1.507f, 5};  // no edge passes through the middle of pixels
  eye.local.rotation = glm::angleAxis(-0.15f, vec3(1, 0, 0));
  scene::Camera& camera = s.cameras.emplace_back();
  camera.name = "eye";
  camera.node = static_cast<int>(s.nodes.size()) - 1;
  return s;
}

inline void add_stage_lamp(scene::Scene& scene, scene::Light light) {
  scene::Node& node = scene.nodes.emplace_back();
  node.local.translation = stage_lamp_place;
  node.local.rotation = glm::quatLookAt(stage_lamp_axis, vec3(0, 1, 0));
  light.node = static_cast<int>(scene.nodes.size()) - 1;
  if (light.name.empty()) light.name = "lamp";
  scene.lights.push_back(light);
  scene::validate(scene);
}

inline bool on_stage_ball(const rays::SurfacePoint& p) {
  return glm::distance(p.position, stage_ball) < 1.0001f * stage_ball_radius;
}
/// Smooth on the ball: corners' normals interpolated linearly point away from its middle everywhere.
inline vec3 stage_normal(const rays::SurfacePoint& p) {
  return on_stage_ball(p) ? glm::normalize(p.position - stage_ball) : p.normal;
}

}  // namespace ssphh::test
