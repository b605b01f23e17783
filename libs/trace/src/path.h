#pragma once
/// One light path from the camera: the estimator behind every image and cube map of this module. Its manual
/// is docs/methods/path.md.

#include <algorithm>
#include <cmath>

#include <ssphh/shading/lights.h>
#include <ssphh/shading/scattering.h>

#include "glass_passage.h"
#include "mirror_lobe.h"
#include "pane_paths.h"
#include "surface_gap.h"

namespace ssphh::trace {

/// `bsdf_only` and `nee_only` exist for tests: they must agree with `mis` where they can find the light.
enum class Strategy { mis, bsdf_only, nee_only };

struct PathOptions {
  int max_depth = 3;
  bool roulette = true;
  Strategy strategy = Strategy::mis;
  /// The first surface that is no glass gets its indirect light from a lookup: what glass shows counts no
  /// depth, and from that surface on light goes straight through glass of any kind.
  bool looks_up = false;
  rays::PathSet paths = rays::PathSet::all;
  /// In which vertices look for emitters; null: only scattered rays find what panes mirror.
  const PaneMirrors* panes = nullptr;
};

/// Paths of at least this depth end by Russian roulette.
inline constexpr int roulette_depth = 3;

/// Light along a path so far.
struct PathLight {
  vec3 throughput{1};
  float spread = 1;    ///< of radiance by refraction, contained in `throughput`
  vec3 absorption{0};  ///< of the body that the ray is in [1/m]
  int glass_met = 0;

  /// Takes away what a body absorbs on the ray before `distance`.
  void absorb(const vec3& by, const Ray& ray, float distance) {
    if (max_component(by) > 0) throughput *= attenuated(by, distance - ray.t_min);
  }
};

/// All that a surface does to light toward wo but letting it go straight on.
inline shading::ScatteringFrom scattering_from(const shading::Surface& surface, const vec3& wo) {
  return {surface, Frame::around(surface.normal).to_local(wo)};
}

/// What arrives of a light sample whose light, its density not yet divided by, is reflected as `value`.
/// `scattered_pdf`: of the scattered rays that may meet the light, too, and share its weight; 0: there are
/// none. `start`: where rays leave `position` on the light's side.
inline vec3 next_event(const PosedGeometry& scene, const shading::LightSample& toward, const vec3& value,
                       float scattered_pdf, const vec3& start, const vec3& position, const Passage& passage,
                       RayTask& task) {
  if (!(max_component(value) > 0)) return vec3(0);
  const bool alone = toward.delta || scattered_pdf == 0;
  const float weight = alone ? 1 : shading::power_heuristic(toward.pdf, scattered_pdf);
  return scene.transmittance(shadow_ray(start, position, toward), passage, task) * value *
         (weight / toward.pdf);
}

/// Decides at a hit whether the path goes straight on, as smooth sheets let it, and with `all_glass` any
/// glass; if so the ray begins anew beyond the hit. A path that cannot scatter any more (`last`) goes on
/// wherever it can.
inline bool go_straight(const shading::Surface& surface, const vec3& ray_origin, const Hit& hit,
                        bool all_glass, bool last, const PathSampler& sampler, PathLight& light, Ray& ray) {
  const shading::GlassParams& glass = surface.glass;
  if (!passes(glass, {1, all_glass ? PassedGlass::all : PassedGlass::smooth_sheets})) return false;
  const vec3 passed =
      glass.share * shading::straight_transmittance(glass, -glm::dot(surface.normal, ray.direction));
  const float through = (passed.x + passed.y + passed.z) / 3;
  const float rest = last ? 0 : scattering_from(surface, -ray.direction).power();
  const float chance = through > 0 ? through / (through + rest) : 0;
  const bool straight = sampler.glass(light.glass_met++).x < chance;
  if (straight) {
    light.throughput *= passed / chance;
    ray.t_min = beyond(ray, hit.distance, surface, ray_origin);
  } else {
    light.throughput /= 1 - chance;
  }
  return straight;
}

/// Makes the surface all glass or all opaque, by chance.
inline bool choose_glass(shading::Surface& surface, const vec3& wo, const PathSampler& sampler,
                         PathLight& light) {
  float& share = surface.glass.share;
  if (!(share > 0)) return false;
  const float chance = scattering_from(surface, wo).glass_chance();
  const bool chosen = sampler.glass(light.glass_met++).y < chance;
  light.throughput *= chosen ? share / chance : (1 - share) / (1 - chance);
  share = chosen ? 1 : 0;
  return chosen;
}

/// Traces a path. `Emitters` (SceneEmitters, GhostEmitters) answers what light there is:
///   along(depth, vertex, ray, distance, visit)    emitters without surface that the ray meets before
///   `distance`
///                                                 (infinite: it escapes); visit(group, radiance, light_pdf,
///                                                 emission)
///   surface(vertex, ray, hit, surface, visit)     the same for the surface it hits
///   sample_count(vertex)                          samples that give all light at a vertex
///   sample(i, vertex, u_choice, u)                optional<shading::LightSample>, the i-th of them
///   found_by_rays(vertex)                         whether rays that leave it can meet any light
///   may_meet(vertex, ray)                         whether this one might, were nothing in its way
/// `Visitor` receives first_hit(surface, ray_origin, ray, hit), of the first surface that the path does not
/// go straight through, and add(depth, group, value, emission), `emission` being the direction in which the
/// light left its emitter; where the options ask for it, also look_up(throughput, surface, ray_origin, ray,
/// hit, sampler), which returns the share of its specular light that it finds by paths of its own. With
/// `scattered_at` the ray is no camera's but leaves that vertex: its path begins at depth 1.
template <class Emitters, class Visitor>
void trace_path(const PosedGeometry& scene, const Emitters& emitters, Ray ray, const PathSampler& sampler,
                const PathOptions& options, RayTask& task, Visitor& visitor,
                const PathVertex* scattered_at = nullptr) {
  PathLight light;
  PathVertex vertex = scattered_at ? *scattered_at : PathVertex{ray.origin};
  bool met_any = scattered_at != nullptr;
  // The surface with the lookup is still to come
  bool looks_up = options.looks_up && (!scattered_at || scattered_at->followed);
  int depth = scattered_at ? 1 : 0;

  for (int vertices = depth;; ++vertices) {
    // Find the nearest surface on which the path does not go straight on.
    Hit hit;
    shading::Surface surface;
    vec3 ray_origin;
    PathSampler::Vertex random;
    const bool last = depth >= options.max_depth;
    // The last ray of a path looks for lights alone.
    if (last && depth > 0 && !emitters.may_meet(vertex, ray)) return;
    for (bool straight = true; straight;) {
      const bool found = scene.intersect(ray, sampler.passage(scene, vertices, false), task, hit);
      const float distance = found ? hit.distance : std::numeric_limits<float>::infinity();
      light.absorb(light.absorption, ray, distance);

      // Add the emitters that the ray meets, weighted against next-event estimation at the vertex before.
      const auto add_emitted = [&](int group, const vec3& radiance, float light_pdf, const vec3& emission) {
        float weight = 1;
        if (vertex.bsdf_pdf > 0 && options.strategy == Strategy::nee_only) return;
        if (vertex.bsdf_pdf > 0 && options.strategy == Strategy::mis)
          weight = shading::power_heuristic(vertex.bsdf_pdf, light_pdf);
        visitor.add(depth, group, light.throughput * radiance * weight, emission);
      };
      emitters.along(depth, vertex, ray, distance, add_emitted);
      if (!found) return;

      // Look up the surface, unless nothing of it is wanted any more.
      if (last && depth > 0 && !scene.emissive(hit.instance) && !scene.glass(hit.instance)) return;
      // Random numbers need nothing of the surface: drawn here, they fill the wait for its memory.
      random = sampler.vertex(vertices);
      surface = scene.surface(hit, -ray.direction, ray_origin);
      const shading::GlassParams& glass = surface.glass;
      if (!glass.sheet && glass.inside && light.absorption == vec3(0))
        light.absorb(glass.absorption, ray, distance);
      // What is unlit is seen, but lights nothing.
      const bool emits = max_component(surface.emission) > 0 && (depth == 0 || !surface.unlit);
      if (emits) emitters.surface(vertex, ray, hit, surface, add_emitted);
      straight =
          options.paths == rays::PathSet::all &&
          go_straight(surface, ray_origin, hit, options.looks_up && !looks_up, last, sampler, light, ray);
    }
    if (!met_any) visitor.first_hit(surface, ray_origin, ray, hit);
    met_any = true;
    if (last || surface.unlit) return;
    float followed = 0;
    if (looks_up) {
      looks_up = choose_glass(surface, -ray.direction, sampler, light);
      if constexpr (requires { visitor.look_up(light.throughput, surface, ray_origin, ray, hit, sampler); }) {
        if (!looks_up) followed = visitor.look_up(light.throughput, surface, ray_origin, ray, hit, sampler);
      }
    }

    const PathVertex before = vertex;
    vertex = {.position = surface.position,
              .normal = surface.geometric_normal,
              .looked_up = options.looks_up && !looks_up};
    if constexpr (requires { emitters.mirrored(); }) {
      const bool mirrors = emitters.mirrored() && max_component(surface.bsdf.f0) > 0;
      if (vertex.looked_up && mirrors) vertex.mirrored = vec3(1 - followed);
    }
    const vec3 beyond_surface = 2.0f * surface.position - ray_origin;  // where rays start that go through
    const Frame frame = Frame::around(surface.normal);
    const vec3 wo = frame.to_local(-ray.direction);
    if (options.paths == rays::PathSet::diffuse) {
      light.throughput *= 1 - surface.glass.share;
      surface.glass.share = 0;
    }
    const shading::ScatteringFrom scattering(
        surface, wo, options.paths == rays::PathSet::diffuse ? shading::Lobes::diffuse : shading::Lobes::all);
    const bool is_glass = surface.glass.share > 0;

    // Sample direct light.
    const bool samples_lights = options.strategy != Strategy::bsdf_only;
    const bool alone = options.strategy == Strategy::nee_only;
    const int light_samples = samples_lights ? emitters.sample_count(vertex) : 0;
    const Passage passage =
        sampler.passage(scene, vertices, true, options.looks_up && !looks_up, options.paths);
    for (int i = 0; i < light_samples; ++i) {
      const PathSampler::Vertex u = i == 0 ? random : sampler.light(i).vertex(vertices);
      const auto toward = emitters.sample(i, vertex, u.light, u.point);
      const float side = toward ? glm::dot(toward->wi, vertex.normal) : 0;
      if (!toward || !(toward->pdf > 0) || !(side > 0 || (is_glass && side < 0))) continue;
      const vec3 wi = frame.to_local(toward->wi);
      shading::BsdfValue f;
      if ((wi.z > 0) == (side > 0)) f = scattering.eval(wi);
      const vec3 arrives =
          next_event(scene, *toward, light.throughput * f.value * toward->radiance, alone ? 0 : f.pdf,
                     side > 0 ? ray_origin : beyond_surface, vertex.position, passage, task);
      if (max_component(arrives) > 0) visitor.add(depth + 1, toward->group, arrives, -toward->wi);
    }
    const bool by_panes = options.panes && !options.looks_up && options.paths == rays::PathSet::all;
    for (int i = 0; by_panes && depth + 2 <= options.max_depth && i < light_samples; ++i) {
      const PathSampler own = sampler.by_panes().light(i);
      const auto event =
          next_event_by_pane(scene, emitters, i, *options.panes, vertex, ray_origin, own.vertex(vertices),
                             alone, own.passage(scene, vertices, true), task, [&](const vec3& wi) {
                               const vec3 local = frame.to_local(wi);
                               return local.z > 0 ? scattering.eval(local) : shading::BsdfValue{};
                             });
      if (event) visitor.add(depth + 2, event->group, light.throughput * event->value, event->emission);
    }
    if constexpr (requires { emitters.mirrored(); }) {
      if (vertex.mirrored != vec3(0)) {
        const MirrorLobe lobe(surface, -ray.direction);
        const float chance = std::min(lobe.rays(), 1.0f);
        for (int i = 0; i < emitters.mirrored_sample_count(); ++i) {
          const PathSampler own = sampler.mirrored().light(i);
          const PathSampler::Vertex u = own.vertex(vertices);
          const auto toward = emitters.sample_mirrored(i, vertex, u.light, u.point);
          if (!toward || !(toward->pdf > 0) || !(u.roulette < chance)) continue;
          const vec3 reflected = vertex.mirrored * lobe.eval(toward->wi).value / chance;
          const vec3 arrives = next_event(scene, *toward, light.throughput * reflected * toward->radiance,
                                          scattering.eval(frame.to_local(toward->wi)).pdf, ray_origin,
                                          vertex.position, own.passage(scene, vertices, true, true), task);
          if (max_component(arrives) > 0) visitor.add(depth + 1, toward->group, arrives, -toward->wi);
        }
      }
    }
    if (!looks_up && depth + 1 == options.max_depth && !emitters.found_by_rays(vertex)) return;

    // Sample the BSDF; a direction that the shading normal allows but the surface does not ends the path.
    const auto sample = scattering.sample(random.lobe, random.direction);
    if (!sample || !(sample->pdf > 0 || sample->glass)) return;
    const vec3 wi = frame.to_world(sample->wi);
    const float side = glm::dot(wi, vertex.normal);
    if (!(sample->wi.z > 0 ? side > 0 : side < 0)) return;
    light.throughput *= sample->weight;
    light.spread *= sample->spread;
    if (sample->glass && !surface.glass.sheet)
      light.absorption = surface.glass.inside == (side > 0) ? surface.glass.absorption : vec3(0);
    vertex.bsdf_pdf = sample->pdf;
    if (vertex.mirrored != vec3(0)) vertex.mirrored *= specular_share(surface, wo, sample->wi);
    std::optional<PathVertex> image;
    if (by_panes && sample->glass && sample->pdf == 0 && side > 0)
      image = image_in_pane(*options.panes, before, surface, ray_origin, hit, wi,
                            sampler.passage(scene, vertices, true), ray);
    if (image) {
      vertex = *image;
    } else {
      ray = {side > 0 ? ray_origin : beyond_surface, wi};
    }

    // End paths by Russian roulette.
    const float brightness = max_component(light.throughput);
    if (!(brightness > 0) || !std::isfinite(brightness)) {
      if (!(brightness <= 0)) ++task.invalid;
      return;
    }
    if (options.roulette && vertices + 1 >= roulette_depth) {
      const float survival = std::min(brightness / light.spread, 0.95f);
      if (random.roulette >= survival) return;
      light.throughput /= survival;
    }
    if (!looks_up) ++depth;
  }
}

}  // namespace ssphh::trace
