#pragma once
/// One of everything that the real-time renderer draws: every kind of lamp, of reflection, of texture and of
/// cover, in an asymmetric place, each lamp in a light group of its own.

#include "stage.h"

namespace ssphh::test {

/// Texels that are all different.
inline scene::Texture busy_texture(const char* name, int width, int height, int least, int step) {
  scene::Texture texture;
  texture.name = name, texture.width = width, texture.height = height;
  for (int i = 0; i < 4 * width * height; ++i)
    texture.rgba.push_back(static_cast<std::uint8_t>(least + i * step % (256 - least)));
  return texture;
}

inline void add_busy_lamp(scene::Scene& s, const char* name, scene::LightType type, const vec3& at,
                          const vec3& goes, const vec3& color, float intensity) {
  scene::Node& node = s.nodes.emplace_back();
  node.local.translation = at;
  node.local.rotation = glm::quatLookAt(glm::normalize(goes), vec3(0.1f, 1, 0.2f));
  scene::Light& light = s.lights.emplace_back();
  light.name = name, light.type = type, light.color = color, light.intensity = intensity;
  light.node = static_cast<int>(s.nodes.size()) - 1;
}

inline void add_busy_lamps(scene::Scene& s) {
  using enum scene::LightType;
  add_busy_lamp(s, "point", point, {1.5f, 2.8f, 2}, {0, -1, 0.1f}, {1, 0.6f, 0.3f}, 9);
  add_busy_lamp(s, "spot", spot, {-1.3f, 2.6f, 2.4f}, {0.3f, -0.8f, -0.9f}, {0.3f, 1, 0.5f}, 14);
  s.lights.back().inner_cone = 0.3f, s.lights.back().outer_cone = 0.6f, s.lights.back().range = 7;
  add_busy_lamp(s, "sun", directional, vec3(0), {-0.5f, -0.8f, -0.7f}, {0.4f, 0.6f, 1}, 3);
  add_busy_lamp(s, "disc", directional, vec3(0), {0.6f, -0.9f, -0.4f}, {1, 0.9f, 0.5f}, 2.5f);
  s.lights.back().angular_radius = 0.03f;
  add_busy_lamp(s, "wide disc", directional, vec3(0), {0.1f, -0.9f, -0.6f}, {0.9f, 0.4f, 0.7f}, 2);
  s.lights.back().angular_radius = 0.09f;
  add_busy_lamp(s, "ball", sphere, {-0.4f, 2.3f, 0.9f}, {0, -1, 0}, {0.7f, 0.5f, 1}, 6);
  s.lights.back().radius = 0.25f;
  s.environment.emplace().equirect = image::Image(16, 8, 3);
  for (int y = 0; y < 8; ++y) {
    for (int x = 0; x < 16; ++x) {
      const vec2 u(static_cast<float>(x) / 16, static_cast<float>(y) / 8);
      s.environment->equirect.set_rgb(x, y,
                                      {0.2f + u.x, 1.1f - u.y, x == 5 && y == 2 ? 9 : 0.4f + u.x * u.y});
    }
  }
  s.environment->color = {0.5f, 0.7f, 0.9f}, s.environment->rotation = 0.7f;
}

inline void add_busy_materials(scene::Scene& s) {
  s.textures = {busy_texture("colour", 5, 3, 70, 37), busy_texture("rough", 3, 4, 90, 53),
                busy_texture("emission", 4, 3, 40, 29), busy_texture("normal", 3, 3, 110, 17)};
  for (std::size_t i = 2; i < s.textures[3].rgba.size(); i += 4) s.textures[3].rgba[i] = 240;
  scene::Material& wall = s.materials[1];  // GGX over Disney's diffuse, textured and bumpy
  wall.metallic = 0.7f, wall.specular = 0.8f, wall.ior = 1.8f, wall.specular_roughness = 0.7f;
  wall.diffuse_roughness = 0.6f, wall.normal_scale = 0.8f;
  wall.base_color_texture = {.texture = 0, .offset = {0.1f, -0.2f}, .scale = {2, 1.4f}, .rotation = 0.4f};
  wall.metallic_roughness_texture = {.texture = 1, .scale = {1.7f, 2.1f}};
  wall.normal_texture = {.texture = 3, .scale = {1.5f, 1.1f}, .rotation = -0.3f};
  scene::Material& ball = s.materials[stage_ball_material];  // Blinn-Phong over Oren-Nayar
  ball.specular = 1, ball.ior = 1.7f, ball.specular_roughness = -0.45f, ball.diffuse_roughness = -0.7f;
  for (const char* name : {"panel", "screen", "leaf", "veil", "sign", "tin"})
    s.materials.emplace_back(matte({0.7f, 0.5f, 0.4f})).name = name;
  s.materials[4].emission = {7, 5, 3};
  s.materials[5].emission = {3, 4, 6}, s.materials[5].double_sided = true;
  s.materials[5].emission_texture = {.texture = 2, .scale = {0.8f, 0.9f}};
  s.materials[6].alpha_mode = scene::AlphaMode::mask, s.materials[6].alpha_cutoff = 0.6f;
  s.materials[6].base_color_texture = {.texture = 0, .nearest = true};
  s.materials[7].alpha_mode = scene::AlphaMode::blend, s.materials[7].alpha = 0.6f;
  s.materials[8].unlit = true, s.materials[8].base_color = {0.2f, 0.6f, 0.9f};
  s.materials[9].metallic = 1, s.materials[9].specular = 1, s.materials[9].specular_roughness = 0.25f;
}

inline scene::Scene busy_scene() {
  scene::Scene s = stage(matte({0.9f, 0.5f, 0.3f}));
  add_busy_materials(s);
  add_mesh(s, scene::make_quad({-0.3f, 0, -0.2f}, {0.6f, 0, 0}, {0, 0, 0.5f}), 4, {0.4f, 2.9f, -0.6f});
  add_mesh(s, scene::make_quad({-0.4f, -0.3f, 0}, {0.8f, 0, 0.3f}, {0, 0.6f, 0.1f}), 5, {-1.7f, 1.7f, -0.9f});
  add_mesh(s, scene::make_quad({-0.5f, 0, -0.5f}, {1, 0, 0}, {0, 0.2f, 1}), 6, {0.6f, 1.5f, 1.1f});
  add_mesh(s, scene::make_quad({-0.4f, -0.5f, 0}, {0.8f, 0, 0.2f}, {0, 1, 0}), 7, {-0.2f, 0.7f, 1.4f});
  add_mesh(s, scene::make_quad({-0.3f, -0.2f, 0}, {0.6f, 0.1f, 0}, {0, 0.4f, 0}), 8, {1.7f, 1.6f, -1.2f});
  add_mesh(s, scene::make_box({-0.25f, 0, -0.2f}, {0.25f, 0.45f, 0.2f}), 9, {0.1f, 0, 1.9f});
  s.nodes.back().movable = true;
  scene::AnimationChannel slides;
  slides.node = static_cast<int>(s.nodes.size()) - 1;
  slides.times = {0, 1}, slides.values = {vec4(0.1f, 0, 1.9f, 0), vec4(0.5f, 0.1f, 1.6f, 0)};
  s.animations.push_back({"slides", {slides}});
  s.nodes[2].local.rotation = glm::angleAxis(0.5f, vec3(0, 1, 0));
  s.nodes[2].local.scale = {1, 0.9f, -1.2f};  // mirrors
  s.instances[4].light_group = "panel", s.instances[5].light_group = "screen";
  add_busy_lamps(s);
  scene::validate(s);
  return s;
}

/// Five that stand about the busy scene, some of which hide each other's view.
inline std::vector<vec3> busy_places() {
  return {{-2, 0.8f, 1}, {2.1f, 1.1f, 0.4f}, {0.2f, 1.7f, 0.3f}, {-0.3f, 0.5f, -1.4f}, {1.2f, 2.4f, 2.2f}};
}

}  // namespace ssphh::test
