#pragma once

#include "eye.h"
#include "gpu_types.h"
#include "lights.h"
#include "probes.h"

namespace ssphh::realtime {

/// Everything that shaders ask of a frame.
FrameBlock frame_block(const Eye& eye, const FrameSettings& settings, const FrameImages& images,
                       const Lights& lights, const Probes& probes, const scene::Bounds& bounds);

/// World to clip space as the geometry pass takes it: depth 1 at the near plane, 0 far away.
mat4 clip_matrix(const FrameBlock& block);

}  // namespace ssphh::realtime
