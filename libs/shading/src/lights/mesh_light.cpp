#include "mesh_light.h"

#include <cmath>

#include <ssphh/scene/area_lamp.h>

#include "../surface/material_lookup.h"
#include "triangle_map.h"

namespace ssphh::shading {

MeshLight::MeshLight(const scene::Scene& scene, const scene::Instance& instance, const mat4& world, int group)
    : MeshLight(&scene, nullptr, scene.meshes[instance.mesh],
                material_at(scene, scene::instance_material(scene, instance)), world, world, group) {}

std::shared_ptr<const MeshLight::Body> MeshLight::body_of(const scene::Light& lamp) {
  Body body{scene::area_lamp_mesh(lamp), {}};
  body.material.emission = lamp.color * lamp.intensity;
  return std::make_shared<const Body>(std::move(body));
}

MeshLight::MeshLight(const scene::Light& lamp, const mat4& world, int group)
    : MeshLight(body_of(lamp), scene::area_lamp_pose(world), world, group) {}

MeshLight::MeshLight(const scene::Scene* scene, std::shared_ptr<const Body> body, const scene::Mesh& mesh,
                     const scene::Material& material, const mat4& placed, const mat4& world, int group)
    : scene_(scene),
      body_(std::move(body)),
      mesh_(&mesh),
      material_(&material),
      world_(world),
      group_(group),
      textured_(material_->emission_texture.texture >= 0 ||
                material_->alpha_mode != scene::AlphaMode::opaque) {
  const float mirror = glm::determinant(mat3(placed)) < 0 ? -1.0f : 1.0f;
  std::vector<float> weights;
  for (const uvec3& index : mesh_->triangles) {
    // Bring the triangle to the world
    const vec3 p0(placed * vec4(mesh_->positions[index.x], 1));
    const vec3 p1(placed * vec4(mesh_->positions[index.y], 1));
    const vec3 p2(placed * vec4(mesh_->positions[index.z], 1));
    const vec3 n = mirror * glm::cross(p1 - p0, p2 - p0);
    const float length = glm::length(n);
    const bool usable = length > 0 && std::isfinite(length);
    triangles_.push_back(
        {p0, p1 - p0, p2 - p0, usable ? n / length : vec3(0), usable ? 0.5f * length : 0.0f, 0});
    if (usable) bounds_.add(p0), bounds_.add(p1), bounds_.add(p2);

    // Mean emission: of a texture at a few points; never quite zero, for what lies between them
    float mean = luminance(material_->emission);
    if (textured_) {
      constexpr int points = 16;
      float sum = 0;
      for (int i = 0; i < points; ++i) {
        const vec2 u((static_cast<float>(i) + 0.5f) / points,
                     std::fmod(0.618034f * static_cast<float>(i) + 0.3f, 1.0f));
        sum += luminance(radiance(triangles_.size() - 1, square_to_triangle(u)));
      }
      mean = 0.95f * sum / points + 0.05f * mean;
    }
    Triangle& t = triangles_.back();
    t.strength = usable ? mean * t.area : 0.0f;
    weights.push_back(t.strength);
    strength_ += t.strength;
  }
  choice_ = Distribution(weights);
  if (choice_.empty()) return;
  center_ = bounds_.center();
  extent2_ = bounds_.radius() * bounds_.radius();

  // Find out whether all lie in one plane
  by_view_ = triangles_.size() <= MeshView::max_triangles;
  if (material_->double_sided) return;
  std::optional<Triangle> first;
  for (const Triangle& t : triangles_) {
    if (t.area == 0) continue;
    if (!first) first = t;
    const float tilt = 1 - glm::dot(t.normal, first->normal);
    const float height = std::abs(glm::dot(t.p0 - first->p0, first->normal));
    if (tilt > 1e-6f || height > 1e-4f * bounds_.radius()) return;
  }
  facing_ = first->normal;
  by_view_ = false;
}

float MeshLight::weigh(const vec3& from, Weights& weights) const {
  float total = 0;
  for (std::size_t i = 0; i < triangles_.size(); ++i) {
    const Triangle& t = triangles_[i];
    const vec3 d = from - (t.p0 + (t.e1 + t.e2) / 3.0f);
    const float distance2 = glm::dot(d, d) + t.area;
    float height = glm::dot(from - t.p0, t.normal);
    if (material_->double_sided) height = std::abs(height);
    const bool lit = t.strength > 0 && (material_->double_sided || height > 0);
    weights[i] = lit ? t.strength * (0.1f + 0.9f * height / std::sqrt(distance2)) / distance2 : 0;
    total += weights[i];
  }
  return total;
}

Distribution::Choice MeshLight::choose(const vec3& from, float u) const {
  if (!by_view_) return choice_.sample(u);
  Weights weights;
  const float total = weigh(from, weights);
  if (!(total > 0 && std::isfinite(total))) return {0, 0, 0};
  return choose_weighted(std::span(weights).first(triangles_.size()), total, u);
}

vec3 MeshLight::radiance(std::size_t triangle, const vec2& barycentric) const {
  if (!textured_) return material_->emission;
  const Corners at(*mesh_, static_cast<std::uint32_t>(triangle), barycentric);
  vec2 uv[2];
  interpolate_uvs(*mesh_, at, uv);
  return emission_at(*scene_, *material_, uv) * base_color_at(*scene_, *mesh_, *material_, at, uv).a;
}

std::optional<LightSample> MeshLight::sample(const vec3& from, float u_choice, const vec2& u) const {
  return sample(from, choose(from, u_choice), u);
}

std::optional<LightSample> MeshLight::sample(const vec3& from, const vec2& u) const {
  const Distribution::Choice choice = choose(from, u.x);
  return sample(from, choice, vec2(choice.u, u.y));
}

std::optional<LightSample> MeshLight::sample(const vec3& from, const Distribution::Choice& choice,
                                             const vec2& u) const {
  if (!(choice.probability > 0)) return std::nullopt;
  const Triangle& triangle = triangles_[choice.index];
  const vec2 b = square_to_triangle(u);
  const vec3 d = triangle.p0 + b.x * triangle.e1 + b.y * triangle.e2 - from;
  const float distance2 = glm::dot(d, d);
  if (!(distance2 > 0)) return std::nullopt;
  const float distance = std::sqrt(distance2);
  const vec3 wi = d / distance;
  float cos_light = -glm::dot(wi, triangle.normal);
  if (material_->double_sided) cos_light = std::abs(cos_light);
  if (!(cos_light > 0)) return std::nullopt;
  const float pdf = choice.probability * distance2 / (triangle.area * cos_light);
  if (!std::isfinite(pdf)) return std::nullopt;
  return LightSample{wi, distance, radiance(choice.index, b), pdf, false, group_};
}

std::optional<MeshView> MeshLight::view(const vec3& position, const vec3& normal) const {
  if (textured_ || triangles_.size() > MeshView::max_triangles) return std::nullopt;
  MeshView view(position, normal, material_->emission, group_);
  for (const Triangle& t : triangles_) {
    if (t.area > 0 && (material_->double_sided || glm::dot(position - t.p0, t.normal) > 0))
      view.add(t.p0, t.p0 + t.e1, t.p0 + t.e2);
  }
  return view;
}

float MeshLight::pdf(const vec3& from, std::uint32_t triangle, float distance, float cos_light) const {
  const Triangle& t = triangles_[triangle];
  if (!(t.area > 0 && cos_light > 0)) return 0;
  if (!material_->double_sided && !(glm::dot(from - t.p0, t.normal) > 0)) return 0;
  float chance = 0;
  if (by_view_) {
    Weights weights;
    const float total = weigh(from, weights);
    if (total > 0 && std::isfinite(total)) chance = weights[triangle] / total;
  } else {
    chance = choice_.probability(triangle);
  }
  return chance * distance * distance / (t.area * cos_light);
}

std::optional<EmitterHit> MeshLight::intersect(const vec3& origin, const vec3& direction,
                                               float max_distance) const {
  // The plane of all triangles, from its front
  const float cos_light = facing_ ? -glm::dot(direction, *facing_) : 0;
  if (!(cos_light > 0)) return std::nullopt;
  const float distance = glm::dot(origin - center_, *facing_) / cos_light;
  if (!(distance >= 0 && distance <= max_distance)) return std::nullopt;
  const vec3 at = origin + distance * direction, way = at - center_;
  if (glm::dot(way, way) > extent2_ * (1 + 1e-5f)) return std::nullopt;
  for (std::size_t i = 0; i < triangles_.size(); ++i) {
    const Triangle& t = triangles_[i];
    const vec3 d = at - t.p0;
    const float u = glm::dot(glm::cross(d, t.e2), t.normal), v = glm::dot(glm::cross(t.e1, d), t.normal);
    if (!(t.area > 0 && u >= 0 && v >= 0 && u + v <= 2 * t.area)) continue;
    return EmitterHit{distance, material_->emission,
                      pdf(origin, static_cast<std::uint32_t>(i), distance, cos_light), group_};
  }
  return std::nullopt;
}

float MeshLight::importance(const vec3& from) const {
  const vec3 d = from - center_;
  const float distance2 = glm::dot(d, d);
  float facing = 1;
  if (facing_) {
    const float height = glm::dot(d, *facing_);
    if (height < -1e-4f * std::sqrt(extent2_)) return 0;
    facing = 0.1f + 0.9f * glm::max(height, 0.0f) / std::sqrt(distance2 + 1e-12f);
  }
  return strength_ * facing / (distance2 + extent2_);
}

float MeshLight::power() const {
  return strength_ * (material_->double_sided ? 0.5f : 0.25f);
}

}  // namespace ssphh::shading
