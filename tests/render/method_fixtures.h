#pragma once
/// A method of the table made for a scene, and how far it is from path tracing.

#include <memory>
#include <string>
#include <vector>

#include <ssphh/methods/method_list.h>
#include <ssphh/place/place.h>
#include <ssphh/scene/with_lighting.h>
#include <ssphh/study/leak.h>
#include <ssphh/study/lookup_error.h>
#include <ssphh/study/surface_points.h>
#include <ssphh/trace/path_tracer.h>
#include <ssphh/trace/transport_scene.h>

namespace ssphh::test {

struct MadeMethod {
  MadeMethod(const std::string& name, const std::vector<std::string>& settings, const scene::Scene& scene)
      : source(scene) {
    const methods::MethodEntry& entry = methods::find_method(name);
    method = entry.make({scene, source}, methods::MethodParameters(name, entry.parameters, settings), {});
  }

  std::vector<vec3> irradiance(const scene::LightingState& state,
                               std::span<const rays::SurfacePoint> points) {
    method->update(state, {});
    return study::look_up(method->light(), points);
  }

  trace::TransportScene source;
  std::unique_ptr<methods::Method> method;
};

/// Points that the scene's cameras and SPHLs can reach.
inline std::vector<rays::SurfacePoint> points_of(const scene::Scene& scene, int count, float time = 0) {
  const trace::TransportScene source(scene);
  const place::PlaceParams seen = place::place_params(scene, time);
  std::vector<vec3> origins = seen.interest;
  for (const scene::ProbePlace& place : seen.manual) origins.push_back(place.position);
  return study::reachable_points(source, origins, time, {count, 1});
}

inline std::vector<rays::IrradianceEstimate> truth_at(const scene::Scene& scene, float time,
                                                      std::span<const rays::SurfacePoint> points,
                                                      int max_depth, int spp) {
  const trace::PathTracer tracer(scene, time);
  return tracer.surface_irradiance(points, {.max_depth = max_depth, .passes = 1, .spp = spp, .seed = 5}, {});
}

/// Σ |looked up − true| / Σ true, as luminance: unlike relative errors, not decided by a dark nook.
inline double absolute_error(std::span<const vec3> found, std::span<const rays::IrradianceEstimate> truth) {
  double sum = 0, all = 0;
  for (std::size_t i = 0; i < found.size(); ++i) {
    const float t = luminance(truth[i].indirect);
    sum += static_cast<double>(std::abs(luminance(found[i]) - t));
    all += static_cast<double>(t);
  }
  return sum / all;
}

/// The scene as path tracing sees it in a state.
inline scene::Scene scene_in(const scene::Scene& scene, const scene::LightingState& state) {
  return scene::with_lighting(scene, state);
}

}  // namespace ssphh::test
