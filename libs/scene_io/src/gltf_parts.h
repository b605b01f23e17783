#pragma once
/// The parts of the glTF loader; gltf.cpp runs them in this order.

#include <span>
#include <vector>

#include <ssphh/scene/scene.h>

#include "gltf_accessor.h"
#include "gltf_deform.h"
#include "read_emission.h"

namespace ssphh::scene_io {

/// An instance whose node or mesh bends it.
struct BentInstance {
  std::size_t instance;
  json::Cursor file_node;
};

/// What the parts hand to each other: indices of the file on the left, of the scene on the right.
struct GltfImport {
  GltfDocument& document;
  scene::Scene& scene;
  std::vector<int> texture_of_image;             ///< −2: not read yet, −1: unusable
  std::vector<std::vector<int>> meshes_of_mesh;  ///< one scene mesh per primitive
  std::vector<bool> mesh_read;
  std::map<int, std::shared_ptr<const FloatArray>> vertex_arrays;  ///< decoded once, shared by primitives
  std::vector<int> node_of_node;                                   ///< −1: not in the scene that is shown
  std::map<int, MeshShape> shapes;                                 ///< of the scene's meshes that can bend
  std::vector<BentInstance> bent;
  /// Of the scene's nodes whose morph targets are animated: channel k moves node k along x by target k's
  /// weight.
  std::map<int, std::vector<scene::AnimationChannel>> weight_keys;
  std::map<int, scene::LampProfile> profiles;  ///< of EXT_lights_ies, read on first use
};

/// Types, references and sizes of everything in the file, used or not, before anything is decoded.
void check_structure(GltfDocument& document);

/// All materials, and the textures they use.
void import_materials(GltfImport& import);

/// Primitives of a glTF mesh as scene meshes; read on first use.
const std::vector<int>& import_mesh(GltfImport& import, int mesh);

/// The node hierarchy of the default scene with its instances, cameras, lights and SPHLs.
void import_nodes(GltfImport& import);

/// Light of KHR_lights_punctual, without its node.
scene::Light import_light(const json::Cursor& light, const GltfDocument& document);
/// Lamp of EXT_lights_ies at a node of the file, without its node; `name`: where it has none of its own.
/// None: the node has no such lamp.
std::optional<scene::Light> import_profile_light(GltfImport& import, const json::Cursor& file_node,
                                                 const std::string& name);
/// Files that the document's extras name, beside it.
FileOf files_beside(const GltfDocument& document);
/// Camera, without its node.
scene::Camera import_camera(const json::Cursor& camera);
/// extras.ssphh.environment of the default scene.
void import_environment(GltfImport& import, const json::Cursor& gltf_scene);
/// extras.ssphh.light_modes and dark_groups of the default scene, whose lights are all there.
void import_light_groups(GltfImport& import);

/// Keyframes; marks animated nodes and what is below them as movable.
void import_animations(GltfImport& import);

/// Gives meshes with morph targets or skins their shape at `time` [s], each instance its own. Those whose
/// shape is animated count as movable, and keep this one; a warning says so.
void pose_meshes(GltfImport& import, float time);

/// object.extensions.NAME
std::optional<json::Cursor> extension(const json::Cursor& object, const char* name);
/// object.extras.NAME; extras that are no object count as none.
std::optional<json::Cursor> extra(const json::Cursor& object, const char* name);
/// object.extras.light_group, or "".
std::string light_group_extra(const json::Cursor& object);

/// Bytes of an image or environment given by uri (data URI or file) or bufferView. Buffer views stay owned by
/// the document; other bytes go to `storage`.
std::span<const std::byte> image_bytes(GltfDocument& document, const json::Cursor& image,
                                       std::vector<std::byte>& storage);

}  // namespace ssphh::scene_io
