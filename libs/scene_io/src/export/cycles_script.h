#pragma once

#include <string_view>

namespace ssphh::scene_io {

/// The Python program that builds a scene in Blender from scene.json and scene.bin beside it and renders it.
/// It is the same for every scene. Source: render_cycles.py, turned into a string when the library is built.
extern const std::string_view cycles_script;

/// The module specular_albedo.py, which render.py imports from its own folder.
extern const std::string_view cycles_albedo_script;

}  // namespace ssphh::scene_io
