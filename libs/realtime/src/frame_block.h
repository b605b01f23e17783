#pragma once

#include <ssphh/realtime/settings.h>
#include <ssphh/scene/query.h>

#include "frame_images.h"
#include "gpu_types.h"
#include "lights.h"
#include "probes.h"

namespace ssphh::realtime {

/// Everything that shaders ask of a frame.
FrameBlock frame_block(const scene::CameraPose& camera, const FrameSettings& settings,
                       const FrameImages& images, const Lights& lights, const Probes& probes,
                       const scene::Bounds& bounds);

/// World to clip space as the geometry pass takes it: depth 1 at the near plane, 0 far away.
mat4 clip_matrix(const FrameBlock& block);

}  // namespace ssphh::realtime
