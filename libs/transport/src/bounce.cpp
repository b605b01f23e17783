#include <algorithm>
#include <cmath>
#include <numeric>

#include <ssphh/core/parallel.h>
#include <ssphh/core/require.h>
#include <ssphh/probes/lookup_weights.h>
#include <ssphh/sh/evaluate.h>
#include <ssphh/sh/irradiance.h>
#include <ssphh/transport/bounce.h>
#include <ssphh/transport/projection.h>

#include "network_data.h"
#include "sphl_emission.h"

namespace ssphh::transport {

struct BounceOperator::Data {
  Data(const TransportNetwork& network_in, const rays::TransportSource& source_in, int degree,
       const BounceParams& params_in)
      : network(network_in),
        source(source_in),
        params(params_in),
        projector(degree, network.gbuffer().directions),
        swept(swept_bounds(source)) {
    params.irradiance_degree = std::min(params.irradiance_degree, degree);
    lookup = probes::make_visible_weights(network.gbuffer().positions, params.weights);
    const std::size_t rays = network.seen().size();
    known.resize(rays);
    basis.assign(rays * bands(), 0);
    begin.assign(rays + 1, 0);
  }

  /// What the weights of a ray were found for.
  static constexpr std::int32_t unknown = -2;  ///< not even that: the source threw
  struct KnownHit {
    std::int32_t patch = no_patch;
    float distance = 0;
    bool near_part = false;
  };

  const TransportNetwork& network;
  const rays::TransportSource& source;
  BounceParams params;
  std::unique_ptr<probes::VisibleWeights> lookup;
  DirectionProjector projector;
  std::vector<scene::Bounds> swept;          ///< per part, all that it ever occupies
  std::vector<KnownHit> known;               ///< per probe ray
  std::vector<std::size_t> begin;            ///< per probe ray, into weights; and the end
  std::vector<probes::ProbeWeight> weights;  ///< lookup weights at the rays' hits
  std::vector<float> basis;                  ///< A_l Y_k(n) at each hit, [ray][k]
  std::size_t edges = 0;
  std::vector<sh::RadianceSh> before;  ///< scratch of solve(), as the next one
  std::vector<float> scratch;

  std::size_t bands() const {
    return static_cast<std::size_t>(sh::coefficient_count(params.irradiance_degree));
  }

  bool crosses_swept(const rays::RayQuery& segment) const {
    return std::ranges::any_of(swept,
                               [&](const scene::Bounds& box) { return !box.empty() && meets(segment, box); });
  }

  const Surfel& surfel_of(std::int32_t patch) const {
    return network.surfels().surfels()[network.surfel_of(static_cast<std::size_t>(patch))];
  }

  /// Whether the pose may have changed what was found at the ray's hit.
  bool is_stale(std::size_t ray) const {
    const SeenPatch& patch = network.seen()[ray];
    const KnownHit& hit = known[ray];
    if (patch.index != hit.patch) return true;
    if (patch.index == no_patch) return false;
    return hit.near_part || hit.distance != network.seen_distance()[ray] || surfel_of(patch.index).part > 0;
  }

  /// Weights and basis functions at the hit of one ray; `at` stays empty where nothing is seen.
  void look_up_anew(std::size_t ray, probes::ProbeWeights& at) {
    const ProbeGBuffer& g = network.gbuffer();
    const std::size_t directions = g.directions.size(), count = bands();
    const SeenPatch& patch = network.seen()[ray];
    known[ray] = {patch.index, network.seen_distance()[ray], false};
    if (patch.index == no_patch) return;
    const Surfel& surfel = surfel_of(patch.index);
    const mat3 turn(network.poses()[surfel.part]);
    const vec3 n = glm::normalize(glm::transpose(glm::inverse(turn)) * surfel.point.normal);
    const vec3 x = g.positions[ray / directions] + known[ray].distance * g.directions[ray % directions];
    bool& near_part = known[ray].near_part;
    const probes::SeesProbe seen = [this, &near_part](const vec3& a, const vec3& b) {
      near_part = near_part || crosses_swept({a, b - a, 1});
      return sees(network, source, a, b);
    };
    at = lookup->at({x, n, surfel.part > 0}, seen);
    const std::span<float> at_hit(basis.data() + ray * count, count);
    sh::eval_basis(params.irradiance_degree, n, at_hit);
    for (int l = 0; l <= params.irradiance_degree; ++l) {
      for (int k = l * l; k < (l + 1) * (l + 1); ++k)
        at_hit[k] *= static_cast<float>(sh::cosine_band_factor(l));
    }
  }

  /// The same of some rays, ascending; the others keep theirs. Lays all weights out in a row again.
  void look_up_anew(std::span<const std::uint32_t> which) {
    if (which.empty()) return;
    std::vector<probes::ProbeWeights> found(which.size());
    try {
      parallel_for(which.size(), 256, [&](std::size_t i) { look_up_anew(which[i], found[i]); });
    } catch (...) {
      for (const std::uint32_t ray : which) known[ray].patch = unknown;
      throw;
    }
    std::vector<probes::ProbeWeight> row;
    row.reserve(weights.size());
    edges = 0;
    const std::size_t directions = network.gbuffer().directions.size();
    std::vector<std::uint8_t> coupled(network.gbuffer().positions.size());
    std::size_t next = 0, old_begin = 0;
    for (std::size_t ray = 0; ray < known.size(); ++ray) {
      if (ray % directions == 0) std::ranges::fill(coupled, std::uint8_t{0});
      const std::size_t old_end = begin[ray + 1], start = row.size();
      if (next < which.size() && which[next] == ray) {
        const auto used = found[next++].used();
        row.insert(row.end(), used.begin(), used.end());
      } else {
        const auto old = weights.begin();
        row.insert(row.end(), old + static_cast<std::ptrdiff_t>(old_begin),
                   old + static_cast<std::ptrdiff_t>(old_end));
      }
      for (std::size_t w = start; w < row.size(); ++w) {
        std::uint8_t& is_coupled = coupled[row[w].probe];
        edges += is_coupled ? 0 : 1;
        is_coupled = 1;
      }
      old_begin = old_end;
      begin[ray + 1] = row.size();
    }
    weights = std::move(row);
  }

  /// Indirect irradiance at what each ray of a probe sees, as the probes give it.
  vec3 look_up(std::size_t ray, const std::vector<sh::RadianceSh>& probes) const {
    const std::size_t count = bands();
    vec3 sum(0);
    for (std::size_t w = begin[ray]; w < begin[ray + 1]; ++w) {
      const sh::RadianceSh& s = probes[weights[w].probe];
      vec3 e(0);
      for (std::size_t k = 0; k < count; ++k) e += basis[ray * count + k] * s.values[k];
      sum += weights[w].weight * e;
    }
    return glm::max(sum, vec3(0));
  }

  /// S = D + B S of all probes.
  void apply(std::span<const Irradiance4> direct, const std::vector<sh::RadianceSh>& from,
             std::vector<sh::RadianceSh>& to) {
    const std::size_t directions = network.gbuffer().directions.size(), stride = projector.stride();
    constexpr std::size_t block = 4;
    scratch.resize((to.size() + block - 1) / block * 3 * stride);
    parallel_for(to.size(), block, [&](std::size_t first, std::size_t end) {
      const std::span<float> radiance(scratch.data() + first / block * 3 * stride, 3 * stride);
      for (std::size_t i = first; i < end; ++i) {
        for (std::size_t q = 0; q < directions; ++q) {
          const std::size_t ray = i * directions + q;
          const SeenPatch& patch = network.seen()[ray];
          vec3 value(0);
          if (patch.index != no_patch) {
            const vec3 e = vec3(direct[patch.index]) + look_up(ray, from);
            value = unpack_albedo(patch.albedo) * (1 / pi) * e;
          }
          radiance[q] = value.x, radiance[stride + q] = value.y, radiance[2 * stride + q] = value.z;
        }
        projector.project(radiance, to[i]);
      }
    });
  }
};

BounceOperator::BounceOperator(const TransportNetwork& network, const rays::TransportSource& source,
                               int degree, const BounceParams& params)
    : data_(std::make_unique<Data>(network, source, degree, params)) {
  std::vector<std::uint32_t> all(network.seen().size());
  std::iota(all.begin(), all.end(), 0u);
  data_->look_up_anew(all);
}

BounceOperator::~BounceOperator() = default;

std::size_t BounceOperator::update_pose() {
  Data& d = *data_;
  std::vector<std::uint32_t> which;
  for (std::size_t ray = 0; ray < d.known.size(); ++ray) {
    if (d.is_stale(ray)) which.push_back(static_cast<std::uint32_t>(ray));
  }
  d.look_up_anew(which);
  return which.size();
}

BounceReport BounceOperator::solve(std::span<const Irradiance4> direct,
                                   std::vector<sh::RadianceSh>& reflected, bool warm) {
  Data& d = *data_;
  require(d.params.tolerance >= 0, "bounce", "the tolerance must be a number from 0 up");
  BounceReport report;
  report.edges = d.edges;
  require(direct.size() == d.network.patch_count(), "bounce", "there is not the direct light of each patch");
  require(!warm || (reflected.size() == d.network.gbuffer().positions.size() && d.params.applications == 0),
          "bounce", "it can only begin with the light of all probes, and iterate as long as needed");
  std::vector<sh::RadianceSh>& before = d.before;
  if (before.empty())
    before.assign(d.network.gbuffer().positions.size(), sh::RadianceSh(d.projector.degree()));
  if (!warm) {
    for (sh::RadianceSh& dark : before) std::ranges::fill(dark.values, vec3(0));
    reflected = before;
    d.apply(direct, before, reflected);  // D
  }
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

}  // namespace ssphh::transport
