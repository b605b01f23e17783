#pragma once
/// VIZ without path tracing: H_{j→i} and P_ij from the links between surfels. Each probe in turn is a sphere
/// that shines; its light on the surfels is found by shadow rays, bounces along the links, and the other
/// probes read it off (docs/methods/transport.md). As in viz.h the sphere neither blocks nor reflects.

#include <vector>

#include <ssphh/core/control.h>
#include <ssphh/probes/probe_set.h>
#include <ssphh/transport/network.h>

namespace ssphh::transport {

struct LinkVizParams {
  int neighbors = 16;   ///< N′: each probe keeps at most so many edges, those with the largest P; −1: all
  float threshold = 0;  ///< and only those with P above it
  probes::VizSource source = probes::VizSource::intensity;
  /// Of what bounces more than once. P and H are for ranking and for HIER: finer than what the spheres'
  /// coarse shadows leave.
  SolveParams solve{.tolerance = 3e-2f};
};

/// Which edges are looked for: those to probes of `to` from probes of `from`, indices.
struct LinkVizScope {
  std::vector<std::uint32_t> to, from;
};

/// Edges i ← j of each of `probes`, ascending j: those that a traced VIZ finds, with every bounce, for
/// diffuse surfaces, as the network is posed. `probes` stand where the network's do and in the same order;
/// only position and radius are read. N direct fields and solutions, memory for the edges kept alone. With a
/// `scope` other probes have no edges, and time is taken for those of `from`
/// alone; an edge has the bits that it has without. Throws Error for parameters out of range.
std::vector<std::vector<probes::Edge>> viz_from_links(const TransportNetwork& network,
                                                      const rays::TransportSource& source,
                                                      std::span<const probes::Probe> probes, int degree,
                                                      const LinkVizParams& params = {},
                                                      const Control& control = {},
                                                      const LinkVizScope* scope = nullptr);

}  // namespace ssphh::transport
