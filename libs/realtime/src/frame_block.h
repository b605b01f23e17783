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

}  // namespace ssphh::realtime
