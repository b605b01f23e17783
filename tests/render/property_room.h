#pragma once
/// A small room with everything that a relight session can change, for properties of transport.

#include <algorithm>

#include "transport_fixtures.h"

namespace ssphh::test {

/// [−1, 1]³ without its front wall: albedos by chance, a glowing panel ("panel"), two lamps ("bulb", "spot"),
/// a sky, a glowing leaf that turns within two seconds ("leaf"), and two SPHLs.
inline scene::Scene swinging_room(std::uint64_t seed) {
  Pcg32 random(seed);
  const auto albedo = [&] { return 0.1f + 0.7f * random.uniform3(); };
  scene::Scene scene;
  scene::Mesh walls = scene::flipped(scene::make_box(vec3(-1), vec3(1)));
  std::erase_if(walls.triangles, [&](const uvec3& t) {
    return walls.positions[t.x].z == 1 && walls.positions[t.y].z == 1 && walls.positions[t.z].z == 1;
  });
  add_body(scene, "walls", walls, albedo());
  add_body(scene, "panel", scene::make_quad({-0.4f, 0.9f, -0.6f}, {0.5f, 0, 0}, {0, 0, 0.7f}), albedo(),
           1.0f + 2.0f * random.uniform3());
  const int leaf = add_body(scene, "leaf", scene::make_box({0, -0.9f, -0.03f}, {0.7f, 0.6f, 0.03f}), albedo(),
                            0.5f * random.uniform3(), {-0.1f, 0, -0.2f});
  const auto turned = [](float angle) { return vec4(0, std::sin(angle / 2), 0, std::cos(angle / 2)); };
  scene.animations.push_back({"swing", {}});
  scene.animations[0].channels.push_back({leaf,
                                          scene::AnimationPath::rotation,
                                          scene::Interpolation::linear,
                                          {0, 2},
                                          {turned(0), turned(2.5f)}});
  for (const auto type : {scene::LightType::point, scene::LightType::spot}) {
    scene::Light& light = scene.lights.emplace_back();
    light.name = type == scene::LightType::point ? "bulb" : "spot";
    light.type = type;
    light.color = 0.3f + 0.7f * random.uniform3();
    light.intensity = 1 + random.uniform();
    light.outer_cone = 1.2f;
    light.node = static_cast<int>(scene.nodes.size());
    scene.nodes.emplace_back().local.translation = 1.2f * random.uniform3() - 0.6f;
  }
  scene::Environment& sky = scene.environment.emplace();
  sky.color = 0.2f + 0.5f * random.uniform3();
  sky.equirect = image::Image(4, 2);
  for (float& x : sky.equirect.pixels) x = 0.2f + 2 * random.uniform();
  add_sphl(scene, "west", {-0.6f, 0.2f, 0.4f});
  add_sphl(scene, "east", {0.6f, -0.3f, -0.5f});
  scene::validate(scene);
  return scene;
}

/// A network in a few milliseconds.
inline transport::RelightParams tiny_session() {
  transport::RelightParams params;
  params.transport.directions = 64;
  params.transport.surfel_size = 0.7f;
  params.transport.link_rays = 16;
  params.transport.samples = 4;
  params.degree = 2;
  params.warm_start = false;
  return params;
}

/// A session with its source; the scene must outlive it.
struct LitRoom {
  explicit LitRoom(const scene::Scene& scene, const transport::RelightParams& params = tiny_session(),
                   float time = 0)
      : source(scene, {.light_samples = 4, .environment_samples = 16}),
        session(source, places_of(scene), params, time) {}

  std::vector<sh::RadianceSh> light() {
    session.update();
    return session.reflected();
  }
  int group(const std::string& name) const { return scene::light_group_index(source.light_groups(), name); }

  trace::TransportScene source;
  LitSession session;
};

/// Largest difference, relative to the largest mean of the second.
inline double apart(const std::vector<sh::RadianceSh>& a, const std::vector<sh::RadianceSh>& b) {
  double worst = a.size() == b.size() ? 0 : INFINITY, largest = 1e-30;
  for (std::size_t i = 0; i < std::min(a.size(), b.size()); ++i) {
    largest = std::max(largest, static_cast<double>(max_component(glm::abs(b[i][0]))));
    for (int k = 0; k < static_cast<int>(b[i].values.size()); ++k)
      worst = std::max(worst, static_cast<double>(max_component(glm::abs(a[i][k] - b[i][k]))));
  }
  return worst / largest;
}

inline std::vector<sh::RadianceSh> times(std::vector<sh::RadianceSh> functions, const vec3& factor) {
  for (sh::RadianceSh& f : functions) f *= factor;
  return functions;
}

}  // namespace ssphh::test
