// Thresholds of tracing, each side of each: which points of a part count, and boxes beside a ray.

#include <gtest/gtest.h>

#include <ssphh/trace/transport_scene.h>

#include "error_message.h"
#include "hand_made.h"
#include "rays.h"
#include "sweep.h"

namespace ssphh::test {
namespace {

/// A mesh on a part that moves, of which half is seen through.
scene::Scene veil(const scene::Mesh& mesh, float alpha) {
  scene::Scene scene;
  const int door = add_node(scene, "door");
  scene.animations.push_back({"a",
                              {{door,
                                scene::AnimationPath::translation,
                                scene::Interpolation::linear,
                                {0, 1},
                                {vec4(0), vec4(1)}}}});
  scene::Material veil = lambertian(vec3(0.5f));
  veil.alpha_mode = scene::AlphaMode::blend, veil.alpha = alpha;
  add_object(scene, mesh, veil, "veil", door);
  return scene;
}

TEST(SamplePart, LeavesOutWhatIsMoreThanHalfTransparent) {
  for (const float alpha : {0.49f, 0.51f}) {
    const scene::Scene scene = veil(scene::make_quad(vec3(-1, 0, 1), vec3(2, 0, 0), vec3(0, 0, -2)), alpha);
    const trace::TransportScene source(scene);
    EXPECT_EQ(source.sample_part(1, 10).empty(), alpha < 0.5f) << alpha;
    EXPECT_EQ(message_of([&] { source.sample_part(1, 1e9); }),
              "points on a part: more than 100 million (ask for fewer per square metre)");
  }
}

// Corners on a line, and so far apart that the area is no number.
TEST(SamplePart, LeavesOutTrianglesWithoutAnArea) {
  scene::Mesh mesh = scene::make_quad(vec3(-1, 0, 1), vec3(2, 0, 0), vec3(0, 0, -2));
  const auto points = [&](const vec3& second, const vec3& third) {
    mesh.positions.resize(4), mesh.triangles.resize(2);
    mesh.normals.clear(), mesh.tangents.clear(), mesh.uvs[0].clear();
    mesh.positions.insert(mesh.positions.end(), {vec3(0), second, third});
    mesh.triangles.push_back({4, 5, 6});
    const scene::Scene scene = veil(mesh, 1);
    return trace::TransportScene(scene).sample_part(1, 0).size();
  };
  EXPECT_EQ(points({1, 0, 0}, {0, 0, -1}), 3u) << "one a triangle";
  EXPECT_EQ(points({1, 0, 0}, {2, 0, 0}), 2u);
  EXPECT_EQ(points({0, 0, 0}, {2, 0, 0}), 2u);
  EXPECT_EQ(points({1e25f, 0, 0}, {0, 0, -1e25f}), 2u);
}

// Of a veil none is kept, so that a limit that does not hold would cost time alone.
TEST(SamplePart, AHundredMillionPointsAreTooMany) {
  const scene::Scene scene = veil(scene::make_quad(vec3(-1, 0, 1), vec3(2, 0, 0), vec3(0, 0, -2)), 0.4f);
  EXPECT_EQ(message_of([&] { trace::TransportScene(scene).sample_part(1, 5e7); }),
            "points on a part: more than 100 million (ask for fewer per square metre)");
}

TEST(RayCounts, AFractionOfBackFacesTakes128) {
  scene::Scene scene;
  add_room(scene, lambertian(vec3(0.5f)));
  const trace::PathTracer tracer(scene);
  EXPECT_EQ(tracer.backface_fraction(vec3(0)), 0);
  EXPECT_EQ(tracer.rays_traced(), 128u);
}

// The points that a ray of the box of directions reaches are themselves a box at each of its places.
TEST(Sweep, MeetsBoxesBesideARayNowhere) {
  const scene::Bounds box{vec3(1, 2, 3), vec3(2, 4, 6)};
  const auto meets = [&](const vec3& from, const vec3& direction, float t_max = 100) {
    return trace::sweep_meets(from, {direction, direction}, t_max, box);
  };
  const vec3 inside(1.5f, 3, 4.5f);
  for (int axis = 0; axis < 3; ++axis) {
    vec3 direction(0);
    direction[axis] = 1;
    for (int other = 0; other < 3; ++other) {
      if (other == axis) continue;
      vec3 from = inside;
      from[axis] = -10;
      EXPECT_TRUE(meets(from, direction));
      EXPECT_FALSE(meets(from, -direction)) << "it lies behind";
      EXPECT_FALSE(meets(from, direction, 10 + box.min[axis] - 0.01f)) << "too short";
      EXPECT_TRUE(meets(from, direction, 10 + box.min[axis] + 0.01f));
      for (const float beside : {box.min[other] - 0.01f, box.max[other] + 0.01f}) {
        from[other] = beside;
        EXPECT_FALSE(meets(from, direction));
      }
    }
  }
  EXPECT_FALSE(trace::sweep_meets(inside, {}, 1, box));
  EXPECT_FALSE(trace::sweep_meets(inside, {vec3(1), vec3(1)}, 1, {}));
  const scene::Bounds wide = trace::grown(box, 0.5f);
  EXPECT_EQ(wide.min, vec3(0.5f, 1.5f, 2.5f));
  EXPECT_EQ(wide.max, vec3(2.5f, 4.5f, 6.5f));
  EXPECT_TRUE(trace::grown({}, 1).empty());
}

}  // namespace
}  // namespace ssphh::test
