#pragma once
/// Scenes as GLB files (docs/gltf.md says what stands where).

#include <cstddef>
#include <filesystem>
#include <vector>

#include <ssphh/core/json.h>
#include <ssphh/scene/scene.h>

namespace ssphh::scene_io {

/// The whole scene, self-contained: textures as PNG, the environment's image as floats. The same scene gives
/// the same bytes, and load_gltf() gives back a scene of the same scene_hash() (unless objects stand at node
/// −1 or several of a kind at one node: they get nodes of their own; and unless nodes stand otherwise than
/// depth first, as load_gltf() orders them). `scene` must be valid
/// (scene::validate). What has no triangles, and Scene::ignored, is not written. Throws Error when the file
/// would not fit GLB's 4 GiB. The members of `extras`, an object or null, are added to the
/// scene's extras.ssphh.
std::vector<std::byte> export_glb(const scene::Scene& scene, const json::Value& extras = {});

/// export_glb() to a file, which is replaced as a whole.
void write_glb(const std::filesystem::path& path, const scene::Scene& scene);

}  // namespace ssphh::scene_io
