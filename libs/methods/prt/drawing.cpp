#include "drawing.h"

#include <cmath>
#include <set>
#include <tuple>

namespace ssphh::methods::prt {

std::vector<ShownVertex> shown_vertices(const TransferMesh& mesh, float spacing) {
  std::set<std::tuple<int, int, int, int>> taken;
  std::vector<ShownVertex> shown;
  for (std::size_t v = 0; v < mesh.vertices.size(); ++v) {
    const rays::SurfacePoint& at = mesh.vertices[v];
    const vec3 size = glm::abs(at.normal);
    const int axis = size.x >= size.y && size.x >= size.z ? 0 : size.y >= size.z ? 1 : 2;
    // Just above the surface: flat ones often lie on a cube's wall.
    const vec3 cube = glm::floor((at.position + 0.01f * spacing * at.normal) / spacing);
    const int side = 2 * axis + (at.normal[axis] < 0 ? 1 : 0);
    const auto place = [&](int i) { return static_cast<int>(cube[i]); };
    if (taken.emplace(place(0), place(1), place(2), side).second)
      shown.push_back({static_cast<std::uint32_t>(v), at});
  }
  return shown;
}

sketch::Sketch transfer_drawing(const TransferVectors& transfer, std::span<const ShownVertex> vertices,
                                float size) {
  sketch::Sketch marks;
  for (const ShownVertex& shown : vertices) {
    const auto first =
        transfer.direct.begin() + static_cast<std::ptrdiff_t>(shown.vertex * transfer.stride());
    marks.lobes.push_back({.center = shown.at.position,
                           .scale = size,
                           .values = {first, first + static_cast<std::ptrdiff_t>(transfer.stride())},
                           .positive = vec3(0.05f, 0.35f, 0.9f)});
  }
  return marks;
}

}  // namespace ssphh::methods::prt
