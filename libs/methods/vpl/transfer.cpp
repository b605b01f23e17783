#include "transfer.h"

#include <cmath>
#include <limits>

#include <ssphh/core/sphere.h>

namespace ssphh::methods::vpl {
namespace {

/// What the receiver makes of light from a unit direction: the cosine, or the lobe.
float response(const Receiver& at, const vec3& wi) {
  const float cosine = glm::dot(at.normal, wi);
  if (!(cosine > 0)) return 0;
  if (at.exponent < 0) return cosine;
  const float lobe = glm::dot(at.axis, wi);
  return lobe > 0 ? (at.exponent + 1) / (2 * pi) * std::pow(lobe, at.exponent) : 0;
}

float sphere_transfer(const Receiver& at, const Vpl& light, const vec3& way, float distance2) {
  // All of it below the receiver's horizon, or the receiver below the light's by the width of the sphere?
  if (glm::dot(at.normal, way) < -light.radius || glm::dot(light.normal, way) > light.radius) return 0;
  const vec3 toward = distance2 > 0 ? way / std::sqrt(distance2) : at.normal;
  // Uniform directions in the cone that the sphere fills; from inside, in a hemisphere.
  constexpr int rings = sphere_rings, spokes = sphere_spokes;
  const float sine2 = std::min(light.radius * light.radius / std::max(distance2, 1e-20f), 1.0f);
  const float one_minus = sine2 / (1 + std::sqrt(1 - sine2));
  const Frame frame = Frame::around(toward);
  float sum = 0;
  for (int i = 0; i < rings; ++i) {
    const float x = (static_cast<float>(i) + 0.5f) / rings * one_minus;
    for (int k = 0; k < spokes; ++k) {
      const float turn = (static_cast<float>(k) + 0.5f * static_cast<float>(i % 2)) / spokes;
      const vec3 wi = frame.to_world(vec3(std::sqrt(x * (2 - x)) * unit_circle(turn), 1 - x));
      sum += response(at, wi) * std::max(-glm::dot(light.normal, wi), 0.0f);
    }
  }
  return sum / (rings * spokes) * 2 * one_minus / (light.radius * light.radius);
}

/// At most the cosine between a unit axis and the way to any point of a box given by its middle relative to
/// the start of the way.
float cosine_bound(const vec3& axis, const vec3& middle, const vec3& half) {
  const Frame frame = Frame::around(axis);
  const auto reach = [&](const vec3& a) { return glm::dot(glm::abs(a), half); };
  const float top = glm::dot(middle, frame.z) + reach(frame.z);
  if (!(top > 0)) return 0;
  const float x = std::max(std::abs(glm::dot(middle, frame.x)) - reach(frame.x), 0.0f);
  const float y = std::max(std::abs(glm::dot(middle, frame.y)) - reach(frame.y), 0.0f);
  return top / std::sqrt(x * x + y * y + top * top);
}

}  // namespace

float unbounded_transfer(const Receiver& at, const Vpl& light) {
  const vec3 way = light.position - at.position;
  const float distance2 = glm::dot(way, way);
  if (!(distance2 > 0)) return 0;
  const vec3 wi = way / std::sqrt(distance2);
  const float leaves = -glm::dot(light.normal, wi);
  return leaves > 0 ? response(at, wi) * leaves / distance2 : 0;
}

float transfer(const Receiver& at, const Vpl& light, const VplParams& params) {
  if (params.kind == VplKind::sphere) {
    const vec3 way = light.position - at.position;
    const float distance2 = glm::dot(way, way);
    if (distance2 < sphere_far2 * light.radius * light.radius)
      return sphere_transfer(at, light, way, distance2);
    return unbounded_transfer(at, light);
  }
  const float open = unbounded_transfer(at, light);
  if (!(params.least_distance > 0)) return open;
  return std::min(open, 1 / (params.least_distance * params.least_distance));
}

float transfer_bound(const Receiver& at, const VplCluster& cluster, const VplParams& params) {
  const bool spheres = params.kind == VplKind::sphere;
  const vec3 middle = cluster.bounds.center() - at.position;
  const vec3 half = 0.5f * (cluster.bounds.max - cluster.bounds.min);
  const vec3 reach = spheres ? half + cluster.most_radius : half;
  const float arrives = cosine_bound(at.normal, middle, reach);
  if (!(arrives > 0)) return 0;
  const float away = std::acos(std::min(cosine_bound(cluster.axis, -middle, reach), 1.0f));
  const float leaves = away > cluster.spread ? std::max(std::cos(away - cluster.spread), 0.0f) : 1;
  const vec3 gap = glm::max(glm::abs(middle) - half, vec3(0));
  const float distance2 = glm::dot(gap, gap);
  // A cone has at most twice the solid angle of the disc that it frames.
  if (spheres) return 2 * arrives * leaves / std::max(distance2, cluster.least_radius * cluster.least_radius);
  const float open = distance2 > 0 ? arrives * leaves / distance2 : std::numeric_limits<float>::infinity();
  if (!(params.least_distance > 0)) return open;
  return std::min(open, 1 / (params.least_distance * params.least_distance));
}

}  // namespace ssphh::methods::vpl
