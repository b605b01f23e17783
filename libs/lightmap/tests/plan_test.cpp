// Wide surfaces far from everything get wider texels; all else is as it was.

#include <map>
#include <set>

#include <gmock/gmock.h>

#include "clearance.h"
#include "cut_mesh.h"
#include "error_message.h"
#include "rooms.h"

namespace ssphh::lightmap {
namespace {

using testing::ElementsAre;
using testing::HasSubstr;
using testing::IsEmpty;

/// A rectangle of two triangles, facing up.
scene::Mesh ground(float half, float height = 0) {
  scene::Mesh mesh;
  mesh.positions = {
      {-half, height, -half}, {-half, height, half}, {half, height, half}, {half, height, -half}};
  mesh.normals.assign(4, vec3(0, 1, 0));
  mesh.uvs[0] = {{0, 0}, {0, 1}, {1, 1}, {1, 0}};
  mesh.triangles = {{0, 1, 2}, {0, 2, 3}};
  return mesh;
}

/// A house of 8 m × 4 m × 6 m in the midst of a plain of 600 m, not about the origin.
scene::Scene house_on_a_plain() {
  return scene_of({ground(300), scene::make_box({-4, 0, -3}, {4, 4, 3})},
                  glm::translate(mat4(1), vec3(50, 2, -70)));
}

TEST(Clearance, IsTheDistanceToWhatRisesOverThePlane) {
  const scene::Scene scene = scene_of({ground(1000), scene::make_box({10, 0, -5}, {12, 3, 5})});
  const Clearance clearance(scene, 0);
  const vec3 up(0, 1, 0);
  EXPECT_FLOAT_EQ(clearance.at({0, 0, 0}, up), 10);
  EXPECT_FLOAT_EQ(clearance.at({-20, 0, 0}, up), 30);
  EXPECT_FLOAT_EQ(clearance.at({20, 0, 0}, up), 8);
  EXPECT_FLOAT_EQ(clearance.at({11, 8, 0}, -up), 5) << "from above, downward";
  EXPECT_TRUE(std::isinf(clearance.at({11, 8, 0}, up))) << "nothing stands over a roof's height";
}

TEST(CutMesh, LeavesNoVertexOnAnEdgeAndEqualAreas) {
  const scene::Mesh before = ground(8);
  const vec3 place(3, 0, 1);
  const auto [after, whole] = cut_mesh(
      before, mat4(1),
      [&](const std::array<vec3, 3>& t, std::uint32_t) {
        const float longest =
            std::max({glm::distance(t[0], t[1]), glm::distance(t[1], t[2]), glm::distance(t[2], t[0])});
        return longest > std::max(0.5f, 0.5f * glm::distance((t[0] + t[1] + t[2]) / 3.0f, place));
      },
      100000);
  ASSERT_GT(after.triangles.size(), 100u);
  double area = 0;
  for (const uvec3& t : after.triangles) {
    const vec3 a = after.positions[t.x], b = after.positions[t.y], c = after.positions[t.z];
    const vec3 normal = glm::cross(b - a, c - a);
    EXPECT_GT(normal.y, 0) << "it faces up, as before";
    area += 0.5 * static_cast<double>(normal.y);
    for (const vec3& v : after.positions) {
      for (const auto& [from, to] : {std::pair(a, b), std::pair(b, c), std::pair(c, a)}) {
        const float share = glm::dot(v - from, to - from) / glm::dot(to - from, to - from);
        const bool between = share > 1e-3f && share < 1 - 1e-3f;
        EXPECT_FALSE(between && glm::distance(v, glm::mix(from, to, share)) < 1e-4f);
      }
    }
  }
  EXPECT_NEAR(area, 256, 1e-3);
  for (std::size_t v = 0; v < after.positions.size(); ++v) {
    const vec2 uv = vec2(after.positions[v].x, after.positions[v].z) / 16.0f + 0.5f;
    EXPECT_NEAR(after.uvs[0][v].x, uv.x, 1e-5f);
    EXPECT_NEAR(after.uvs[0][v].y, uv.y, 1e-5f);
    EXPECT_EQ(after.normals[v], vec3(0, 1, 0));
  }
}

TEST(CutMesh, TellsWhatEachIsAPartOf) {
  const scene::Mesh before = ground(8);
  const auto [after, whole] = cut_mesh(
      before, mat4(1),
      [](const std::array<vec3, 3>& t, std::uint32_t of) { return of == 1 && glm::distance(t[0], t[1]) > 3; },
      1000);
  ASSERT_EQ(whole.size(), after.triangles.size());
  ASSERT_GT(whole.size(), 8u);
  for (std::size_t k = 0; k < whole.size(); ++k) {
    const uvec3& t = after.triangles[k];
    const vec3 middle = (after.positions[t.x] + after.positions[t.y] + after.positions[t.z]) / 3.0f;
    EXPECT_EQ(whole[k], middle.x > middle.z ? 1u : 0u);
  }
}

TEST(CutMesh, CutsBothSidesOfASeamAlike) {
  // Two halves that share places and no vertices, of which one is to be cut.
  scene::Mesh mesh = ground(1);
  mesh.positions.insert(mesh.positions.end(), {mesh.positions[0], mesh.positions[2]});
  mesh.normals.clear(), mesh.uvs[0].clear();
  mesh.triangles[1] = {4, 5, 3};
  const scene::Mesh after = cut_mesh(
                                mesh, mat4(1),
                                [](const std::array<vec3, 3>& t, std::uint32_t) {
                                  return t[0].x + t[1].x + t[2].x < 0 && glm::distance(t[0], t[1]) > 1.9f;
                                },
                                100)
                                .mesh;
  const auto touching = [&](const vec3& at) {
    return std::ranges::count_if(after.triangles, [&](const uvec3& t) {
      return after.positions[t.x] == at || after.positions[t.y] == at || after.positions[t.z] == at;
    });
  };
  EXPECT_EQ(touching({0, 0, 0}), 4) << "the middle of the seam is a corner on either side";
}

TEST(CutMesh, StopsAtTheMostTriangles) {
  const scene::Mesh mesh = cut_mesh(
                               ground(1), mat4(1), [](const auto&, std::uint32_t) { return true; }, 1000)
                               .mesh;
  EXPECT_GE(mesh.triangles.size(), 1000u);
  EXPECT_LE(mesh.triangles.size(), 4000u);
}

TEST(Plan, APlainAroundAHouseTakesNoTexelsFromIt) {
  const Plan plan = plan_lightmap(house_on_a_plain(), 0, {}, {.size = 512});
  const float uniform = lay_out(make_charts(house_on_a_plain(), 0).charts, {.size = 512}).density;
  EXPECT_GT(plan.layout.density, 6 * uniform);
  EXPECT_THAT(plan.charts.notes, ElementsAre(HasSubstr("texels are up to 32 times as wide on")));

  const Clearance clearance(house_on_a_plain(), 0);
  const Unwrapped u{Plan(plan)};
  std::set<int> all;
  double area = 0;
  for (std::size_t c = 0, f = 0; c < u.charts.charts.size(); ++c) {
    const Chart& chart = u.charts.charts[c];
    all.insert(chart.halvings);
    const vec2 ideal(std::ldexp(u.layout.density, -chart.halvings));
    EXPECT_LT(glm::distance(u.layout.places[c].scale, ideal) * glm::length(chart.size), 1.5f);
    for (std::size_t t = 0; t < chart.triangles.size(); ++t, ++f) {
      const Face& face = u.texels.faces[f];
      area += 0.5 * static_cast<double>(glm::length(glm::cross(face.position[1] - face.position[0],
                                                               face.position[2] - face.position[0])));
      if (chart.halvings == 0) continue;
      for (const vec3& share : shares())
        EXPECT_GE(clearance.at(point(face.position, share), face.front),
                  6 * 1.9f * std::ldexp(0.5f, chart.halvings))
            << "no texel is much wider than a 48th of the distance to the house";
    }
  }
  EXPECT_THAT(all, ElementsAre(0, 1, 2, 3, 4, 5));
  EXPECT_NEAR(area, 600 * 600 + 2 * (8 * 4 + 4 * 6 + 8 * 6), 1);
}

TEST(Plan, LightGoesOnFromTexelsToWiderOnes) {
  // A linear field is linear over seams of charts whose texels differ: what is off is a twentieth of a texel.
  const Unwrapped u(plan_lightmap(house_on_a_plain(), 0, {}, {.size = 512}));
  const auto field = [](const vec3& at) { return vec3(600) + vec3(at.x, at.z, 0.5f * (at.x - at.z)); };
  const image::Image atlas = u.atlas([&](const rays::SurfacePoint& at) { return field(at.position); });
  for (std::size_t c = 0, f = 0; c < u.charts.charts.size(); ++c) {
    const float texel = std::ldexp(1 / u.layout.density, u.charts.charts[c].halvings);
    for (std::size_t t = 0; t < u.charts.charts[c].triangles.size(); ++t, ++f) {
      const Face& face = u.texels.faces[f];
      if (face.front.y < 0.99f) continue;
      for (const vec3& share : shares()) {
        const vec3 error = glm::abs(u.looked_up(atlas, face, share) - field(point(face.position, share)));
        EXPECT_LT(max_component(error), 0.3f * texel);
      }
    }
  }
}

TEST(Plan, RoomsAreAsTheyWereHoweverFewTexelsThereAre) {
  const scene::Scene room =
      scene_of({scene::make_box({-4, 0, -3}, {4, 3, 3}), scene::make_sphere(0.7f, 24, 12)});
  const Plan plan = plan_lightmap(room, 0, {}, {.size = 64});
  EXPECT_LT(plan.layout.density, enough_density);
  const Layout before = lay_out(make_charts(room, 0).charts, {.size = 64});
  EXPECT_EQ(plan.layout.density, before.density);
  EXPECT_EQ(plan.scene.meshes.size(), 2u);
  EXPECT_THAT(plan.charts.notes, IsEmpty());
}

TEST(Plan, APlainThatHasEnoughTexelsIsNotCut) {
  const scene::Scene scene = scene_of({ground(30), scene::make_box({-1, 0, -1}, {1, 1, 1})});
  EXPECT_THAT(plan_lightmap(scene, 0, {}, {.size = 1024}).charts.notes, IsEmpty());
  EXPECT_THAT(plan_lightmap(scene, 0, {}, {.size = 256}).charts.notes,
              ElementsAre(HasSubstr("times as wide")));
  EXPECT_THAT(plan_lightmap(scene, 0, {}, {.density = 50.0f}).charts.notes, IsEmpty());
  const Plan dense = plan_lightmap(scene, 0, {}, {.size = 1024, .density = 50.0f});
  EXPECT_EQ(dense.layout.density, 50) << "which would not fit without wider texels";
  EXPECT_THAT(dense.charts.notes, ElementsAre(HasSubstr("that are 1.92 m or more from all else")));
}

TEST(Plan, ADensityThatDoesNotFitEvenSoIsRefusedAsItWas) {
  const scene::Scene room = scene_of({scene::make_box({-4, 0, -3}, {4, 3, 3})});
  EXPECT_EQ(
      test::message_of([&] { plan_lightmap(room, 0, {}, {.size = 64, .density = 5000.0f}); }),
      test::message_of([&] { lay_out(make_charts(room, 0).charts, {.size = 64, .density = 5000.0f}); }));
}

TEST(Plan, WhatIsRoundKeepsItsTexelsThoughNothingStandsBeforeIt) {
  scene::Mesh big = scene::make_sphere(100, 96, 48);
  const Plan plan = plan_lightmap(scene_of({big}), 0, {}, {.size = 256});
  EXPECT_LT(plan.layout.density, enough_density);
  EXPECT_THAT(plan.charts.notes, IsEmpty());
}

TEST(Plan, CoordinatesOfTheFileAreKept) {
  scene::Scene scene = house_on_a_plain();
  scene.meshes[0].uvs[1] = scene.meshes[0].uvs[0];
  const Plan plan = plan_lightmap(scene, 0, {}, {.size = 512});
  EXPECT_EQ(plan.scene.meshes.size(), 2u);
  EXPECT_THAT(plan.charts.notes, IsEmpty());
}

TEST(Plan, SaysWhyNothingHasAChart) {
  scene::Scene scene = scene_of({ground(1)});
  scene.materials.emplace_back().unlit = true;
  scene.meshes[0].material = 0;
  EXPECT_THAT(test::message_of([&] { plan_lightmap(scene, 0); }), HasSubstr("it is unlit"));
}

}  // namespace
}  // namespace ssphh::lightmap
