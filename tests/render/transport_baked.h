#pragma once

#include <ssphh/bake/transport_bake.h>
#include <ssphh/place/init.h>
#include <ssphh/trace/transport_scene.h>

namespace ssphh::test {

struct TransportBaked {
  probes::ProbeSet set;
  bake::TransportBakeReport report;
};

/// The scene's own probes, lit by transport.
inline TransportBaked transport_baked(const scene::Scene& scene, int degree,
                                      const bake::TransportBakeParams& params = {}) {
  const trace::TransportScene source(scene);
  TransportBaked baked;
  baked.set = bake::bake_transport(source, place::init_from_scene(scene, degree), params, baked.report);
  return baked;
}

}  // namespace ssphh::test
