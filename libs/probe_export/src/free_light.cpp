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
struct Sight {
  vec3 place;
  std::vector<std::pair<vec3, bool>> probes;

  bool any() const {
    return std::ranges::any_of(probes, [](const auto& probe) { return probe.second; });
  }
};
thread_local Sight* current_sight = nullptr;

/// The sight of one place, for as long as it lives.
class Looking {
 public:
  explicit Looking(const vec3& place) : sight_{place, {}} { current_sight = &sight_; }
  ~Looking() { current_sight = nullptr; }
  Looking(const Looking&) = delete;
  Looking& operator=(const Looking&) = delete;
  bool any() const { return sight_.any(); }

 private:
  Sight sight_;
};

}  // namespace

FreeLight::FreeLight(const probes::ProbeSet& set, const rays::TransportSource& source,
                     probes::ProbeLight light)
    : world_(source, set.generator.time) {
  probes::LookupParams params;
  params.light = light;
  params.weights.method = params.weights.fallback;
  const std::vector<vec3> positions = scene::positions_of(set.probes);
  const auto sees = [this](const vec3&, const vec3& probe) {
    Sight& sight = *current_sight;
    for (const auto& [position, seen] : sight.probes)
      if (position == probe) return seen;
    sight.probes.emplace_back(probe, world_.visible(sight.place, probe));
    return sight.probes.back().second;
  };
  lookup_ = std::make_unique<probes::IrradianceLookup>(
      set, probes::make_weights(positions, sees, params.weights), params);
}

vec3 FreeLight::irradiance(const vec3& place, const vec3& normal, bool& seen) const {
  const Looking looking(place);
  const vec3 found = lookup_->irradiance({place, normal});
  seen = looking.any();
  return found;
}

LightAt FreeLight::at(const vec3& place) const {
  static const sh::SphereQuadrature rule = sh::sphere_quadrature(probes::max_irradiance_degree + degree);
  const Looking looking(place);
  LightAt result;
  result.light = sh::project(degree, rule, [&](const vec3& n) { return lookup_->irradiance({place, n}); });
  for (int l = 0; l <= degree; ++l) {
    for (int k = l * l; k < (l + 1) * (l + 1); ++k)
      result.light[k] /= static_cast<float>(sh::cosine_band_factor(l));
  }
  result.seen = looking.any();
  return result;
}

}  // namespace ssphh::probe_export
