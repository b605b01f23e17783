#pragma once
/// A TransportSource that tests every triangle of a Scene: slow, and independent of Embree. Animated nodes
/// are parts, base colours albedos. Knows no light but emission.

#include <algorithm>
#include <array>
#include <atomic>
#include <limits>
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
        if (fresh) parts_.emplace_back().name = scene.nodes[node].name, parts_.back().node = instance.node;
        index = at->second;
      }
      const scene::Mesh& mesh = scene.meshes[instance.mesh];
      const int material = scene::instance_material(scene, instance);
      const scene::Material look = material < 0 ? scene::Material{} : scene.materials[material];
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
        parts_[index].shapes.add(triangle.corner);
      }
    }
  }

  int part_count() const override { return static_cast<int>(parts_.size()); }
  const std::string& part_name(int part) const override { return at(part).name; }
  scene::Bounds part_bounds(int part) const override { return at(part).bounds; }
  float duration() const override { return scene::animation_duration(scene_); }
  mat4 part_pose(int part, float time) const override {
    if (part == 0) return mat4(1);
    return scene::world_matrices(scene_, time)[at(part).node];
  }

  void intersect(int part, std::span<const rays::RayQuery> rays,
                 std::span<rays::RayHit> hits) const override {
    const std::vector<Triangle>& triangles = at(part).triangles;
    for (std::size_t i = 0; i < rays.size(); ++i) {
      hits[i] = {};
      const Triangle* nearest = nullptr;
      at(part).shapes.visit(rays[i], [&](std::size_t k, float t) {
        if (t < hits[i].distance) hits[i].distance = t, nearest = &triangles[k];
        return true;
      });
      if (nearest == nullptr) continue;
      const vec3 n = glm::normalize(
          glm::cross(nearest->corner[1] - nearest->corner[0], nearest->corner[2] - nearest->corner[0]));
      const bool behind = glm::dot(n, rays[i].direction) > 0;
      hits[i].normal = behind ? -n : n;
      hits[i].back = behind && !nearest->double_sided;
      hits[i].albedo = nearest->albedo;
      hits[i].emission = hits[i].back ? vec3(0) : nearest->emission;
    }
    rays_ += rays.size();
  }
  void occluded(int part, std::span<const rays::RayQuery> rays,
                std::span<std::uint8_t> blocked) const override {
    for (std::size_t i = 0; i < rays.size(); ++i) {
      blocked[i] = 0;
      at(part).shapes.visit(rays[i], [&](std::size_t, float t) {
        blocked[i] = t < rays[i].t_max;
        return !blocked[i];
      });
    }
    rays_ += rays.size();
  }
  /// It knows no glass.
  bool joined(int part, const rays::RayQuery& segment) const override {
    std::uint8_t blocked = 0;
    occluded(part, {&segment, 1}, {&blocked, 1});
    return blocked == 0;
  }

  std::uint64_t rays_traced() const override { return rays_; }

 private:
  struct Triangle {
    vec3 corner[3];
    vec3 emission, albedo;
    bool double_sided;
  };
  /// Numbers lie by kind, and the loop over them has no branches: most of what tests with this source cost.
  class Shapes {
   public:
    void add(const vec3 (&corner)[3]) {
      const vec3 columns[] = {corner[0], corner[1] - corner[0], corner[2] - corner[0]};
      for (std::size_t k = 0; k < 9; ++k) numbers_[k].push_back(columns[k / 3][static_cast<int>(k % 3)]);
    }

    /// met(triangle, distance) for each that the ray meets within (0, t_max], until that returns false.
    /// Möller & Trumbore, Fast, Minimum Storage Ray/Triangle Intersection, 1997.
    template <class Met>
    void visit(const rays::RayQuery& ray, const Met& met) const {
      constexpr std::size_t at_once = 32;
      constexpr float miss = std::numeric_limits<float>::infinity();
      const vec3 o = ray.origin, d = ray.direction;
      const float t_max = ray.t_max;
      float found[at_once];
      for (std::size_t first = 0, count = numbers_[0].size(); first < count; first += at_once) {
        const auto column = [&](std::size_t k) { return numbers_[k].data() + first; };
        const float *cx = column(0), *cy = column(1), *cz = column(2);
        const float *ux = column(3), *uy = column(4), *uz = column(5);
        const float *vx = column(6), *vy = column(7), *vz = column(8);
        const std::size_t n = std::min(at_once, count - first);
        for (std::size_t i = 0; i < n; ++i) {
          const float px = d.y * vz[i] - vy[i] * d.z, py = d.z * vx[i] - vz[i] * d.x,
                      pz = d.x * vy[i] - vx[i] * d.y;
          const float determinant = ux[i] * px + uy[i] * py + uz[i] * pz;
          const float x = o.x - cx[i], y = o.y - cy[i], z = o.z - cz[i];
          const float a = (x * px + y * py + z * pz) / determinant;
          const float qx = y * uz[i] - uy[i] * z, qy = z * ux[i] - uz[i] * x, qz = x * uy[i] - ux[i] * y;
          const float b = (d.x * qx + d.y * qy + d.z * qz) / determinant;
          const float t = (vx[i] * qx + vy[i] * qy + vz[i] * qz) / determinant;
          const bool within = (a >= 0) & (a <= 1) & (b >= 0) & (a + b <= 1) & (t > 0) & (t <= t_max);
          found[i] = (within & (determinant != 0)) ? t : miss;
        }
        for (std::size_t i = 0; i < n; ++i)
          if (found[i] < miss && !met(first + i, found[i])) return;
      }
    }

   private:
    std::array<std::vector<float>, 9> numbers_;  ///< a corner, and the ways from it to the others
  };
  struct Part {
    std::string name;
    int node = -1;
    std::vector<Triangle> triangles;
    Shapes shapes;  ///< of the triangles
    scene::Bounds bounds;
  };
  const Part& at(int part) const { return parts_[part]; }

  scene::Scene scene_;
  std::vector<Part> parts_;
  mutable std::atomic<std::uint64_t> rays_{0};
};

}  // namespace ssphh::test
