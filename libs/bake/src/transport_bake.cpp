#include <algorithm>
#include <numeric>

#include <fmt/format.h>

#include <ssphh/bake/light_modes.h>
#include <ssphh/bake/transport_bake.h>
#include <ssphh/bake/update.h>
#include <ssphh/core/counted.h>
#include <ssphh/core/log.h>
#include <ssphh/core/require.h>
#include <ssphh/core/require_named.h>
#include <ssphh/core/stopwatch.h>
#include <ssphh/probes/probe_file.h>
#include <ssphh/transport/session_sets.h>

#include "renew_records.h"

namespace ssphh::bake {
namespace {

void describe_network(const transport::TransportNetwork& network, probes::ProbeSet& set,
                      TransportBakeReport& report) {
  set.generator.directions = network.params().directions;
  set.generator.surfel_size = network.params().surfel_size;
  set.generator.link_rays = network.params().link_rays;
  report.surfels = network.surfel_count();
  report.finest_surfel = network.surfels().size();
  report.coarsest_surfel = network.surfels().coarsest();
  report.links = network.links().link_count();
  report.contraction = network.contraction().upper;
  report.lost = static_cast<double>(network.lost_links()) /
                (static_cast<double>(network.surfel_count()) * network.params().link_rays);
}

/// Share of what a probe sees that is the back of a one-sided surface.
float back_share(const transport::ProbeGBuffer& seen, std::size_t probe) {
  constexpr std::uint32_t back_bit = std::uint32_t{1} << 30;
  const std::size_t count = seen.directions.size();
  const auto first = seen.hits.begin() + static_cast<std::ptrdiff_t>(probe * count);
  const auto backs =
      std::count_if(first, first + static_cast<std::ptrdiff_t>(count), [](const transport::PackedHit& hit) {
        return hit.distance < std::numeric_limits<float>::infinity() && (hit.albedo_and_back & back_bit);
      });
  return static_cast<float>(backs) / static_cast<float>(count);
}

/// One line, however many probes: "3 probes receive ...: "a", "b", "c"".
void warn_of(const std::vector<std::string>& names, std::string_view of_one, std::string_view of_several,
             TransportBakeReport& report) {
  if (names.empty()) return;
  constexpr std::size_t most = 5;
  std::string list;
  for (std::size_t i = 0; i < std::min(names.size(), most); ++i)
    list += fmt::format("{}\"{}\"", i == 0 ? "" : ", ", names[i]);
  report.warnings.push_back(fmt::format("{}: {}{}", counted(names.size(), of_one, of_several), list,
                                        names.size() > most ? ", ..." : ""));
}

void check_light(const transport::TransportNetwork& network, const probes::ProbeSet& set, std::size_t count,
                 TransportBakeReport& report) {
  std::vector<std::string> inside, dark;
  for (std::size_t i = 0; i < count; ++i) {
    const probes::Probe& probe = set.probes[i];
    if (back_share(network.gbuffer(), i) > 0.5f) {
      inside.push_back(probe.name);
    } else if (sh::mean(probe.self) == vec3(0)) {
      dark.push_back(probe.name);
    }
  }
  warn_of(inside, "probe seems to lie inside a body (most of what it sees are back faces)",
          "probes seem to lie inside a body (most of what they see are back faces)", report);
  warn_of(dark, "probe receives no light at all", "probes receive no light at all", report);
  constexpr double most_lost = 0.01;
  if (report.lost > most_lost) {
    report.warnings.push_back(fmt::format(
        "{:.1f} % of the surfels' rays end where no surfel is: their light is lost; more --directions or "
        "smaller surfels may find the places",
        100 * report.lost));
  }
}

/// Light that is known in part is no light to keep.
void require_converged(const transport::SolveReport& solved) {
  if (solved.converged) return;
  throw Error("light of surfels",
              fmt::format("did not converge in {} bounces: {:.2g} of it may be missing", solved.iterations,
                          solved.error),
              "allow more of them, or a larger tolerance");
}

/// At the surfels, in the session's pose, to its lights and to training lights.
void fit(const transport::RelightSession& session, const rays::TransportSource& source, probes::ProbeSet& set,
         const transport::FitParams& params, TransportBakeReport& report, const Control& control) {
  const Stopwatch watch;
  const transport::TransportNetwork& network = session.network();
  set.fitted = transport::fit_weights(network, source, transport::surfel_points(network), params,
                                      session.direct_by_group(), control);
  report.fit_seconds += watch.seconds();
}

void find_records(transport::RelightSession& session, probes::ProbeSet& set,
                  const transport::GatherParams& params, const LightScope& scope, TransportBakeReport& report,
                  const Control& control) {
  const Stopwatch watch;
  renew_records(session, set, params, scope, control);
  report.record_seconds = watch.seconds();
  report.records = set.surface ? set.surface->points.size() : 0;
}

/// How many probes are asked for.
std::size_t own_count(const probes::ProbeSet& set, const TransportBakeParams& params) {
  return params.own_probes > 0 ? std::min(params.own_probes, set.probes.size()) : set.probes.size();
}

/// Edges to the probes that are asked for; none: between all.
std::optional<transport::LinkVizScope> own_edges(const probes::ProbeSet& set,
                                                 const TransportBakeParams& params) {
  if (own_count(set, params) == set.probes.size()) return std::nullopt;
  transport::LinkVizScope scope{std::vector<std::uint32_t>(own_count(set, params)),
                                std::vector<std::uint32_t>(set.probes.size())};
  std::iota(scope.to.begin(), scope.to.end(), 0u);
  std::iota(scope.from.begin(), scope.from.end(), 0u);
  return scope;
}

/// Edges to these probes from one another and from those that theirs come from.
transport::LinkVizScope edges_to(const probes::ProbeSet& set, const std::vector<std::uint32_t>& which) {
  transport::LinkVizScope scope{which, which};
  for (const std::uint32_t i : which) {
    require(i < set.probes.size(), "update of edges", "there is no probe of that index");
    for (const probes::Edge& edge : set.probes[i].edges)
      scope.from.push_back(static_cast<std::uint32_t>(edge.from));
  }
  return scope;
}

void find_edges(const transport::TransportNetwork& network, const rays::TransportSource& source,
                probes::ProbeSet& set, const transport::LinkVizParams& params,
                const std::optional<transport::LinkVizScope>& scope, TransportBakeReport& report,
                const Control& control) {
  if (scope && scope->to.empty()) return;
  const Stopwatch watch;
  std::vector<std::vector<probes::Edge>> edges = transport::viz_from_links(
      network, source, set.probes, set.degree, params, control, scope ? &*scope : nullptr);
  for (std::size_t i = 0; i < edges.size(); ++i) {
    if (!scope || std::ranges::binary_search(scope->to, i)) set.probes[i].edges = std::move(edges[i]);
  }
  set.generator.viz = probes::VizMethod::links;
  set.generator.viz_source = params.source;
  report.viz_seconds = watch.seconds();
}

/// Each group's light with the probes as the only unknowns.
std::vector<std::vector<sh::RadianceSh>> bounce_by_group(const transport::RelightSession& session,
                                                         const rays::TransportSource& source,
                                                         const TransportBakeParams& params, int degree,
                                                         TransportBakeReport& report) {
  transport::BounceOperator bounce(session.network(), source, degree, params.bounce);
  std::vector<std::vector<sh::RadianceSh>> reflected;
  for (const std::vector<transport::Irradiance4>& direct : session.direct_by_group()) {
    const transport::BounceReport done = bounce.solve(direct, reflected.emplace_back());
    report.iterations = std::max(report.iterations, done.iterations);
    report.contraction = std::max(report.contraction, done.contraction);
    if (!done.converged) {
      throw Error("light between the probes",
                  fmt::format("did not converge in {} bounces: each adds to what it gets", done.iterations),
                  "place more probes, or bake with --operator surfel");
    }
  }
  return reflected;
}

void require_probes(const probes::ProbeSet& set) {
  if (set.probes.empty())
    throw Error("bake", "there are no probes to bake", "run INIT on a scene with SPHLs");
}

/// Lights everything once, then each group alone.
class LitSession {
 public:
  LitSession(const rays::TransportSource& source, const probes::ProbeSet& set,
             const TransportBakeParams& params, TransportBakeReport& report, const Control& control)
      : source_(source),
        params_(params),
        report_(report),
        degree_(set.degree),
        session_(source, scene::places_of(set.probes), relight_params(set, params), set.generator.time,
                 control) {
    const transport::RelightReport done = session_.update(session_.lighting(), control);
    if (params.op == probes::LightOperator::surfel) require_converged(done.solve);
  }

  transport::RelightSession& session() { return session_; }

  std::vector<std::vector<sh::RadianceSh>> reflected_by_group(const Control& control) {
    if (params_.op == probes::LightOperator::bounce) {
      report_.contraction = 0;
      return bounce_by_group(session_, source_, params_, degree_, report_);
    }
    transport::SolveReport slowest;
    std::vector<std::vector<sh::RadianceSh>> reflected = session_.reflected_by_group(control, &slowest);
    report_.iterations = slowest.iterations;
    report_.error = slowest.error;
    require_converged(slowest);
    return reflected;
  }

 private:
  static transport::RelightParams relight_params(const probes::ProbeSet& set,
                                                 const TransportBakeParams& params) {
    transport::RelightParams relight{params.transport, params.solve};
    relight.degree = set.degree;
    return relight;
  }

  const rays::TransportSource& source_;
  const TransportBakeParams& params_;
  TransportBakeReport& report_;
  int degree_;
  transport::RelightSession session_;
};

void require_transport(const TransportBakeParams& params) {
  require_named("light operator", params.op);
  require(params.op != probes::LightOperator::path, "transport bake",
          "path tracing is no transport between probes");
}

void tell_warnings(const TransportBakeReport& report) {
  for (const std::string& warning : report.warnings) log_warning("{}", warning);
}

/// Of all the light that stands in a probe, as both halves of a trial that has no noise.
probes::Trial light_of(const probes::Probe& probe) {
  probes::Trial light;
  for (const probes::GroupLight& group : probe.groups) {
    sh::RadianceSh& sum = light.halves[0].emplace_back(group.reflected);
    if (!group.emitted.empty()) sum += group.emitted;
  }
  light.halves[1] = light.halves[0];
  return light;
}

}  // namespace

probes::ProbeSet bake_transport(const rays::TransportSource& source, probes::ProbeSet set,
                                const TransportBakeParams& params, TransportBakeReport& report,
                                const Control& control) {
  require_probes(set);
  require_transport(params);
  report = {};
  const std::uint64_t rays_before = source.rays_traced();
  const Stopwatch watch;
  LitSession lit(source, set, params, report, control);
  transport::RelightSession& session = lit.session();
  const transport::TransportNetwork& network = session.network();
  describe_network(network, set, report);
  std::vector<std::vector<sh::RadianceSh>> reflected = lit.reflected_by_group(control);

  set.generator.op = params.op;
  set.generator.viz = probes::VizMethod::none;
  set.generator.gen = probes::GenMode::full;
  set.hierarchy.reset();
  set.fitted.reset();
  set.surface.reset();
  set.light_groups.clear();
  for (const std::string& group : source.light_groups()) set.light_groups.push_back({group, vec3(1)});
  for (probes::Probe& probe : set.probes) probe.edges.clear();
  transport::store_groups(set, std::move(reflected), session.emitted_by_group());

  report.seconds = watch.seconds();
  if (params.records.points > 0) find_records(session, set, params.records, {}, report, control);
  if (params.viz)
    find_edges(network, source, set, params.viz_params, own_edges(set, params), report, control);
  if (params.fit) fit(session, source, set, params.fit_params, report, control);
  report.rays = source.rays_traced() - rays_before;
  check_light(network, set, own_count(set, params), report);
  probes::validate(set, "bake");
  tell_warnings(report);
  return set;
}

void add_transport(const rays::TransportSource& source, probes::ProbeSet& set,
                   const TransportBakeParams& params, TransportBakeReport& report, const Control& control,
                   const TransportScope& scope) {
  require_probes(set);
  scope.light.require_within(set.probes.size(), set.light_groups.size());
  report = {};
  const bool edges = params.viz && !(scope.edges && scope.edges->empty()),
             records = params.records.points > 0;
  if (!edges && !params.fit && !records) return;
  const std::uint64_t rays_before = source.rays_traced();
  transport::RelightSession session(source, scene::places_of(set.probes), {params.transport, params.solve},
                                    set.generator.time, control);
  const transport::TransportNetwork& network = session.network();
  describe_network(network, set, report);
  if (edges) {
    find_edges(network, source, set, params.viz_params,
               scope.edges ? edges_to(set, *scope.edges) : own_edges(set, params), report, control);
  }
  if (params.fit) {
    session.update(session.lighting(), control);
    fit(session, source, set, params.fit_params, report, control);
  }
  if (records) find_records(session, set, params.records, scope.light, report, control);
  report.rays = source.rays_traced() - rays_before;
}

TransportUpdate update_transport(const rays::TransportSource& source, probes::ProbeSet& set,
                                 const TransportBakeParams& params, const LightScope& scope,
                                 float edge_change, TransportBakeReport& report, const Control& control) {
  require_probes(set);
  require_transport(params);
  scope.require_within(set.probes.size(), set.light_groups.size());
  require(std::ranges::equal(set.light_groups, source.light_groups(), {}, &probes::LightGroup::name),
          "transport update", "the set is of other light groups than the scene");
  report = {};
  const std::uint64_t rays_before = source.rays_traced();
  const Stopwatch watch;
  LitSession lit(source, set, params, report, control);
  transport::RelightSession& session = lit.session();
  describe_network(session.network(), set, report);
  const std::vector<probes::Probe> before = set.probes;
  transport::store_groups(set, lit.reflected_by_group(control), session.emitted_by_group());
  set.hierarchy.reset();

  TransportUpdate update;
  std::vector<std::uint32_t> changed_much;
  for (std::size_t i = 0; i < before.size(); ++i) {
    std::vector<probes::GroupLight>& now = set.probes[i].groups;
    for (std::size_t g = 0; g < now.size(); ++g) {
      if (!scope.has_probe(i) || !scope.has_group(g)) now[g] = before[i].groups[g];
    }
    update.changed.push_back(changed_share(light_of(before[i]), light_of(set.probes[i])));
    if (now != before[i].groups) update.probes.push_back(static_cast<std::uint32_t>(i));
    if (update.changed[i] > edge_change) changed_much.push_back(static_cast<std::uint32_t>(i));
  }

  report.seconds = watch.seconds();
  if (params.records.points > 0) find_records(session, set, params.records, scope, report, control);
  if (params.viz) {
    find_edges(session.network(), source, set, params.viz_params, edges_to(set, changed_much), report,
               control);
  }
  if (params.fit) fit(session, source, set, params.fit_params, report, control);
  probes::merge_groups(set);
  report.rays = source.rays_traced() - rays_before;
  check_light(session.network(), set, own_count(set, params), report);
  probes::validate(set, "bake");
  tell_warnings(report);
  return update;
}

TransportBakeParams transport_params_of(const probes::ProbeSet& set) {
  const probes::GeneratorInfo& g = set.generator;
  TransportBakeParams params;
  params.op = g.op;
  if (g.directions > 0) {
    params.transport.directions = g.directions;
    params.transport.surfel_size = g.surfel_size;
    params.transport.link_rays = g.link_rays;
  }
  params.viz = g.viz == probes::VizMethod::links;
  params.viz_params.source = g.viz_source;
  params.fit = set.fitted.has_value();
  if (set.baseline) {
    params.viz_params.neighbors = set.baseline->viz_neighbors;
    params.viz_params.threshold = set.baseline->viz_threshold;
    params.records.points = set.baseline->records;
    params.records.baked = baked_indices(light_modes(set));
    params.transport.most_surfels = set.baseline->most_surfels;
  }
  return params;
}

}  // namespace ssphh::bake
