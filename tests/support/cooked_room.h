#pragma once
/// Two rooms with a wall between them, probes and points with random light of three groups, as a cooked file.

#include <random>

#include <ssphh/cook/cook.h>
#include <ssphh/runtime/runtime.h>
#include <ssphh/scene/primitives.h>

#include "random_set.h"
#include "triangle_source.h"

namespace ssphh::test {

enum class OnSurfaces { nothing, records, fitted };

inline scene::Scene two_rooms_with_a_wall() {
  scene::Scene scene;
  scene.nodes.emplace_back();
  scene.materials.emplace_back();
  // Floor, ceiling, four walls; and one across, which leaves a passage
  scene.meshes = {scene::make_quad({-2, 0, -1.5f}, {0, 0, 3}, {4, 0, 0}),
                  scene::make_quad({-2, 2, -1.5f}, {4, 0, 0}, {0, 0, 3}),
                  scene::make_quad({-2, 0, -1.5f}, {4, 0, 0}, {0, 2, 0}),
                  scene::make_quad({-2, 0, 1.5f}, {0, 2, 0}, {4, 0, 0}),
                  scene::make_quad({-2, 0, -1.5f}, {0, 2, 0}, {0, 0, 3}),
                  scene::make_quad({2, 0, -1.5f}, {0, 0, 3}, {0, 2, 0}),
                  scene::make_box({-0.05f, 0, -1.5f}, {0.05f, 2, 0.7f})};
  for (scene::Mesh& mesh : scene.meshes) {
    mesh.material = 0;
    scene.instances.push_back({static_cast<int>(scene.instances.size()), 0, -1, ""});
  }
  return scene;
}

/// Places on the floor, two walls and the wall between the rooms.
inline std::vector<rays::SurfacePoint> places_on_surfaces(int count, std::uint64_t seed) {
  Pcg32 random(seed);
  std::vector<rays::SurfacePoint> places;
  for (int i = 0; i < count; ++i) {
    const vec3 u = random.uniform3();
    switch (i % 4) {
      case 0:
        places.push_back({{4 * u.x - 2, 0, 3 * u.y - 1.5f}, {0, 1, 0}});
        break;
      case 1:
        places.push_back({{4 * u.x - 2, 2 * u.y, -1.5f}, {0, 0, 1}});
        break;
      case 2:
        places.push_back({{-2, 2 * u.x, 3 * u.y - 1.5f}, {1, 0, 0}});
        break;
      default:
        places.push_back({{0.05f, 2 * u.x, 2.2f * u.y - 1.5f}, {1, 0, 0}});
        break;
    }
  }
  return places;
}

/// Places anywhere in the rooms, as something that moves comes there.
inline std::vector<rays::SurfacePoint> places_in_the_open(int count, std::uint64_t seed) {
  Pcg32 random(seed);
  std::vector<rays::SurfacePoint> places;
  for (int i = 0; i < count; ++i)
    places.push_back({vec3(3.8f, 1.8f, 2.8f) * random.uniform3() - vec3(1.9f, -0.1f, 1.4f),
                      glm::normalize(2.0f * random.uniform3() - 1.0f), true});
  return places;
}

inline probes::ProbeSet set_of_two_rooms(OnSurfaces on_surfaces, int degree = 5, std::uint64_t seed = 4) {
  Pcg32 random(seed), places(9);
  probes::ProbeSet set;
  set.degree = degree;
  set.generator.scene_hash = {1, 2};
  set.light_groups = {{"lamp", {1, 0.5f, 2}}, {"the sun", vec3(0.25f)}, {"night \u00fc", vec3(0)}};
  set.light_groups[1].mode = scene::LightMode::baked;
  for (int i = 0; i < 27; ++i) {
    probes::Probe& probe = set.probes.emplace_back();
    probe.position =
        vec3(1.3f * static_cast<float>(i % 3) - 1.2f, 0.6f * static_cast<float>(i / 3 % 3) + 0.4f,
             1.0f * static_cast<float>(i / 9) - 1.0f) +
        0.1f * places.uniform3();
    for (std::size_t g = 0; g < set.light_groups.size(); ++g) {
      probes::GroupLight& light = probe.groups.emplace_back();
      light.reflected = random_sh(random, degree, 0.6f);
      light.reflected[0] += vec3(probe.position.x < 0 ? 2.5f : 8.0f);
      if (g == 1) light.emitted = random_sh(random, degree, 0.1f);
    }
  }
  const std::vector<rays::SurfacePoint> points = places_on_surfaces(300, 5);
  if (on_surfaces == OnSurfaces::records) {
    probes::SurfaceRecords& records = set.surface.emplace();
    records.points = points;
    for (std::size_t g = 0; g < set.light_groups.size(); ++g) {
      std::vector<probes::PackedRecordLight>& group = records.groups.emplace_back();
      for (const rays::SurfacePoint& point : points) {
        probes::RecordLight light;
        for (glm::length_t c = 0; c < 4; ++c) light[c] = random.uniform3() + vec3(c == 3 ? 2 : 0);
        group.push_back(probes::pack(light, point.normal));
      }
    }
  }
  if (on_surfaces == OnSurfaces::fitted) {
    probes::FittedPoints& fitted = set.fitted.emplace();
    fitted.points = points;
    for (std::size_t i = 0; i < points.size(); ++i) {
      probes::PointWeights& weights = fitted.weights.emplace_back();
      const int count = static_cast<int>(i % 5);  // of some points none
      for (int k = 0; k < count; ++k)
        weights.add((7 * static_cast<int>(i) + k) % 27,
                    (0.5f + random.uniform()) / static_cast<float>(count));
    }
  }
  probes::merge_groups(set);
  return set;
}

/// The file's bytes, aligned as `malloc` does.
inline std::vector<std::byte> cook_two_rooms(const probes::ProbeSet& set, int sight_size = 16) {
  const scene::Scene scene = two_rooms_with_a_wall();
  const TriangleSource source(scene);
  const cook::CookScene cook_scene{scene, source};
  return cook::cook(set, &cook_scene, {sight_size}).bytes;
}

/// An open cooked file in memory of its own.
class OpenedFile {
 public:
  explicit OpenedFile(std::vector<std::byte> bytes) : bytes_(std::move(bytes)) {
    std::size_t size = 0;
    result = ssphh_runtime_size_needed(bytes_.data(), bytes_.size(), &size);
    memory_.resize(size);
    if (result == SSPHH_RUNTIME_OK)
      result = ssphh_runtime_open(bytes_.data(), bytes_.size(), memory_.data(), size, &runtime);
  }
  OpenedFile(const OpenedFile&) = delete;

  vec3 irradiance(const rays::SurfacePoint& at) const {
    vec3 e;
    const unsigned flags = at.moves ? SSPHH_RUNTIME_OPEN : SSPHH_RUNTIME_STILL;
    const ssphh_runtime_result looked_up =
        ssphh_runtime_irradiance(runtime, flags, &at.position.x, &at.normal.x, &e.x);
    if (looked_up != SSPHH_RUNTIME_OK) throw Error("lookup", ssphh_runtime_message(looked_up));
    return e;
  }
  const std::vector<std::byte>& bytes() const { return bytes_; }

  ssphh_runtime_result result = SSPHH_RUNTIME_OK;
  ssphh_runtime* runtime = nullptr;

 private:
  std::vector<std::byte> bytes_, memory_;
};

}  // namespace ssphh::test
