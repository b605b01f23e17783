#pragma once
/// Scenes with the light of their surfels, and records where that asks for them.

#include <array>
#include <memory>
#include <span>
#include <vector>

#include <ssphh/probes/surface_interpolation.h>
#include <ssphh/rays/posed_world.h>
#include <ssphh/transport/surface_gather.h>

#include "transport_fixtures.h"

namespace ssphh::test {

using transport::Irradiance4;
using transport::SurfaceGather;

/// A scene with its surfels and the light that they solve.
struct SolvedScene {
  explicit SolvedScene(scene::Scene scene_in, float surfel_size = 0)
      : scene(std::move(scene_in)), source(scene), session(source, places_of(scene), params(surfel_size)) {
    session.update();
    lit = session.patch_irradiance();
    reflected = session.surfel_irradiance();
  }
  static transport::RelightParams params(float surfel_size) {
    transport::RelightParams params;
    params.transport = small_network();
    if (surfel_size > 0) params.transport.surfel_size = surfel_size;
    return params;
  }
  const transport::TransportNetwork& network() const { return session.network(); }
  std::unique_ptr<SurfaceGather> where_needed(int most, int rays) const {
    return gather_where_needed(network(), {most, rays}, std::array{0.0f}, [&](float) {
      return transport::PosedIrradiance{{}, lit, reflected};
    });
  }
  /// At each of some places, how far lookups between the gather's points are from `truth`.
  std::vector<double> errors_between(const SurfaceGather& gather, std::span<const rays::SurfacePoint> some,
                                     std::span<const probes::RecordLight> truth) const {
    std::vector<probes::RecordLight> light;
    gather.light(lit, light);
    const rays::PosedWorld world(source, 0);
    const probes::SurfaceInterpolation known(
        gather.points(), [&](const vec3& a, const vec3& b) { return world.visible(a, b); });
    std::vector<double> errors;
    for (std::size_t i = 0; i < some.size(); ++i) {
      vec3 found(0);
      known.irradiance(some[i], light, found);
      errors.push_back(double(glm::distance(found, truth[i][3])));
    }
    return errors;
  }

  scene::Scene scene;
  trace::TransportScene source;
  LitSession session;
  std::vector<Irradiance4> lit, reflected;
};

}  // namespace ssphh::test
