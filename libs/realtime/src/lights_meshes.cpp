/// Glowing meshes and flat lamps: a closed form, divided among points that have shadow maps.

#include <algorithm>
#include <cmath>

#include <ssphh/scene/query.h>
#include <ssphh/shading/mesh_view.h>

#include "lights.h"

namespace ssphh::realtime {
namespace {

/// Of a glowing mesh's points above it, in roots of its area.
constexpr float most_lift = 0.05f;

float mesh_area(const scene::Mesh& mesh, const mat4& world) {
  float area = 0;
  const auto corner = [&](unsigned i) { return vec3(world * vec4(mesh.positions[i], 1)); };
  for (const uvec3& t : mesh.triangles)
    area += 0.5f * glm::length(glm::cross(corner(t.y) - corner(t.x), corner(t.z) - corner(t.x)));
  return area;
}

}  // namespace

void Lights::shape_as_mesh(Source& source, GpuEmitter& e, const scene::Mesh& mesh, const mat4& placed,
                           bool even, const RendererParams& params) {
  source.points = spread_points(mesh, placed, std::clamp(params.area_samples, 1, max_area_samples));
  source.first_map = area_slots_;
  area_slots_ += static_cast<int>(source.points.size());
  e.items = ivec4(static_cast<int>(EmitterKind::mesh), 0, static_cast<int>(source.points.size()), 0);
  e.more.z = mesh_area(mesh, placed);
  if (!even) return;
  if (mesh.triangles.size() > shading::MeshView::max_triangles) {
    source.ball = as_ball(mesh);
    return;
  }
  for (const uvec3& t : mesh.triangles) {
    for (int c = 0; c < 3; ++c) source.corners.push_back(mesh.positions[t[c]]);
  }
  e.count.x = static_cast<int>(mesh.triangles.size());
}

void Lights::add_meshes(const scene::Scene& scene, const std::vector<mat4>& world,
                        const std::vector<std::string>& groups, const RendererParams& params) {
  for (const scene::Instance& instance : scene.instances) {
    const int material = scene::instance_material(scene, instance);
    if (material < 0 || instance.mesh < 0) continue;
    const scene::Material& m = scene.materials[material];
    if (m.unlit || !(max_component(m.emission) > 0)) continue;
    Source source;
    GpuEmitter e;
    const bool even = m.emission_texture.texture < 0 && m.alpha_mode == scene::AlphaMode::opaque;
    shape_as_mesh(source, e, scene.meshes[instance.mesh], node_matrix(world, instance.node), even, params);
    if (source.points.empty()) continue;
    source.emitter = static_cast<int>(emitters_.size());
    source.group = scene::light_group_index(groups, scene::light_group(scene, instance));
    source.node = instance.node;
    source.radiance = mean_emission(scene, m);
    e.more.y = m.double_sided ? 1 : 0;
    emitters_.push_back(e);
    sources_.push_back(std::move(source));
  }
}

void Lights::place_samples(Source& source, const mat4& world) {
  GpuEmitter& e = emitters_[source.emitter];
  const mat3 to_normal = glm::transpose(glm::inverse(mat3(world)));
  // Off the surface, or its own triangles would stand in the way; a small lamp of a wide scene stays where it
  // is.
  const float lift = std::min(2 * near_, most_lift * std::sqrt(e.more.z));
  for (std::size_t i = 0; i < source.points.size(); ++i) {
    const AreaPoint& p = source.points[i];
    const bool directed = p.normal != vec3(0);
    const vec3 normal = directed ? glm::normalize(to_normal * p.normal) : vec3(0);
    // Sphere lights are not scaled by their node
    const vec3 position =
        directed ? vec3(world * vec4(p.position, 1)) + lift * normal : vec3(world[3]) + p.position;
    const int slot = source.first_map + static_cast<int>(i);
    e.samples[i] = {vec4(position, p.share), vec4(normal, static_cast<float>(slot)), vec4(0)};
    for (int face = 0; face < 6; ++face) {
      const MapView view = cube_view(position, face, near_);
      const bool behind = directed && e.more.y == 0 && glm::dot(view.forward, normal) < -0.82f;
      areas_.set_view(6 * slot + face, view, !behind);
    }
  }
  if (source.ball) {
    const vec3 scale(glm::length(vec3(world[0])), glm::length(vec3(world[1])), glm::length(vec3(world[2])));
    const bool even = glm::all(glm::lessThan(glm::abs(scale - scale.x), vec3(0.01f * scale.x)));
    e.place = vec4(vec3(world * vec4(source.ball->center, 1)), even ? scale.x * source.ball->radius : 0);
  }
  for (std::size_t i = 0; i < source.corners.size(); ++i) e.corners[i] = world * vec4(source.corners[i], 1);
}

}  // namespace ssphh::realtime
