#pragma once
/// Glass before a wall that glows, drawn by OpenGL.

#include <cmath>

#include <ssphh/shading/surface.h>

#include "gl_context.h"
#include "pictures.h"
#include "stage.h"

namespace ssphh::test {

inline constexpr PictureSize glass_size{48, 32};
inline const vec3 glow(0.8f, 0.5f, 0.2f), sky(0.6f, 0.9f, 1.2f);

inline scene::Material pane(const vec3& tint) {
  scene::Material m;
  m.base_color = tint, m.specular_roughness = 0, m.transmission = 1;
  return m;
}

/// A wall that glows and lights nothing, all across the picture under an even sky, and before it whatever
/// `glass` says.
inline scene::Scene before_a_wall(const std::vector<scene::Material>& glass) {
  scene::Scene s;
  scene::Material wall = matte(glow);
  wall.unlit = true;
  s.materials = {wall};
  add_mesh(s, scene::make_quad({-20, -20, -9}, {40, 0, 0}, {0, 40, 0}), 0);
  for (std::size_t i = 0; i < glass.size(); ++i) {
    s.materials.push_back(glass[i]);
    add_mesh(s, scene::make_quad({-9, -9, -3 - 0.5f * static_cast<float>(i)}, {18, 0, 0}, {0, 18, 0}),
             static_cast<int>(i) + 1);
  }
  s.nodes.emplace_back();
  s.cameras.emplace_back().node = static_cast<int>(s.nodes.size()) - 1;
  s.cameras[0].yfov = 1.8f;  // also at a slant
  s.environment.emplace().color = sky;
  scene::validate(s);
  return s;
}

/// Path traced up to so many scattering events.
inline image::Image traced(const scene::Scene& scene, int max_depth, int spp = 64) {
  trace::RenderParams params;
  params.width = glass_size.width, params.height = glass_size.height;
  params.camera = scene::camera_pose(scene, "");
  params.path = {.max_depth = max_depth, .passes = 1, .spp = spp, .seed = 1};
  trace::RenderState state;
  trace::PathTracer(scene).render(params, state);
  return trace::resolve(state.color, 1);
}

inline vec3 sum_of(const image::Image& image) {
  vec3 sum(0);
  for (int y = 0; y < image.height; ++y)
    for (int x = 0; x < image.width; ++x) sum += image.rgb(x, y);
  return sum;
}

/// Mean difference from the truth, of its mean.
inline double off(const image::Image& picture, const image::Image& truth) {
  double sum = 0, all = 0;
  for (std::size_t i = 0; i < truth.pixels.size(); ++i) {
    sum += static_cast<double>(std::abs(picture.pixels[i] - truth.pixels[i]));
    all += static_cast<double>(truth.pixels[i]);
  }
  return sum / all;
}

class GlassPixels : public WithGl {
 protected:
  image::Image draw(const scene::Scene& scene, int supersample = 1) {
    realtime::Renderer renderer(
        gl(), scene,
        {.light_map_size = 128, .area_map_size = 128, .sun_map_size = 128, .environment_map_size = 128});
    renderer.draw(scene::camera_pose(scene, ""), {.supersample = supersample},
                  {.width = glass_size.width, .height = glass_size.height});
    return renderer.read_back();
  }
};

}  // namespace ssphh::test
