#pragma once
/// The parts of the GLB writer; gltf_export.cpp puts them together.

#include <cstddef>
#include <map>
#include <set>
#include <span>
#include <string>
#include <tuple>
#include <vector>

#include <nlohmann/json.hpp>

#include <ssphh/scene/scene.h>

namespace ssphh::scene_io {

using Json = nlohmann::ordered_json;

/// The document under construction: its arrays in order, and the binary chunk.
struct GltfExport {
  explicit GltfExport(const scene::Scene& scene_) : scene(scene_) {}

  const scene::Scene& scene;
  Json accessors = Json::array(), animations = Json::array(), buffer_views = Json::array(),
       cameras = Json::array(), images = Json::array(), lights = Json::array(), materials = Json::array(),
       meshes = Json::array(), nodes = Json::array(), samplers = Json::array(), textures = Json::array();
  std::set<std::string> extensions;
  std::vector<std::byte> binary;

  std::map<int, int> images_by_texture;
  std::map<std::tuple<int, int, int>, int> samplers_by_wrap;
  std::map<std::pair<int, int>, int> textures_by_parts;
  int default_material = -1;
};

/// The shortest decimal that reads back as the same float. Throws Error for NaN and infinities.
Json number(float value);
Json numbers(std::span<const float> values);
Json numbers(const vec3& v);

/// Appends a value to an array and returns its index.
int push(Json& array, Json value);

/// Sets object.extensions.NAME and notes its use.
void add_extension(GltfExport& out, Json& object, const std::string& name, Json value);

/// Bytes in the binary chunk, four-byte aligned. Returns the buffer view's index. `target`: 34962 vertices,
/// 34963 indices, 0 neither.
int add_buffer_view(GltfExport& out, std::span<const std::byte> bytes, int target);

/// `components` floats per element; `bounds` writes min and max. Returns the accessor's index.
int add_float_accessor(GltfExport& out, std::span<const float> values, int components, bool bounds,
                       int target);

/// Triangle corners, in 16 bits where they fit. Returns the accessor's index.
int add_index_accessor(GltfExport& out, std::span<const uvec3> triangles, std::size_t vertex_count);

/// All materials, and the textures they use.
void export_materials(GltfExport& out);
/// Index of the glTF material for a scene material; −1 is written on first use.
int export_material_index(GltfExport& out, int material);

/// Nodes with the meshes, cameras, lights and SPHLs that stand at them. Returns the roots.
Json export_nodes(GltfExport& out);

Json export_camera(const scene::Camera& camera);
Json export_light(const scene::Light& light);
/// extras of the glTF scene, or null.
Json export_environment(GltfExport& out);
void export_animations(GltfExport& out);

}  // namespace ssphh::scene_io
