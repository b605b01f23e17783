// Every vertex of small bodies: positions, normals, texture coordinates and the order of triangles, of which
// volumes and closed edges say nothing. In expected/primitives.txt.

#include <cmath>

#include <gtest/gtest.h>

#include <ssphh/scene/primitives.h>

#include "expected_text.h"
#include "scene_text.h"

namespace ssphh::scene {
namespace {

void add(Scene& scene, const std::string& name, Mesh mesh) {
  mesh.name = name;
  scene.meshes.push_back(std::move(mesh));
}

TEST(PrimitivesText, EveryVertexIsThatOfTheList) {
  Scene s;
  s.name = "primitives";
  add(s, "quad", make_quad({1, 2, 3}, {2, 0, 0.5f}, {0, 3, 0}));
  add(s, "polygon",
      make_polygon(std::vector<vec3>{{0, 0, 1}, {3, 0, 1}, {4, 2, 1}, {0, 2, 1}},
                   std::vector<uvec3>{{0, 1, 2}, {2, 3, 0}}));
  add(s, "box", make_box({-1, 0, 2}, {1, 0.5f, 5}));
  add(s, "sphere", make_sphere(2, 3, 2));
  add(s, "finer sphere", make_sphere(2, 5, 4));
  add(s, "torus", make_torus(3, 0.5f, 3, 4));
  // Steps of 26.6° and 63.4°: the first joint is smooth, the second has an edge.
  add(s, "lathe", make_lathe(std::vector<vec2>{{0, 0}, {2, 0}, {4, 1}, {5, 3}, {0, 3}}, 3));
  add(s, "cylinder", make_cylinder(0.5f, 2, 3));
  add(s, "cone", make_cone(0.5f, 1.2f, 3));
  add(s, "column", make_column(0.25f, 4, 3));
  const auto ring = [](float t) {
    return vec3(std::cos(2 * pi * t), 0.2f * t * (1 - t), -2 * std::sin(2 * pi * t));
  };
  add(s, "closed tube", make_tube(ring, true, 0.25f, 5, 3));
  const auto bow = [](float t) { return vec3(3 * t, t * t, -t * t * t); };
  add(s, "open tube", make_tube(bow, false, 0.25f, 3, 3));
  add(s, "straight tube", make_tube([](float t) { return vec3(0, 4 * t, 0); }, false, 0.5f, 3, 3));
  add(s, "knot", make_torus_knot(2, 3, 1, 0.4f, 0.1f, 24, 3));
  add(s, "spiral", make_spiral(1, 0.5f, 2, 1.5f, 0.1f, 9, 3));
  test::expect_text_of("libs/scene/tests/expected/primitives.txt", test::scene_text(s));
}

/// The middle of each cap, which is one vertex among many.
TEST(PrimitivesText, CapsLieFlatOnTheEnds) {
  const Mesh tube = make_tube([](float t) { return vec3(1, 2, 3) + t * vec3(0, 0, 6); }, false, 0.5f, 3, 4);
  const std::size_t ends = 4 * 5;  // after four rings of five vertices
  ASSERT_EQ(tube.positions.size(), ends + 2 * 6);
  for (std::size_t i = 0; i < 12; ++i) {
    const bool back = i >= 6, middle = i % 6 == 0;
    const vec3 p = tube.positions[ends + i], center(1, 2, back ? 9 : 3);
    EXPECT_NEAR(glm::distance(p, center), middle ? 0 : 0.5f, 1e-6f) << i;  // float rounding
    EXPECT_NEAR(p.z, center.z, 1e-6f);
    EXPECT_LT(glm::distance(tube.normals[ends + i], vec3(0, 0, back ? 1 : -1)), 1e-6f);
    const vec2 uv = tube.uvs[0][ends + i];
    EXPECT_NEAR(glm::distance(uv, vec2(0.5f)), middle ? 0 : 0.5f, 1e-6f);
  }
  for (std::size_t i = tube.triangles.size() - 8; i < tube.triangles.size(); ++i) {
    const uvec3 t = tube.triangles[i];
    const vec3 n =
        glm::cross(tube.positions[t.y] - tube.positions[t.x], tube.positions[t.z] - tube.positions[t.x]);
    EXPECT_GT(glm::dot(n, tube.normals[t.x]), 0) << "triangle " << i << " faces outward";
  }
}

TEST(PrimitivesText, EveryArrayIsTurnedMovedAndAppended) {
  Mesh mesh = make_quad({0, 0, 0}, {1, 0, 0}, {0, 1, 0});
  mesh.tangents = {{1, 0, 0, 1}, {1, 0, 0, -1}, {0, 1, 0, 1}, {0, 1, 0, -1}};
  mesh.uvs[1] = {{9, 8}, {7, 6}, {5, 4}, {3, 2}};
  mesh.colors = {{1, 0, 0, 1}, {0, 1, 0, 1}, {0, 0, 1, 1}, {1, 1, 0, 0.5f}};
  mat4 m(1);  // (x, y, z) → (2y + 5, x, −3z): turned, stretched, mirrored twice
  m[0] = {0, 1, 0, 0}, m[1] = {2, 0, 0, 0}, m[2] = {0, 0, -3, 0}, m[3] = {5, 0, 0, 1};
  mat4 mirror = m;
  mirror[2] = {0, 0, 3, 0};
  Scene s;
  s.name = "changed";
  add(s, "flipped", flipped(mesh));
  add(s, "moved", transformed(mesh, m));
  add(s, "mirrored", transformed(mesh, mirror));
  Mesh both = mesh;
  append(both, transformed(mesh, m));
  add(s, "appended", both);
  append(both, both);
  EXPECT_EQ(both.positions.size(), 16u) << "to itself";
  EXPECT_EQ(both.triangles.back(), (uvec3(12, 14, 15)));
  test::expect_text_of("libs/scene/tests/expected/changed.txt", test::scene_text(s));
  EXPECT_THROW(append(both, make_box(vec3(0), vec3(1))), Error) << "which has fewer arrays";
}

}  // namespace
}  // namespace ssphh::scene
