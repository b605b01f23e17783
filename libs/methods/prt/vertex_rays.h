#pragma once
/// What the vertices of a mesh see of it: traced once, for transfer vectors of any reach and any number of
/// bounces.

#include <cstdint>
#include <vector>

#include <ssphh/core/control.h>

#include "transfer_mesh.h"

namespace ssphh::methods::prt {

/// A task of the loops over vertices takes so many.
inline constexpr std::size_t vertices_at_once = 32;

/// Where a vertex's ray ends.
struct VertexHit {
  float distance;               ///< [m]; infinite: it escapes
  std::int32_t triangle;        ///< of the mesh; −1: none, or of a surface that the mesh lacks
  std::uint16_t second, third;  ///< weights of the triangle's last two corners, in shares of 65535
  std::uint32_t albedo;         ///< pack_albedo

  vec3 weights() const {
    const float b = static_cast<float>(second) / 65535, c = static_cast<float>(third) / 65535;
    return {1 - b - c, b, c};
  }
};

struct VertexRays {
  int count = 0;                ///< per vertex
  std::vector<VertexHit> hits;  ///< [vertex · count + ray]
  /// 1 where a vertex lies within a body: more than half of what it sees shows its back.
  std::vector<std::uint8_t> buried;

  std::span<const VertexHit> of(std::size_t vertex) const {
    return std::span(hits).subspan(vertex * static_cast<std::size_t>(count), static_cast<std::size_t>(count));
  }
};

/// Direction of a vertex's ray: cosine-distributed about its normal.
vec3 vertex_ray_direction(const TransferMesh& mesh, std::size_t vertex, int ray);

/// The triangles around each vertex.
struct VertexRings {
  explicit VertexRings(const TransferMesh& mesh);
  std::span<const std::uint32_t> of(std::size_t vertex) const {
    return std::span(triangle).subspan(begin[vertex], begin[vertex + 1] - begin[vertex]);
  }

  std::vector<std::uint32_t> begin;  ///< one more than vertices
  std::vector<std::uint32_t> triangle;
};

/// Rays start on the triangles around a vertex, near it: a vertex in a corner would start them within its
/// neighbour's wall. They see part 0 of the source alone: what moves neither hides nor reflects. The same
/// input gives the same bits.
VertexRays find_vertex_rays(const TransferMesh& mesh, const VertexRings& rings, const MeshIndex& index,
                            const rays::TransportSource& source, int rays, const Control& control = {});

}  // namespace ssphh::methods::prt
