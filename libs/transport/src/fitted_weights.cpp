#include <algorithm>
#include <cmath>

#include <fmt/format.h>

#include <ssphh/core/error.h>
#include <ssphh/core/parallel.h>
#include <ssphh/geometry/nearest.h>
#include <ssphh/probes/lookup_weights.h>
#include <ssphh/sh/evaluate.h>
#include <ssphh/sh/irradiance.h>
#include <ssphh/transport/direct_field.h>
#include <ssphh/transport/fitted_weights.h>

#include "probe_light.h"
#include "sphl_emission.h"

namespace ssphh::transport {
namespace {

/// One light in one pose, solved: each probe's irradiance function, and the irradiance at each point.
struct Lesson {
  std::vector<sh::IrradianceSh> probes;
  std::vector<vec3> points;
  double weight;
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

/// Direct irradiance of patches from an isotropic light at a probe.
std::vector<Irradiance4> light_at(const TransportNetwork& network, const rays::TransportSource& source,
                                  std::size_t probe) {
  SphlEmitter light{network.gbuffer().positions[probe], 0.01f, sh::RadianceSh(0)};
  light.leaving[0] = vec3(1e4f);
  std::vector<vec3> at_samples(network.samples().size(), vec3(0));
  add_emission(network, source, light, at_samples);
  std::vector<Irradiance4> direct;
  DirectField(network, 0).sum({}, at_samples, direct);
  return direct;
}

Lesson solve_light(const TransportNetwork& network, const DirectionProjector& projector,
                   std::span<const std::int32_t> seen, std::size_t rays, std::span<const Irradiance4> direct,
                   double weight) {
  std::vector<Irradiance4> bounced, all(direct.begin(), direct.end());
  Solver solver;
  solver.solve(network.links(), network.albedo(), direct, chebyshev_bound(network.contraction()),
               {1e-4f, 300}, bounced);
  for (std::size_t p = 0; p < all.size(); ++p) all[p] += bounced[network.surfel_of(p)];
  std::vector<sh::RadianceSh> radiance;
  project_reflected(network, projector, all, radiance);

  Lesson lesson;
  lesson.weight = weight;
  for (const sh::RadianceSh& r : radiance) lesson.probes.push_back(sh::irradiance_from_radiance(r));
  lesson.points.resize(seen.size() / rays);
  parallel_for(lesson.points.size(), 256, [&](std::size_t begin, std::size_t end) {
    for (std::size_t p = begin; p < end; ++p) {
      vec3 sum(0);
      for (std::size_t r = p * rays; r < (p + 1) * rays; ++r) {
        if (seen[r] == no_patch) continue;
        const auto p_seen = static_cast<std::size_t>(seen[r]);
        sum += network.albedo()[p_seen] * vec3(all[p_seen]);
      }
      lesson.points[p] = sum / static_cast<float>(rays);
    }
  });
  return lesson;
}

/// The nearest probes that see a point; visibility as the lookups have it.
std::vector<int> visible_probes(const TransportNetwork& network, const rays::TransportSource& source,
                                const geometry::NearestPoints& nearest, float offset,
                                const rays::SurfacePoint& point, int wanted) {
  std::array<geometry::Near, 48> near;
  const int count = nearest.find(point.position, near);
  std::vector<int> visible;
  for (int i = 0; i < count && static_cast<int>(visible.size()) < wanted; ++i) {
    const int probe = near[i].index;
    const vec3 from = point.position + offset * point.normal;
    if (sees(network, source, from, network.gbuffer().positions[probe])) visible.push_back(probe);
  }
  return visible;
}

void check(const FitParams& params) {
  const auto within = [](const char* name, int value, int low, int high) {
    if (value < low || value > high) throw Error(name, fmt::format("{} is outside {}..{}", value, low, high));
  };
  within("fitted probes", params.probes, 1, probes::max_weights);
  within("training lights", params.training_lights, 1, 1024);
  within("gather rays", params.gather_rays, 4, 1 << 16);
  within("fit degree", params.degree, 0, sh::max_degree);
  if (!(params.own_weight > 0) || !(params.own_weight <= 1000))
    throw Error("own weight", fmt::format("{} is outside 0..1000", params.own_weight));
}

}  // namespace

struct WeightFit::Data {
  FitParams params;
  std::vector<rays::SurfacePoint> points;
  std::vector<Lesson> lessons;
  std::vector<std::vector<int>> probes;  ///< per point: those that it sees in some pose

  probes::PointWeights fit(std::size_t point) const;
};

/// One equation per light, pose and channel, each relative to its own light. Dividing by the truth makes
/// least squares too dark by about the variance of what is left over, so the sum of the equations is met at
/// last.
probes::PointWeights WeightFit::Data::fit(std::size_t point) const {
  const std::vector<int>& candidates = probes[point];
  if (candidates.empty()) return {};
  std::vector<float> basis(static_cast<std::size_t>(sh::coefficient_count(params.degree)));
  sh::eval_basis(params.degree, points[point].normal, basis);
  const std::size_t count = candidates.size();
  std::vector<double> rows, targets;
  std::vector<vec3> values(count);
  for (const Lesson& lesson : lessons) {
    const vec3 truth = lesson.points[point];
    vec3 mean(0);
    for (std::size_t i = 0; i < count; ++i) {
      const sh::IrradianceSh& function = lesson.probes[candidates[i]];
      values[i] = vec3(0);
      for (std::size_t k = 0; k < basis.size(); ++k) values[i] += basis[k] * function.values[k];
      mean += values[i] / static_cast<float>(count);
    }
    for (glm::length_t c = 0; c < 3; ++c) {
      const double scale = lesson.weight / std::max({double(truth[c]), 0.1 * double(mean[c]), 1e-12});
      for (const vec3& e : values) rows.push_back(double(e[c]) * scale);
      targets.push_back(double(truth[c]) * scale);
    }
  }
  const std::vector<double> prior(count, 1.0 / static_cast<double>(count));
  const std::vector<double> v = fit_non_negative(rows, targets, prior, double(params.ridge));
  double wanted = 0, got = 0;
  for (std::size_t q = 0; q < targets.size(); ++q) {
    wanted += targets[q];
    for (std::size_t i = 0; i < count; ++i) got += rows[q * count + i] * v[i];
  }
  const double scale = got > 0 && wanted > 0 ? wanted / got : 1;

  // The largest, should several poses have brought more than a point may have.
  std::vector<std::size_t> order;
  for (std::size_t i = 0; i < count; ++i) {
    if (v[i] > 0) order.push_back(i);
  }
  std::stable_sort(order.begin(), order.end(), [&](std::size_t a, std::size_t b) { return v[a] > v[b]; });
  order.resize(std::min<std::size_t>(order.size(), probes::max_weights));
  std::sort(order.begin(), order.end());
  probes::PointWeights out;
  for (const std::size_t i : order) out.add(candidates[i], static_cast<float>(scale * v[i]));
  return out;
}

WeightFit::WeightFit(std::vector<rays::SurfacePoint> points, const FitParams& params) {
  check(params);
  const std::size_t count = points.size();
  data_ =
      std::unique_ptr<Data>(new Data{params, std::move(points), {}, std::vector<std::vector<int>>(count)});
}
WeightFit::~WeightFit() = default;
WeightFit::WeightFit(WeightFit&&) noexcept = default;

void WeightFit::add_pose(const TransportNetwork& network, const rays::TransportSource& source,
                         std::span<const SurfelLight> lights, const Control& control) {
  Data& d = *data_;
  const std::vector<vec3>& positions = network.gbuffer().positions;
  const DirectionProjector projector(d.params.degree, network.gbuffer().directions);
  const auto rays = static_cast<std::size_t>(d.params.gather_rays);
  const std::vector<std::int32_t> seen = network.gather(d.points, d.params.gather_rays, control);
  const auto chosen = spread_probes(positions, static_cast<std::size_t>(d.params.training_lights));
  ProgressStage progress(control, "training", chosen.size() + lights.size(), "lights");
  const auto learn = [&](std::span<const Irradiance4> direct, double weight) {
    control.check();
    d.lessons.push_back(solve_light(network, projector, seen, rays, direct, weight));
    progress.advance(1);
  };
  for (const std::size_t probe : chosen) learn(light_at(network, source, probe), 1);
  for (const SurfelLight& light : lights) learn(light, double(d.params.own_weight));

  const geometry::NearestPoints nearest(positions);
  const float offset = 0.01f * std::min(probes::median_spacing(positions), 2.0f);
  parallel_for(
      d.points.size(), 32,
      [&](std::size_t begin, std::size_t end) {
        for (std::size_t p = begin; p < end; ++p) {
          std::vector<int>& known = d.probes[p];
          for (const int probe :
               visible_probes(network, source, nearest, offset, d.points[p], d.params.probes)) {
            if (std::find(known.begin(), known.end(), probe) == known.end()) known.push_back(probe);
          }
        }
      },
      control);
}

probes::FittedPoints WeightFit::solve(const Control& control) const {
  const Data& d = *data_;
  probes::FittedPoints fitted;
  fitted.points = d.points;
  fitted.weights.resize(d.points.size());
  ProgressStage progress(control, "fitting", d.points.size(), "points");
  parallel_for(
      d.points.size(), 32,
      [&](std::size_t begin, std::size_t end) {
        for (std::size_t p = begin; p < end; ++p) fitted.weights[p] = d.fit(p);
        progress.advance(end - begin);
      },
      control);
  return fitted;
}

probes::FittedPoints fit_weights(const TransportNetwork& network, const rays::TransportSource& source,
                                 std::span<const rays::SurfacePoint> points, const FitParams& params,
                                 std::span<const SurfelLight> lights, const Control& control) {
  WeightFit fit({points.begin(), points.end()}, params);
  fit.add_pose(network, source, lights, control);
  return fit.solve(control);
}

std::vector<rays::SurfacePoint> surfel_points(const TransportNetwork& network, int per_surfel) {
  const auto samples = static_cast<std::size_t>(network.params().samples);
  const std::size_t wanted = std::min(static_cast<std::size_t>(std::max(per_surfel, 1)), samples);
  const std::vector<Surfel>& surfels = network.surfels().surfels();
  std::vector<rays::SurfacePoint> points;
  for (std::size_t s = 0; s < surfels.size() && surfels[s].part == 0; ++s) {
    for (std::size_t i = s * samples; i < s * samples + wanted; ++i) {
      if (network.sample_exists(i)) points.push_back(network.samples()[i]);
    }
  }
  return points;
}

}  // namespace ssphh::transport
