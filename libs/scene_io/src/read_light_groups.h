#pragma once

#include <ssphh/core/json_cursor.h>
#include <ssphh/scene/scene.h>

namespace ssphh::scene_io {

/// Modes of light groups, as overlays and glTF files write them: {"sky": "baked", "lamp": "mixed"}. Call it
/// when the scene has its lights; fails for a group that it lacks and for a mode that there is not.
void read_light_modes(scene::Scene& scene, const json::Cursor& modes);

/// Dark groups (Scene::dark_groups) of a glTF file: a list of names. Fails for a group that the scene lacks.
void read_dark_groups(scene::Scene& scene, const json::Cursor& groups);

}  // namespace ssphh::scene_io
