#pragma once
/// A TransportSource that tests every triangle of a Scene: slow, and independent of Embree. Animated nodes
/// are parts, base colours albedos. Knows no light but emission.

#include <atomic>
#include <map>

#include "unlit_source.h"

namespace ssphh::test {

class TriangleSource : public UnlitSource {
 public:
  explicit TriangleSource(const scene::Scene& scene) : scene_(scene), parts_(1) {
    parts_[0].name = "static";
    const std::vector<mat4> world = scene::world_matrices(scene);
    std::map<int, std::size_t> part_of;
    for (const scene::Instance& instance : scene.instances) {
      const auto node = static_cast<std::size_t>(instance.node);
      std::size_t index = 0;
      if (scene.nodes[node].movable) {
        const auto [at, fresh] = part_of.try_emplace(instance.node, parts_.size());
        if (fresh) parts_.push_back({scene.nodes[node].name, instance.node, {}, {}});
        index = at->second;
      }
      const scene::Mesh& mesh = scene.meshes[static_cast<std::size_t>(instance.mesh)];
      const int material = scene::instance_material(scene, instance);
      const scene::Material look =
          material < 0 ? scene::Material{} : scene.materials[static_cast<std::size_t>(material)];
      for (const uvec3& t : mesh.triangles) {
        Triangle triangle{{}, look.emission, look.base_color, look.double_sided};
        for (int k = 0; k < 3; ++k) {
          const vec3 p = mesh.positions[t[k]];
          triangle.corner[k] = index == 0 ? vec3(world[node] * vec4(p, 1)) : p;
          parts_[index].bounds.add(triangle.corner[k]);
        }
        // A mirrored front stays the front.
        if (index == 0 && glm::determinant(mat3(world[node])) < 0)
          std::swap(triangle.corner[1], triangle.corner[2]);
        parts_[index].triangles.push_back(triangle);
      }
    }
  }

  int part_count() const override { return static_cast<int>(parts_.size()); }
  const std::string& part_name(int part) const override { return at(part).name; }
  scene::Bounds part_bounds(int part) const override { return at(part).bounds; }
  float duration() const override { return scene::animation_duration(scene_); }
  mat4 part_pose(int part, float time) const override {
    if (part == 0) return mat4(1);
    return scene::world_matrices(scene_, time)[static_cast<std::size_t>(at(part).node)];
  }

  void intersect(int part, std::span<const rays::RayQuery> rays,
                 std::span<rays::RayHit> hits) const override {
    for (std::size_t i = 0; i < rays.size(); ++i) {
      hits[i] = {};
      for (const Triangle& triangle : at(part).triangles) {
        const float t = distance(triangle, rays[i]);
        if (!(t < hits[i].distance)) continue;
        const vec3 n = glm::normalize(
            glm::cross(triangle.corner[1] - triangle.corner[0], triangle.corner[2] - triangle.corner[0]));
        const bool behind = glm::dot(n, rays[i].direction) > 0;
        hits[i].distance = t;
        hits[i].normal = behind ? -n : n;
        hits[i].back = behind && !triangle.double_sided;
        hits[i].albedo = triangle.albedo;
        hits[i].emission = hits[i].back ? vec3(0) : triangle.emission;
      }
    }
    rays_ += rays.size();
  }
  void occluded(int part, std::span<const rays::RayQuery> rays,
                std::span<std::uint8_t> blocked) const override {
    for (std::size_t i = 0; i < rays.size(); ++i) {
      blocked[i] = 0;
      for (const Triangle& triangle : at(part).triangles) {
        if (distance(triangle, rays[i]) < rays[i].t_max) {
          blocked[i] = 1;
          break;
        }
      }
    }
    rays_ += rays.size();
  }

  std::uint64_t rays_traced() const override { return rays_; }

 private:
  struct Triangle {
    vec3 corner[3];
    vec3 emission, albedo;
    bool double_sided;
  };
  struct Part {
    std::string name;
    int node = -1;
    std::vector<Triangle> triangles;
    scene::Bounds bounds;
  };
  const Part& at(int part) const { return parts_[static_cast<std::size_t>(part)]; }

  /// Möller & Trumbore, Fast, Minimum Storage Ray/Triangle Intersection, 1997; infinite for a miss.
  static float distance(const Triangle& triangle, const rays::RayQuery& ray) {
    constexpr float miss = std::numeric_limits<float>::infinity();
    const vec3 u = triangle.corner[1] - triangle.corner[0], v = triangle.corner[2] - triangle.corner[0];
    const vec3 p = glm::cross(ray.direction, v);
    const float determinant = glm::dot(u, p);
    if (determinant == 0) return miss;
    const vec3 from = ray.origin - triangle.corner[0];
    const float a = glm::dot(from, p) / determinant;
    if (a < 0 || a > 1) return miss;
    const vec3 q = glm::cross(from, u);
    const float b = glm::dot(ray.direction, q) / determinant;
    if (b < 0 || a + b > 1) return miss;
    const float t = glm::dot(v, q) / determinant;
    return t > 0 && t <= ray.t_max ? t : miss;
  }

  scene::Scene scene_;
  std::vector<Part> parts_;
  mutable std::atomic<std::uint64_t> rays_{0};
};

}  // namespace ssphh::test
