#include "corona_obj.h"

#include <cstdint>
#include <iterator>

#include <fmt/format.h>
#include <glm/geometric.hpp>

namespace ssphh::scene_io {

std::string encode_corona_obj(const scene::Mesh& mesh, std::span<const vec2> uv) {
  std::string out;
  auto to = std::back_inserter(out);
  for (const vec3& p : mesh.positions) fmt::format_to(to, "v {} {} {}\n", p.x, p.y, p.z);
  for (const vec2& t : uv) fmt::format_to(to, "vt {} {} 0\n", t.x, t.y);
  for (const vec3& n : mesh.normals) fmt::format_to(to, "vn {} {} {}\n", n.x, n.y, n.z);
  if (mesh.normals.empty()) {
    for (const uvec3& t : mesh.triangles) {
      const vec3 a = mesh.positions[t.x];
      const vec3 cross = glm::cross(mesh.positions[t.y] - a, mesh.positions[t.z] - a);
      const float length = glm::length(cross);
      const vec3 n = length > 0 ? cross / length : vec3(0, 1, 0);
      fmt::format_to(to, "vn {} {} {}\n", n.x, n.y, n.z);
    }
  }
  for (std::size_t i = 0; i < mesh.triangles.size(); ++i) {
    out += 'f';
    for (int c = 0; c < 3; ++c) {
      const std::uint64_t v = std::uint64_t{mesh.triangles[i][c]} + 1;
      const std::uint64_t n = mesh.normals.empty() ? i + 1 : v;
      if (uv.empty()) {
        fmt::format_to(to, " {}//{}", v, n);
      } else {
        fmt::format_to(to, " {}/{}/{}", v, v, n);
      }
    }
    out += '\n';
  }
  return out;
}

}  // namespace ssphh::scene_io
