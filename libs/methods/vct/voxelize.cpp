#include "voxelize.h"

#include <algorithm>
#include <cmath>

#include <ssphh/core/parallel.h>

namespace ssphh::methods::vct {
namespace {

/// Convex and planar. Each of the six cuts adds at most one corner to a triangle's three; where rounding lets
/// it be more, slivers are lost.
struct Polygon {
  int count = 0;
  std::array<vec3, 12> corner{};
  void add(const vec3& p) {
    if (count < static_cast<int>(corner.size())) corner[count++] = p;
  }
  const vec3& at(int i) const { return corner[i]; }
};

/// The part on the side sign·(p[axis] − wall) ≥ 0 (Sutherland & Hodgman, Reentrant Polygon Clipping, 1974).
Polygon keep(const Polygon& polygon, int axis, float wall, float sign) {
  Polygon kept;
  for (int i = 0; i < polygon.count; ++i) {
    const vec3 &a = polygon.at(i), &b = polygon.at(i + 1 == polygon.count ? 0 : i + 1);
    const float da = sign * (a[axis] - wall), db = sign * (b[axis] - wall);
    if (da >= 0) kept.add(a);
    if ((da > 0 && db < 0) || (da < 0 && db > 0)) {
      vec3 crossing = a + (da / (da - db)) * (b - a);
      crossing[axis] = wall;
      kept.add(crossing);
    }
  }
  return kept;
}

struct Range {
  int first, last;
};

Range slabs(const Polygon& polygon, int axis, int size) {
  float low = polygon.at(0)[axis], high = low;
  for (int i = 1; i < polygon.count; ++i) {
    low = std::min(low, polygon.at(i)[axis]);
    high = std::max(high, polygon.at(i)[axis]);
  }
  const auto most = static_cast<float>(size);
  return {static_cast<int>(std::floor(std::clamp(low, 0.0f, most))),
          std::min(static_cast<int>(std::floor(std::clamp(high, -1.0f, most))), size - 1)};
}

/// Calls body(index, piece) for each slab of one voxel's thickness that the polygon passes.
template <class Body>
void for_slabs(const Polygon& polygon, int axis, int size, const Body& body) {
  const Range range = slabs(polygon, axis, size);
  Polygon rest = polygon;
  for (int i = range.first; i <= range.last && rest.count >= 3; ++i) {
    rest = keep(rest, axis, static_cast<float>(i), 1);
    const Polygon piece = keep(rest, axis, static_cast<float>(i + 1), -1);
    if (piece.count >= 3) body(i, piece);
  }
}

void add_piece(const Polygon& polygon, const Cell& cell, std::vector<Fragment>& out) {
  constexpr float least_area = 1e-9f;  // of a voxel's face
  Fragment fragment;
  vec3 moment(0);
  float weight = 0;
  for (int i = 2; i < polygon.count; ++i) {
    const vec3 area = 0.5f * glm::cross(polygon.at(i - 1) - polygon.at(0), polygon.at(i) - polygon.at(0));
    const float size = glm::length(area);
    fragment.area += area;
    moment += size * (polygon.at(0) + polygon.at(i - 1) + polygon.at(i)) / 3.0f;
    weight += size;
  }
  if (!(weight > least_area)) return;
  fragment.voxel = voxel_key(cell);
  fragment.centroid = moment / weight;
  out.push_back(fragment);
}

void cut_mesh(const scene::Mesh& mesh, const mat4& to_world, const VoxelGrid& grid, bool cutout,
              std::vector<Fragment>& out, const Control& control) {
  constexpr std::size_t grain = 1024;
  const bool mirrored = glm::determinant(mat3(to_world)) < 0;
  std::vector<std::vector<Fragment>> chunks((mesh.triangles.size() + grain - 1) / grain);
  parallel_for(
      chunks.size(), 1,
      [&](std::size_t c) {
        for (std::size_t t = c * grain; t < std::min((c + 1) * grain, mesh.triangles.size()); ++t) {
          std::array<vec3, 3> corners;
          for (glm::length_t k = 0; k < 3; ++k) {
            const vec3& p = mesh.positions[mesh.triangles[t][k]];
            corners[k] = grid.to_grid(vec3(to_world * vec4(p, 1)));
          }
          if (mirrored) std::swap(corners[1], corners[2]);
          cut_triangle(grid, corners, chunks[c]);
        }
      },
      control);
  for (std::vector<Fragment>& chunk : chunks) {
    for (Fragment& fragment : chunk) fragment.cutout = cutout;
    out.insert(out.end(), chunk.begin(), chunk.end());
  }
}

}  // namespace

void cut_triangle(const VoxelGrid& grid, const std::array<vec3, 3>& corners, std::vector<Fragment>& out) {
  Polygon triangle;
  for (const vec3& corner : corners) {
    if (!is_finite(corner)) return;
    triangle.add(corner);
  }
  for_slabs(triangle, 0, grid.size.x, [&](int x, const Polygon& slab) {
    for_slabs(slab, 1, grid.size.y, [&](int y, const Polygon& column) {
      for_slabs(column, 2, grid.size.z, [&](int z, const Polygon& piece) {
        add_piece(piece, {x, y, z}, out);
      });
    });
  });
}

std::vector<Fragment> voxelize(const scene::Scene& scene, float time, bool moving, const VoxelGrid& grid,
                               const Control& control) {
  const std::vector<mat4> world = scene::world_matrices(scene, time);
  std::vector<Fragment> fragments;
  for (const scene::Instance& instance : scene.instances) {
    const auto node = static_cast<std::size_t>(instance.node);
    if (scene.nodes[node].movable != moving) continue;
    const int material = scene::instance_material(scene, instance);
    const scene::Material* m = material >= 0 ? &scene.materials[material] : nullptr;
    const bool cutout = m && (m->alpha_mode != scene::AlphaMode::opaque || m->is_glass());
    cut_mesh(scene.meshes[instance.mesh], world[node], grid, cutout, fragments, control);
  }
  std::ranges::stable_sort(fragments, {}, &Fragment::voxel);
  return fragments;
}

}  // namespace ssphh::methods::vct
