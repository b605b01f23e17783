#include <algorithm>

#include <ssphh/core/sphere.h>
#include <ssphh/probe_export/free_light.h>
#include <ssphh/scene/probe_place.h>
#include <ssphh/sh/irradiance.h>
#include <ssphh/sh/project.h>

namespace ssphh::probe_export {
namespace {

constexpr int degree = 2;

/// Which probes a place sees: each is asked for by one ray, whatever the normal that the lookup has in mind.
class Sight {
 public:
  Sight(const rays::PosedWorld& world, const vec3& place) : world_(world), place_(place) {}

  bool sees(const vec3& probe) {
    for (const auto& [position, seen] : probes_)
      if (position == probe) return seen;
    probes_.emplace_back(probe, world_.visible(place_, probe));
    return probes_.back().second;
  }
  bool any() const {
    return std::ranges::any_of(probes_, [](const auto& probe) { return probe.second; });
  }

 private:
  const rays::PosedWorld& world_;
  vec3 place_;
  std::vector<std::pair<vec3, bool>> probes_;
};

}  // namespace

FreeLight::FreeLight(const probes::ProbeSet& set, const rays::TransportSource& source,
                     probes::ProbeLight light)
    : world_(source, set.generator.time) {
  probes::LookupParams params;
  params.light = light;
  params.weights.method = params.weights.fallback;
  const std::vector<vec3> positions = scene::positions_of(set.probes);
  weights_ = probes::make_visible_weights(positions, params.weights);
  const auto sees = [this](const vec3& a, const vec3& b) { return world_.visible(a, b); };
  lookup_ = std::make_unique<probes::IrradianceLookup>(
      set, probes::make_weights(positions, sees, params.weights), params);
}

vec3 FreeLight::irradiance(const vec3& place, const vec3& normal, bool& seen) const {
  Sight sight(world_, place);
  const probes::SeesProbe sees = [&sight](const vec3&, const vec3& probe) { return sight.sees(probe); };
  const rays::SurfacePoint at{place, normal};
  const vec3 found = lookup_->irradiance(at, weights_->at(at, sees));
  seen = sight.any();
  return found;
}

LightAt FreeLight::at(const vec3& place) const {
  static const sh::SphereQuadrature rule = sh::sphere_quadrature(probes::max_irradiance_degree + degree);
  Sight sight(world_, place);
  const probes::SeesProbe sees = [&sight](const vec3&, const vec3& probe) { return sight.sees(probe); };
  LightAt result;
  result.light = sh::project(degree, rule, [&](const vec3& n) {
    const rays::SurfacePoint at{place, n};
    return lookup_->irradiance(at, weights_->at(at, sees));
  });
  for (int l = 0; l <= degree; ++l) {
    for (int k = l * l; k < (l + 1) * (l + 1); ++k)
      result.light[k] /= static_cast<float>(sh::cosine_band_factor(l));
  }
  result.seen = sight.any();
  return result;
}

}  // namespace ssphh::probe_export
