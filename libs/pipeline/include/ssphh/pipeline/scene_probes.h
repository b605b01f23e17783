#pragma once
/// Probes held against the scene that they are to light.

#include <optional>
#include <span>
#include <string>
#include <vector>

#include <ssphh/probes/lookup.h>
#include <ssphh/probes/probe_set.h>
#include <ssphh/rays/transport_source.h>
#include <ssphh/scene/scene.h>
#include <ssphh/trace/render_state.h>

namespace ssphh::pipeline {

/// What tells the scene from the one in which the set was baked: name, content, light groups, modes that it
/// asks for and by which the set would hold other light, and where something moves the time, if one is given.
/// Empty: nothing.
std::string scene_difference(const probes::ProbeSet& set, const scene::Scene& scene,
                             const std::vector<std::string>& light_groups, std::optional<float> time);

/// Throws an Error that names the differences; a warning with `force`.
void require_same_scene(const std::string& file, const probes::ProbeSet& set, const scene::Scene& scene,
                        const std::vector<std::string>& light_groups, std::optional<float> time, bool force);

/// Reads a probe file and holds its set against the scene, as require_same_scene() does; of keys, as
/// probes::read_probe_keys() has them, the light at `time`.
probes::ProbeSet read_probes_of(const scene::Scene& scene, const std::string& file, std::optional<float> time,
                                bool force);

/// The same; of a folder of tiles that are too many for one set those in which a picture shows surfaces, the
/// most seen first. `source` is of the scene. What mirrors show of other tiles is lit by probes of these.
probes::ProbeSet read_probes_in_view(const scene::Scene& scene, const std::string& file,
                                     std::optional<float> time, bool force,
                                     const rays::TransportSource& source, const trace::RenderParams& params);

/// Places of the cameras and probes (without probes: also of lamps and SPHLs; without any of these: where
/// study::default_view() looks from): what they can reach is what counts. `source` is of the scene.
std::vector<vec3> viewpoints(const scene::Scene& scene, const rays::TransportSource& source,
                             std::span<const probes::ProbeSet> sets, float time);

/// What the choice means for the set in `file`. Throws Error for `fitted` and `surface` with a set that
/// has none.
probes::LookupParams lookup_params(const std::string& file, const probes::ProbeSet& set,
                                   const probes::LookupSpec& spec);

}  // namespace ssphh::pipeline
