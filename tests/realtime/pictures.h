#pragma once
/// The same picture by OpenGL and by tracing.

#include <random>

#include <ssphh/probes/lookup.h>
#include <ssphh/realtime/renderer.h>
#include <ssphh/study/surface_points.h>
#include <ssphh/trace/path_tracer.h>
#include <ssphh/trace/transport_scene.h>

#include "pixel_points.h"

namespace ssphh::test {

/// To be quick where no shadow's edge is compared.
inline const realtime::RendererParams small_maps{
    .light_map_size = 256, .sun_map_size = 256, .environment_map_size = 256};

/// Probes at the scene's SPHLs with made-up light of degree 4, positive and different in every direction: a
/// lookup that is wrong anywhere shows.
inline probes::ProbeSet made_up_probes(const std::vector<vec3>& places, unsigned seed = 1) {
  std::mt19937 random(seed);
  std::uniform_real_distribution<float> mean(0.5f, 2), rest(-0.25f, 0.25f);
  probes::ProbeSet set;
  set.degree = 4;
  set.light_groups = {{"made up", vec3(1)}};
  for (const vec3& place : places) {
    probes::Probe probe;
    probe.position = place;
    probes::GroupLight light{sh::RadianceSh(4), sh::RadianceSh(4)};
    light.reflected[0] = vec3(mean(random), mean(random), mean(random));
    for (int k = 1; k < 25; ++k) light.reflected[k] = vec3(rest(random), rest(random), rest(random));
    probe.groups.push_back(light);
    set.probes.push_back(probe);
  }
  probes::merge_groups(set);
  return set;
}

inline std::vector<vec3> probe_places(const scene::Scene& scene) {
  std::vector<vec3> places;
  for (const scene::ProbePlace& p : scene::sphl_places(scene)) places.push_back(p.position);
  return places;
}

inline probes::ProbeSet made_up_probes(const scene::Scene& scene) {
  return made_up_probes(probe_places(scene));
}

/// Smooth enough that it is nowhere dark, where tiles interpolate between what is cut off at 0.
inline probes::ProbeSet smooth_probes(const std::vector<vec3>& places) {
  probes::ProbeSet set = made_up_probes(places);
  for (probes::Probe& probe : set.probes) {
    for (probes::GroupLight& light : probe.groups) {
      for (int k = 0; k < 25; ++k) {
        const float band = std::floor(std::sqrt(static_cast<float>(k)));
        light.reflected[k] *= k == 0 ? 2 : 1 / (band * band);
      }
    }
  }
  probes::merge_groups(set);
  return set;
}

/// Points all over the still surfaces with smooth weights of the nearest visible probes.
inline probes::FittedPoints made_up_fit(const scene::Scene& scene, const probes::ProbeSet& probes,
                                        int count) {
  const trace::TransportScene source(scene);
  const trace::PathTracer tracer(scene);
  std::vector<vec3> places;
  for (const probes::Probe& probe : probes.probes) places.push_back(probe.position);
  probes::WeightParams params;
  params.method = probes::WeightMethod::distance;
  const auto weights = probes::make_weights(
      places, [&](const vec3& a, const vec3& b) { return tracer.visible(a, b); }, params);
  study::SurfacePointParams points;
  points.count = count;
  probes::FittedPoints fitted;
  for (const rays::SurfacePoint& point : study::reachable_points(source, places, 0, points)) {
    if (point.moves) continue;
    const probes::ProbeWeights found = weights->at(point);
    fitted.points.push_back(point);
    probes::PointWeights& kept = fitted.weights.emplace_back();
    for (const probes::ProbeWeight& weight : found.used()) kept.add(weight.probe, weight.weight);
  }
  return fitted;
}

/// Records at such points: light that varies with the place and as the surface turns.
inline probes::SurfaceRecords made_up_records(const std::vector<rays::SurfacePoint>& points,
                                              const std::vector<probes::LightGroup>& groups) {
  probes::SurfaceRecords records;
  records.points = points;
  std::vector<vec3> scales;
  for (const probes::LightGroup& group : groups) {
    scales.push_back(group.scale);
    const float phase = static_cast<float>(scales.size());
    std::vector<probes::PackedRecordLight>& kept = records.groups.emplace_back();
    for (const rays::SurfacePoint& p : points) {
      probes::RecordLight light(0);
      light[3] = vec3(1.5f) + glm::sin(phase + 0.7f * p.position + 0.4f * p.normal);
      for (glm::length_t c = 0; c < 3; ++c)
        light[c] = 0.5f * glm::sin(vec3(phase + float(c), 2, 3) + p.position);
      kept.push_back(probes::pack(light, p.normal));
    }
  }
  probes::merge_groups(records, scales);
  return records;
}

inline probes::SurfaceLists listed(const scene::Scene& scene, const std::vector<rays::SurfacePoint>& points,
                                   const trace::PathTracer& tracer) {
  return probes::prepare_surfaces(scene, 0, points,
                                  [&](const vec3& a, const vec3& b) { return tracer.visible(a, b); });
}

inline void set_records(realtime::Renderer& renderer, const scene::Scene& scene,
                        const probes::SurfaceRecords& records, const trace::PathTracer& tracer) {
  renderer.set_records(listed(scene, records.points, tracer));
  renderer.set_record_light(records.light);
}

inline mat4 light_world(const scene::Scene& scene, std::size_t light) {
  const int node = scene.lights[light].node;
  return node < 0 ? mat4(1) : scene::world_matrices(scene, 0)[node];
}

inline probes::FittedSurfaces prepared(const scene::Scene& scene, const probes::FittedPoints& fitted,
                                       const trace::PathTracer& tracer) {
  return probes::prepare_fitted(scene, 0, fitted,
                                [&](const vec3& a, const vec3& b) { return tracer.visible(a, b); });
}

/// A lookup as OpenGL takes it, which follows no mirrored ways.
struct WithoutMirrors final : rays::IndirectLight {
  explicit WithoutMirrors(const rays::IndirectLight& all) : light(all) {}
  vec3 irradiance(const rays::SurfacePoint& at) const override { return light.irradiance(at); }
  vec3 glossy(const rays::SurfacePoint& at, const vec3& r, float roughness) const override {
    return light.glossy(at, r, roughness);
  }
  std::vector<std::string> direct_groups() const override { return light.direct_groups(); }
  std::vector<std::string> mirrored_groups() const override { return light.mirrored_groups(); }
  bool follows_mirrors() const override { return false; }

  const rays::IndirectLight& light;
};

/// Direct light traced, indirect light looked up (none: max_depth 1).
inline image::Image traced(const scene::Scene& scene, const rays::IndirectLight* indirect, PictureSize size,
                           int spp, std::uint64_t seed, const trace::PathTracer& tracer) {
  trace::RenderParams params;
  params.width = size.width, params.height = size.height;
  params.camera = scene::camera_pose(scene, "");
  params.path = {indirect ? 2 : 1, 1, spp, seed};
  if (params.camera.camera.orthographic) params.projection = trace::Projection::orthographic;
  trace::RenderState state;
  indirect ? tracer.render_with(WithoutMirrors(*indirect), params, state) : tracer.render(params, state);
  return trace::resolve(state.color, state.passes_done);
}

inline image::Image drawn(realtime::Renderer& renderer, const scene::Scene& scene, PictureSize size,
                          realtime::FrameSettings settings = {}) {
  settings.supersample = 4;
  renderer.draw(scene::camera_pose(scene, ""), settings, {.width = size.width, .height = size.height});
  return renderer.read_back();
}

inline double mean_luminance(const image::Image& image) {
  double sum = 0;
  for (int y = 0; y < image.height; ++y) {
    for (int x = 0; x < image.width; ++x) sum += static_cast<double>(luminance(image.rgb(x, y)));
  }
  return sum / (static_cast<double>(image.width) * image.height);
}

}  // namespace ssphh::test
