#pragma once
/// Where a camera stands that a scene lacks.

#include <ssphh/rays/transport_source.h>
#include <ssphh/scene/query.h>

namespace ssphh::study {

/// A view that shows what matters of the scene, posed at `time` seconds. Inside a scene that is closed in
/// most directions around many places within, and that light gets into (a room, a house): from where the eye
/// of somebody who stands there would be, far across and toward things. Else from outside, from in front, the
/// right and above, so that nearly all of it fits into a square picture. The same scene gives the same view.
/// `source` must be of the scene. Throws Error as scene::check_indices() does.
scene::CameraPose default_view(const scene::Scene& scene, const rays::TransportSource& source,
                               float time = 0);

}  // namespace ssphh::study
