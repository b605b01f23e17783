#include <array>
#include <vector>

#include <ssphh/core/require.h>
#include <ssphh/scene/primitives.h>

namespace ssphh::scene {
namespace {

std::uint32_t index(std::size_t i) {
  return static_cast<std::uint32_t>(i);
}

template <class T>
void append_array(std::vector<T>& to, const std::vector<T>& from) {
  to.insert(to.end(), from.begin(), from.end());
}

}  // namespace

Mesh make_quad(const vec3& corner, const vec3& u, const vec3& v) {
  Mesh mesh;
  mesh.positions = {corner, corner + u, corner + u + v, corner + v};
  mesh.normals.assign(4, glm::normalize(glm::cross(u, v)));
  mesh.uvs[0] = {{0, 1}, {1, 1}, {1, 0}, {0, 0}};
  mesh.triangles = {{0, 1, 2}, {0, 2, 3}};
  return mesh;
}

Mesh make_polygon(std::span<const vec3> corners, std::span<const uvec3> triangles) {
  require(corners.size() >= 3 && !triangles.empty(), "polygon", "it needs 3 corners and a triangle");
  for (const uvec3& t : triangles)
    require(std::max({t.x, t.y, t.z}) < corners.size(), "polygon",
            "a triangle names a corner that is not there");
  const uvec3 t = triangles.front();
  const vec3 u = glm::normalize(corners[t.y] - corners[t.x]);
  const vec3 n = glm::normalize(glm::cross(u, corners[t.z] - corners[t.x]));
  const vec3 v = glm::cross(n, u);
  Mesh mesh;
  mesh.positions.assign(corners.begin(), corners.end());
  mesh.normals.assign(corners.size(), n);
  for (const vec3& p : corners) mesh.uvs[0].emplace_back(glm::dot(p, u), -glm::dot(p, v));
  mesh.triangles.assign(triangles.begin(), triangles.end());
  return mesh;
}

Mesh make_box(const vec3& min, const vec3& max) {
  const auto corner = [&](int x, int y, int z) {
    return vec3(x ? max.x : min.x, y ? max.y : min.y, z ? max.z : min.z);
  };
  // Corners of each face, counter-clockwise from outside, lower left first.
  const std::array<std::array<vec3, 4>, 6> faces = {{
      {corner(1, 0, 1), corner(1, 0, 0), corner(1, 1, 0), corner(1, 1, 1)},
      {corner(0, 0, 0), corner(0, 0, 1), corner(0, 1, 1), corner(0, 1, 0)},
      {corner(0, 1, 1), corner(1, 1, 1), corner(1, 1, 0), corner(0, 1, 0)},
      {corner(0, 0, 0), corner(1, 0, 0), corner(1, 0, 1), corner(0, 0, 1)},
      {corner(0, 0, 1), corner(1, 0, 1), corner(1, 1, 1), corner(0, 1, 1)},
      {corner(1, 0, 0), corner(0, 0, 0), corner(0, 1, 0), corner(1, 1, 0)},
  }};
  Mesh mesh;
  for (const auto& face : faces) {
    const std::uint32_t first = index(mesh.positions.size());
    mesh.positions.insert(mesh.positions.end(), face.begin(), face.end());
    const vec3 n = glm::normalize(glm::cross(face[1] - face[0], face[2] - face[0]));
    mesh.normals.insert(mesh.normals.end(), 4, n);
    mesh.uvs[0].insert(mesh.uvs[0].end(), {{0, 1}, {1, 1}, {1, 0}, {0, 0}});
    mesh.triangles.emplace_back(first, first + 1, first + 2);
    mesh.triangles.emplace_back(first, first + 2, first + 3);
  }
  return mesh;
}

Mesh flipped(Mesh mesh) {
  for (uvec3& t : mesh.triangles) std::swap(t.y, t.z);
  for (vec3& n : mesh.normals) n = -n;
  for (vec4& t : mesh.tangents) t.w = -t.w;
  return mesh;
}

Mesh transformed(Mesh mesh, const mat4& m) {
  const mat3 linear(m);
  const mat3 for_normals = glm::transpose(glm::inverse(linear));
  for (vec3& p : mesh.positions) p = vec3(m * vec4(p, 1));
  for (vec3& n : mesh.normals) n = glm::normalize(for_normals * n);
  for (vec4& t : mesh.tangents) t = vec4(glm::normalize(linear * vec3(t)), t.w);
  if (glm::determinant(linear) < 0) {
    for (uvec3& t : mesh.triangles) std::swap(t.y, t.z);
    for (vec4& t : mesh.tangents) t.w = -t.w;
  }
  return mesh;
}

void append(Mesh& mesh, const Mesh& part) {
  if (&mesh == &part) return append(mesh, Mesh(part));
  const std::size_t total = mesh.positions.size() + part.positions.size();
  const auto agree = [total](std::size_t a, std::size_t b) { return a + b == 0 || a + b == total; };
  require(agree(mesh.normals.size(), part.normals.size()) &&
              agree(mesh.tangents.size(), part.tangents.size()) &&
              agree(mesh.uvs[0].size(), part.uvs[0].size()) &&
              agree(mesh.uvs[1].size(), part.uvs[1].size()) && agree(mesh.colors.size(), part.colors.size()),
          "mesh", "what is appended has other arrays");
  const std::uint32_t first = index(mesh.positions.size());
  append_array(mesh.positions, part.positions);
  append_array(mesh.normals, part.normals);
  append_array(mesh.tangents, part.tangents);
  append_array(mesh.uvs[0], part.uvs[0]);
  append_array(mesh.uvs[1], part.uvs[1]);
  append_array(mesh.colors, part.colors);
  for (const uvec3& t : part.triangles) mesh.triangles.push_back(t + first);
}

}  // namespace ssphh::scene
