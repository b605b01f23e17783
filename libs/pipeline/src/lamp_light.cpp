#include <algorithm>
#include <optional>

#include <ssphh/bake/transport_bake.h>
#include <ssphh/core/parallel.h>
#include <ssphh/core/require.h>
#include <ssphh/pipeline/lamp_light.h>
#include <ssphh/probes/lookup.h>
#include <ssphh/probes/surface_interpolation.h>
#include <ssphh/scene/probe_place.h>
#include <ssphh/transport/session_sets.h>

namespace ssphh::pipeline {
namespace {

transport::RelightParams session_params(const probes::ProbeSet& set) {
  const bake::TransportBakeParams baked = bake::transport_params_of(set);
  transport::RelightParams params{baked.transport, baked.solve};
  params.degree = std::min(set.degree, probes::max_irradiance_degree);
  return params;
}

}  // namespace

struct LampLight::Data {
  const rays::RadianceSource& sight;
  std::vector<rays::SurfacePoint> points;
  transport::RelightSession session;
  scene::LightingState dark;       ///< the scene's lights, every group off
  std::vector<int> group_of = {};  ///< of each light
  probes::ProbeSet set = {};
  std::optional<probes::IrradianceLookup> probes = {};  ///< for points that no record reaches
  std::vector<probes::SurfaceShare> shares = {};        ///< of the records, point after point
  std::vector<std::size_t> first = {};                  ///< of each point, and the end
  std::vector<vec3> light = {};

  /// What of the records counts at each point is the same wherever the lamp is.
  void find_shares(const Control& control) {
    first.assign(points.size() + 1, 0);
    if (!set.surface) return;
    const probes::SurfaceInterpolation records(
        set.surface->points, [this](const vec3& a, const vec3& b) { return sight.joined(a, b); });
    std::vector<std::vector<probes::SurfaceShare>> found(points.size());
    parallel_for(points.size(), 64, [&](std::size_t i) {
      probes::SurfaceShares storage;
      const auto at = records.at(points[i], storage);
      found[i].assign(at.begin(), at.end());
    });
    control.check();
    for (std::size_t i = 0; i < found.size(); ++i) {
      shares.insert(shares.end(), found[i].begin(), found[i].end());
      first[i + 1] = shares.size();
    }
  }
  vec3 at(std::size_t i) const {
    if (first[i] == first[i + 1]) return probes->irradiance(points[i]);
    probes::RecordLight sum(0);
    for (std::size_t k = first[i]; k < first[i + 1]; ++k)
      sum += shares[k].weight * set.surface->light[shares[k].point];
    return glm::max(sum * vec4(points[i].normal, 1), vec3(0));
  }
};

LampLight::LampLight(const rays::TransportSource& source, const rays::RadianceSource& sight,
                     const probes::ProbeSet& set, std::vector<rays::SurfacePoint> points,
                     const Control& control)
    : data_(std::make_unique<Data>(Data{
          .sight = sight,
          .points = std::move(points),
          .session = {source, scene::places_of(set.probes), session_params(set), set.generator.time, control},
          .dark = rays::lighting_at(source, set.generator.time)})) {
  Data& d = *data_;
  for (std::size_t i = 0; i < d.dark.lights.size(); ++i)
    d.group_of.push_back(source.light_group_of(static_cast<int>(i)));
  d.session.update(d.dark, control);
  if (set.surface && !set.surface->points.empty())
    d.session.keep_records_at(set.surface->points, {.rays = transport::GatherParams{}.rays}, control);
  d.dark.group_scales.assign(d.dark.group_scales.size(), vec3(0));
  d.set = transport::lookup_set(d.session);
  // Of the probes alone: the records are summed here.
  probes::LookupParams lookup;
  lookup.weights.method = lookup.weights.fallback;
  d.probes.emplace(d.set, sight, lookup);
  d.find_shares(control);
  d.light.resize(d.points.size());
}
LampLight::~LampLight() = default;
LampLight::LampLight(LampLight&&) noexcept = default;
LampLight& LampLight::operator=(LampLight&&) noexcept = default;

std::span<const vec3> LampLight::at(std::size_t light, const vec3& place, const Control& control) {
  Data& d = *data_;
  require(light < d.dark.lights.size(), "light of a lamp", "there is no light of that index");
  require(is_finite(place), "light of a lamp", "its place must be finite");
  scene::LightingState state = d.dark;
  const int group = d.group_of[light];
  state.group_scales[static_cast<std::size_t>(group)] = vec3(1);
  for (std::size_t i = 0; i < state.lights.size(); ++i)
    if (i != light && d.group_of[i] == group) state.lights[i].intensity = 0;
  state.lights[light].world[3] = vec4(place, 1);
  d.session.update(state, control);
  transport::refresh(d.set, d.session);
  d.probes->swap_light(d.set);
  parallel_for(d.points.size(), 256, [&](std::size_t i) { d.light[i] = d.at(i); });
  return d.light;
}

}  // namespace ssphh::pipeline
