// Where a number stops to be good enough: a little on either side of every such bound.

#include <cmath>

#include <gtest/gtest.h>

#include <ssphh/scene/query.h>

#include "builtin/builder.h"
#include "error_message.h"

namespace ssphh::scene {
namespace {

Scene triangle_at(const quat& rotation, const vec3& normal, const vec4& tangent) {
  Scene s;
  s.nodes.resize(1);
  s.nodes[0].local.rotation = rotation;
  s.meshes.resize(1);
  s.meshes[0].positions = {{0, 0, 0}, {0, 1, 0}, {0, 0, 1}};
  s.meshes[0].triangles = {{0, 1, 2}};
  s.meshes[0].normals.assign(3, normal);
  s.meshes[0].tangents.assign(3, tangent);
  s.instances.push_back({0, 0, -1, {}});
  return s;
}

std::vector<std::string> repairs(Scene scene) {
  return validate(scene);
}

TEST(Edges, SquaredLengthsOfNormalsAndTangentsAreOneWithinAThousandth) {
  const quat none(1, 0, 0, 0);
  for (const float off : {-1.01e-3f, 1.01e-3f}) {
    const float length = std::sqrt(1 + off);
    EXPECT_EQ(repairs(triangle_at(none, {length, 0, 0}, {0, 1, 0, 1})),
              std::vector<std::string>{"3 normals were not unit vectors: normalised"});
    EXPECT_EQ(repairs(triangle_at(none, {1, 0, 0}, {0, length, 0, 1})),
              std::vector<std::string>{"3 tangents were not unit vectors: mended"});
  }
  for (const float off : {-0.99e-3f, 0.99e-3f}) {
    const float length = std::sqrt(1 + off);
    EXPECT_TRUE(repairs(triangle_at(none, {length, 0, 0}, {0, length, 0, -1})).empty()) << off;
  }
}

TEST(Edges, LengthsOfRotationsAreOneWithinATenThousandth) {
  for (const float length : {1 - 0.985e-4f, 1 + 0.985e-4f})
    EXPECT_TRUE(repairs(triangle_at({length, 0, 0, 0}, {1, 0, 0}, {0, 1, 0, 1})).empty()) << length;
  for (const float length : {1 - 1.015e-4f, 1 + 1.015e-4f})
    EXPECT_EQ(repairs(triangle_at({length, 0, 0, 0}, {1, 0, 0}, {0, 1, 0, 1})),
              std::vector<std::string>{"1 rotations were not unit quaternions: normalised"});
}

/// Below 1e-20 the square of a length is hardly a float any more.
TEST(Edges, WhatIsShorterThanAnyLengthHasNoDirection) {
  Scene scene = triangle_at({0, 1.02e-20f, 0, 0}, {0, 1.02e-20f, 0}, {0, 0, 1.02e-20f, -1});
  validate(scene);
  EXPECT_NEAR(scene.nodes[0].local.rotation.x, 1, 1e-4f);
  EXPECT_LT(glm::distance(scene.meshes[0].normals[0], vec3(0, 1, 0)), 1e-4f);  // of a square that is denormal
  EXPECT_LT(glm::distance(scene.meshes[0].tangents[0], vec4(0, 0, 1, -1)), 1e-4f);
  scene = triangle_at({0, 0.98e-20f, 0, 0}, {0, 0.98e-20f, 0}, {0, 0, 0.98e-20f, -1});
  validate(scene);
  EXPECT_EQ(scene.nodes[0].local.rotation, quat(1, 0, 0, 0));
  EXPECT_EQ(scene.meshes[0].normals[0], vec3(1, 0, 0)) << "the triangle's";
  const vec4 tangent = scene.meshes[0].tangents[0];
  EXPECT_NEAR(glm::dot(vec3(tangent), vec3(1, 0, 0)), 0, 1e-6f) << "some direction across the normal";
  EXPECT_NEAR(glm::length(vec3(tangent)), 1, 1e-6f);
  EXPECT_EQ(tangent.w, -1);
}

TEST(Edges, TrianglesThinnerThanTenToTheMinusTenAreGone) {
  for (const auto& [height, kept] : {std::pair{1.015e-10f, 1u}, std::pair{0.985e-10f, 0u}}) {
    // Every corner in turn is the one that is opposite to the longest side.
    for (std::size_t turn = 0; turn < 3; ++turn) {
      Scene scene;
      scene.meshes.resize(1);
      scene.meshes[0].positions = {{0, 0, 0}, {1, 0, 0}, {0.5f, height, 0}};
      std::rotate(scene.meshes[0].positions.begin(),
                  scene.meshes[0].positions.begin() + static_cast<std::ptrdiff_t>(turn),
                  scene.meshes[0].positions.end());
      scene.meshes[0].triangles = {{0, 1, 2}};
      validate(scene);
      EXPECT_EQ(scene.meshes[0].triangles.size(), kept) << height << " " << turn;
    }
  }
}

TEST(Edges, AMatrixIsAffineWithinAMillionth) {
  for (int column = 0; column < 3; ++column) {
    for (const float off : {-0.98e-6f, 0.98e-6f, -1.02e-6f, 1.02e-6f}) {
      Scene scene;
      scene.nodes.resize(1);
      scene.nodes[0].matrix = mat4(1);
      (*scene.nodes[0].matrix)[column].w = off;
      EXPECT_EQ(test::message_of([&] { validate(scene); }),
                std::abs(off) < 1e-6f ? "no error" : "node 0: matrix is not affine")
          << column << " " << off;
    }
  }
}

/// A normal that was lost is the mean of the triangles around it, by area.
TEST(Edges, LostNormalsAreMeansByArea) {
  Scene scene;
  scene.meshes.resize(1);
  Mesh& mesh = scene.meshes[0];
  mesh.positions = {{0, 0, 0}, {3, 0, 0}, {0, 1, 0}, {0, 0, 1}, {9, 9, 9}};
  mesh.triangles = {{0, 1, 2}, {0, 2, 3}};  // of area 3/2 across z, 1/2 across x
  mesh.normals.assign(5, vec3(0));
  EXPECT_EQ(validate(scene),
            std::vector<std::string>{"5 normals without direction: computed from the triangles"});
  const vec3 expected[] = {
      glm::normalize(vec3(1, 0, 3)), {0, 0, 1}, glm::normalize(vec3(1, 0, 3)), {1, 0, 0}, {0, 1, 0}};
  for (std::size_t i = 0; i < 5; ++i) EXPECT_LT(glm::distance(mesh.normals[i], expected[i]), 1e-6f) << i;
}

/// Cameras and lamps of the built-in scenes stand upright unless they look along the vertical.
TEST(Edges, LookingAtAPlaceIsUprightButAlongTheVertical) {
  const auto axes = [](const vec3& direction) {
    return mat3(looking_at(vec3(1, 2, 3), vec3(1, 2, 3) + 7.0f * direction).matrix());
  };
  for (const float side : {-1.0f, 1.0f}) {
    for (const vec3 d :
         {vec3(0.05f, side, 0.02f), vec3(0.3f, side, -2), vec3(0.03f, side, 0.02f), vec3(0, side, 0)}) {
      const vec3 direction = glm::normalize(d);
      const mat3 m = axes(direction);
      EXPECT_LT(glm::distance(-m[2], direction), 1e-6f);  // float rounding
      EXPECT_NEAR(glm::determinant(m), 1, 1e-6f);
      const bool steep = std::abs(direction.y) > 0.999f;
      EXPECT_NEAR(steep ? m[0].z : m[0].y, 0, 1e-6f) << direction.y;
      EXPECT_GT(steep ? -m[1].z : m[1].y, 0) << direction.y;
    }
  }
  EXPECT_EQ(looking_at(vec3(1, 2, 3), vec3(0)).translation, vec3(1, 2, 3));
}

}  // namespace
}  // namespace ssphh::scene
