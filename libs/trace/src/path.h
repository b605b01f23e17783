#pragma once
/// One light path from the camera: the estimator behind every image and cube map of this module. Its manual
/// is docs/methods/path.md.

#include <algorithm>
#include <cmath>

#include <ssphh/core/random.h>
#include <ssphh/shading/lights.h>

#include "posed_geometry.h"

namespace ssphh::trace {

/// `bsdf_only` and `nee_only` exist for tests: they must agree with `mis` where they can find the light.
enum class Strategy { mis, bsdf_only, nee_only };

struct PathOptions {
  int max_depth = 3;
  bool roulette = true;
  Strategy strategy = Strategy::mis;
};

/// Paths of at least this depth end by Russian roulette.
inline constexpr int roulette_depth = 3;

/// Random numbers of sample `index` of a pixel. Every vertex has its own dimensions, so what happens at one
/// does not shift those of the next.
struct PathSampler {
  std::uint64_t seed;
  std::uint32_t index;

  SampleSequence camera() const { return {seed, index}; }
  /// The random numbers of a vertex.
  struct Vertex {
    float light, lobe;
    vec2 point, direction;
    float roulette;
  };
  Vertex vertex(int depth) const {
    const auto u = sample_pairs(hash_combine(seed, static_cast<std::uint64_t>(depth) + 1), index);
    return {u[0].x, u[0].y, u[1], u[2], u[3].x};
  }
  /// Never 0.
  std::uint64_t alpha_seed(int depth, bool shadow) const {
    const std::uint64_t event =
        (std::uint64_t{index} << 32) | (static_cast<std::uint64_t>(depth) << 1) | shadow;
    return hash_combine(~seed, event) | 1;
  }
};

/// Where a scattered or camera ray starts, and what MIS needs to know about it.
struct PathVertex {
  vec3 position;       ///< on the surface: lights are sampled from here
  vec3 normal{0};      ///< geometric, toward wo; zero at the camera
  float bsdf_pdf = 0;  ///< of the ray that leaves; only for depth ≥ 1
};

/// Traces a path. `Emitters` (SceneEmitters, GhostEmitters) answers what light there is:
///   along(depth, vertex, ray, distance, visit)    emitters without surface that the ray meets before
///   `distance`
///                                                 (infinite: it escapes); visit(group, radiance, light_pdf,
///                                                 emission)
///   surface(vertex, ray, hit, surface, visit)     the same for the surface it hits
///   sample(vertex, u_choice, u)                   optional<shading::LightSample>
///   found_by_rays()                               whether scattered rays can meet any light
/// `Visitor` receives first_hit(surface, ray_origin, ray, hit) and add(depth, group, value, emission),
/// `emission` being the direction in which the light left its emitter. With `scattered_at` the ray is no
/// camera's but leaves that vertex: its path begins at depth 1.
template <class Emitters, class Visitor>
void trace_path(const PosedGeometry& scene, const Emitters& emitters, Ray ray, const PathSampler& sampler,
                const PathOptions& options, RayTask& task, Visitor& visitor,
                const PathVertex* scattered_at = nullptr) {
  vec3 throughput(1);
  PathVertex vertex = scattered_at ? *scattered_at : PathVertex{ray.origin};
  const bool has_alpha = scene.has_alpha();

  for (int depth = scattered_at ? 1 : 0;; ++depth) {
    // Find the nearest surface.
    Hit hit;
    const bool found = scene.intersect(ray, has_alpha ? sampler.alpha_seed(depth, false) : 0, task, hit);
    const float distance = found ? hit.distance : std::numeric_limits<float>::infinity();

    // Add the emitters that the ray meets, weighted against next-event estimation at the vertex before.
    const auto add_emitted = [&](int group, const vec3& radiance, float light_pdf, const vec3& emission) {
      float weight = 1;
      if (depth > 0 && options.strategy == Strategy::nee_only) return;
      if (depth > 0 && options.strategy == Strategy::mis)
        weight = shading::power_heuristic(vertex.bsdf_pdf, light_pdf);
      visitor.add(depth, group, throughput * radiance * weight, emission);
    };
    emitters.along(depth, vertex, ray, distance, add_emitted);
    if (!found) return;

    // Look up the surface, unless nothing of it is wanted any more.
    const bool last = depth >= options.max_depth;
    if (last && depth > 0 && !scene.emissive(hit.instance)) return;
    // Random numbers need nothing of the surface: drawn here, they fill the wait for its memory.
    const PathSampler::Vertex random = sampler.vertex(depth);
    vec3 ray_origin;
    const shading::Surface surface = scene.surface(hit, -ray.direction, ray_origin);
    if (depth == 0) visitor.first_hit(surface, ray_origin, ray, hit);
    // What is unlit is seen, but lights nothing.
    const bool emits = max_component(surface.emission) > 0 && (depth == 0 || !surface.unlit);
    if (emits) emitters.surface(vertex, ray, hit, surface, add_emitted);
    if (last || surface.unlit) return;

    vertex = {surface.position, surface.geometric_normal};
    const Frame frame = Frame::around(surface.normal);
    const vec3 wo = frame.to_local(-ray.direction);
    const shading::BsdfFrom bsdf(surface.bsdf, wo);

    // Sample direct light.
    if (options.strategy != Strategy::bsdf_only) {
      const auto light = emitters.sample(vertex, random.light, random.point);
      if (light && light->pdf > 0 && glm::dot(light->wi, vertex.normal) > 0) {
        const shading::BsdfValue f = bsdf.eval(frame.to_local(light->wi));
        const vec3 value = throughput * f.value * light->radiance;
        if (max_component(value) > 0) {
          const bool alone = light->delta || options.strategy == Strategy::nee_only;
          const float weight = alone ? 1 : shading::power_heuristic(light->pdf, f.pdf);
          const Ray shadow{ray_origin, light->wi, shadow_distance(ray_origin, light->distance)};
          if (!scene.occluded(shadow, has_alpha ? sampler.alpha_seed(depth, true) : 0, task)) {
            visitor.add(depth + 1, light->group, value * (weight / light->pdf), -light->wi);
          }
        }
      }
    }
    if (depth + 1 == options.max_depth && !emitters.found_by_rays()) return;

    // Sample the BSDF; a direction that the shading normal allows but the surface does not ends the path.
    const auto sample = bsdf.sample(random.lobe, random.direction);
    if (!sample || !(sample->pdf > 0)) return;
    const vec3 wi = frame.to_world(sample->wi);
    if (glm::dot(wi, vertex.normal) <= 0) return;
    throughput *= sample->weight;
    vertex.bsdf_pdf = sample->pdf;
    ray = {ray_origin, wi};

    // End paths by Russian roulette.
    const float brightness = max_component(throughput);
    if (!(brightness > 0) || !std::isfinite(brightness)) {
      if (!(brightness <= 0)) ++task.invalid;
      return;
    }
    if (options.roulette && depth + 1 >= roulette_depth) {
      const float survival = std::min(brightness, 0.95f);
      if (random.roulette >= survival) return;
      throughput /= survival;
    }
  }
}

}  // namespace ssphh::trace
