#pragma once
/// All surfaces that never move, as triangles fine enough to keep light at their vertices.

#include <cstdint>
#include <vector>

#include <ssphh/geometry/triangle_tree.h>
#include <ssphh/rays/transport_source.h>

namespace ssphh::methods::prt {

struct TransferMeshParams {
  float edge = 0;           ///< longest edge of a triangle [m], over 0
  int most = 1 << 20;       ///< vertices; more are an Error, not a long wait
  bool both_sides = false;  ///< also the back of every surface; else of those whose back lies in the open
};

struct TransferMesh {
  std::vector<rays::SurfacePoint> vertices;  ///< world space; smooth normals where the scene has them
  std::vector<uvec3> triangles;              ///< counter-clockwise seen from their side

  geometry::Corners corners(std::size_t triangle) const {
    const uvec3& t = triangles[triangle];
    return {vertices[t.x].position, vertices[t.y].position, vertices[t.z].position};
  }
};

/// The instances that do not move, posed at time 0. Edges longer than asked for are halved, which neighbours
/// do alike, so that no vertex lies on another triangle's edge. A surface's back has vertices of its own;
/// it lies in the open when of what cosine rays from there meet less than half shows its back. Throws Error
/// for too many vertices.
TransferMesh make_transfer_mesh(const scene::Scene& scene, const rays::TransportSource& source,
                                const TransferMeshParams& params);

/// A triangle of a mesh that holds a surface point.
struct MeshPlace {
  std::int32_t triangle = -1;  ///< −1: none
  vec3 weight{0};              ///< of its vertices
};

/// Finds places on a mesh.
class MeshIndex {
 public:
  MeshIndex() = default;
  /// Points may lie `reach` metres off the mesh.
  MeshIndex(const TransferMesh& mesh, float reach);

  /// The nearest triangle that faces the way of the point's normal. None for points that move.
  MeshPlace find(const rays::SurfacePoint& point) const;
  std::size_t bytes() const { return tree_.bytes() + normals_.size() * sizeof(vec3); }

 private:
  geometry::TriangleTree tree_;
  std::vector<vec3> normals_;  ///< of the triangles, unit
  float reach_ = 0;
};

}  // namespace ssphh::methods::prt
