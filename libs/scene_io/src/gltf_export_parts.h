#pragma once
/// The parts of the GLB writer; gltf_export.cpp puts them together.

#include <cstddef>
#include <map>
#include <set>
#include <span>
#include <string>
#include <tuple>
#include <vector>

#include <ssphh/core/json.h>
#include <ssphh/scene/scene.h>

namespace ssphh::scene_io {

/// The document under construction: its arrays in order, and the binary chunk.
struct GltfExport {
  explicit GltfExport(const scene::Scene& scene_) : scene(scene_) {}

  const scene::Scene& scene;
  json::Value accessors = json::Value::array(), animations = json::Value::array(),
              buffer_views = json::Value::array(), cameras = json::Value::array(),
              images = json::Value::array(), lights = json::Value::array(), materials = json::Value::array(),
              meshes = json::Value::array(), nodes = json::Value::array(), profiles = json::Value::array(),
              samplers = json::Value::array(), textures = json::Value::array();
  std::set<std::string> extensions;
  std::vector<std::byte> binary;

  std::map<int, int> images_by_texture;
  std::map<std::tuple<unsigned, unsigned, bool>, int> samplers_by_wrap;
  std::map<std::pair<int, int>, int> textures_by_parts;
  int default_material = -1;
  std::vector<scene::LampProfile> profiles_written;  ///< in the order of `profiles`
};

/// The shortest decimal that reads back as the same float. Throws Error for NaN and infinities.
json::Value number(float value);
json::Value numbers(std::span<const float> values);
json::Value numbers(const vec3& v);

/// Appends a value to an array and returns its index.
int push(json::Value& array, json::Value value);

/// Sets object.extensions.NAME and notes its use.
void add_extension(GltfExport& out, json::Value& object, const std::string& name, json::Value value);

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
json::Value export_nodes(GltfExport& out);

json::Value export_camera(const scene::Camera& camera);
json::Value export_light(const scene::Light& light);
/// EXT_lights_ies of a node: a light with a profile, which is written once for all that have it.
json::Value export_profile_light(GltfExport& out, const scene::Light& light, const std::string& node_name);
/// extras.ssphh.environment of the glTF scene, or null.
json::Value export_environment(GltfExport& out);
/// extras.ssphh.light_modes of it, or null.
json::Value export_light_modes(const GltfExport& out);
void export_animations(GltfExport& out);

}  // namespace ssphh::scene_io
