#include <algorithm>

#include <fmt/format.h>

#include <ssphh/bake/transport_bake.h>
#include <ssphh/core/log.h>
#include <ssphh/core/require.h>
#include <ssphh/core/stopwatch.h>
#include <ssphh/probes/probe_file.h>
#include <ssphh/transport/session_sets.h>

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
void warn_of(const std::vector<std::string>& names, const char* problem, TransportBakeReport& report) {
  if (names.empty()) return;
  constexpr std::size_t most = 5;
  std::string list;
  for (std::size_t i = 0; i < std::min(names.size(), most); ++i)
    list += fmt::format("{}\"{}\"", i == 0 ? "" : ", ", names[i]);
  report.warnings.push_back(
      fmt::format("{} {}: {}{}", names.size(), problem, list, names.size() > most ? ", ..." : ""));
}

void check_light(const transport::TransportNetwork& network, const probes::ProbeSet& set, bool converged,
                 TransportBakeReport& report) {
  std::vector<std::string> inside, dark;
  for (std::size_t i = 0; i < set.probes.size(); ++i) {
    const probes::Probe& probe = set.probes[i];
    if (back_share(network.gbuffer(), i) > 0.5f) {
      inside.push_back(probe.name);
    } else if (sh::mean(probe.self) == vec3(0)) {
      dark.push_back(probe.name);
    }
  }
  warn_of(inside, "probes seem to lie inside a body (most of what they see are back faces)", report);
  warn_of(dark, "probes receive no light at all", report);
  constexpr double most_lost = 0.01;
  if (report.lost > most_lost) {
    report.warnings.push_back(fmt::format(
        "{:.1f} % of the surfels' rays end where no surfel is: their light is lost; more --directions or "
        "smaller surfels may find the places",
        100 * report.lost));
  }
  if (!converged) {
    report.warnings.push_back(fmt::format(
        "the light did not converge in {} iterations: surfaces reflect nearly all of it", report.iterations));
  }
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

void keep_records(transport::RelightSession& session, probes::ProbeSet& set,
                  const transport::GatherParams& params, TransportBakeReport& report,
                  const Control& control) {
  const Stopwatch watch;
  session.keep_records(params, control);
  set.surface = session.records_by_group(control);
  report.record_seconds = watch.seconds();
}

void find_edges(const transport::TransportNetwork& network, const rays::TransportSource& source,
                probes::ProbeSet& set, const transport::LinkVizParams& params, TransportBakeReport& report,
                const Control& control) {
  const Stopwatch watch;
  std::vector<std::vector<probes::Edge>> edges =
      transport::viz_from_links(network, source, set.probes, set.degree, params, control);
  for (std::size_t i = 0; i < edges.size(); ++i) set.probes[i].edges = std::move(edges[i]);
  set.generator.viz = probes::VizMethod::links;
  report.viz_seconds = watch.seconds();
}

/// Each group's light with the probes as the only unknowns.
std::vector<std::vector<sh::RadianceSh>> bounce_by_group(const transport::RelightSession& session,
                                                         const rays::TransportSource& source,
                                                         const TransportBakeParams& params, int degree,
                                                         TransportBakeReport& report, bool& converged) {
  const transport::BounceOperator bounce(session.network(), source, degree, params.bounce);
  std::vector<std::vector<sh::RadianceSh>> reflected;
  for (const std::vector<transport::Irradiance4>& direct : session.direct_by_group()) {
    const transport::BounceReport done = bounce.solve(direct, reflected.emplace_back());
    report.iterations = std::max(report.iterations, done.iterations);
    report.contraction = std::max(report.contraction, done.contraction);
    converged = converged && done.converged;
  }
  return reflected;
}

void require_probes(const probes::ProbeSet& set) {
  if (set.probes.empty())
    throw Error("bake", "there are no probes to bake", "run INIT on a scene with SPHLs");
}

}  // namespace

probes::ProbeSet bake_transport(const rays::TransportSource& source, probes::ProbeSet set,
                                const TransportBakeParams& params, TransportBakeReport& report,
                                const Control& control) {
  require_probes(set);
  require(params.op != probes::LightOperator::path, "transport bake",
          "path tracing is no transport between probes");
  report = {};
  const std::uint64_t rays_before = source.rays_traced();
  const Stopwatch watch;

  // Light everything once, then each group alone.
  transport::RelightParams relight_params{params.transport, params.solve};
  relight_params.degree = set.degree;
  transport::RelightSession session(source, transport::places_of(set.probes), relight_params,
                                    set.generator.time, control);
  session.update(session.lighting(), control);
  const transport::TransportNetwork& network = session.network();
  describe_network(network, set, report);
  bool converged = true;
  std::vector<std::vector<sh::RadianceSh>> reflected;
  if (params.op == probes::LightOperator::bounce) {
    report.contraction = 0;
    reflected = bounce_by_group(session, source, params, set.degree, report, converged);
  } else {
    transport::SolveReport slowest;
    reflected = session.reflected_by_group(control, &slowest);
    report.iterations = slowest.iterations;
    converged = slowest.converged;
  }

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
  if (params.records.points > 0) keep_records(session, set, params.records, report, control);
  if (params.viz) find_edges(network, source, set, params.viz_params, report, control);
  if (params.fit) fit(session, source, set, params.fit_params, report, control);
  report.rays = source.rays_traced() - rays_before;
  check_light(network, set, converged, report);
  probes::validate(set, "bake");
  for (const std::string& warning : report.warnings) log_warning("{}", warning);
  return set;
}

void add_transport(const rays::TransportSource& source, probes::ProbeSet& set,
                   const TransportBakeParams& params, TransportBakeReport& report, const Control& control) {
  require_probes(set);
  report = {};
  const std::uint64_t rays_before = source.rays_traced();
  transport::RelightSession session(source, transport::places_of(set.probes),
                                    {params.transport, params.solve}, set.generator.time, control);
  const transport::TransportNetwork& network = session.network();
  describe_network(network, set, report);
  if (params.viz) find_edges(network, source, set, params.viz_params, report, control);
  if (params.fit || params.records.points > 0) session.update(session.lighting(), control);
  if (params.fit) fit(session, source, set, params.fit_params, report, control);
  if (params.records.points > 0) keep_records(session, set, params.records, report, control);
  report.rays = source.rays_traced() - rays_before;
}

void update_edges(const rays::TransportSource& source, probes::ProbeSet& set,
                  std::span<const std::uint32_t> which, const transport::LinkVizParams& params,
                  TransportBakeReport& report, const Control& control) {
  require_probes(set);
  report = {};
  if (which.empty()) return;
  const std::uint64_t rays_before = source.rays_traced();
  const Stopwatch watch;
  transport::LinkVizScope scope{{which.begin(), which.end()}, {which.begin(), which.end()}};
  for (const std::uint32_t i : which) {
    require(i < set.probes.size(), "update of edges", "there is no probe of that index");
    for (const probes::Edge& edge : set.probes[i].edges)
      scope.from.push_back(static_cast<std::uint32_t>(edge.from));
  }
  std::vector<vec3> positions;
  for (const probes::Probe& probe : set.probes) positions.push_back(probe.position);
  transport::TransportParams network_params;
  network_params.directions = set.generator.directions;
  network_params.surfel_size = set.generator.surfel_size;
  network_params.link_rays = set.generator.link_rays;
  const transport::TransportNetwork network(source, positions, network_params, set.generator.time, control);
  describe_network(network, set, report);
  std::vector<std::vector<probes::Edge>> edges =
      transport::viz_from_links(network, source, set.probes, set.degree, params, control, &scope);
  for (const std::uint32_t i : which) set.probes[i].edges = std::move(edges[i]);
  report.viz_seconds = watch.seconds();
  report.rays = source.rays_traced() - rays_before;
}

}  // namespace ssphh::bake
