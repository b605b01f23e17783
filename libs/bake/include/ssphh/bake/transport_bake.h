#pragma once
/// A set's light by transport between surfels instead of path tracing: every bounce, no noise, seconds
/// instead of minutes (docs/methods/transport.md).

#include <ssphh/bake/light_scope.h>
#include <ssphh/probes/probe_set.h>
#include <ssphh/transport/bounce.h>
#include <ssphh/transport/fitted_weights.h>
#include <ssphh/transport/link_viz.h>
#include <ssphh/transport/relight_session.h>

namespace ssphh::bake {

struct TransportBakeParams {
  probes::LightOperator op = probes::LightOperator::surfel;  ///< surfel or bounce
  transport::BounceParams bounce;
  transport::TransportParams transport{.surfels_per_radius = 32};  ///< finer: nobody waits for a frame
  transport::SolveParams solve{.max_iterations = 2000, .settle = true};
  bool viz = false;  ///< also find the edges between the probes
  transport::LinkVizParams viz_params;
  transport::GatherParams records;  ///< of light kept at surfaces
  bool fit = false;                 ///< also fit lookup weights at the surfels
  transport::FitParams fit_params;
  /// Only so many of the set's first probes are asked for: no other gets edges or is warned of. The others
  /// are there to see what is around these. 0: all.
  std::size_t own_probes = 0;
};

/// What a bake took: not part of the set.
struct TransportBakeReport {
  std::size_t surfels = 0, links = 0;
  std::size_t tiles = 1;                         ///< that were baked one after the other (tiled_transport.h)
  std::size_t resumed = 0;                       ///< of these, that an earlier run had baked
  float finest_surfel = 0, coarsest_surfel = 0;  ///< edges [m]
  int iterations = 0;                            ///< of the light group that took most
  double contraction = 0;   ///< surfel: upper bound of the factor by which one bounce shrinks light; bounce:
                            ///< an estimate of it for the probes' operator
  float error = 0;          ///< surfel: share of the light that is missing at most
  double lost = 0;          ///< share of the surfels' rays that end where no surfel is
  std::size_t records = 0;  ///< surface points that keep light
  double seconds = 0;       ///< all but VIZ, the fit and the records
  double viz_seconds = 0;
  double fit_seconds = 0;
  double record_seconds = 0;
  std::uint64_t rays = 0;
  std::vector<std::string> warnings;
};

/// Fills the set that INIT made with `surfel` or `bounce` transport, per light group, in the pose of its
/// time; degree and places are the set's. What the set held of light, edges, hierarchy, fitted points and
/// records is replaced. Warns about probes inside a body or without light and about more than 1 % of light
/// lost. Throws Error without probes, for parameters out of range and for light that does not converge.
probes::ProbeSet bake_transport(const rays::TransportSource& source, probes::ProbeSet set,
                                const TransportBakeParams& params, TransportBakeReport& report,
                                const Control& control = {});

/// What an update finds anew of what a set holds.
struct TransportScope {
  LightScope light;  ///< records go with the nearest probe; of some light groups alone they keep their places
  std::optional<std::vector<std::uint32_t>> edges;  ///< to these probes, ascending; none: to all
};

/// What the parameters ask for beside light (edges, lookup weights, records), for a set whose light something
/// else finds: builds a network in the pose of the set's time and notes its parameters in the set; without
/// anything to find it builds none. In a `scope` that names probes, edges are found to each of them from one
/// another and from those that its edges come from. Fills the report's surfels, links, contraction, lost,
/// viz_seconds, fit_seconds, record_seconds and rays.
void add_transport(const rays::TransportSource& source, probes::ProbeSet& set,
                   const TransportBakeParams& params, TransportBakeReport& report,
                   const Control& control = {}, const TransportScope& scope = {});

/// What an update found by transport.
struct TransportUpdate {
  std::vector<float> changed;         ///< of every probe: changed_share() of its light
  std::vector<std::uint32_t> probes;  ///< whose light has other bits than before, ascending
};

/// Finds the light of a set that bake_transport() filled anew, within the scope; edges, if the parameters ask
/// for them, to those of its probes whose light has changed by more than `edge_change`. Its light groups must
/// be those of the source. Throws Error for others, and as bake_transport() does.
TransportUpdate update_transport(const rays::TransportSource& source, probes::ProbeSet& set,
                                 const TransportBakeParams& params, const LightScope& scope,
                                 float edge_change, TransportBakeReport& report, const Control& control = {});

/// What bake_transport() and add_transport() were told when they filled this set, as far as it and its
/// baseline tell.
TransportBakeParams transport_params_of(const probes::ProbeSet& set);

}  // namespace ssphh::bake
