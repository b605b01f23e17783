#pragma once
/// Where a frame is seen from, and which way its pixels look.

#include <ssphh/realtime/settings.h>
#include <ssphh/scene/query.h>

#include "frame_images.h"

namespace ssphh::realtime {

/// A place p of the picture, -1..1 to the right and up, looks from `position` along `forward` + q.x `right` +
/// q.y `up`, q = p - `shift`; orthographic: along `forward` from beside the position by the others.
struct Eye {
  vec3 position{0}, right{0}, up{0}, forward{0};  ///< `forward` is of length 1, and the others' normal
  vec2 shift{0};
  bool orthographic = false;
};

/// Throws Error for a pose that is not finite.
Eye eye_of(const scene::CameraPose& camera, const FrameSettings& settings, const FrameImages& images);
/// Of any perspective or orthographic camera, whose clip space has the least and the greatest distance at
/// these z. Throws Error, naming a G-buffer, for other matrices.
Eye eye_of(const mat4& view_projection, float nearest_z, float farthest_z);

}  // namespace ssphh::realtime
