#pragma once
/// Pictures rendered in tiles by a farm.

#include <ssphh/farm/dispatch.h>
#include <ssphh/probes/lookup.h>
#include <ssphh/scene/scene.h>

namespace ssphh::farm {

/// The probes and the lookup of a render that is lit by them.
struct RenderProbes {
  const probes::ProbeSet* set = nullptr;
  probes::LookupSpec lookup;  ///< as ProbeLighting's
};

/// All of `params.path.passes` passes of the whole picture, bit for bit as PathTracer::render or, with
/// `probes`, render_with. Images that `layers` (each once, in the order of their table) leave out are
/// black.
/// Tiles that are in options.results are taken from there.
trace::RenderState render(const FarmOptions& options, const scene::Scene& scene, float time,
                          const trace::RenderParams& params, const std::optional<RenderProbes>& probes,
                          const std::vector<trace::RenderLayer>& layers, FarmReport& report,
                          const Control& control = {});

/// Edge of a tile in pixels; at the right and lower edge they are smaller.
inline constexpr int tile_edge = 32;

}  // namespace ssphh::farm
