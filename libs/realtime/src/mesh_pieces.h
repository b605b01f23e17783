#pragma once
/// Meshes cut into pieces that lie together, so that a shadow map or a view can leave most of them out.

#include <vector>

#include <ssphh/scene/query.h>

namespace ssphh::realtime {

struct MeshPiece {
  std::size_t first_index;
  int index_count;
  scene::Bounds bounds;
};

/// Appends the mesh's triangles to `indices`, ordered so that each piece's stand together.
std::vector<MeshPiece> split_mesh(const scene::Mesh& mesh, std::vector<unsigned>& indices);
/// The mesh's triangles as they follow each other, where their indices begin at `first_index`.
std::vector<MeshPiece> pieces_in_order(const scene::Mesh& mesh, std::size_t first_index);

}  // namespace ssphh::realtime
