#include "mesh_pieces.h"

#include <algorithm>
#include <span>

namespace ssphh::realtime {
namespace {

constexpr std::size_t most_triangles = 1500;

MeshPiece piece_of(const scene::Mesh& mesh, std::span<const uvec3> triangles, std::size_t first_index) {
  MeshPiece piece{first_index, static_cast<int>(3 * triangles.size()), {}};
  for (const uvec3& t : triangles) {
    for (int c = 0; c < 3; ++c) piece.bounds.add(mesh.positions[t[c]]);
  }
  return piece;
}

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
    pieces.push_back(piece_of(mesh, triangles, indices.size()));
    for (const uvec3& t : triangles) indices.insert(indices.end(), {t.x, t.y, t.z});
  }
};

}  // namespace

std::vector<MeshPiece> split_mesh(const scene::Mesh& mesh, std::vector<unsigned>& indices) {
  std::vector<uvec3> triangles = mesh.triangles;
  std::vector<MeshPiece> pieces;
  Splitter{mesh, indices, pieces}.split(triangles);
  return pieces;
}

std::vector<MeshPiece> pieces_in_order(const scene::Mesh& mesh, std::size_t first_index) {
  std::vector<MeshPiece> pieces;
  const std::span<const uvec3> triangles(mesh.triangles);
  for (std::size_t t = 0; t < triangles.size(); t += most_triangles) {
    const std::size_t count = std::min(most_triangles, triangles.size() - t);
    pieces.push_back(piece_of(mesh, triangles.subspan(t, count), first_index + 3 * t));
  }
  return pieces;
}

}  // namespace ssphh::realtime
