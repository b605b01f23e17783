#pragma once
/// glTF 2.0, text or GLB (docs/gltf.md says what becomes of what).

#include <cstddef>
#include <filesystem>
#include <span>

#include <ssphh/scene/scene.h>

namespace ssphh::scene_io {

/// Reads a glTF file that is in memory. `path` names it in messages and is the base of relative references to
/// buffers and images. Throws Error naming file and place ("x.gltf: nodes[3].mesh: index 7 out of range, the
/// file has 2 meshes"). Missing or unreadable images are warnings. What is left out stands in Scene::ignored.
/// Skins and morph targets give meshes the shape that they have at `time` [s]; the scene's own animations go
/// on from any time, but these shapes stay.
scene::Scene load_gltf(std::span<const std::byte> data, const std::filesystem::path& path, float time = 0);

}  // namespace ssphh::scene_io
