/// Rays against one part, and points on it.

#include <cmath>

#include <ssphh/core/random.h>
#include <ssphh/core/require.h>
#include <ssphh/shading/bsdf.h>

#include "for_rays.h"
#include "glass_passage.h"
#include "transport_data.h"

namespace ssphh::trace {
namespace {

vec3 lambertian_albedo(const shading::Surface& surface, const vec3& wo) {
  if (surface.unlit) return vec3(0);
  const float opaque = 1 - surface.glass.share;
  return glm::clamp(opaque * shading::directional_albedo(surface.bsdf, glm::dot(surface.normal, wo)), 0.0f,
                    1.0f);
}

/// Uniform on the triangle: weights of the second and third corner.
vec2 square_to_triangle(const vec2& u) {
  const float s = std::sqrt(u.x);
  return {s * (1 - u.y), s * u.y};
}

/// Points on triangle `index` of an instance: area times density of them, at least one.
void sample_triangle(const TransportData& data, int instance_index, std::uint32_t index, double density,
                     std::vector<rays::PartPoint>& points) {
  const scene::Instance& instance = data.scene.instances[instance_index];
  const scene::Mesh& mesh = data.scene.meshes[instance.mesh];
  const mat4 m = instance.node < 0 ? mat4(1) : data.layout().frames.to_frame[instance.node];
  const uvec3& corners = mesh.triangles[index];
  const vec3 p0(m * vec4(mesh.positions[corners.x], 1));
  const vec3 e1 = vec3(m * vec4(mesh.positions[corners.y], 1)) - p0;
  const vec3 e2 = vec3(m * vec4(mesh.positions[corners.z], 1)) - p0;
  const vec3 cross = glm::cross(e1, e2);
  const float length = glm::length(cross);
  if (!(length > 0 && std::isfinite(length))) return;
  const vec3 front = (glm::determinant(mat3(m)) < 0 ? -1 / length : 1 / length) * cross;
  const int material = scene::instance_material(data.scene, instance);
  const bool double_sided = material >= 0 && data.scene.materials[material].double_sided;

  const double count = std::ceil(0.5 * static_cast<double>(length) * density);
  if (!(static_cast<double>(points.size()) + count < 1e8))
    throw Error("points on a part", "more than 100 million", "ask for fewer per square metre");
  const std::uint64_t seed = pixel_seed(0, static_cast<std::uint32_t>(instance_index), index);
  for (std::uint32_t i = 0; i < std::max(1.0, count); ++i) {
    const vec2 b = square_to_triangle(SampleSequence(seed, i).next2());
    const Hit hit{instance_index, index, b, 0};
    vec3 ray_origin;
    const shading::Surface surface = data.geometry.surface(hit, front, ray_origin);
    if (surface.alpha < 0.5f || passes(surface.glass, 0)) continue;
    points.push_back({{p0 + b.x * e1 + b.y * e2, front}, lambertian_albedo(surface, front), double_sided});
  }
}

}  // namespace

void TransportScene::intersect(int part, std::span<const rays::RayQuery> rays,
                               std::span<rays::RayHit> hits) const {
  require(rays.size() == hits.size(), "rays", "there is not one hit for each");
  data_->part(part);  // throws where there is none
  const ShadedGeometry& geometry = data_->geometry;
  const shading::LightSet& lights = data_->lights;
  for_rays(rays.size(), data_->rays, [&](std::size_t begin, std::size_t end, RayTask& task) {
    for (std::size_t i = begin; i < end; ++i) {
      rays::RayHit& out = hits[i] = {};
      const rays::RayQuery& ray = rays[i];
      Ray way{ray.origin, ray.direction, ray.t_max};
      Hit hit;
      ++task.rays;
      bool met_glass = false;
      const bool found = geometry.intersect(part, way, 0, hit, &met_glass);
      if (met_glass) {
        if (found) way.t_max = hit.distance;
        out.through = geometry.through_glass(part, way, 0, task);
      }
      if (!found) continue;
      const vec3 wo = -glm::normalize(ray.direction);
      vec3 ray_origin;
      const shading::Surface surface = geometry.surface(hit, wo, ray_origin);
      out.distance = hit.distance;
      out.normal = surface.geometric_normal;
      out.albedo = lambertian_albedo(surface, wo);
      out.emission = surface.emission;
      out.group = max_component(surface.emission) > 0 ? lights.instance_group(hit.instance) : -1;
      out.back = geometry.is_back(hit, ray.direction);
    }
  });
}

void TransportScene::occluded(int part, std::span<const rays::RayQuery> rays,
                              std::span<std::uint8_t> blocked) const {
  require(rays.size() == blocked.size(), "rays", "there is not one answer for each");
  data_->part(part);  // throws where there is none
  const ShadedGeometry& geometry = data_->geometry;
  for_rays(rays.size(), data_->rays, [&](std::size_t begin, std::size_t end, RayTask& task) {
    for (std::size_t i = begin; i < end; ++i) {
      const rays::RayQuery& ray = rays[i];
      const bool covers_any = ray.t_max > 0;
      task.rays += covers_any;
      bool met_glass = false;
      blocked[i] =
          covers_any && geometry.occluded(part, {ray.origin, ray.direction, ray.t_max}, 0, met_glass) ? 1 : 0;
    }
  });
}

bool TransportScene::joined(int part, const rays::RayQuery& segment) const {
  data_->part(part);  // throws where there is none
  const Ray way{segment.origin, segment.direction, segment.t_max};
  RayTask task{1};
  bool met_glass = false;
  const bool joined = !data_->geometry.occluded(part, way, 0, met_glass) &&
                      (!met_glass || data_->geometry.through_glass(part, way, 0, task) == vec3(1));
  data_->rays.add(task.rays);
  return joined;
}

float TransportScene::surface_gap() const {
  return data_->gap;
}

std::vector<rays::PartPoint> TransportScene::sample_part(int part_index,
                                                         double points_per_square_metre) const {
  if (!(points_per_square_metre >= 0)) throw Error("points per square metre", "they must not be negative");
  const ScenePart& part = data_->part(part_index);
  std::vector<rays::PartPoint> points;
  for (const int i : part.instances) {
    const scene::Instance& instance = data_->scene.instances[i];
    const auto triangles = data_->scene.meshes[instance.mesh].triangles.size();
    for (std::uint32_t t = 0; t < triangles; ++t)
      sample_triangle(*data_, i, t, points_per_square_metre, points);
  }
  return points;
}

}  // namespace ssphh::trace
