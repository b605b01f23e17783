#pragma once
/// Rooms of random furniture and lamps, for properties of whole renders.

#include <ssphh/core/random.h>

#include "hand_made.h"

namespace ssphh::test {

class RoomDraw {
 public:
  explicit RoomDraw(std::uint64_t seed) : random_(seed) {}

  float number(float low, float high) { return low + (high - low) * random_.uniform(); }
  vec3 triple(float low, float high) { return low + (high - low) * random_.uniform3(); }
  vec3 direction() { return sample_uniform_sphere(random_.uniform2()); }
  scene::Material matte() { return lambertian(triple(0.1f, 0.8f)); }
  scene::Material any_material() {
    scene::Material m;
    m.base_color = triple(0, 1);
    m.metallic = number(0, 1);
    m.diffuse_roughness = number(-1, 1);
    m.specular_roughness = number(0.15f, 1) * (random_.next() % 2 ? 1.0f : -1.0f);
    m.specular = number(0, 1);
    m.ior = number(1.1f, 2);
    return m;
  }
  /// A box or a ball of about half a metre, near the middle.
  scene::Mesh body() {
    const vec3 place = triple(-0.3f, 0.3f);
    const mat4 pose =
        glm::translate(mat4(1), place) * glm::mat4_cast(glm::angleAxis(number(0, 3), direction()));
    return scene::transformed(random_.next() % 2 ? scene::make_sphere(number(0.2f, 0.4f), 12, 6)
                                                 : scene::make_box(-triple(0.1f, 0.4f), triple(0.1f, 0.4f)),
                              pose);
  }

 private:
  Pcg32 random_;
};

/// [−1, 1]³ with a body in it, a window to the sky, and one lamp of each type.
inline scene::Scene random_room(std::uint64_t seed) {
  RoomDraw draw(seed);
  scene::Scene scene;
  add_room(scene, draw.matte());
  scene.meshes[0].triangles.resize(10);  // a wall is missing
  add_object(scene, draw.body(), draw.any_material(), "body");
  add_object(scene, scene::make_quad(vec3(-0.3f, 0.9f, -0.3f), vec3(0.6f, 0, 0), vec3(0, 0, 0.6f)),
             lambertian(draw.triple(0, 0.5f), draw.triple(1, 4)), "panel");
  const auto lamp = [&](scene::LightType type, float intensity, const char* name) -> scene::Light& {
    scene::Light& light = add_light(scene, type, intensity, draw.triple(-0.8f, 0.8f), draw.direction(), name);
    light.color = draw.triple(0.3f, 1);
    return light;
  };
  lamp(scene::LightType::point, 0.7f, "bulb").range = 5;
  lamp(scene::LightType::spot, 1.1f, "spot").inner_cone = 0.3f;
  lamp(scene::LightType::directional, 0.4f, "sun").angular_radius = draw.number(0, 0.1f);
  lamp(scene::LightType::sphere, 2, "globe").radius = 0.1f;
  add_constant_sky(scene, draw.triple(0.1f, 0.5f));
  return scene;
}

inline trace::RenderParams view_of_room(int size, int spp, int max_depth, std::uint64_t seed) {
  trace::RenderParams params;
  params.width = size + size / 2, params.height = size;
  params.camera.world = look_at(vec3(0.75f, 0.3f, 0.85f), vec3(-0.1f, -0.05f, 0));
  params.camera.camera.yfov = 1.4f;
  params.path = {max_depth, 1, spp, seed};
  return params;
}

}  // namespace ssphh::test
