#pragma once
/// Square pictures from straight above, of which every pixel's place is known.

#include <random>

#include <ssphh/probes/lookup.h>
#include <ssphh/realtime/renderer.h>
#include <ssphh/scene/probe_place.h>

#include "gl_context.h"

namespace ssphh::realtime {

inline const probes::SeesProbe everything_sees = [](const vec3&, const vec3&) { return true; };

/// Indirect light alone, seen along −z of `frame` at right angles.
struct StraightView {
  Frame frame;
  float extent = 1;  ///< metres across
  int side = 24;     ///< pixels

  /// In the frame's x and y, of a pixel's middle.
  vec2 place(int x, int y) const {
    const auto n = static_cast<float>(side);
    return (vec2(x, side - 1 - y) + 0.5f) * (extent / n) - 0.5f * extent;
  }
  image::Image draw(Renderer& renderer, FrameSettings settings = {}) const {
    scene::CameraPose camera;
    camera.world = mat4(vec4(frame.x, 0), vec4(frame.y, 0), vec4(frame.z, 0), vec4(4.0f * frame.z, 1));
    camera.camera.orthographic = true;
    camera.camera.yheight = extent;
    settings.view = View::indirect;
    renderer.draw(camera, settings, {.width = side, .height = side});
    return renderer.read_back();
  }
};

/// Probes with light of degree 4, positive and different in every direction and colour.
class MadeUpProbes {
 public:
  MadeUpProbes() {
    set.degree = 4;
    set.light_groups = {{"made up", vec3(1)}};
  }
  void add(const vec3& position, const vec3& scale = vec3(1)) {
    std::uniform_real_distribution<float> mean(2, 4), rest(-0.3f, 0.3f);
    probes::Probe probe;
    probe.position = position;
    probes::GroupLight light{sh::RadianceSh(4), sh::RadianceSh(4)};
    for (int k = 0; k < 25; ++k)
      for (int c = 0; c < 3; ++c) light.reflected[k][c] = scale[c] * (k == 0 ? mean(random_) : rest(random_));
    probe.groups.push_back(light);
    set.probes.push_back(probe);
    probes::merge_groups(set);
  }
  std::vector<vec3> positions() const { return scene::positions_of(set.probes); }

  probes::ProbeSet set;

 private:
  std::mt19937 random_{5};
};

/// Of pictures: the largest difference of a pixel and the brightest expected, by channel.
struct Worst {
  vec3 difference{0}, brightest{0};

  void take(const vec3& drawn, const vec3& expected) {
    difference = glm::max(difference, glm::abs(drawn - expected));
    brightest = glm::max(brightest, expected);
  }
  vec3 share() const { return difference / brightest; }
};

/// One body of diffuse colours that differ by channel.
inline scene::Scene coloured(scene::Mesh mesh) {
  scene::Scene scene;
  scene.nodes.emplace_back();
  scene.materials.emplace_back();
  scene.materials[0].base_color = vec3(0.8f, 0.5f, 0.3f);
  scene.materials[0].specular = 0;
  mesh.material = 0;
  scene.meshes.push_back(std::move(mesh));
  scene.instances = {{0, 0, -1, ""}};
  return scene;
}
inline vec3 reflected(const vec3& irradiance) {
  return vec3(0.8f, 0.5f, 0.3f) / pi * irradiance;
}

}  // namespace ssphh::realtime
