#pragma once
/// A coloured room under an open sky, with a pillar, a shelf and a block that slides, two lamps, and light by
/// formulas: a TransportSource in which nothing is alike, and whose every ray is the same on all machines.

#include <fmt/format.h>

#include <ssphh/core/random.h>
#include <ssphh/core/sphere.h>
#include <ssphh/image/sphere_map.h>
#include <ssphh/rays/posed_world.h>
#include <ssphh/scene/primitives.h>

#include "triangle_source.h"

// What all tests share is found as test::name beside these, too.
namespace ssphh::test {}
namespace ssphh::methods::test {
using namespace ssphh::test;

inline scene::Scene open_room(const quat& turn) {
  scene::Scene s;
  s.nodes.emplace_back().local.rotation = turn;
  const auto add_node = [&](const vec3& at) {
    scene::Node& node = s.nodes.emplace_back();
    node.parent = 0, node.local.translation = at;
    return static_cast<int>(s.nodes.size()) - 1;
  };
  const auto add = [&](scene::Mesh mesh, const vec3& color) {
    s.materials.emplace_back().base_color = color;
    mesh.material = static_cast<int>(s.materials.size()) - 1;
    s.meshes.push_back(std::move(mesh));
    s.instances.push_back({static_cast<int>(s.meshes.size()) - 1, add_node(vec3(0)), -1, ""});
  };
  const vec3 x(4.3f, 0, 0), y(0, 2.6f, 0), z(0, 0, 3.7f);
  add(scene::make_quad(vec3(0), z, x), {0.7f, 0.6f, 0.5f});
  add(scene::make_quad(vec3(0), x, y), {0.8f, 0.3f, 0.2f});
  add(scene::make_quad(z, y, x), {0.2f, 0.7f, 0.4f});
  add(scene::make_quad(vec3(0), y, z), {0.3f, 0.4f, 0.8f});
  add(scene::make_quad(x, z, y), {0.6f, 0.6f, 0.2f});
  add(scene::make_quad({0, 2.6f, 0}, {2.1f, 0, 0}, {0, 0, 3.7f}), {0.5f, 0.5f, 0.6f});  // half a ceiling
  add(scene::make_box({1.13f, -0.2f, 1.21f}, {1.62f, 1.73f, 1.84f}),
      {0.6f, 0.4f, 0.5f});  // no face in the floor's plane
  add(scene::make_quad({2.9f, 1.1f, 0.07f}, {0.9f, 0.1f, 0}, {0, 0.08f, 0.8f}), {0.4f, 0.7f, 0.7f});
  s.materials.back().double_sided = true;
  add(scene::make_box({-0.31f, -0.27f, -0.22f}, {0.33f, 0.36f, 0.41f}), {0.7f, 0.2f, 0.6f});
  s.nodes.back().movable = true;
  s.nodes.back().local.translation = {3.1f, 0.45f, 2.2f};
  scene::AnimationChannel slides;
  slides.node = static_cast<int>(s.nodes.size()) - 1;
  slides.times = {0, 1}, slides.values = {vec4(3.1f, 0.45f, 2.2f, 0), vec4(2.2f, 0.75f, 2.9f, 0)};
  s.animations.push_back({"slides", {slides}});

  for (const auto& [name, at, color] : {std::tuple("near", vec3(0.7f, 2.1f, 0.9f), vec3(1, 0.7f, 0.4f)),
                                        std::tuple("far", vec3(3.6f, 1.9f, 3.1f), vec3(0.3f, 0.6f, 1))}) {
    scene::Light& light = s.lights.emplace_back();
    light.name = name, light.color = color, light.intensity = 3, light.node = add_node(at);
  }
  s.environment.emplace().name = "sky";
  s.environment->equirect = image::Image(8, 4, 3);
  for (int v = 0; v < 4; ++v)
    for (int u = 0; u < 8; ++u)
      s.environment->equirect.set_rgb(
          u, v, {0.3f + 0.2f * static_cast<float>(u % 5), 1 - 0.2f * static_cast<float>(v), 0.8f});
  s.environment->color = {0.9f, 0.8f, 1.1f}, s.environment->rotation = 0.4f;
  int sphl = 0;
  for (const vec3& at : {vec3(0.6f, 0.5f, 0.7f), vec3(2.2f, 1.9f, 1), vec3(3.5f, 0.6f, 0.9f),
                         vec3(0.5f, 1.4f, 3.1f), vec3(2.4f, 0.4f, 3.2f)})
    s.sphls.push_back({fmt::format("SPHL {}", sphl++), add_node(at), 0.1f, true});
  return s;
}

/// Lamps that are points, shadowed; and the sky by a few directions.
class RoomLight final : public rays::DirectLight {
 public:
  RoomLight(const rays::TransportSource& source, const scene::Environment& sky,
            std::span<const scene::LightState> lamps, std::span<const mat4> poses, float rotation)
      : surfaces_(source, poses),
        lamps_(lamps.begin(), lamps.end()),
        sky_(sky),
        turn_(sky.rotation + rotation) {}

  void irradiance(int group, std::span<const rays::SurfacePoint> points, std::span<vec3> out) const override {
    for (std::size_t i = 0; i < points.size(); ++i)
      out[i] = group < 2 ? of_lamp(group, points[i]) : of_sky(points[i]);
  }
  bool may_shadow(int group, const rays::SurfacePoint& point, const scene::Bounds& box) const override {
    if (group == 2) return true;
    const vec3 middle = 0.5f * (point.position + place(group)),
               reach = 0.5f * glm::abs(place(group) - point.position);
    return glm::all(glm::lessThanEqual(box.min, middle + reach)) &&
           glm::all(glm::lessThanEqual(middle - reach, box.max));
  }
  vec3 emitted(int, const rays::RayQuery&, float) const override { return vec3(0); }
  float flux(int group) const override { return 4 * pi * luminance(group < 2 ? strength(group) : vec3(2)); }
  std::optional<rays::Photon> emit(int group, const rays::PhotonNumbers& numbers) const override {
    const vec3 d = sample_uniform_sphere(numbers.direction);
    if (group < 2) return rays::Photon{place(group), d, 4 * pi * strength(group), 0};
    const Frame frame = Frame::around(-d);
    const vec2 at = 3.0f * (2.0f * numbers.place - 1.0f);
    return rays::Photon{surfaces_.bounds().center() - 5.0f * d + at.x * frame.x + at.y * frame.y, d,
                        4 * pi * 36 * radiance(-d), 0};
  }

 private:
  vec3 place(int lamp) const { return vec3(lamps_[lamp].world[3]); }
  vec3 strength(int lamp) const {
    const scene::LightState& state = lamps_[lamp];
    return state.intensity * state.color;
  }
  vec3 radiance(const vec3& d) const {
    return sky_.color * vec3(1 + std::sin(turn_) * d.x, 0.6f + 0.3f * d.y, 0.9f);
  }
  vec3 of_lamp(int lamp, const rays::SurfacePoint& p) const {
    const vec3 way = place(lamp) - p.position;
    const float cosine = glm::dot(p.normal, glm::normalize(way));
    if (cosine <= 0 || !surfaces_.visible(p.position + 1e-4f * p.normal, place(lamp))) return vec3(0);
    return cosine / glm::dot(way, way) * strength(lamp);
  }
  vec3 of_sky(const rays::SurfacePoint& p) const {
    constexpr int rays = 12;
    vec3 sum(0);
    for (int i = 0; i < rays; ++i) {
      const vec3 d = spherical_fibonacci(i, rays);
      const float cosine = glm::dot(p.normal, d);
      if (cosine > 0 && !surfaces_.occluded({p.position + 1e-4f * p.normal, d}))
        sum += 4 * pi / rays * cosine * radiance(d);
    }
    return sum;
  }

  rays::PosedWorld surfaces_;
  std::vector<scene::LightState> lamps_;
  const scene::Environment& sky_;
  float turn_;
};

class OpenRoom final : public ssphh::test::TriangleSource {
 public:
  explicit OpenRoom(const quat& turn = {1, 0, 0, 0}) : OpenRoom(open_room(turn)) {}
  const scene::Scene& scene() const { return scene_; }

  const std::vector<std::string>& light_groups() const override { return groups_; }
  std::vector<scene::LightState> lights(float time) const override {
    return scene::lighting_at(scene_, time).lights;
  }
  const std::vector<std::string>& light_names() const override { return names_; }
  int light_group_of(int light) const override { return light; }
  bool group_emits_from(int group, int part) const override { return group == 2 && part == 0; }
  int environment_group() const override { return 2; }
  std::unique_ptr<rays::DirectLight> direct_light(std::span<const scene::LightState> lights,
                                                  std::span<const mat4> poses,
                                                  const scene::EnvironmentState& environment) const override {
    return std::make_unique<RoomLight>(*this, *scene_.environment, lights, poses, environment.rotation);
  }

 private:
  explicit OpenRoom(scene::Scene scene) : TriangleSource(scene), scene_(std::move(scene)) {}

  scene::Scene scene_;
  std::vector<std::string> groups_{"near", "far", "sky"}, names_{"near", "far"};
};

}  // namespace ssphh::methods::test
