#include "still_surface.h"

#include <algorithm>
#include <array>

namespace ssphh::probes {

std::vector<StillTriangle> still_triangles(const scene::Scene& scene, float time) {
  const std::vector<mat4> world = scene::world_matrices(scene, time);
  std::vector<StillTriangle> out;
  for (const scene::Instance& instance : scene.instances) {
    if (instance.mesh < 0) continue;
    const bool posed = instance.node >= 0;
    if (posed && scene.nodes[instance.node].movable) continue;
    const int material = scene::instance_material(scene, instance);
    if (material >= 0 && scene.materials[material].unlit) continue;
    const bool glass = material >= 0 && scene.materials[material].is_glass();
    const mat4 to_world = posed ? world[instance.node] : mat4(1);
    const scene::Mesh& mesh = scene.meshes[instance.mesh];
    const auto corner = [&](unsigned i) { return vec3(to_world * vec4(mesh.positions[i], 1)); };
    for (const uvec3& t : mesh.triangles) {
      const StillTriangle now{corner(t.x), corner(t.y), corner(t.z), glass};
      if (glm::length(glm::cross(now.b - now.a, now.c - now.a)) > 0) out.push_back(now);
    }
  }
  return out;
}

std::optional<float> passed(const StillTriangle& t, const vec3& from, const vec3& to) {
  const vec3 normal = glm::cross(t.b - t.a, t.c - t.a);
  const float before = glm::dot(from - t.a, normal), after = glm::dot(to - t.a, normal);
  if ((before > 0) == (after > 0)) return {};
  const float share = before / (before - after);
  const vec3 x = glm::mix(from, to, share);
  const auto inside = [&](const vec3& a, const vec3& b) {
    return glm::dot(glm::cross(b - a, x - a), normal) >= 0;
  };
  if (!inside(t.a, t.b) || !inside(t.b, t.c) || !inside(t.c, t.a)) return {};
  return share;
}

std::optional<vec3> middle_within(const StillTriangle& t, const vec3& min, const vec3& max) {
  const vec3 middle = (t.a + t.b + t.c) / 3.0f;
  const auto inside = [&](int c) { return min[c] <= middle[c] && middle[c] < max[c]; };
  if (inside(0) && inside(1) && inside(2)) return middle;
  // Cut off at each side of the box in turn: a corner more each, at most
  std::array<vec3, 9> corners{t.a, t.b, t.c}, kept;
  std::size_t count = 3;
  for (glm::length_t axis = 0; axis < 3; ++axis) {
    for (const float side : {1.0f, -1.0f}) {
      const float limit = side > 0 ? min[axis] : max[axis];
      std::size_t left = 0;
      for (std::size_t i = 0; i < count; ++i) {
        const vec3 &from = corners[i], &to = corners[(i + 1) % count];
        const float a = side * (from[axis] - limit), b = side * (to[axis] - limit);
        if (a >= 0) kept[left++] = from;
        if ((a >= 0) != (b >= 0)) kept[left++] = from + a / (a - b) * (to - from);
      }
      std::copy_n(kept.begin(), left, corners.begin());
      count = left;
    }
  }
  if (count == 0) return {};
  vec3 sum(0);
  for (std::size_t i = 0; i < count; ++i) sum += corners[i];
  return sum / static_cast<float>(count);
}

TriangleCells triangle_cells(const std::vector<StillTriangle>& triangles, const vec3& origin, float size,
                             const ivec3& cells) {
  std::vector<std::pair<std::uint32_t, std::uint32_t>> pairs;  // cell, triangle
  const vec3 end = origin + size * vec3(cells);
  const auto cell_of = [&](const vec3& x) {
    return glm::clamp(ivec3(glm::floor((x - origin) / size)), ivec3(0), cells - 1);
  };
  for (std::size_t i = 0; i < triangles.size(); ++i) {
    const std::size_t begin = pairs.size();
    visit_parts(triangles[i], origin, end, 0.5f * size, [&](const StillTriangle& t) {
      const ivec3 low = cell_of(glm::min(t.a, glm::min(t.b, t.c)));
      const ivec3 high = cell_of(glm::max(t.a, glm::max(t.b, t.c)));
      for (int z = low.z; z <= high.z; ++z) {
        for (int y = low.y; y <= high.y; ++y) {
          for (int x = low.x; x <= high.x; ++x)
            pairs.emplace_back((z * cells.y + y) * cells.x + x, static_cast<std::uint32_t>(i));
        }
      }
    });
    const auto from = pairs.begin() + static_cast<std::ptrdiff_t>(begin);
    std::sort(from, pairs.end());
    pairs.erase(std::unique(from, pairs.end()), pairs.end());
  }
  std::ranges::sort(pairs);
  TriangleCells out;
  const auto count = static_cast<std::size_t>(cells.x) * static_cast<std::size_t>(cells.y) *
                     static_cast<std::size_t>(cells.z);
  out.first.assign(count + 1, 0);
  for (const auto& [cell, triangle] : pairs) {
    ++out.first[cell + 1];
    out.triangles.push_back(triangle);
  }
  for (std::size_t cell = 0; cell < count; ++cell) out.first[cell + 1] += out.first[cell];
  return out;
}

}  // namespace ssphh::probes
