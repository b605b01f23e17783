#include "inspection.h"

#include <algorithm>
#include <cmath>
#include <functional>
#include <memory>

#include <fmt/format.h>

#include <ssphh/shading/surface.h>

#include "objects.h"

namespace ssphh::viewer {
namespace {

/// Of the records around the point those whose neighbours decide what is interpolated there.
constexpr std::size_t records_around = 256;

void sort_by_weight(std::vector<LightShare>& shares) {
  std::ranges::stable_sort(shares, std::greater<>{}, [](const LightShare& s) { return std::abs(s.weight); });
}

/// False: no record reaches there.
bool light_by_records(const probes::SurfaceRecords& records, const rays::SurfacePoint& at,
                      const probes::SeesProbe& sees, InspectedLight& out) {
  std::vector<std::size_t> near(records.points.size());
  for (std::size_t i = 0; i < near.size(); ++i) near[i] = i;
  const auto distance = [&](std::size_t i) {
    const vec3 to = records.points[i].position - at.position;
    return glm::dot(to, to);
  };
  const std::size_t count = std::min(near.size(), records_around);
  std::ranges::partial_sort(near, near.begin() + static_cast<std::ptrdiff_t>(count), {}, distance);
  near.resize(count);
  std::vector<rays::SurfacePoint> points;
  std::vector<probes::RecordLight> light;
  for (const std::size_t i : near) points.push_back(records.points[i]), light.push_back(records.light[i]);
  const probes::SurfaceInterpolation interpolation(points, sees);
  probes::SurfaceShares room;
  for (const probes::SurfaceShare& share : interpolation.at(at, room))
    out.shares.push_back({fmt::format("record {}", near[share.point]), share.weight});
  return interpolation.irradiance(at, light, out.irradiance);
}

}  // namespace

std::optional<InspectedSurface> inspect_surface(const scene::Scene& scene, const Edits& edits, float time,
                                                const rays::RayQuery& ray) {
  const std::vector<mat4> worlds = scene::world_matrices(scene, time);
  const auto picked = pick_body(scene, worlds, ray);
  if (!picked) return {};
  const scene::Instance& instance = scene.instances[picked->instance];
  const scene::Mesh& mesh = scene.meshes[instance.mesh];
  const mat4& world = worlds[instance.node];
  InspectedSurface out;
  out.distance = picked->distance;
  out.position = ray.origin + picked->distance * ray.direction;
  out.object = node_name(scene, instance.node);

  const uvec3 corners = mesh.triangles[picked->triangle];
  const auto corner = [&](int k) { return vec3(world * vec4(mesh.positions[corners[k]], 1)); };
  const vec3 ab = corner(1) - corner(0), ac = corner(2) - corner(0), n = glm::cross(ab, ac);
  const vec3 to = out.position - corner(0);
  const float area = std::max(glm::dot(n, n), 1e-30f);
  const vec2 weights(glm::dot(glm::cross(to, ac), n) / area, glm::dot(glm::cross(ab, to), n) / area);
  const int material = scene::instance_material(scene, instance);
  const shading::Surface surface =
      shading::surface_at(scene, mesh, material, static_cast<std::uint32_t>(picked->triangle), weights, world,
                          glm::transpose(glm::inverse(mat3(world))), -ray.direction);
  out.normal = surface.normal;
  out.face_normal = surface.geometric_normal;
  if (material < 0) return out;
  const scene::Material &before = scene.materials[material], &now = edits.materials[material];
  out.material = now.name.empty() ? fmt::format("material {}", material) : now.name;
  // Textures multiply the colour, which may have been edited.
  for (int c = 0; c < 3; ++c) {
    const float factor = before.base_color[c] * (1 - before.metallic);
    out.albedo[c] = factor > 0 ? surface.bsdf.diffuse[c] * now.base_color[c] * (1 - now.metallic) / factor
                               : now.base_color[c] * (1 - now.metallic);
  }
  return out;
}

InspectedLight inspect_light(const probes::ProbeSet& set, const probes::LookupParams& params,
                             const rays::SurfacePoint& at, const probes::SeesProbe& sees) {
  InspectedLight out;
  const auto method = params.weights.method;
  if ((!method || *method == probes::WeightMethod::surface) && probes::has_records(set, params)) {
    out.by_records = light_by_records(*set.surface, at, sees, out);
    sort_by_weight(out.shares);
    if (out.by_records) return out;
    out.shares.clear();
  }
  std::vector<vec3> places;
  for (const probes::Probe& probe : set.probes) places.push_back(probe.position);
  probes::LookupParams by_probes = params;
  probes::WeightParams& how = by_probes.weights;
  if (!method || *method == probes::WeightMethod::surface || *method == probes::WeightMethod::fitted)
    how.method = how.fallback;
  const std::shared_ptr<const probes::LookupWeights> weights = probes::make_weights(places, sees, how);
  const probes::ProbeWeights found = weights->at(at);
  for (const probes::ProbeWeight& w : found.used())
    out.shares.push_back({set.probes[w.probe].name, w.weight});
  sort_by_weight(out.shares);
  out.irradiance = probes::IrradianceLookup(set, weights, by_probes).irradiance(at);
  return out;
}

}  // namespace ssphh::viewer
