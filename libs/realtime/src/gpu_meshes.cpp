#include "gpu_meshes.h"

#include <fmt/format.h>

#include <ssphh/core/error.h>

#include "gpu_types.h"

namespace ssphh::realtime {
namespace {

/// As gbuffer.vert and shadow.vert take them.
struct Attribute {
  const char* name;
  unsigned location;
  int components;
  gl::VertexSource source;
  bool in_scene;        ///< whether the scene's mesh has it
  std::size_t lacking;  ///< where it stands in GpuVertex
};
std::array<Attribute, 6> attributes_of(const MeshBuffers& b, const scene::Mesh& mesh) {
  constexpr std::size_t uv = offsetof(GpuVertex, uv);
  return {{{"positions", 0, 3, b.positions, true, 0},
           {"normals", 1, 3, b.normals, !mesh.normals.empty(), offsetof(GpuVertex, normal)},
           {"first uvs", 2, 2, b.uvs[0], !mesh.uvs[0].empty(), uv},
           {"tangents", 3, 4, b.tangents, !mesh.tangents.empty(), offsetof(GpuVertex, tangent)},
           {"colors", 4, 4, b.colors, !mesh.colors.empty(), offsetof(GpuVertex, color)},
           {"second uvs", 5, 2, b.uvs[1], !mesh.uvs[1].empty(), uv + sizeof(vec2)}}};
}

void check(const MeshBuffers& buffers, const scene::Mesh& mesh) {
  const auto where = [&](const char* what) {
    return fmt::format("buffers of mesh {}, {}", buffers.mesh, what);
  };
  for (const Attribute& a : attributes_of(buffers, mesh)) {
    const bool given = a.source.buffer != 0;
    if (given && !a.in_scene)
      throw Error(where(a.name), "the scene's mesh has none: leave them out here, too");
    if (given || a.in_scene) gl::check_source(a.source, a.components, mesh.positions.size(), where(a.name));
  }
  gl::check_source(buffers.indices, 3 * mesh.triangles.size(), where("indices"));
}

MeshArrays arrays_of(const MeshBuffers& buffers, const gl::Buffer& lacking) {
  MeshArrays arrays;
  arrays.index = buffers.indices.type;
  for (const Attribute& a : attributes_of(buffers, {})) {
    const gl::VertexSource none{lacking.id(), a.lacking};
    arrays.all.attribute(a.location, a.source.buffer != 0 ? a.source : none, a.components);
  }
  arrays.position_only.attribute(0, buffers.positions, 3);
  for (gl::VertexArray* array : {&arrays.all, &arrays.position_only}) array->indices(buffers.indices.buffer);
  return arrays;
}

void append(const scene::Mesh& mesh, std::vector<GpuVertex>& vertices) {
  for (std::size_t i = 0; i < mesh.positions.size(); ++i) {
    GpuVertex& v = vertices.emplace_back();
    if (!mesh.normals.empty()) v.normal = mesh.normals[i];
    if (!mesh.uvs[0].empty()) v.uv.x = mesh.uvs[0][i].x, v.uv.y = mesh.uvs[0][i].y;
    if (!mesh.uvs[1].empty()) v.uv.z = mesh.uvs[1][i].x, v.uv.w = mesh.uvs[1][i].y;
    if (!mesh.tangents.empty()) v.tangent = mesh.tangents[i];
    if (!mesh.colors.empty()) v.color = mesh.colors[i];
  }
}

}  // namespace

GpuMeshes make_meshes(const scene::Scene& scene, std::span<const MeshBuffers> engines) {
  const std::size_t joined = engines.size();
  GpuMeshes all;
  all.lacking = gl::Buffer(std::span<const GpuVertex>(std::array<GpuVertex, 1>{}));
  all.meshes.resize(scene.meshes.size(), {joined, 0, {}});
  for (const MeshBuffers& b : engines) {
    const std::string where = fmt::format("buffers of mesh {}", b.mesh);
    if (b.mesh < 0 || b.mesh >= static_cast<int>(scene.meshes.size()))
      throw Error(where, fmt::format("the scene has {}", scene.meshes.size()));
    if (all.meshes[b.mesh].arrays != joined) throw Error(where, "they are given twice");
    const scene::Mesh& mesh = scene.meshes[b.mesh];
    check(b, mesh);
    all.meshes[b.mesh] = {all.arrays.size(), 0,
                          pieces_in_order(mesh, b.indices.offset / gl::size_of(b.indices.type))};
    all.arrays.push_back(arrays_of(b, all.lacking));
  }

  std::vector<vec3> positions;
  std::vector<GpuVertex> vertices;
  std::vector<unsigned> indices;
  for (std::size_t m = 0; m < scene.meshes.size(); ++m) {
    if (all.meshes[m].arrays != joined) continue;
    const scene::Mesh& mesh = scene.meshes[m];
    all.meshes[m].first_vertex = static_cast<int>(positions.size());
    all.meshes[m].pieces = split_mesh(mesh, indices);
    positions.insert(positions.end(), mesh.positions.begin(), mesh.positions.end());
    append(mesh, vertices);
  }
  all.positions = gl::Buffer(std::span<const vec3>(positions));
  all.vertices = gl::Buffer(std::span<const GpuVertex>(vertices));
  all.indices = gl::Buffer(std::span<const unsigned>(indices));
  const auto attribute = [&](std::size_t offset) {
    return gl::VertexSource{all.vertices.id(), offset, sizeof(GpuVertex)};
  };
  constexpr std::size_t uv = offsetof(GpuVertex, uv);
  const MeshBuffers ours{.positions = {all.positions.id(), 0, sizeof(vec3)},
                         .normals = attribute(offsetof(GpuVertex, normal)),
                         .tangents = attribute(offsetof(GpuVertex, tangent)),
                         .uvs = {attribute(uv), attribute(uv + sizeof(vec2))},
                         .colors = attribute(offsetof(GpuVertex, color)),
                         .indices = {all.indices.id()}};
  all.arrays.push_back(arrays_of(ours, all.lacking));
  return all;
}

}  // namespace ssphh::realtime
