#pragma once
/// Closed rooms whose every wall has the same albedo ρ and gets the same direct irradiance E, however the
/// room is shaped: each bounce keeps the share ρ, so that all bounces together bring E ρ / (1 − ρ) to every
/// place and normal, and from every direction comes radiance 1 / π of that and of what lamps leave at once.

#include <string>

#include <ssphh/methods/method_list.h>
#include <ssphh/scene/primitives.h>

#include "expect_near.h"
#include "fake_source.h"
#include "given_light.h"
#include "triangle_source.h"

// What all tests share is found as test::name beside these, too.
namespace ssphh::test {}
namespace ssphh::methods::test {
using namespace ssphh::test;

inline constexpr vec3 even_albedo(0.2f, 0.5f, 0.75f);

/// Two rooms of 2 × 2 × 2 m with 10 cm of wall between them, the first with its corner in the origin, the
/// other beyond x = 2.1.
class EvenRooms final : public TriangleSource {
 public:
  /// Direct irradiance in either room; `probes`: where the scene has SPHLs.
  EvenRooms(const vec3& first, const vec3& second, const std::vector<vec3>& probes)
      : EvenRooms(rooms(probes), first, second) {}

  const scene::Scene& scene() const { return scene_; }
  MethodScene method_scene() const { return {scene_, *this}; }
  static bool in_second(const vec3& place) { return place.x > 2.05f; }
  /// Indirect irradiance of the room in which the place is.
  vec3 answer(const vec3& place) const {
    return (in_second(place) ? second_ : first_) * even_albedo / (1.0f - even_albedo);
  }
  /// On walls of both rooms, and the third in the air.
  static std::vector<rays::SurfacePoint> points() {
    std::vector<rays::SurfacePoint> points;
    for (const float x : {0.0f, 2.1f}) {
      points.push_back({{x + 0.7f, 0, 1.2f}, {0, 1, 0}});
      points.push_back({{x, 1.1f, 0.6f}, {1, 0, 0}});
      points.push_back({{x + 1.1f, 0.9f, 1}, glm::normalize(vec3(1, -2, 3))});
      points.push_back({{x + 1.3f, 0.4f, 2}, {0, 0, -1}});
    }
    return points;
  }

  const std::vector<std::string>& light_groups() const override { return groups_; }
  std::unique_ptr<rays::DirectLight> direct_light(std::span<const scene::LightState>, std::span<const mat4>,
                                                  const scene::EnvironmentState&) const override {
    auto light = std::make_unique<GivenLight>();
    light->at = [this](int, const rays::SurfacePoint& p) { return in_second(p.position) ? second_ : first_; };
    light->fluxes = {1};
    return light;
  }
  /// What path tracing would find: the radiance of all bounces, and walls that nobody sees through.
  std::unique_ptr<rays::RadianceSource> path_tracing(const scene::LightingState&) const override {
    ++traced;
    auto paths = std::make_unique<FakeSource>();
    paths->groups = groups_;
    paths->reflected = {[this](const vec3& place, const vec3&) { return answer(place) / pi; }};
    paths->free = [](const vec3& a, const vec3& b) { return in_second(a) == in_second(b); };
    return paths;
  }
  mutable int traced = 0;

 private:
  EvenRooms(scene::Scene scene, const vec3& first, const vec3& second)
      : TriangleSource(scene), scene_(std::move(scene)), first_(first), second_(second) {}

  static scene::Scene rooms(const std::vector<vec3>& probes) {
    scene::Scene s;
    s.nodes.emplace_back();
    s.materials.emplace_back().base_color = even_albedo;
    for (const float x : {0.0f, 2.1f}) {
      for (int axis = 0; axis < 3; ++axis) {
        for (const bool far : {false, true}) {
          vec3 corner(x, 0, 0), u(0), v(0);
          u[(axis + 1) % 3] = 2, v[(axis + 2) % 3] = 2;
          if (far) corner[axis] += 2;
          const scene::Mesh quad = scene::make_quad(corner, u, v);
          s.meshes.push_back(far ? scene::flipped(quad) : quad);
          s.meshes.back().material = 0;
          s.instances.push_back({static_cast<int>(s.meshes.size()) - 1, 0, -1, ""});
        }
      }
    }
    for (const vec3& at : probes) {
      s.nodes.emplace_back().local.translation = at;
      s.sphls.push_back(
          {"SPHL " + std::to_string(s.sphls.size()), static_cast<int>(s.nodes.size()) - 1, 0.1f, true});
    }
    return s;
  }

  scene::Scene scene_;
  vec3 first_, second_;
  std::vector<std::string> groups_{"lamps"};
};

inline std::unique_ptr<Method> made(const char* name, const MethodScene& scene,
                                    const std::vector<std::string>& settings = {}) {
  const MethodEntry& entry = find_method(name);
  return entry.make(scene, MethodParameters(entry.name, entry.parameters, settings), {});
}

/// Irradiance at the rooms' points after an update to the source's own lights, all of them `scale` as strong.
inline std::vector<vec3> found(Method& method, const EvenRooms& rooms, const vec3& scale = vec3(1)) {
  scene::LightingState state = rays::lighting_at(rooms, 0);
  state.group_scales.assign(1, scale);
  method.update(state, {});
  std::vector<vec3> light;
  for (const rays::SurfacePoint& point : EvenRooms::points())
    light.push_back(method.light().irradiance(point));
  return light;
}

}  // namespace ssphh::methods::test
