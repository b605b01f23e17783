#include <algorithm>
#include <cmath>

#include <ssphh/core/parallel.h>
#include <ssphh/gi/transport/bounce.h>
#include <ssphh/sh/evaluate.h>
#include <ssphh/sh/irradiance.h>

#include "probe_light.h"
#include "sphl_emission.h"

namespace ssphh::gi {

struct BounceOperator::Data {
  const TransportNetwork& network;
  BounceParams params;
  DirectionProjector projector;
  std::vector<std::size_t> begin;    ///< per probe ray, into weights; and the end
  std::vector<ProbeWeight> weights;  ///< lookup weights at the rays' hits
  std::vector<float> basis;          ///< A_l Y_k(n) at each hit, [ray][k]
  std::size_t edges = 0;

  std::size_t bands() const {
    return static_cast<std::size_t>(sh::coefficient_count(params.irradiance_degree));
  }

  /// Indirect irradiance at what each ray of a probe sees, as the probes give it.
  vec3 look_up(std::size_t ray, const std::vector<sh::RadianceSh>& probes) const {
    const std::size_t count = bands();
    vec3 sum(0);
    for (std::size_t w = begin[ray]; w < begin[ray + 1]; ++w) {
      const sh::RadianceSh& s = probes[static_cast<std::size_t>(weights[w].probe)];
      vec3 e(0);
      for (std::size_t k = 0; k < count; ++k) e += basis[ray * count + k] * s.values[k];
      sum += weights[w].weight * e;
    }
    return glm::max(sum, vec3(0));
  }

  /// S = D + B S of all probes.
  void apply(std::span<const Irradiance4> direct, const std::vector<sh::RadianceSh>& before,
             std::vector<sh::RadianceSh>& after) const {
    const std::size_t directions = network.gbuffer().directions.size(), stride = projector.stride();
    parallel_for(after.size(), 4, [&](std::size_t first, std::size_t end) {
      std::vector<float> radiance(3 * stride, 0.0f);
      for (std::size_t i = first; i < end; ++i) {
        for (std::size_t q = 0; q < directions; ++q) {
          const std::size_t ray = i * directions + q;
          const SeenPatch& patch = network.seen()[ray];
          vec3 value(0);
          if (patch.surfel != no_surfel) {
            const vec3 e = vec3(direct[static_cast<std::size_t>(patch.surfel)]) + look_up(ray, before);
            value = unpack_albedo(patch.albedo) * (1 / pi) * e;
          }
          radiance[q] = value.x, radiance[stride + q] = value.y, radiance[2 * stride + q] = value.z;
        }
        projector.project(radiance, after[i]);
      }
    });
  }
};

BounceOperator::BounceOperator(const TransportNetwork& network, const scene::TransportSource& source,
                               int degree, const BounceParams& params)
    : data_(new Data{network, params, DirectionProjector(degree, network.gbuffer().directions), {}, {}, {}}) {
  Data& d = *data_;
  d.params.irradiance_degree = std::min(params.irradiance_degree, degree);
  const ProbeGBuffer& g = network.gbuffer();
  const std::size_t directions = g.directions.size(), rays = network.seen().size(), count = d.bands();
  const auto weights = make_weights(
      g.positions, [&](const vec3& a, const vec3& b) { return sees(network, source, a, b); }, params.weights);

  // Find the weights at every hit, then lay them out in a row.
  std::vector<ProbeWeights> at(rays);
  d.basis.assign(rays * count, 0);
  parallel_for(rays, 256, [&](std::size_t first, std::size_t end) {
    for (std::size_t ray = first; ray < end; ++ray) {
      const SeenPatch& patch = network.seen()[ray];
      if (patch.surfel == no_surfel) continue;
      const Surfel& surfel = network.surfels().surfels()[static_cast<std::size_t>(patch.surfel)];
      const mat3 turn(network.poses()[static_cast<std::size_t>(surfel.part)]);
      const vec3 n = glm::normalize(glm::transpose(glm::inverse(turn)) * surfel.point.normal);
      const vec3 x =
          g.positions[ray / directions] + network.seen_distance()[ray] * g.directions[ray % directions];
      at[ray] = weights->at({x, n, surfel.part > 0});
      const std::span<float> basis(d.basis.data() + ray * count, count);
      sh::eval_basis(d.params.irradiance_degree, n, basis);
      for (int l = 0; l <= d.params.irradiance_degree; ++l) {
        for (int k = l * l; k < (l + 1) * (l + 1); ++k)
          basis[static_cast<std::size_t>(k)] *= static_cast<float>(sh::cosine_band_factor(l));
      }
    }
  });
  std::vector<std::uint8_t> coupled(g.positions.size());
  for (std::size_t ray = 0; ray < rays; ++ray) {
    if (ray % directions == 0) std::fill(coupled.begin(), coupled.end(), std::uint8_t{0});
    d.begin.push_back(d.weights.size());
    for (int k = 0; k < at[ray].count; ++k) {
      const ProbeWeight& w = at[ray].entries[static_cast<std::size_t>(k)];
      d.weights.push_back(w);
      std::uint8_t& known = coupled[static_cast<std::size_t>(w.probe)];
      d.edges += known ? 0 : 1;
      known = 1;
    }
  }
  d.begin.push_back(d.weights.size());
}

BounceOperator::~BounceOperator() = default;

BounceReport BounceOperator::solve(std::span<const Irradiance4> direct,
                                   std::vector<sh::RadianceSh>& reflected) const {
  const Data& d = *data_;
  BounceReport report;
  report.edges = d.edges;
  std::vector<sh::RadianceSh> before(d.network.gbuffer().positions.size(),
                                     sh::RadianceSh(d.projector.degree()));
  reflected = before;
  d.apply(direct, before, reflected);  // D
  const int most = d.params.applications > 0 ? d.params.applications : d.params.max_iterations;
  float last_change = 0;
  report.converged = d.params.applications > 0;
  while (report.iterations < most) {
    before.swap(reflected);
    d.apply(direct, before, reflected);
    ++report.iterations;
    float change = 0, largest = 0;
    for (std::size_t i = 0; i < reflected.size(); ++i) {
      change = std::max(change, max_component(glm::abs(reflected[i][0] - before[i][0])));
      largest = std::max(largest, max_component(reflected[i][0]));
    }
    // Below this, rounding decides the ratio.
    if (last_change > 1e-3f * largest) report.contraction = double(change) / double(last_change);
    last_change = change;
    if (d.params.applications == 0 && change <= d.params.tolerance * largest) {
      report.converged = true;
      break;
    }
  }
  return report;
}

}  // namespace ssphh::gi
