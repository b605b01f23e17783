#include <cmath>

#include <ssphh/shading/surface.h>

#include "material_lookup.h"

namespace ssphh::shading {
namespace {

vec3 normalize_or(const vec3& v, const vec3& fallback) {
  const float length2 = glm::dot(v, v);
  return length2 > 0 && std::isfinite(length2) ? v / std::sqrt(length2) : fallback;
}

/// World-space tangent (xyz) along +u of the normal texture, and handedness (w): bitangent = w · n × t, along
/// −v, for v points down the image and a normal map's green up. All zero where the texture coordinates say
/// nothing.
vec4 tangent_at(const scene::Mesh& mesh, const scene::TextureUse& use, const Corners& at, const mat3& world) {
  if (!mesh.tangents.empty()) {
    const vec4 t = at.interpolate(mesh.tangents);
    return {world * vec3(t), t.w < 0 ? -1.0f : 1.0f};
  }
  const std::vector<vec2>& uvs = mesh.uvs[use.uv_set == 1 ? 1 : 0];
  if (uvs.empty()) return vec4(0);
  const vec3 e1 = mesh.positions[at.index.y] - mesh.positions[at.index.x];
  const vec3 e2 = mesh.positions[at.index.z] - mesh.positions[at.index.x];
  const vec2 d1 = transform_uv_direction(use, uvs[at.index.y] - uvs[at.index.x]);
  const vec2 d2 = transform_uv_direction(use, uvs[at.index.z] - uvs[at.index.x]);
  const float determinant = d1.x * d2.y - d1.y * d2.x;
  if (determinant == 0 || !std::isfinite(determinant)) return vec4(0);
  const vec3 along_u = (determinant > 0 ? 1.0f : -1.0f) * (d2.y * e1 - d1.y * e2);
  // Seen from the front, u right and v down turn clockwise: a negative determinant over counter-clockwise
  // corners
  return {world * along_u, determinant < 0 ? 1.0f : -1.0f};
}

/// Applies the normal map to the unit normal `n` of the front side.
vec3 mapped_normal(const scene::Scene& scene, const scene::Mesh& mesh, const scene::Material& material,
                   const Corners& at, const vec2 (&uv)[2], const mat4& world, const vec3& n) {
  const vec4 tangent = tangent_at(mesh, material.normal_texture, at, mat3(world));
  const vec3 t = normalize_or(vec3(tangent) - n * glm::dot(n, vec3(tangent)), vec3(0));
  if (t == vec3(0)) return n;
  // A mirroring instance turns the frame's handedness around
  const float mirror = glm::determinant(mat3(world)) < 0 ? -1.0f : 1.0f;
  const vec3 b = mirror * tangent.w * glm::cross(n, t);
  vec3 m = 2.0f * vec3(sample_texture(scene, material.normal_texture, uv, false)) - 1.0f;
  m.x *= material.normal_scale, m.y *= material.normal_scale;
  return normalize_or(m.x * t + m.y * b + m.z * n, n);
}

/// Turns a normal that faces away from wo just so far that it sees wo, so no point shades black for its
/// normal only.
vec3 facing_normal(const vec3& n, const vec3& wo, const vec3& geometric) {
  constexpr float least_cosine = 1e-3f;
  const float c = glm::dot(n, wo);
  if (c >= least_cosine) return n;
  return normalize_or(n + (2 * least_cosine - c) * wo, geometric);
}

struct MetallicRoughness {
  float metallic, roughness;
};

MetallicRoughness metallic_roughness_at(const scene::Scene& scene, const scene::Material& material,
                                        const vec2 (&uv)[2]) {
  MetallicRoughness at{material.metallic, material.specular_roughness};
  if (material.metallic_roughness_texture.texture >= 0) {
    const vec4 texel = sample_texture(scene, material.metallic_roughness_texture, uv, false);
    at.metallic *= texel.b;
    at.roughness *= texel.g;  // the sign, which chooses the model, stays
  }
  return at;
}

BsdfParams bsdf_at(const scene::Material& material, const MetallicRoughness& at, const vec3& base) {
  const float r = (material.ior - 1) / (material.ior + 1);
  BsdfParams params;
  params.diffuse = base * (1 - at.metallic);
  params.f0 = glm::mix(vec3(r * r * material.specular), base, at.metallic);
  params.diffuse_roughness = material.diffuse_roughness;
  params.specular_roughness = at.roughness;
  return params;
}

GlassParams glass_of(const scene::Scene& scene, const scene::Material& material, const MetallicRoughness& at,
                     const vec3& base, const vec2 (&uv)[2]) {
  GlassParams glass;
  const float transmission =
      material.transmission * sample_texture(scene, material.transmission_texture, uv, false).r;
  glass.share = transmission * (1 - at.metallic);
  glass.sheet = !(material.thickness > 0);
  glass.ior = material.ior;
  glass.specular = material.specular;
  glass.roughness = glm::min(std::abs(at.roughness), 1.0f);
  glass.tint = base;
  glass.absorption = absorption_of(material);
  return glass;
}

}  // namespace

vec3 absorption_of(const scene::Material& material) {
  if (!(material.thickness > 0 && material.attenuation_distance > 0)) return vec3(0);
  constexpr float least = 1e-30f;  // black after any distance, and no infinity
  return -glm::log(glm::max(material.attenuation_color, vec3(least))) / material.attenuation_distance;
}

Surface surface_at(const scene::Scene& scene, const scene::Mesh& mesh, int material, std::uint32_t triangle,
                   const vec2& barycentric, const mat4& world, const mat3& normal_matrix, const vec3& wo) {
  const Corners at(mesh, triangle, barycentric);
  const vec3 &p0 = mesh.positions[at.index.x], &p1 = mesh.positions[at.index.y],
             &p2 = mesh.positions[at.index.z];
  SurfaceGeometry geometry;
  geometry.position = vec3(world * vec4(at.interpolate(mesh.positions), 1));
  // The inverse transpose also keeps the front in front when an instance is mirrored
  geometry.front = normal_matrix * glm::cross(p1 - p0, p2 - p0);
  if (!mesh.normals.empty()) geometry.normal = normal_matrix * at.interpolate(mesh.normals);
  interpolate_uvs(mesh, at, geometry.uv);
  return surface_of(geometry, scene, mesh, material, triangle, barycentric, world, wo);
}

Surface surface_of(const SurfaceGeometry& geometry, const scene::Scene& scene, const scene::Mesh& mesh,
                   int material_index, std::uint32_t triangle, const vec2& barycentric, const mat4& world,
                   const vec3& wo) {
  const scene::Material& material = material_at(scene, material_index);
  const bool normal_mapped = material.normal_texture.texture >= 0;
  // Only these two read the mesh: everybody else is spared its cache misses
  const Corners at = normal_mapped || !mesh.colors.empty() ? Corners(mesh, triangle, barycentric) : Corners();
  Surface surface;
  surface.position = geometry.position;
  const vec3 front = normalize_or(geometry.front, wo);
  const bool from_front = glm::dot(front, wo) >= 0;
  surface.geometric_normal = from_front ? front : -front;

  // Shading normal
  vec3 normal = normalize_or(geometry.normal, front);
  if (glm::dot(normal, front) < 0)
    normal = -normal;  // files whose normals and winding disagree: winding wins
  if (normal_mapped) normal = mapped_normal(scene, mesh, material, at, geometry.uv, world, normal);
  surface.normal = facing_normal(from_front ? normal : -normal, wo, surface.geometric_normal);

  // Material
  const vec4 base = base_color_at(scene, mesh, material, at, geometry.uv);
  surface.alpha = base.a;
  surface.unlit = material.unlit;
  if (material.unlit) {
    surface.emission = vec3(base);
    surface.bsdf.diffuse = surface.bsdf.f0 = vec3(0);
    return surface;
  }
  MetallicRoughness at_point = metallic_roughness_at(scene, material, geometry.uv);
  if (material.is_glass()) {
    surface.glass = glass_of(scene, material, at_point, vec3(base), geometry.uv);
    surface.glass.inside = !from_front;
    // Metal takes no part in glass: of what is left it is the larger share.
    if (surface.glass.share < 1) at_point.metallic /= 1 - surface.glass.share;
  }
  surface.bsdf = bsdf_at(material, at_point, vec3(base));
  if ((from_front || material.double_sided) && max_component(material.emission) > 0) {
    surface.emission = emission_at(scene, material, geometry.uv);
  }
  return surface;
}

vec3 surface_albedo(const Surface& surface, float cos_o) {
  const vec3 opaque = directional_albedo(surface.bsdf, cos_o);
  if (!(surface.glass.share > 0)) return opaque;
  const GlassShares shares = glass_shares(surface.glass, cos_o);
  return glm::mix(opaque, shares.reflected + shares.transmitted, surface.glass.share);
}

GlassParams glass_at(const scene::Scene& scene, const scene::Mesh& mesh, int material_index,
                     std::uint32_t triangle, const vec2& barycentric) {
  const scene::Material& material = material_at(scene, material_index);
  if (!material.is_glass()) return {};
  const Corners at(mesh, triangle, barycentric);
  vec2 uv[2];
  interpolate_uvs(mesh, at, uv);
  return glass_of(scene, material, metallic_roughness_at(scene, material, uv),
                  vec3(base_color_at(scene, mesh, material, at, uv)), uv);
}

float coverage_at(const scene::Scene& scene, const scene::Mesh& mesh, int material, std::uint32_t triangle,
                  const vec2& barycentric) {
  const Corners at(mesh, triangle, barycentric);
  vec2 uv[2];
  interpolate_uvs(mesh, at, uv);
  return base_color_at(scene, mesh, material_at(scene, material), at, uv).a;
}

}  // namespace ssphh::shading
