#pragma once
/// Wavefront OBJ and MTL (docs/scenes.md says what becomes of what).

#include <filesystem>
#include <string_view>

#include <ssphh/scene/scene.h>

namespace ssphh::scene_io {

/// Reads an OBJ file that is in memory. `path` names it in messages and is the base of MTL and texture names.
/// One mesh, node and instance per object or group and material. Throws Error naming file and line for broken
/// geometry; missing MTL files, materials and textures are warnings, and default colours stand in.
scene::Scene load_obj(std::string_view text, const std::filesystem::path& path);

}  // namespace ssphh::scene_io
