#pragma once
/// What a picture or a set of probes asks of the farm, and the key under which one unit's result is kept:
/// everything that decides it and nothing else, so that it serves other pictures and bakes as well.

#include <ssphh/farm/farm_render.h>
#include <ssphh/farm/job.h>
#include <ssphh/farm/scene_package.h>

namespace ssphh::farm {

/// The job of all of the set's places, without probes.
ProbeJob job_of_set(const probes::ProbeSet& set, const bake::VizParams& viz_params, bake::BakeStage stage,
                    const SceneRef& scene);

/// `file`: the probes as they travel.
ProbeLighting lighting_of(const RenderProbes& probes, const Blob& file);

/// Of one probe of job_of_set.
Hash128 unit_key(const ProbeJob& all, std::uint32_t probe);

/// Of one tile; those of the job do not matter.
Hash128 unit_key(const TileJob& job, const trace::Tile& tile);

/// Of all that the job asks for, whatever package its scene comes in.
Hash128 unit_key(const TransportJob& job);

}  // namespace ssphh::farm
