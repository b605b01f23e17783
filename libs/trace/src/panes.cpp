#include "panes.h"

#include <cmath>

#include "surface_gap.h"

namespace ssphh::trace {
namespace {

/// The pane of `panes` from `first` on in whose plane the triangle lies, new if there is none.
Pane& pane_of(std::vector<Pane>& panes, std::size_t first, int instance, const vec3& normal,
              const Pane::Triangle& triangle) {
  const auto lies_in = [&](const Pane& pane) {
    const float size = 1e-4f * (glm::length(triangle.edge1) + glm::length(triangle.edge2)) +
                       position_error(max_abs_component(triangle.corner));
    const auto near = [&](const vec3& p) { return std::abs(pane.above(p)) <= size; };
    return pane.triangles.size() < most_pane_triangles && near(triangle.corner) &&
           near(triangle.corner + triangle.edge1) && near(triangle.corner + triangle.edge2);
  };
  for (std::size_t i = first; i < panes.size(); ++i) {
    if (lies_in(panes[i])) return panes[i];
  }
  Pane pane;
  pane.instance = instance, pane.normal = normal, pane.height = glm::dot(normal, triangle.corner);
  return panes.emplace_back(std::move(pane));
}

}  // namespace

bool Pane::meets(const vec3& origin, const vec3& direction, Hit& hit) const {
  const float along = glm::dot(normal, direction);
  const float distance = -above(origin) / along;
  if (!(distance > 0) || std::isinf(distance)) return false;
  const vec3 p = origin + distance * direction;
  for (const Triangle& t : triangles) {
    const vec3 way = p - t.corner;
    const float a = glm::dot(t.edge1, t.edge1), b = glm::dot(t.edge1, t.edge2),
                c = glm::dot(t.edge2, t.edge2);
    const float d = glm::dot(way, t.edge1), e = glm::dot(way, t.edge2);
    const float u = c * d - b * e, v = a * e - b * d, whole = a * c - b * b;
    if (!(u >= 0 && v >= 0 && u + v <= whole)) continue;
    hit = {instance, t.index, {u / whole, v / whole}, distance};
    return true;
  }
  return false;
}

std::vector<Pane> find_panes(const ShadedGeometry& geometry) {
  std::vector<Pane> panes;
  const scene::Scene& scene = geometry.scene();
  const SceneParts& layout = geometry.layout();
  for (const int i : layout.part(0).instances) {
    const scene::Instance& instance = scene.instances[i];
    const int m = scene::instance_material(scene, instance);
    if (m < 0 || !geometry.glass(i) || scene.materials[m].thickness > 0) continue;
    const mat4 world = instance.node < 0 ? mat4(1) : layout.frames.to_frame[instance.node];
    const scene::Mesh& mesh = scene.meshes[instance.mesh];
    const std::size_t first = panes.size();
    for (std::uint32_t t = 0; t < mesh.triangles.size() && panes.size() - first <= most_planes; ++t) {
      const auto corner = [&](int k) { return vec3(world * vec4(mesh.positions[mesh.triangles[t][k]], 1)); };
      const Pane::Triangle triangle{t, corner(0), corner(1) - corner(0), corner(2) - corner(0)};
      const vec3 cross = glm::cross(triangle.edge1, triangle.edge2);
      if (!(glm::length(cross) > 0) || !std::isfinite(glm::length(cross))) continue;
      Pane& pane = pane_of(panes, first, i, glm::normalize(cross), triangle);
      for (int k = 0; k < 3; ++k) pane.bounds.add(corner(k));
      pane.area += 0.5f * glm::length(cross);
      pane.triangles.push_back(triangle);
    }
    if (panes.size() - first > most_planes) panes.resize(first);
  }
  return panes;
}

}  // namespace ssphh::trace
