#pragma once

#include <ssphh/core/json_cursor.h>
#include <ssphh/scene/scene.h>

namespace ssphh::scene_io {

/// An overlay's entry of "textures": the tone curve of every texture of a name, gain · x^gamma + offset on
/// its linear values, put into its texels. Fails for a texture that the scene lacks and for one that is no
/// colour (normals, roughness).
void read_tone_curve(scene::Scene& scene, const json::Cursor& entry);

}  // namespace ssphh::scene_io
