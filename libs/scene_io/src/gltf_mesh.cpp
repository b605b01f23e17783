#include <algorithm>
#include <array>
#include <limits>
#include <numeric>

#include <fmt/format.h>

#include "gltf_accessor.h"
#include "gltf_draco.h"
#include "gltf_parts.h"
#include "printable.h"

namespace ssphh::scene_io {
namespace {

using scene::Mesh;

constexpr std::array mode_names = {"points", "lines", "line loop", "line strip"};

// Corners of triangle lists, strips and fans. Strips alternate so that all triangles keep their orientation.
std::vector<uvec3> triangles_of(std::uint64_t mode, std::size_t corners,
                                const std::vector<std::uint32_t>& indices) {
  const auto vertex = [&](std::size_t corner) {
    return indices.empty() ? static_cast<std::uint32_t>(corner) : indices[corner];
  };
  std::vector<uvec3> out;
  if (mode == 4) {
    out.reserve(corners / 3);
    for (std::size_t i = 0; i + 2 < corners; i += 3)
      out.emplace_back(vertex(i), vertex(i + 1), vertex(i + 2));
    return out;
  }
  if (corners > 2) out.reserve(corners - 2);
  for (std::size_t i = 0; i + 2 < corners; ++i) {
    if (mode == 5) {
      out.emplace_back(vertex(i), vertex(i + 1 + i % 2), vertex(i + 2 - i % 2));
    } else {
      out.emplace_back(vertex(i + 1), vertex(i + 2), vertex(0));
    }
  }
  return out;
}

// The vertices to keep, in rising order, those that triangles use: files often share one vertex buffer
// between many primitives. Renumbers the triangles to match.
std::vector<std::uint32_t> compact_vertices(std::vector<uvec3>& triangles, std::size_t vertex_count) {
  std::uint32_t low = std::numeric_limits<std::uint32_t>::max(), high = 0;
  for (const uvec3& t : triangles) {
    low = std::min({low, t.x, t.y, t.z});
    high = std::max({high, t.x, t.y, t.z});
  }
  std::vector<std::uint32_t> new_index(high - low + 1, 0), used;
  for (const uvec3& t : triangles) {
    for (int c = 0; c < 3; ++c) new_index[t[c] - low] = 1;
  }
  for (std::uint32_t i = 0; i < new_index.size(); ++i) {
    if (new_index[i] == 0) continue;
    new_index[i] = static_cast<std::uint32_t>(used.size());
    used.push_back(low + i);
  }
  if (used.size() >= vertex_count / 2) {  // little to gain: leave the file's vertices as they are
    used.resize(vertex_count);
    std::iota(used.begin(), used.end(), 0u);
    return used;
  }
  for (uvec3& t : triangles) t = {new_index[t.x - low], new_index[t.y - low], new_index[t.z - low]};
  return used;
}

const FloatArray& vertex_array(GltfImport& import, int accessor, int min_components, int max_components) {
  auto& array = import.vertex_arrays[accessor];
  if (!array) {
    array = std::make_shared<const FloatArray>(
        read_floats(import.document, accessor, min_components, max_components));
  } else if (array->components < min_components || array->components > max_components) {
    import.document.item("accessors", accessor)
        .fail(fmt::format("has {} components, which its use as a vertex attribute does not allow",
                          array->components));
  }
  return *array;
}

/// The vertices of a primitive, plain or packed.
struct Vertices {
  GltfImport& import;
  json::Cursor attributes;
  const DracoPrimitive* packed = nullptr;

  // nullptr: the primitive has no such attribute.
  const FloatArray* find(const char* name, int min_components, int max_components) const {
    const auto accessor = import.document.reference(attributes, name, "accessors");
    if (!accessor) return nullptr;
    const FloatArray* unpacked = packed ? packed->find(name) : nullptr;
    if (!unpacked) return &vertex_array(import, *accessor, min_components, max_components);
    if (unpacked->components < min_components || unpacked->components > max_components)
      attributes[name].fail(fmt::format("has {} components, which it cannot have", unpacked->components));
    return unpacked;
  }

  // One T per vertex in `used`; empty when absent. Components that the file lacks (alpha) are 1.
  template <class T>
  std::vector<T> read(const char* name, int min_components, std::size_t vertex_count,
                      const std::vector<std::uint32_t>& used) const {
    const FloatArray* array = find(name, min_components, T::length());
    if (!array) return {};
    if (array->count != vertex_count) {
      attributes[name].fail(fmt::format("has {} elements, POSITION has {}", array->count, vertex_count));
    }
    import.document.charge(used.size() * sizeof(T), attributes);
    std::vector<T> out(used.size(), T(1));
    for (std::size_t i = 0; i < used.size(); ++i) {
      const float* value = (*array)[used[i]];
      for (int c = 0; c < array->components; ++c) out[i][c] = value[c];
    }
    return out;
  }
};

// The material of primitives that name none has glTF's default values.
int default_material(GltfImport& import) {
  auto& materials = import.scene.materials;
  if (materials.size() == import.document.count("materials")) {
    auto& material = materials.emplace_back();
    material.name = "glTF default";
    material.base_color = vec3(1);
    material.metallic = 1;
  }
  return static_cast<int>(import.document.count("materials"));
}

void list_ignored(GltfDocument& document, const json::Cursor& primitive) {
  const json::Cursor attributes = primitive["attributes"];
  for (const auto& [name, unused] : attributes.value().members()) {
    const bool known = name == "POSITION" || name == "NORMAL" || name == "TANGENT" || name == "TEXCOORD_0" ||
                       name == "TEXCOORD_1" || name == "COLOR_0" || name.starts_with("JOINTS_") ||
                       name.starts_with("WEIGHTS_");
    if (!known) document.ignored.add(fmt::format("vertex attribute {}", printable(name, 40)));
  }
}

// What bends the vertices in `used`.
MeshShape read_shape(const Vertices& vertices, const json::Cursor& primitive, std::size_t vertex_count,
                     const std::vector<std::uint32_t>& used) {
  MeshShape shape;
  if (const auto targets = primitive.find("targets")) {
    for (const json::Cursor& target : json::elements(*targets)) {
      const Vertices differences{vertices.import, target};
      vertices.import.document.charge(sizeof(MeshShape::Target), target);
      shape.targets.push_back({differences.read<vec3>("POSITION", 3, vertex_count, used),
                               differences.read<vec3>("NORMAL", 3, vertex_count, used),
                               differences.read<vec3>("TANGENT", 3, vertex_count, used)});
    }
  }
  for (int set = 0;; ++set) {
    const std::string joints = fmt::format("JOINTS_{}", set), weights = fmt::format("WEIGHTS_{}", set);
    if (!vertices.attributes.has(joints.c_str()) || !vertices.attributes.has(weights.c_str())) break;
    shape.influences.push_back({vertices.read<vec4>(joints.c_str(), 4, vertex_count, used),
                                vertices.read<vec4>(weights.c_str(), 4, vertex_count, used)});
  }
  return shape;
}

std::optional<Mesh> import_primitive(GltfImport& import, const json::Cursor& primitive, MeshShape& shape) {
  GltfDocument& document = import.document;
  const auto mode_member = primitive.find("mode");
  const std::uint64_t mode = mode_member ? mode_member->unsigned_integer(6) : 4;
  if (mode < 4) {
    document.ignored.add(fmt::format("mesh of {}", mode_names[mode]));
    return std::nullopt;
  }
  list_ignored(document, primitive);
  const json::Cursor attributes = primitive["attributes"];
  const auto material = document.reference(primitive, "material", "materials");
  const auto packed = read_draco(document, primitive);
  const Vertices vertices{import, attributes, packed ? &*packed : nullptr};
  const FloatArray* positions = vertices.find("POSITION", 3, 3);
  if (!positions) {
    document.ignored.add("mesh without positions");
    return std::nullopt;
  }

  // Assemble triangles
  const std::size_t vertex_count = positions->count;
  std::vector<std::uint32_t> indices;
  std::size_t corners = vertex_count;
  const auto index_accessor = document.reference(primitive, "indices", "accessors");
  if (packed || index_accessor) {
    indices = packed ? packed->indices : read_indices(document, *index_accessor);
    corners = indices.size();
    for (std::size_t i = 0; i < indices.size(); ++i) {
      if (indices[i] >= vertex_count) {
        (index_accessor ? primitive["indices"] : primitive)
            .fail(fmt::format("element {} is {}, the mesh has {} vertices", i, indices[i], vertex_count));
      }
    }
  }
  document.charge(corners * sizeof(uvec3), primitive);
  Mesh mesh;
  mesh.triangles = triangles_of(packed ? 4 : mode, corners, indices);
  if (mesh.triangles.empty()) {
    document.ignored.add("mesh without triangles");
    return std::nullopt;
  }

  // Read the attributes of the vertices that are used
  const auto used = compact_vertices(mesh.triangles, vertex_count);
  mesh.positions = vertices.read<vec3>("POSITION", 3, vertex_count, used);
  mesh.normals = vertices.read<vec3>("NORMAL", 3, vertex_count, used);
  mesh.tangents = vertices.read<vec4>("TANGENT", 4, vertex_count, used);
  mesh.uvs[0] = vertices.read<vec2>("TEXCOORD_0", 2, vertex_count, used);
  mesh.uvs[1] = vertices.read<vec2>("TEXCOORD_1", 2, vertex_count, used);
  mesh.colors = vertices.read<vec4>("COLOR_0", 3, vertex_count, used);
  mesh.material = material ? *material : default_material(import);
  shape = read_shape(vertices, primitive, vertex_count, used);
  return mesh;
}

}  // namespace

const std::vector<int>& import_mesh(GltfImport& import, int index) {
  auto& out = import.meshes_of_mesh[index];
  if (import.mesh_read[index]) return out;
  import.mesh_read[index] = true;
  const json::Cursor mesh = import.document.item("meshes", index);
  const std::string name = mesh.text_or("name", fmt::format("mesh {}", index));
  const json::Cursor primitives = mesh["primitives"];
  for (std::size_t i = 0; i < primitives.size(); ++i) {
    MeshShape shape;
    auto primitive = import_primitive(import, primitives[i], shape);
    if (!primitive) continue;
    import.document.charge(sizeof(Mesh) + name.size(), mesh);
    primitive->name = primitives.size() == 1 ? name : fmt::format("{}.{}", name, i);
    out.push_back(static_cast<int>(import.scene.meshes.size()));
    if (!shape.empty()) import.shapes[out.back()] = std::move(shape);
    import.scene.meshes.push_back(*std::move(primitive));
  }
  return out;
}

}  // namespace ssphh::scene_io
