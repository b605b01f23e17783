#pragma once
/// What people do with relight sessions: aim lamps, and keep the light.

#include <string>
#include <vector>

#include <ssphh/core/control.h>
#include <ssphh/probes/probe_set.h>
#include <ssphh/scene/scene.h>
#include <ssphh/transport/relight_session.h>

namespace ssphh::pipeline {

/// A light's pose turned such that −z goes along `direction`, of any length but 0, else throws Error; the
/// place stays. A flat lamp is turned the shortest way.
mat4 aimed(scene::LightType type, const mat4& world, const vec3& direction);

/// The light of a session in this scene as a bake would write it, in the state of its last update. `groups`
/// are the names of the scene's light groups. Throws Cancelled when asked to stop.
probes::ProbeSet baked_session(const transport::RelightSession& session, const scene::Scene& scene,
                               const std::vector<std::string>& groups, probes::LightOperator op,
                               const Control& control = {});

}  // namespace ssphh::pipeline
