#include "mesh_pieces.h"

#include <algorithm>
#include <span>

namespace ssphh::realtime {
namespace {

constexpr std::size_t most_triangles = 1500;

struct Splitter {
  const scene::Mesh& mesh;
  std::vector<unsigned>& indices;
  std::vector<MeshPiece>& pieces;

  vec3 middle(const uvec3& t) const {
    return (mesh.positions[t.x] + mesh.positions[t.y] + mesh.positions[t.z]) / 3.0f;
  }

  /// Halves by the longest axis of the triangles' middles until they are few.
  void split(std::span<uvec3> triangles) {
    if (triangles.size() <= most_triangles) return emit(triangles);
    scene::Bounds middles;
    for (const uvec3& t : triangles) middles.add(middle(t));
    const vec3 extent = middles.max - middles.min;
    const int axis = extent.x >= extent.y && extent.x >= extent.z ? 0 : (extent.y >= extent.z ? 1 : 2);
    const auto half = static_cast<std::ptrdiff_t>(triangles.size() / 2);
    std::nth_element(triangles.begin(), triangles.begin() + half, triangles.end(),
                     [&](const uvec3& a, const uvec3& b) { return middle(a)[axis] < middle(b)[axis]; });
    split(triangles.first(static_cast<std::size_t>(half)));
    split(triangles.subspan(static_cast<std::size_t>(half)));
  }

  void emit(std::span<const uvec3> triangles) {
    if (triangles.empty()) return;
    MeshPiece piece{indices.size(), static_cast<int>(3 * triangles.size()), {}};
    for (const uvec3& t : triangles) {
      for (int c = 0; c < 3; ++c) {
        indices.push_back(t[c]);
        piece.bounds.add(mesh.positions[t[c]]);
      }
    }
    pieces.push_back(piece);
  }
};

}  // namespace

std::vector<MeshPiece> split_mesh(const scene::Mesh& mesh, std::vector<unsigned>& indices) {
  std::vector<uvec3> triangles = mesh.triangles;
  std::vector<MeshPiece> pieces;
  Splitter{mesh, indices, pieces}.split(triangles);
  return pieces;
}

}  // namespace ssphh::realtime
