#pragma once
/// Small scenes made by hand, and cameras on them.

#include <ssphh/scene/primitives.h>
#include <ssphh/scene/scene.h>
#include <ssphh/trace/path_tracer.h>

#include "z_test.h"

namespace ssphh::test {

inline scene::Material lambertian(const vec3& albedo, const vec3& emission = vec3(0)) {
  scene::Material m;
  m.base_color = albedo;
  m.emission = emission;
  m.specular = 0;
  return m;
}

inline int add_node(scene::Scene& scene, const std::string& name, const vec3& position = vec3(0),
                    const quat& rotation = quat(1, 0, 0, 0)) {
  scene::Node node;
  node.name = name;
  node.local.translation = position;
  node.local.rotation = rotation;
  scene.nodes.push_back(node);
  return static_cast<int>(scene.nodes.size()) - 1;
}

/// Adds an instance of the mesh; returns its index.
inline int add_object(scene::Scene& scene, scene::Mesh mesh, const scene::Material& material,
                      const std::string& name = "object", int node = -1) {
  scene.materials.push_back(material);
  mesh.material = static_cast<int>(scene.materials.size()) - 1;
  scene.meshes.push_back(std::move(mesh));
  scene::Instance instance;
  instance.mesh = static_cast<int>(scene.meshes.size()) - 1;
  instance.node = node >= 0 ? node : add_node(scene, name);
  scene.instances.push_back(instance);
  return static_cast<int>(scene.instances.size()) - 1;
}

/// Rotation that turns −z, where lights and cameras look, to a direction.
inline quat looking(const vec3& direction) {
  const Frame frame = Frame::around(-glm::normalize(direction));
  return glm::quat_cast(mat3(frame.x, frame.y, frame.z));
}

inline scene::Light& add_light(scene::Scene& scene, scene::LightType type, float intensity,
                               const vec3& position, const vec3& direction = vec3(0, -1, 0),
                               const std::string& name = "lamp") {
  scene::Light light;
  light.name = name;
  light.type = type;
  light.intensity = intensity;
  light.node = add_node(scene, name, position, looking(direction));
  scene.lights.push_back(light);
  return scene.lights.back();
}

inline void add_constant_sky(scene::Scene& scene, const vec3& radiance) {
  scene::Environment sky;
  sky.color = radiance;
  scene.environment = sky;
}

/// A 200×200 m floor at y = 0, facing up.
inline void add_floor(scene::Scene& scene, const scene::Material& material) {
  add_object(scene, scene::make_quad(vec3(-100, 0, 100), vec3(200, 0, 0), vec3(0, 0, -200)), material,
             "floor");
}

/// A closed room seen from inside: [−1, 1]³.
inline void add_room(scene::Scene& scene, const scene::Material& material) {
  add_object(scene, scene::flipped(scene::make_box(vec3(-1), vec3(1))), material, "room");
}

inline mat4 look_at(const vec3& eye, const vec3& target, const vec3& up = vec3(0, 1, 0)) {
  const vec3 back = glm::normalize(eye - target);
  const vec3 right = glm::normalize(glm::cross(up, back));
  return {vec4(right, 0), vec4(glm::cross(back, right), 0), vec4(back, 0), vec4(eye, 1)};
}

/// Looks straight down with a parallel view of `size` metres, from `height` above the point.
inline trace::RenderParams view_down(const vec3& point, float size, int pixels, float height = 0.5f) {
  trace::RenderParams params;
  params.width = params.height = pixels;
  params.projection = trace::Projection::orthographic;
  params.camera.camera.orthographic = true;
  params.camera.camera.yheight = size;
  params.camera.world = look_at(point + vec3(0, height, 0), point, vec3(0, 0, -1));
  return params;
}

/// The view of one point: 1 mm in all, so that every pixel estimates the same radiance (to 1e-3 of the
/// distances).
inline trace::RenderParams view_point(const vec3& point, int spp, int max_depth, std::uint64_t seed = 1) {
  trace::RenderParams params = view_down(point, 1e-3f, 16);
  params.path = {max_depth, 1, spp, seed};
  return params;
}

inline trace::RenderState render(const scene::Scene& scene, const trace::RenderParams& params) {
  trace::RenderState state;
  trace::PathTracer(scene).render(params, state);
  return state;
}

/// All pixels of one channel as samples.
inline Samples pixels_of(const image::Image& image, int channel = 0) {
  Samples samples;
  for (int y = 0; y < image.height; ++y) {
    for (int x = 0; x < image.width; ++x) samples.add(static_cast<double>(image.at(x, y)[channel]));
  }
  return samples;
}

inline double mean_of(const image::Image& image, int channel = 0) {
  return pixels_of(image, channel).mean();
}

}  // namespace ssphh::test
