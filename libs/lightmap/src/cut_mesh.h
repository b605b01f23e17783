#pragma once
/// Meshes of smaller triangles.

#include <array>
#include <functional>

#include <ssphh/scene/scene.h>

namespace ssphh::lightmap {

/// Whether a part of the mesh's triangle `whole`, with these corners in the world [m], is to be cut.
using WantsCut = std::function<bool(const std::array<vec3, 3>& corners, std::uint32_t whole)>;

struct CutMesh {
  scene::Mesh mesh;
  std::vector<std::uint32_t> whole;  ///< which triangle each is a part of
};

/// Bisects triangles at their longest edge in the world until none is wanted smaller, or there are `most`.
/// Neighbours are cut with them (Rivara, Algorithms for refining triangular grids, 1984), also where they
/// share places and no vertices: nothing gapes. New vertices are the means of their edge's ends.
CutMesh cut_mesh(scene::Mesh mesh, const mat4& to_world, const WantsCut& wants, std::size_t most);

}  // namespace ssphh::lightmap
