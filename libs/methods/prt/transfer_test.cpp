#include <gtest/gtest.h>

#include <ssphh/core/error.h>
#include <ssphh/core/random.h>
#include <ssphh/image/sphere_map.h>
#include <ssphh/scene/primitives.h>
#include <ssphh/sh/evaluate.h>
#include <ssphh/sh/irradiance.h>
#include <ssphh/sh/quadrature.h>

#include "error_message.h"
#include "sky_transfer.h"
#include "triangle_source.h"

namespace ssphh::methods::prt {
namespace {

void add(scene::Scene& scene, scene::Mesh mesh) {
  scene.meshes.push_back(std::move(mesh));
  scene.nodes.emplace_back();
  scene.instances.push_back(
      {static_cast<int>(scene.meshes.size()) - 1, static_cast<int>(scene.nodes.size()) - 1, -1, ""});
}

sh::RadianceSh random_sky(int degree, std::uint64_t seed) {
  sh::RadianceSh sky(degree);
  Pcg32 random(seed);
  for (vec3& v : sky.values) v = random.uniform3() - 0.3f;
  return sky;
}

struct Baked {
  Baked(const scene::Scene& scene, const TransferParams& params, int rays, float edge)
      : source(scene),
        mesh(make_transfer_mesh(scene, source, {.edge = edge})),
        index(mesh, 0.01f),
        rings(mesh),
        transfer(find_transfer(mesh, rings, find_vertex_rays(mesh, rings, index, source, rays), params)) {}
  test::TriangleSource source;
  TransferMesh mesh;
  MeshIndex index;
  VertexRings rings;
  TransferVectors transfer;
};

TEST(Transfer, OpenPlaneIsTheClosedForm) {
  scene::Scene scene;
  add(scene, scene::make_quad({-1, 0, 1}, {2, 0, 0.5f}, {0, 1, -2}));
  for (const int degree : {0, 2, 4, 5}) {
    const Baked plane(scene, {.degree = degree, .bounces = 1}, 32, 1);
    const sh::RadianceSh sky = random_sky(degree, 1);
    ASSERT_GT(plane.mesh.vertices.size(), 8u);
    for (std::size_t v = 0; v < plane.mesh.vertices.size(); ++v) {
      const vec3 e = sh::irradiance(sky, plane.mesh.vertices[v].normal);
      const vec3 found = plane.transfer.direct_irradiance(v, sky);
      for (int c = 0; c < 3; ++c) EXPECT_NEAR(found[c], e[c], 1e-5f);
      EXPECT_EQ(plane.transfer.reflected_irradiance(v, sky), vec3(0));
    }
  }
}

/// Beside a wall without end half of the sky is hidden.
TEST(Transfer, OfMoreBandsThanThereAreIsRefused) {
  scene::Scene scene;
  add(scene, scene::make_quad({-1, 0, 1}, {2, 0, 0}, {0, 0, -2}));
  for (const int degree : {-1, 11}) {
    const std::string error = test::message_of([&] { Baked(scene, {.degree = degree}, 16, 1); });
    EXPECT_NE(error.find("radiance transfer"), std::string::npos) << error;
  }
}

TEST(Transfer, AWallHidesHalfTheSky) {
  scene::Scene scene;
  add(scene, scene::make_quad({0, 0, 1}, {1, 0, 0}, {0, 0, -1}));             // floor, x ≥ 0
  add(scene, scene::make_quad({0, -1, 5000}, {0, 0, -10000}, {0, 5000, 0}));  // wall x = 0
  test::TriangleSource source(scene);
  TransferMesh mesh;
  const vec3 up(0, 1, 0);
  for (const vec3& p : {vec3(1e-2f, 0, 0), vec3(2e-2f, 0, 0), vec3(1e-2f, 0, -1e-2f)})
    mesh.vertices.push_back({p, up});
  mesh.triangles.push_back({0, 1, 2});
  const MeshIndex index(mesh, 0.01f);
  const VertexRings rings(mesh);
  const VertexRays rays = find_vertex_rays(mesh, rings, index, source, 4096);
  const TransferVectors transfer = find_transfer(mesh, rings, rays, {.degree = 4});
  const TransferVectors near = find_transfer(mesh, rings, rays, {.degree = 4, .reach = 1e-3f});
  // An independent sum: the sky where x > 0 and y > 0, times the cosine.
  const sh::RadianceSh sky = random_sky(4, 2);
  vec3 expected(0);
  const sh::SphereQuadrature rule = sh::stratified_sphere_samples(1000, 3);
  std::array<double, 25> basis;
  for (std::size_t i = 0; i < rule.directions.size(); ++i) {
    const glm::dvec3& d = rule.directions[i];
    if (d.x < 0 || d.y < 0) continue;
    sh::eval_basis(4, d, std::span<double>(basis));
    for (int k = 0; k < 25; ++k) expected += static_cast<float>(rule.weights[i] * d.y * basis[k]) * sky[k];
  }
  for (std::size_t v = 0; v < 3; ++v) {
    const vec3 e = transfer.direct_irradiance(v, sky), open = near.direct_irradiance(v, sky);
    const vec3 all = sh::irradiance(sky, up);
    for (int c = 0; c < 3; ++c) {
      // 4096 stratified rays; the sky's values are about 1.
      EXPECT_NEAR(e[c], expected[c], 0.03f);
      // What lies beyond the reach hides nothing.
      EXPECT_NEAR(open[c], all[c], 1e-4f);
    }
    EXPECT_GT(glm::length(all - expected), 0.3f);
  }
}

TEST(Transfer, BuriedVerticesTakeTheirNeighboursValue) {
  scene::Scene scene;
  add(scene, scene::make_quad({-1, 0, 1}, {2, 0, 0}, {0, 0, -2}));
  add(scene, scene::make_box({-0.3f, -0.1f, -0.3f}, {0.3f, 0.4f, 0.3f}));
  const Baked baked(scene, {.degree = 0}, 128, 0.25f);
  sh::RadianceSh sky(0);
  sky[0] = vec3(std::sqrt(4 * pi));  // radiance 1
  int under = 0;
  for (std::size_t v = 0; v < baked.mesh.vertices.size(); ++v) {
    const rays::SurfacePoint& at = baked.mesh.vertices[v];
    const bool buried = std::abs(at.position.x) < 0.29f && std::abs(at.position.z) < 0.29f &&
                        at.position.y == 0 && at.normal.y > 0.9f;
    under += buried ? 1 : 0;
    if (buried) {
      EXPECT_GT(baked.transfer.direct_irradiance(v, sky).x, 0.3f * pi);
    }
  }
  EXPECT_GT(under, 0);
}

TEST(Transfer, MeshesAreRefinedAlikeOnBothSidesOfAnEdge) {
  scene::Scene scene;
  add(scene, scene::make_quad({0, 0, 0}, {7, 0, 0}, {0, 0, -1}));
  add(scene, scene::make_quad({0, 0, -1}, {7, 0, 0}, {0, 0, -3}));
  test::TriangleSource source(scene);
  const TransferMesh mesh = make_transfer_mesh(scene, source, {.edge = 0.5f});
  // No vertex lies inside another triangle's edge, and areas add up, each side once.
  double area = 0;
  for (std::size_t i = 0; i < mesh.triangles.size(); ++i) {
    const geometry::Corners c = mesh.corners(i);
    area += 0.5 * static_cast<double>(glm::length(glm::cross(c[1] - c[0], c[2] - c[0])));
    for (std::size_t k = 0; k < 3; ++k) {
      const vec3 a = c[k], b = c[(k + 1) % 3];
      EXPECT_LE(glm::length(b - a), 0.5f);
      for (const rays::SurfacePoint& v : mesh.vertices) {
        if (v.normal.y * mesh.vertices[mesh.triangles[i].x].normal.y < 0) continue;  // of the other side
        if (glm::length(v.position - a) < 1e-4f || glm::length(v.position - b) < 1e-4f) continue;
        EXPECT_GT(glm::length(v.position - a) + glm::length(v.position - b), glm::length(b - a) + 1e-5f);
      }
    }
  }
  EXPECT_NEAR(area, 2 * 7 * 4, 1e-3);
  EXPECT_THROW(make_transfer_mesh(scene, source, {.edge = 0.5f, .most = 10}), Error);
}

/// A side is left out where half of what it sees are backs, as within a body; a sign before it is none.
TEST(Transfer, ASideThatSeesFewBacksIsInTheOpen) {
  const auto underside = [](float sign) {
    scene::Scene scene;
    add(scene, scene::make_quad({-1, 0, 1}, {2, 0, 0}, {0, 0, -2}));
    add(scene, scene::make_quad({-100, -1, 100}, {200, 0, 0}, {0, 0, -200}));
    add(scene,
        scene::make_quad({-sign, -0.7f, -sign}, {2 * sign, 0, 0}, {0, 0, 2 * sign}));  // faces the ground
    const TransferMesh mesh = make_transfer_mesh(scene, test::TriangleSource(scene), {.edge = 300});
    double area = 0;
    for (std::size_t i = 0; i < mesh.triangles.size(); ++i) {
      const geometry::Corners c = mesh.corners(i);
      const vec3 cross = glm::cross(c[1] - c[0], c[2] - c[0]);
      if (c[0].y == 0 && cross.y < 0) area += 0.5 * static_cast<double>(glm::length(cross));
    }
    return area;
  };
  EXPECT_NEAR(underside(0.4f), 4, 1e-4);
  EXPECT_EQ(underside(5), 0);
}

TEST(Transfer, PlacesAreFoundOnTheirSide) {
  scene::Scene scene;
  add(scene, scene::make_quad({-1, 0, 1}, {2, 0, 0}, {0, 0, -2}));
  test::TriangleSource source(scene);
  const TransferMesh mesh = make_transfer_mesh(scene, source, {.edge = 0.5f});
  const MeshIndex index(mesh, 0.01f);
  for (const float side : {1.0f, -1.0f}) {
    const MeshPlace place = index.find({{0.3f, 0.001f * side, 0.2f}, {0, side, 0}});
    ASSERT_GE(place.triangle, 0);
    vec3 at(0);
    for (int k = 0; k < 3; ++k) {
      const rays::SurfacePoint& v = mesh.vertices[mesh.triangles[place.triangle][k]];
      EXPECT_GT(v.normal.y * side, 0.99f);
      at += place.weight[k] * v.position;
    }
    EXPECT_NEAR(glm::length(at - vec3(0.3f, 0, 0.2f)), 0, 1e-5f);
  }
  EXPECT_EQ(index.find({{0.3f, 0.5f, 0.2f}, {0, 1, 0}}).triangle, -1);
  EXPECT_EQ(index.find({{0.3f, 0, 0.2f}, {1, 0, 0}}).triangle, -1);
  EXPECT_EQ(index.find({{0.3f, 0, 0.2f}, {0, 1, 0}, true}).triangle, -1);
}

TEST(Transfer, SmoothNormalsAreThoseOfTheSurfaceAsPosedMirroredOrNot) {
  for (const float mirror : {1.0f, -1.0f}) {
    scene::Scene scene;
    add(scene, scene::make_sphere(1, 24, 12));
    scene::Transform& pose = scene.nodes[0].local;
    pose.translation = {3, 4, 5}, pose.scale = vec3(1.5f * mirror, 1, 0.8f);
    pose.rotation = glm::angleAxis(0.7f, glm::normalize(vec3(1, 2, 3)));
    const test::TriangleSource source(scene);
    const TransferMesh mesh = make_transfer_mesh(scene, source, {.edge = 10});
    ASSERT_GT(mesh.vertices.size(), 200u);
    for (const rays::SurfacePoint& v : mesh.vertices) {
      // An ellipsoid's gradient
      const vec3 local = glm::inverse(pose.rotation) * (v.position - pose.translation);
      const vec3 expected = pose.rotation * glm::normalize(local / (pose.scale * pose.scale));
      EXPECT_GT(glm::dot(v.normal, expected), 0.9999f);
    }
    for (std::size_t t = 0; t < mesh.triangles.size(); ++t) {
      const geometry::Corners c = mesh.corners(t);
      const vec3 out = c[0] + c[1] + c[2] - 3.0f * pose.translation;
      EXPECT_GT(glm::dot(glm::cross(c[1] - c[0], c[2] - c[0]), out), 0) << "wound to be seen from outside";
    }
  }
}

TEST(Transfer, EnvironmentsAreProjectedAsTheyShine) {
  scene::Environment constant;
  constant.color = {1, 2, 3};
  const sh::RadianceSh flat = project_environment(constant, 2);
  EXPECT_NEAR(sh::irradiance(flat, vec3(0, 1, 0)).y, 2 * pi, 1e-5f);
  scene::Environment ramp;
  ramp.equirect = image::Image(64, 32);
  for (int y = 0; y < 32; ++y)
    for (int x = 0; x < 64; ++x)
      ramp.equirect.set_rgb(x, y,
                            vec3(1 + image::equirect_direction((static_cast<float>(x) + 0.5f) / 64,
                                                               (static_cast<float>(y) + 0.5f) / 32)
                                         .z));
  const sh::RadianceSh found = project_environment(ramp, 1);
  // E(n) = π + 2π/3 n.z
  EXPECT_NEAR(sh::irradiance(found, vec3(0, 0, 1)).x, 5 * pi / 3, 2e-3f);
  EXPECT_NEAR(sh::irradiance(found, vec3(1, 0, 0)).x, pi, 2e-3f);
}

// Hits are uniform over triangles that are small beside the way to them: each corner weighs a third on
// average, and some hit lies close to it.
TEST(Transfer, HitsWeighTheCornersOfTheirTriangles) {
  scene::Scene scene;
  add(scene, scene::make_quad({-1, 0, 1}, {2, 0, 0}, {0, 0, -2}));
  add(scene, scene::make_quad({-1, 1, -1}, {2, 0, 0}, {0, 0, 2}));
  const test::TriangleSource source(scene);
  const TransferMesh mesh = make_transfer_mesh(scene, source, {.edge = 0.3f});
  const VertexRays rays = find_vertex_rays(mesh, VertexRings(mesh), MeshIndex(mesh, 0.01f), source, 64);
  vec3 sum(0), largest(0);
  int count = 0;
  for (const VertexHit& hit : rays.hits) {
    if (hit.triangle < 0) continue;
    const vec3 weights = hit.weights();
    EXPECT_GE(glm::min(weights.x, glm::min(weights.y, weights.z)), 0);
    sum += weights, largest = glm::max(largest, weights), ++count;
  }
  ASSERT_GT(count, 2000);
  const float sigma = std::sqrt(1.0f / 18 / static_cast<float>(count));
  for (int c = 0; c < 3; ++c) {
    EXPECT_NEAR(sum[c] / static_cast<float>(count), 1.0f / 3, 5 * sigma) << "corner " << c;
    EXPECT_GT(largest[c], 0.95f) << "corner " << c;
  }
}

}  // namespace
}  // namespace ssphh::methods::prt
