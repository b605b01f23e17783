#include <algorithm>
#include <cmath>

#include <fmt/format.h>

#include <ssphh/core/error.h>
#include <ssphh/core/parallel.h>
#include <ssphh/gi/fitted_weights.h>
#include <ssphh/sh/evaluate.h>
#include <ssphh/sh/irradiance.h>

#include "nearest.h"
#include "transport/probe_light.h"
#include "transport/sphl_emission.h"

namespace ssphh::gi {
namespace {

/// One training light, solved: what leaves each surfel, and each probe's irradiance function.
struct Training {
  std::vector<vec3> radiosity;  ///< per surfel
  std::vector<sh::IrradianceSh> probes;
};

/// Probes far apart: begin with the first, then always the one farthest from all taken.
std::vector<std::size_t> spread_probes(const std::vector<vec3>& positions, std::size_t count) {
  std::vector<float> distance2(positions.size(), std::numeric_limits<float>::infinity());
  std::vector<std::size_t> chosen;
  for (std::size_t next = 0; chosen.size() < std::min(count, positions.size());) {
    chosen.push_back(next);
    const vec3 last = positions[next];
    float farthest = -1;
    for (std::size_t i = 0; i < positions.size(); ++i) {
      const vec3 d = positions[i] - last;
      distance2[i] = std::min(distance2[i], glm::dot(d, d));
      if (distance2[i] > farthest) farthest = distance2[i], next = i;
    }
    if (!(farthest > 0)) break;
  }
  return chosen;
}

Training train(const TransportNetwork& network, const scene::TransportSource& source,
               const DirectionProjector& projector, std::size_t probe) {
  const std::size_t samples = static_cast<std::size_t>(network.params().samples);
  SphlEmitter light{network.gbuffer().positions[probe], 0.01f, sh::RadianceSh(0)};
  light.leaving[0] = vec3(1e4f);
  std::vector<vec3> at_samples(network.samples().size(), vec3(0));
  add_emission(network, source, light, at_samples);
  std::vector<Irradiance4> direct(network.surfel_count(), Irradiance4(0)), indirect;
  for (std::size_t s = 0; s < direct.size(); ++s) {
    float used = 0;
    for (std::size_t i = s * samples; i < (s + 1) * samples; ++i) {
      if (!network.sample_used()[i]) continue;
      direct[s] += vec4(at_samples[i], 0);
      ++used;
    }
    direct[s] /= std::max(used, 1.0f);
  }
  Solver solver;
  solver.solve(network.links(), network.albedo(), direct, network.contraction().upper, {1e-4f, 300},
               indirect);
  for (std::size_t s = 0; s < direct.size(); ++s) direct[s] += indirect[s];

  Training training;
  for (std::size_t s = 0; s < direct.size(); ++s)
    training.radiosity.push_back(network.albedo()[s] * vec3(direct[s]));
  std::vector<sh::RadianceSh> radiance;
  project_reflected(network, projector, direct, radiance);
  for (const sh::RadianceSh& r : radiance) training.probes.push_back(sh::irradiance_from_radiance(r));
  return training;
}

/// The nearest probes that see a point; visibility as the lookups have it.
std::vector<int> visible_probes(const TransportNetwork& network, const scene::TransportSource& source,
                                const NearestPoints& nearest, float offset, const scene::SurfacePoint& point,
                                int wanted) {
  std::array<Near, 48> near;
  const int count = nearest.find(point.position, near);
  std::vector<int> visible;
  for (int i = 0; i < count && static_cast<int>(visible.size()) < wanted; ++i) {
    const int probe = near[static_cast<std::size_t>(i)].index;
    const vec3 from = point.position + offset * point.normal;
    if (sees(network, source, from, network.gbuffer().positions[static_cast<std::size_t>(probe)]))
      visible.push_back(probe);
  }
  return visible;
}

void check(const FitParams& params) {
  const auto within = [](const char* name, int value, int low, int high) {
    if (value < low || value > high) throw Error(name, fmt::format("{} is outside {}..{}", value, low, high));
  };
  within("fitted probes", params.probes, 1, max_weights);
  within("training lights", params.training_lights, 1, 1024);
  within("gather rays", params.gather_rays, 4, 1 << 16);
  within("fit degree", params.degree, 0, sh::max_degree);
}

}  // namespace

FittedPoints fit_weights(const TransportNetwork& network, const scene::TransportSource& source,
                         std::span<const scene::SurfacePoint> points, const FitParams& params,
                         const Control& control) {
  check(params);
  const std::vector<vec3>& positions = network.gbuffer().positions;
  const DirectionProjector projector(params.degree, network.gbuffer().directions);
  std::vector<Training> training;
  {
    const auto lights = spread_probes(positions, static_cast<std::size_t>(params.training_lights));
    ProgressStage progress(control, "training", lights.size(), "lights");
    for (const std::size_t probe : lights) {
      control.check();
      training.push_back(train(network, source, projector, probe));
      progress.advance(1);
    }
  }

  FittedPoints fitted;
  fitted.points.assign(points.begin(), points.end());
  fitted.weights.resize(points.size());
  const auto rays = static_cast<std::size_t>(params.gather_rays);
  const std::vector<std::int32_t> seen = network.gather(points, params.gather_rays, control);
  const NearestPoints nearest(positions);
  const float offset = 0.01f * std::min(median_spacing(positions), 2.0f);
  ProgressStage progress(control, "fitting", points.size(), "points");
  parallel_for(
      points.size(), 32,
      [&](std::size_t begin, std::size_t end) {
        std::vector<double> rows, targets, prior;
        std::vector<float> basis(static_cast<std::size_t>(sh::coefficient_count(params.degree)));
        for (std::size_t p = begin; p < end; ++p) {
          const std::vector<int> probes =
              visible_probes(network, source, nearest, offset, points[p], params.probes);
          if (probes.empty()) continue;
          sh::eval_basis(params.degree, points[p].normal, basis);

          // One equation per training light and channel, each relative to its own light.
          rows.clear();
          targets.clear();
          for (const Training& light : training) {
            vec3 truth(0);
            for (std::size_t r = 0; r < rays; ++r) {
              const std::int32_t s = seen[p * rays + r];
              if (s != no_surfel) truth += light.radiosity[static_cast<std::size_t>(s)];
            }
            truth /= static_cast<float>(rays);
            std::vector<vec3> values;
            vec3 mean(0);
            for (const int probe : probes) {
              vec3 e(0);
              const sh::IrradianceSh& function = light.probes[static_cast<std::size_t>(probe)];
              for (std::size_t k = 0; k < basis.size(); ++k) e += basis[k] * function.values[k];
              values.push_back(e);
              mean += e / static_cast<float>(probes.size());
            }
            for (glm::length_t c = 0; c < 3; ++c) {
              const double scale = 1 / std::max({double(truth[c]), 0.1 * double(mean[c]), 1e-12});
              for (const vec3& e : values) rows.push_back(double(e[c]) * scale);
              targets.push_back(double(truth[c]) * scale);
            }
          }
          prior.assign(probes.size(), 1.0 / static_cast<double>(probes.size()));
          const std::vector<double> v = fit_non_negative(rows, targets, prior, double(params.ridge));
          ProbeWeights& out = fitted.weights[p];
          for (std::size_t i = 0; i < probes.size(); ++i) {
            if (v[i] > 0)
              out.entries[static_cast<std::size_t>(out.count++)] = {probes[i], static_cast<float>(v[i])};
          }
        }
        progress.advance(end - begin);
      },
      control);
  return fitted;
}

std::vector<scene::SurfacePoint> surfel_points(const TransportNetwork& network, int per_surfel) {
  const auto samples = static_cast<std::size_t>(network.params().samples);
  const std::size_t wanted = std::min(static_cast<std::size_t>(std::max(per_surfel, 1)), samples);
  const std::vector<Surfel>& surfels = network.surfels().surfels();
  std::vector<scene::SurfacePoint> points;
  for (std::size_t s = 0; s < surfels.size() && surfels[s].part == 0; ++s) {
    for (std::size_t i = s * samples; i < s * samples + wanted; ++i) {
      if (network.sample_exists(i)) points.push_back(network.samples()[i]);
    }
  }
  return points;
}

}  // namespace ssphh::gi
