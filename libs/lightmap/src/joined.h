#pragma once
/// Which triangles of a mesh hang together, and over which edges.

#include <array>

#include "world_mesh.h"

namespace ssphh::lightmap {

/// Neighbours of each triangle over its three edges; −1: none.
using Neighbours = std::vector<std::array<std::int32_t, 3>>;

/// Over edges between two triangles, of equal winding, whose ends stand at the same places and whose shading
/// normals there differ by at most `crease` radians.
Neighbours joined_smoothly(const WorldMesh& mesh, float crease);
/// Over edges between two triangles whose ends stand at the same places of the world and of the second
/// texture coordinates.
Neighbours joined_in_uvs(const WorldMesh& mesh);

}  // namespace ssphh::lightmap
