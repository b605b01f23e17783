#include <gtest/gtest.h>

#include <ssphh/core/error.h>
#include <ssphh/rays/posed_world.h>
#include <ssphh/scene/primitives.h>
#include <ssphh/study/surface_points.h>

#include "boxes.h"
#include "error_message.h"
#include "ray_source.h"
#include "triangle_source.h"

namespace ssphh::study {
namespace {

/// A room of 4 × 2 × 3 m with walls 0.1 m thick, and a pillar of 0.5 × 2 × 0.5 m (but for 1 cm) in it.
const std::vector<scene::Bounds> room = {{{-0.1f, -0.1f, -0.1f}, {4.1f, 2.1f, 3.1f}},
                                         {{0, 0, 0}, {4, 2, 3}},
                                         {{2, 0.01f, 1}, {2.5f, 1.99f, 1.5f}}};

TEST(SurfacePoints, AreUniformByAreaOnWhatCanBeReached) {
  const test::TriangleSource source(boxes(room));
  constexpr int count = 4000;
  const std::vector<vec3> eyes = {{0.5f, 1, 1.5f}};
  const std::vector<rays::SurfacePoint> points = reachable_points(source, eyes, 0, {count, 1});
  ASSERT_EQ(points.size(), static_cast<std::size_t>(count));
  // Count by surface: floor and ceiling, walls at x, walls at z, sides of the pillar, its ends.
  const double areas[] = {2 * 12.0, 2 * 6.0, 2 * 8.0, 4 * 0.5 * 1.98, 2 * 0.25};
  double total = 0;
  for (const double a : areas) total += a;
  double counts[5] = {};
  for (const rays::SurfacePoint& p : points) {
    const vec3& x = p.position;
    const bool pillar = x.x > 1.9f && x.x < 2.6f && x.z > 0.9f && x.z < 1.6f && x.y > 0.005f && x.y < 1.995f;
    const vec3 n = glm::abs(p.normal);
    if (pillar) {
      ++counts[n.y > 0.5f ? 4 : 3];
    } else {
      ++counts[n.y > 0.5f ? 0 : n.x > 0.5f ? 1 : 2];
      // Inner side of the room: toward its middle.
      EXPECT_GT(glm::dot(p.normal, vec3(2, 1, 1.5f) - x), 0);
      EXPECT_TRUE(glm::all(glm::greaterThan(x, vec3(-1e-3f))) &&
                  glm::all(glm::lessThan(x, vec3(4.001f, 2.001f, 3.001f))));
    }
  }
  // χ² with four degrees of freedom: 23.5 is passed once in 10⁴. Points of one line are dependent, which two
  // crossings of a convex room at most double.
  double chi2 = 0;
  for (int i = 0; i < 5; ++i) {
    const double expected = count * areas[i] / total;
    chi2 += (counts[i] - expected) * (counts[i] - expected) / expected;
  }
  EXPECT_LT(chi2, 2 * 23.5);
}

TEST(SurfacePoints, ReachRoundOneCornerByDiffuseReflection) {
  // The back of the pillar is hidden from an eye in front of it and yet lit by the room.
  const test::TriangleSource source(boxes(room));
  const std::vector<vec3> eyes = {{0.5f, 1, 1.25f}};
  int behind = 0;
  for (const rays::SurfacePoint& p : reachable_points(source, eyes, 0, {2000, 2}))
    behind += p.normal.x > 0.9f && std::abs(p.position.x - 2.5f) < 1e-3f;
  // Its share of the area is 0.99/57: 35 of 2000, with a standard deviation of 6.
  EXPECT_NEAR(behind, 35, 24);
}

TEST(SurfacePoints, FollowAMovingPartAndKeepTheRest) {
  const test::TriangleSource source(boxes(room, true));
  const std::vector<vec3> eyes = {{0.5f, 1, 1.5f}};
  const auto at = [&](float time) { return reachable_points(source, eyes, time, {500, 3}); };
  const auto on_pillar = [](const rays::SurfacePoint& p, float x0) {
    const vec3& x = p.position;
    return x.x > x0 - 1e-3f && x.x < x0 + 0.501f && x.z > 0.999f && x.z < 1.501f && x.y > 0.005f &&
           x.y < 1.995f;
  };
  int before = 0, after = 0;
  for (const auto& p : at(0)) before += on_pillar(p, 2);
  for (const auto& p : at(0.5f)) after += on_pillar(p, 3);
  EXPECT_GT(before, 10);
  EXPECT_GT(after, 10);
  for (const auto& p : at(0)) {
    if (p.position.y > 0.005f && p.position.y < 1.995f) {
      EXPECT_EQ(p.moves, on_pillar(p, 2));
    }
  }
  const auto first = at(0.5f), again = at(0.5f);
  for (std::size_t i = 0; i < first.size(); ++i) EXPECT_EQ(first[i].position, again[i].position);
}

TEST(SurfacePoints, KeepTheirDistanceFromWhatStandsBeforeThem) {
  // The pillar's sides, 2 m and more from the walls they face, stay; so does no point that faces one nearer.
  const test::TriangleSource source(boxes(room));
  const std::vector<vec3> eyes = {{0.5f, 1, 1.5f}};
  int near = 0;
  for (const auto& p : reachable_points(source, eyes, 0, {500, 3})) near += std::abs(p.normal.z) > 0.9f;
  EXPECT_GT(near, 20);
  const rays::PosedWorld surfaces(source, 0);
  for (const auto& p : reachable_points(source, eyes, 0, {500, 3, 1.2f})) {
    const rays::RayQuery ahead{p.position + 1e-3f * p.normal, p.normal, 1.19f};
    std::uint8_t blocked = 0;
    surfaces.occluded({&ahead, 1}, {&blocked, 1});
    EXPECT_FALSE(blocked);
  }
}

TEST(SurfacePoints, InTheOpenStandBetweenSurfacesAndFaceAnywhere) {
  const test::TriangleSource source(boxes(room));
  const std::vector<vec3> eyes = {{0.5f, 1, 1.5f}};
  const auto surfaces = reachable_points(source, eyes, 0, {2000, 3});
  const auto points = points_in_the_open(source, surfaces, 0, 5);
  ASSERT_EQ(points.size(), surfaces.size()) << "the room is closed";
  vec3 normal(0);
  for (std::size_t i = 0; i < points.size(); ++i) {
    const vec3& x = points[i].position;
    EXPECT_TRUE(glm::all(glm::greaterThan(x, vec3(0))) && glm::all(glm::lessThan(x, vec3(4, 2, 3))));
    EXPECT_TRUE(points[i].moves);
    EXPECT_GT(glm::dot(x - surfaces[i].position, surfaces[i].normal), 0);
    normal += points[i].normal / static_cast<float>(points.size());
  }
  // Each component of the mean has a standard deviation of 1/√(3 · 2000): five of them.
  for (glm::length_t c = 0; c < 3; ++c) EXPECT_NEAR(normal[c], 0, 5 / std::sqrt(6000.0f));
}

TEST(SurfacePoints, InTheOpenStandAfterATwentiethOfTheWayAndAsMuchBeforeItsEnd) {
  // Whatever the way, it ends 2 m from its start; ±1 m are the bounds, by which surfaces are lifted.
  const test::RaySource source([](const vec3&, const vec3& d) { return test::surface_at(2, d); });
  const std::vector<rays::SurfacePoint> surfaces(4000, {vec3(1, 2, 3), {0, 1, 0}});
  const vec3 start = vec3(1, 2, 3) + 1e-4f * std::sqrt(3.0f) * vec3(0, 1, 0);
  float low = 2, high = 0, mean = 0;
  vec3 direction(0);
  for (const rays::SurfacePoint& p : points_in_the_open(source, surfaces, 0, 5)) {
    const float way = glm::distance(p.position, start);
    low = std::min(low, way), high = std::max(high, way), mean += way / 4000;
    direction += (p.position - start) / way / 4000.0f;
  }
  // Uniform within 0.1 … 1.9 m: four thousand come within a 400th of its ends but for a chance of e⁻¹⁰.
  EXPECT_GT(low, 0.0999f);
  EXPECT_LT(low, 0.1f + 1.8f / 400);
  EXPECT_LT(high, 1.9001f);
  EXPECT_GT(high, 1.9f - 1.8f / 400);
  EXPECT_NEAR(mean, 1, 5 * 1.8f / std::sqrt(12 * 4000.0f));
  EXPECT_NEAR(direction.y, 2.0f / 3, 5 * std::sqrt(1.0f / 18 / 4000)) << "cosine-distributed";
}

TEST(SurfacePoints, LieOnWallsThatAreTheScenesBoundsHoweverTheyAreRounded) {
  const vec3 size(3.3f, 2.1f, 4.7f), low(0.1f, -0.7f, 1.3f);
  const test::TriangleSource source(boxes({{low, low + size}}));
  const std::vector<vec3> eyes = {low + 0.5f * size};
  constexpr int count = 4000;
  for (const bool boxed : {false, true}) {
    SurfacePointParams params{count, 4};
    if (boxed) params.box = scene::Bounds{low, low + size};
    double counts[6] = {};
    for (const rays::SurfacePoint& p : reachable_points(source, eyes, 0, params)) {
      const vec3 n = glm::abs(p.normal);
      const int axis = n.x > 0.5f ? 0 : n.y > 0.5f ? 1 : 2;
      ++counts[2 * axis + (p.normal[axis] < 0)];
    }
    const double areas[] = {double(size.y * size.z), double(size.x * size.z), double(size.x * size.y)};
    const double total = 2 * (areas[0] + areas[1] + areas[2]);
    double chi2 = 0;
    for (int i = 0; i < 6; ++i) {
      const double expected = count * areas[i / 2] / total;
      chi2 += (counts[i] - expected) * (counts[i] - expected) / expected;
    }
    EXPECT_LT(chi2, 2 * 25.7) << "five degrees of freedom: passed once in 10⁴; twice for points of one line";
  }
}

TEST(SurfacePoints, InAViewAreWhatTheCameraSeesAsMuchAsItSeesOfIt) {
  // From the room's middle toward +x, a quarter of the view's width ends at the pillar's edge
  const test::TriangleSource source(boxes(room));
  scene::CameraPose camera{mat4(1), {}};
  camera.world[0] = vec4(0, 0, 1, 0), camera.world[2] = vec4(-1, 0, 0, 0),
  camera.world[3] = vec4(0.5f, 1, 1.25f, 1);
  camera.camera.yfov = 2 * std::atan(0.5f);
  constexpr int count = 4000;
  const auto points = points_in_view(source, camera, 1, 0, count, 3);
  ASSERT_EQ(points.size(), static_cast<std::size_t>(count));
  double pillar = 0;
  for (const rays::SurfacePoint& p : points) {
    EXPECT_LT(glm::dot(p.normal, p.position - vec3(camera.world[3])), 0);
    const vec3 way = p.position - vec3(camera.world[3]);
    EXPECT_LE(std::max(std::abs(way.y), std::abs(way.z)), 0.5001f * way.x);
    pillar += std::abs(p.position.x - 2) < 1e-3f;
  }
  // Its face is 0.5 m wide at 1.5 m, and fills the view's height but for what is above 0.75 m: a third of it.
  EXPECT_NEAR(pillar / count, 1.0 / 3, 4 * std::sqrt(2.0 / 9 / count));
  // Parallel: 2 m high and wide
  camera.camera.orthographic = true;
  camera.camera.yheight = 1.6f;
  pillar = 0;
  for (const rays::SurfacePoint& p : points_in_view(source, camera, 1, 0, count, 3))
    pillar += std::abs(p.position.x - 2) < 1e-3f;
  EXPECT_NEAR(pillar / count, 0.5 / 1.6, 4 * std::sqrt(0.22 / count));
  // Away from all there is
  camera.world[3].x = 50;
  EXPECT_TRUE(points_in_view(source, camera, 1, 0, 10).empty());
  EXPECT_THROW(points_in_view(source, camera, 1, 0, 0), Error);
}

TEST(SurfacePoints, InABoxAreAllThereAndUniformByArea) {
  // A quarter of the room's floor, a piece of a wall and one side of the pillar; on a plain of 200 m, of
  // which hardly any point would fall into it by chance.
  std::vector<scene::Bounds> all = room;
  all.push_back({{-100, -0.3f, -100}, {100, -0.2f, 100}});
  const test::TriangleSource source(boxes(all));
  const std::vector<vec3> eyes = {{0.5f, 1, 1.5f}, {50, 3, 50}};
  const scene::Bounds box{{1, -0.05f, 0.5f}, {2.1f, 1, 3.05f}};
  constexpr int count = 1500;
  const auto points = reachable_points(source, eyes, 0, {count, 1, 0, box});
  ASSERT_EQ(points.size(), static_cast<std::size_t>(count));
  const double areas[] = {1.1 * 2.5 - 0.1 * 0.5, 1.1, 0.5 * 0.99, 2 * 0.1 * 0.99 + 0.1 * 0.5};
  double total = 0, counts[4] = {};
  for (const double a : areas) total += a;
  for (const rays::SurfacePoint& p : points) {
    EXPECT_TRUE(within({box.min - 2e-3f, box.max + 2e-3f}, p.position)) << "within rounding of 200 m";
    const bool pillar = p.position.x > 1.999f && p.position.y > 0.005f;
    ++counts[pillar ? (p.normal.x < -0.5f ? 2 : 3) : p.normal.y > 0.5f ? 0 : 1];
  }
  double chi2 = 0;
  for (int i = 0; i < 4; ++i) {
    const double expected = count * areas[i] / total;
    chi2 += (counts[i] - expected) * (counts[i] - expected) / expected;
  }
  EXPECT_LT(chi2, 2 * 21.1) << "three degrees of freedom: passed once in 10⁴; twice for points of one line";
}

TEST(SurfacePoints, InTheOpenStayInTheirBox) {
  const test::TriangleSource source(boxes(room));
  const std::vector<vec3> eyes = {{0.5f, 1, 1.5f}};
  const scene::Bounds box{{-1, -1, -1}, {1, 0.5f, 4}};
  const auto surfaces = reachable_points(source, eyes, 0, {500, 3, 0, box});
  const auto points = points_in_the_open(source, surfaces, 0, 5, box);
  ASSERT_EQ(points.size(), surfaces.size());
  for (std::size_t i = 0; i < points.size(); ++i) {
    EXPECT_TRUE(within(box, points[i].position));
    EXPECT_GT(glm::dot(points[i].position - surfaces[i].position, surfaces[i].normal), 0);
  }
}

TEST(SurfacePoints, SeePlacesBeforeThemThatNothingHides) {
  const test::TriangleSource source(boxes(room));
  const std::vector<rays::SurfacePoint> points = {
      {{0, 1, 1.25f}, {1, 0, 0}}, {{4, 1, 1.25f}, {-1, 0, 0}}, {{1, 0, 1}, {0, -1, 0}}};
  const std::vector<vec3> places = {{1, 1, 1.25f}};
  EXPECT_EQ(sees_any(source, points, places, 0), (std::vector<std::uint8_t>{1, 0, 0}))
      << "straight before it; behind the pillar; behind its surface";
  EXPECT_EQ(sees_any(source, points, {}, 0), (std::vector<std::uint8_t>{0, 0, 0}));
}

TEST(SurfacePoints, ErrorsSayWhatIsMissing) {
  const test::TriangleSource source(boxes(room));
  EXPECT_THROW(reachable_points(source, {}, 0), Error);
  const std::vector<vec3> inside_the_wall = {{-0.05f, 1, 1}};
  EXPECT_THROW(reachable_points(source, std::vector<vec3>{{0, 0, 0}}, 0, {0, 0}), Error);
  EXPECT_THROW(reachable_points(test::TriangleSource(scene::Scene{}), inside_the_wall, 0), Error);
  const auto in_box = [&](const scene::Bounds& box) {
    return test::message_of([&] {
      reachable_points(source, std::vector<vec3>{{0.5f, 1, 1.5f}}, 0, {8, 0, 0, box});
    });
  };
  EXPECT_EQ(in_box({{1, 1, 1}, {0, 2, 2}}),
            "box: it is none (give the lower corner first, x0,y0,z0,x1,y1,z1)");
  EXPECT_EQ(in_box({{50, 0, 0}, {51, 1, 1}}),
            "box: it lies outside of the scene, which reaches from -0.1, -0.1, -0.1 to 4.1, 2.1, 3.1");
  EXPECT_EQ(in_box({{1, 1, 1}, {1.5f, 1.5f, 1.5f}}),
            "surface points: only 0 of 8 points in the box can be reached from cameras and probes (place "
            "probes inside of "
            "what is to be lit)");
}

}  // namespace
}  // namespace ssphh::study
