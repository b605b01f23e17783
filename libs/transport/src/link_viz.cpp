#include <algorithm>
#include <cmath>
#include <numeric>

#include <fmt/format.h>

#include <ssphh/core/parallel.h>
#include <ssphh/core/random.h>
#include <ssphh/core/require.h>
#include <ssphh/core/require_named.h>
#include <ssphh/transport/direct_field.h>
#include <ssphh/transport/link_viz.h>

#include "probe_light.h"
#include "sphl_emission.h"

namespace ssphh::transport {
namespace {

/// The edges that a probe keeps: a heap with the weakest on top.
class StrongestEdges {
 public:
  explicit StrongestEdges(const LinkVizParams& params) : params_(params) {}

  /// Whether an edge with this P would be kept.
  bool wants(float transfer) const {
    return transfer > params_.threshold && params_.neighbors != 0 &&
           (!full() || transfer > edges_[0].transfer);
  }
  void add(probes::Edge&& edge) {
    if (full()) {
      std::pop_heap(edges_.begin(), edges_.end(), stronger);
      edges_.pop_back();
    }
    edges_.push_back(std::move(edge));
    std::push_heap(edges_.begin(), edges_.end(), stronger);
  }
  std::vector<probes::Edge> by_neighbor() && {
    std::ranges::sort(edges_, [](const probes::Edge& a, const probes::Edge& b) { return a.from < b.from; });
    return std::move(edges_);
  }

 private:
  static bool stronger(const probes::Edge& a, const probes::Edge& b) {
    return a.transfer != b.transfer ? a.transfer > b.transfer : a.from < b.from;
  }
  bool full() const {
    return params_.neighbors > 0 && edges_.size() >= static_cast<std::size_t>(params_.neighbors);
  }

  const LinkVizParams& params_;
  std::vector<probes::Edge> edges_;
};

/// Probes in an order without any pattern in space. Neighbours that come ever closer would be projected only
/// to be thrown out by the next.
std::vector<std::size_t> scattered(std::size_t count) {
  std::vector<std::size_t> order(count);
  std::iota(order.begin(), order.end(), std::size_t{0});
  std::ranges::sort(order, [](std::size_t a, std::size_t b) { return mix64(a) < mix64(b); });
  return order;
}

/// 1 for each probe of the list; without a list for all.
std::vector<std::uint8_t> marked(const std::vector<std::uint32_t>* which, std::size_t count) {
  std::vector<std::uint8_t> marks(count, which ? 0 : 1);
  if (!which) return marks;
  for (const std::uint32_t i : *which) {
    require(i < count, "VIZ from links", "there is no probe of that index");
    marks[i] = 1;
  }
  return marks;
}

/// The links from surfel to surfel, of mean albedo: bounces that read an eighth of what those between patches
/// do.
struct SurfelLinks {
  std::vector<Link> links;
  LinkRows rows;
  std::vector<vec3> albedo;
  double bound = 0;  ///< for Chebyshev's steps

  explicit SurfelLinks(const TransportNetwork& network) {
    const std::size_t count = network.surfel_count();
    std::vector<glm::dvec4> reflected(count, glm::dvec4(0));
    std::vector<std::size_t> first{0};
    links.reserve(network.links().link_count());
    for (const LinkRows::Row& row : network.links().rows) {
      for (const auto& part : {row.fixed, row.moving}) {
        for (const Link& link : part) {
          const std::size_t surfel = network.surfel_of(link.patch);
          links.push_back({static_cast<std::uint32_t>(surfel), link.weight});
          reflected[surfel] += double(link.weight) * glm::dvec4(network.albedo()[link.patch], 1);
        }
      }
      merge_from(first.back());
      first.push_back(links.size());
    }
    for (std::size_t s = 0; s < count; ++s) {
      rows.rows.push_back({std::span<const Link>(links).subspan(first[s], first[s + 1] - first[s]), {}});
      albedo.emplace_back(reflected[s] / std::max(reflected[s].w, 1e-30));
    }
    bound = chebyshev_bound(contraction(rows, albedo));
  }
  SurfelLinks(const SurfelLinks&) = delete;  // rows point into links

 private:
  /// Of links to one surfel makes one.
  void merge_from(std::size_t begin) {
    std::sort(links.begin() + static_cast<std::ptrdiff_t>(begin), links.end(),
              [](const Link& a, const Link& b) { return a.patch < b.patch; });
    std::size_t end = begin;
    for (std::size_t i = begin; i < links.size(); ++i) {
      if (end > begin && links[end - 1].patch == links[i].patch) {
        links[end - 1].weight += links[i].weight;
      } else {
        links[end++] = links[i];
      }
    }
    links.resize(end);
  }
};

class LinkViz {
 public:
  LinkViz(const TransportNetwork& network, const rays::TransportSource& source,
          std::span<const probes::Probe> probes, int degree, const LinkVizParams& params,
          const LinkVizScope* scope)
      : network_(network),
        source_(source),
        probes_(probes),
        params_(params),
        projector_(degree, network.gbuffer().directions),
        field_(network, 0),
        surfels_(network),
        kept_(probes.size(), StrongestEdges(params)),
        to_(marked(scope ? &scope->to : nullptr, probes.size())),
        from_(marked(scope ? &scope->from : nullptr, probes.size())) {}

  std::vector<std::vector<probes::Edge>> run(const Control& control) {
    const auto count = static_cast<std::uint64_t>(std::ranges::count(from_, 1));
    ProgressStage progress(control, "VIZ from links", count, "probes");
    for (const std::size_t j : scattered(probes_.size())) {
      if (!from_[j]) continue;
      control.check();
      light_sphere(j);
      read_off(j);
      progress.advance(1);
    }
    std::vector<std::vector<probes::Edge>> edges;
    for (StrongestEdges& kept : kept_) edges.push_back(std::move(kept).by_neighbor());
    return edges;
  }

 private:
  /// Irradiance of every patch while probe j is the only light.
  void light_sphere(std::size_t j) {
    sphere_ = {probes_[j].position, probes_[j].radius, sh::RadianceSh(0)};
    radiance_ = probes::emitter_radiance(params_.source, sphere_.radius);
    sphere_.leaving[0] = vec3(radiance_ * std::sqrt(4 * pi));
    at_samples_.assign(network_.samples().size(), vec3(0));
    add_emission(network_, source_, sphere_, at_samples_);
    field_.sum({}, at_samples_, direct_);
    // The first bounce and the last are between patches, as far as light of their own colours goes.
    further_.assign(network_.surfel_count(), Irradiance4(0));
    bounce(first_);
    further_.clear();
    Solver().solve(surfels_.rows, surfels_.albedo, first_, surfels_.bound, params_.solve, further_);
    for (std::size_t s = 0; s < first_.size(); ++s) further_[s] += first_[s];
    bounce(indirect_);
    for (std::size_t p = 0; p < direct_.size(); ++p) direct_[p] += indirect_[network_.surfel_of(p)];
  }

  /// What the direct light and `further_` give every surfel.
  void bounce(std::vector<Irradiance4>& out) {
    radiosity_.resize(direct_.size());
    parallel_for(direct_.size(), 4096, [&](std::size_t p) {
      radiosity_[p] = vec4(network_.albedo()[p], 0) * (direct_[p] + further_[network_.surfel_of(p)]);
    });
    out.resize(network_.surfel_count());
    bounce_once(network_.links(), radiosity_, out);
  }

  /// P of what probe i sees on surfaces.
  float seen_on_surfaces(std::size_t i) const {
    const std::size_t directions = network_.gbuffer().directions.size();
    glm::dvec3 sum(0);
    for (std::size_t ray = i * directions; ray < (i + 1) * directions; ++ray)
      sum += glm::dvec3(radiance_of(network_.seen()[ray], direct_));
    for (const MirroredPatch& mirrored : mirrored_of(network_, i))
      sum += glm::dvec3(mirrored.share * radiance_of(mirrored.patch, direct_));
    return luminance(vec3(sum / double(directions)));
  }

  void read_off(std::size_t j) {
    // Upper bounds of P first: the sphere takes rays and H a projection, and most pairs need neither.
    std::vector<std::uint8_t> wanted(probes_.size());
    parallel_for(probes_.size(), 8, [&](std::size_t i) {
      wanted[i] =
          i != j && to_[i] &&
          kept_[i].wants(seen_on_surfaces(i) + radiance_ * sphere_share(probes_[i].position, sphere_));
    });
    std::vector<std::size_t> at;
    std::vector<vec3> positions;
    for (std::size_t i = 0; i < wanted.size(); ++i) {
      if (wanted[i]) at.push_back(i), positions.push_back(probes_[i].position);
    }
    const std::vector<float> visible = visible_shares(network_, source_, positions, sphere_);

    parallel_for(at.size(), 4, [&](std::size_t k) {
      probes::Edge edge;
      edge.from = static_cast<int>(j);
      edge.h = sh::RadianceSh(projector_.degree());
      project_reflected(network_, projector_, direct_, at[k], edge.h);
      if (visible[k] > 0) {
        sh::RadianceSh seen(projector_.degree());
        add_seen_emission(positions[k], sphere_, seen);
        seen *= vec3(visible[k]);
        edge.h += seen;
      }
      edge.transfer = probes::transfer_coefficient(edge.h);
      if (kept_[at[k]].wants(edge.transfer)) kept_[at[k]].add(std::move(edge));
    });
  }

  const TransportNetwork& network_;
  const rays::TransportSource& source_;
  std::span<const probes::Probe> probes_;
  const LinkVizParams& params_;
  DirectionProjector projector_;
  DirectField field_;
  SurfelLinks surfels_;
  std::vector<StrongestEdges> kept_;
  std::vector<std::uint8_t> to_, from_;
  // Of the sphere that is lit.
  SphlEmitter sphere_;
  float radiance_ = 1;
  std::vector<vec3> at_samples_;
  std::vector<Irradiance4> direct_, radiosity_;          ///< of patches
  std::vector<Irradiance4> first_, further_, indirect_;  ///< of surfels
};

}  // namespace

std::vector<std::vector<probes::Edge>> viz_from_links(const TransportNetwork& network,
                                                      const rays::TransportSource& source,
                                                      std::span<const probes::Probe> probes, int degree,
                                                      const LinkVizParams& params, const Control& control,
                                                      const LinkVizScope* scope) {
  require_named("source of VIZ from links", params.source);
  if (params.neighbors < -1) throw Error("VIZ from links", "neighbours must be -1 (all) or a count");
  if (!(params.threshold >= 0 && std::isfinite(params.threshold)))
    throw Error("VIZ from links", "the threshold must be a number from 0 up, as P is");
  const std::vector<vec3>& positions = network.gbuffer().positions;
  require(std::ranges::equal(probes, positions, {}, &probes::Probe::position), "VIZ from links",
          "the probes do not stand where the network's do");
  return LinkViz(network, source, probes, degree, params, scope).run(control);
}

}  // namespace ssphh::transport
