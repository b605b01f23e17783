#include <gtest/gtest.h>

#include <ssphh/scene/primitives.h>

#include "geometry.h"

namespace ssphh::scene {
namespace {

struct Body {
  std::string name;
  Mesh mesh;
  double volume, area;
  double tolerance;  ///< relative: of the inscribed polyhedron against the smooth body
};

// A polygon of n sides inscribed in a circle loses about (2π/n)²/6 of the area and (2π/n)²/24 of the length;
// each body is listed with a bound of a few times that for its own tessellation.
std::vector<Body> bodies() {
  const double tube_length =
      2 * std::sqrt(std::pow(pi_d * 0.5 * 3, 2) + 0.25);  // spiral: r 0.5, 3 turns, height 1
  return {
      {"box", make_box({-1, 0, 2}, {1, 0.5f, 5}), 3, 2 * (1 + 6 + 1.5), 1e-6},
      {"sphere", make_sphere(2, 128, 64), 4 / 3. * pi_d * 8, 4 * pi_d * 4, 3e-3},
      {"torus", make_torus(1, 0.25f, 192, 96), 2 * pi_d * pi_d / 16, pi_d * pi_d, 3e-3},
      {"cylinder", make_cylinder(0.5f, 2, 128), pi_d * 0.5, pi_d * 2.5, 1e-3},
      {"cone", make_cone(0.5f, 1.2f, 128), pi_d * 0.1, pi_d * 0.5 * (0.5 + 1.3), 1e-3},
      {"spiral", make_spiral(0.5f, 0.5f, 1, 3, 0.05f, 1000, 64), pi_d * 0.0025 * tube_length,
       2 * pi_d * (0.05 * tube_length + 0.0025), 3e-3},
      {"closed tube",
       make_tube([](float t) { return vec3(std::cos(2 * pi * t), 0, -std::sin(2 * pi * t)); }, true, 0.25f,
                 192, 96),
       2 * pi_d * pi_d / 16, pi_d * pi_d, 3e-3},
  };
}

std::vector<Body> all_bodies() {
  std::vector<Body> result = bodies();
  const double unknown = std::numeric_limits<double>::quiet_NaN();
  result.push_back({"column", make_column(0.25f, 4), unknown, unknown, 0});
  result.push_back({"trefoil", make_torus_knot(2, 3, 0.4f, 0.2f, 0.1f), unknown, unknown, 0});
  result.push_back({"knot", make_torus_knot(3, 4, 0.4f, 0.15f, 0.05f), unknown, unknown, 0});
  return result;
}

TEST(Primitives, VolumeAndAreaAreThoseOfTheSmoothBody) {
  for (const Body& body : bodies()) {
    const auto triangles = triangles_of(body.mesh);
    EXPECT_NEAR(signed_volume(triangles) / body.volume, 1, body.tolerance) << body.name;
    EXPECT_NEAR(area(triangles) / body.area, 1, body.tolerance) << body.name;
  }
}

TEST(Primitives, BodiesAreClosedAndFaceOutward) {
  for (const Body& body : all_bodies()) {
    const auto triangles = triangles_of(body.mesh);
    EXPECT_EQ(open_edges(triangles), 0) << body.name;
    EXPECT_GT(signed_volume(triangles), 0) << body.name;
  }
}

TEST(Primitives, MeshesNeedNoRepair) {
  for (const Body& body : all_bodies()) {
    Scene scene;
    scene.meshes.push_back(body.mesh);
    EXPECT_TRUE(validate(scene).empty()) << body.name;
    EXPECT_EQ(body.mesh.uvs[0].size(), body.mesh.positions.size()) << body.name;
  }
}

TEST(Primitives, NormalsAgreeWithTheTrianglesAroundThem) {
  for (const Body& body : all_bodies()) {
    ASSERT_EQ(body.mesh.normals.size(), body.mesh.positions.size()) << body.name;
    float worst = 1;
    for (const uvec3& t : body.mesh.triangles) {
      const vec3 a = body.mesh.positions[t.x];
      const vec3 n = glm::normalize(glm::cross(body.mesh.positions[t.y] - a, body.mesh.positions[t.z] - a));
      for (int c = 0; c < 3; ++c) worst = std::min(worst, glm::dot(n, body.mesh.normals[t[c]]));
    }
    // Corners sharper than 30° are split, so a vertex normal stands at most 15° plus half a facet off.
    EXPECT_GT(worst, std::cos(glm::radians(25.0f))) << body.name;
  }
}

TEST(Primitives, SphereNormalsPointAwayFromTheCenter) {
  const Mesh mesh = make_sphere(3, 24, 12);
  for (std::size_t i = 0; i < mesh.positions.size(); ++i) {
    EXPECT_NEAR(glm::length(mesh.positions[i]), 3, 1e-6 * 3);  // float rounding
    EXPECT_NEAR(glm::dot(mesh.positions[i], mesh.normals[i]), 3, 1e-6 * 3);
  }
}

TEST(Primitives, QuadFacesTheCrossProductOfItsSides) {
  const Mesh mesh = make_quad({1, 2, 3}, {2, 0, 0}, {0, 0, -1});
  const auto triangles = triangles_of(mesh);
  EXPECT_EQ(mesh.normals[0], vec3(0, 1, 0));
  EXPECT_FLOAT_EQ(static_cast<float>(area(triangles)), 2);
  for (const Triangle& t : triangles) EXPECT_GT(glm::cross(t[1] - t[0], t[2] - t[0]).y, 0);
}

TEST(Primitives, FlippingAndMirroringTurnTheSurface) {
  const Mesh box = make_box(vec3(-1), vec3(1));
  EXPECT_DOUBLE_EQ(signed_volume(triangles_of(flipped(box))), -8);
  mat4 mirror(1);
  mirror[0][0] = -2;
  const Mesh mirrored = transformed(box, mirror);
  EXPECT_DOUBLE_EQ(signed_volume(triangles_of(mirrored)), 16);  // still faces outward
  EXPECT_EQ(mirrored.normals[0], vec3(-1, 0, 0));
}

TEST(Primitives, NormalsTransformWithTheInverseTranspose) {
  mat4 squash(1);
  squash[1][1] = 0.25f;
  const Mesh mesh = transformed(make_sphere(1, 48, 24), squash);
  for (std::size_t i = 0; i < mesh.positions.size(); ++i) {
    const vec3 p = mesh.positions[i];
    const vec3 gradient = glm::normalize(vec3(p.x, p.y * 16, p.z));  // of x² + (y/¼)² + z²
    EXPECT_GT(glm::dot(gradient, mesh.normals[i]), 1 - 1e-5f);       // float rounding
  }
}

TEST(Primitives, AppendKeepsBothParts) {
  Mesh mesh = make_box(vec3(0), vec3(1));
  append(mesh, make_box(vec3(2), vec3(4)));
  EXPECT_EQ(mesh.triangles.size(), 24u);
  EXPECT_DOUBLE_EQ(signed_volume(triangles_of(mesh)), 9);
}

}  // namespace
}  // namespace ssphh::scene
