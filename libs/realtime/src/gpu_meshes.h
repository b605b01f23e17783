#pragma once
/// Meshes in OpenGL's memory: joined in buffers of this library, or where an engine keeps them.

#include <span>
#include <vector>

#include <ssphh/gl/buffer.h>
#include <ssphh/realtime/mesh_buffers.h>
#include <ssphh/scene/query.h>

#include "mesh_pieces.h"

namespace ssphh::realtime {

/// How shaders read the meshes of some buffers.
struct MeshArrays {
  gl::VertexArray all, position_only;
  gl::Index index = gl::Index::u32;
};

struct GpuMesh {
  std::size_t arrays = 0;  ///< which of GpuMeshes::arrays
  int first_vertex = 0;
  std::vector<MeshPiece> pieces;
};

struct GpuMeshes {
  gl::Buffer positions, vertices, indices;  ///< of all meshes that no engine has
  gl::Buffer lacking;                       ///< a vertex of what meshes of an engine lack
  std::vector<MeshArrays> arrays;           ///< of each mesh that an engine has, then of those buffers
  std::vector<GpuMesh> meshes;

  std::size_t bytes() const { return positions.size() + vertices.size() + indices.size() + lacking.size(); }
};

/// Throws Error for buffers that do not hold the scene's meshes, as far as their sizes tell.
GpuMeshes make_meshes(const scene::Scene& scene, std::span<const MeshBuffers> engines);

}  // namespace ssphh::realtime
