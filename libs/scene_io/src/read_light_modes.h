#pragma once

#include <ssphh/core/json_cursor.h>
#include <ssphh/scene/scene.h>

namespace ssphh::scene_io {

/// Modes of light groups, as overlays and glTF files write them: {"sky": "baked", "lamp": "mixed"}. Call it
/// when the scene has its lights; fails for a group that it lacks and for a mode that there is not.
void read_light_modes(scene::Scene& scene, const json::Cursor& modes);

}  // namespace ssphh::scene_io
