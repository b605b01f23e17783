// Rays against a floor that stays and balls that move, whose answers follow from their equations alone.

#include <bit>
#include <cmath>
#include <numbers>

#include <glm/gtc/matrix_transform.hpp>
#include <gtest/gtest.h>

#include <ssphh/rays/posed_world.h>

#include "error_message.h"
#include "not_finite.h"

namespace ssphh::rays {
namespace {

using ssphh::test::message_of;

using test::infinity;
constexpr float rounding = 2e-6f;  // of a few float operations on numbers near 1

/// Part 0 is the floor y = 0, 20 m wide; all others are balls of radius 1 around the origins of their frames.
class Balls : public TransportSource {
 public:
  explicit Balls(int balls) : balls_(balls) {}

  int part_count() const override { return 1 + balls_; }
  scene::Bounds part_bounds(int part) const override {
    scene::Bounds box;
    if (part == empty_part) return box;
    box.add(part == 0 ? vec3(-10, 0, -10) : vec3(-1));
    box.add(part == 0 ? vec3(10, 0, 10) : vec3(1));
    return box;
  }
  /// Ball p stands at height 2p and climbs by 1 m/s.
  mat4 part_pose(int part, float time) const override {
    const auto p = static_cast<float>(part);
    return glm::translate(mat4(1), vec3(0, 2 * p + time, 0));
  }
  void intersect(int part, std::span<const RayQuery> rays, std::span<RayHit> hits) const override {
    for (std::size_t i = 0; i < rays.size(); ++i) {
      hits[i] = {};
      const float t = distance(part, rays[i]);
      if (!(t < rays[i].t_max)) continue;
      const vec3 at = rays[i].origin + t * rays[i].direction;
      hits[i].distance = t;
      hits[i].normal = part == 0 ? vec3(-0.0f, 1, -0.0f) : glm::normalize(at);
      hits[i].albedo = vec3(0.1f * static_cast<float>(part + 1));
      hits[i].group = part;
    }
  }
  void occluded(int part, std::span<const RayQuery> rays, std::span<std::uint8_t> blocked) const override {
    for (std::size_t i = 0; i < rays.size(); ++i)
      blocked[i] = distance(part, rays[i]) < rays[i].t_max ? 1 : 0;
  }

  const std::string& part_name(int) const override { return name_; }
  float duration() const override { return 1; }
  std::vector<PartPoint> sample_part(int, double) const override { return {}; }
  const std::vector<std::string>& light_groups() const override { return none_; }
  std::vector<scene::LightState> lights(float) const override { return {}; }
  const std::vector<std::string>& light_names() const override { return none_; }
  int light_group_of(int) const override { return 0; }
  bool group_emits_from(int, int) const override { return false; }
  std::unique_ptr<DirectLight> direct_light(std::span<const scene::LightState>, std::span<const mat4>,
                                            const scene::EnvironmentState&) const override {
    return nullptr;
  }
  std::uint64_t rays_traced() const override { return 0; }

  int empty_part = -1;  ///< one without triangles

 private:
  /// Of the nearest surface in front, in units of the direction.
  float distance(int part, const RayQuery& ray) const {
    if (part == empty_part) return infinity;
    if (part == 0) {
      const float t = -ray.origin.y / ray.direction.y;
      return t > 0 ? t : infinity;
    }
    const float a = glm::dot(ray.direction, ray.direction), b = glm::dot(ray.origin, ray.direction),
                c = glm::dot(ray.origin, ray.origin) - 1, root = b * b - a * c;
    if (!(root >= 0)) return infinity;
    const float t = (-b - std::sqrt(root)) / a;
    return t > 0 ? t : infinity;
  }

  int balls_;
  std::string name_ = "ball";
  std::vector<std::string> none_;
};

void expect_near(const vec3& got, const vec3& wanted) {
  EXPECT_LT(glm::distance(got, wanted), rounding) << got.x << " " << got.y << " " << got.z;
}

TEST(PosedWorld, ABoxTurnsIntoTheBoxAroundIt) {
  const scene::Bounds box{{1, 2, 3}, {2, 4, 7}};
  mat4 turn(0);  // x → y → z → x, and moved by (10, 20, 30)
  turn[0].y = turn[1].z = turn[2].x = turn[3].w = 1;
  turn[3] += vec4(10, 20, 30, 0);
  expect_near(transformed(box, turn).min, {13, 21, 32});
  expect_near(transformed(box, turn).max, {17, 22, 34});
  // A square of side 1 on its edge is √2 wide.
  const scene::Bounds tilted = transformed({vec3(0), vec3(1)}, glm::rotate(mat4(1), pi / 4, vec3(0, 0, 1)));
  constexpr float half_diagonal = std::numbers::sqrt2_v<float> / 2;
  expect_near(tilted.min, {-half_diagonal, 0, 0});
  expect_near(tilted.max, {half_diagonal, 2 * half_diagonal, 1});
  EXPECT_TRUE(transformed(scene::Bounds{}, turn).empty());
  // x + y − z, x − y + z and −x + y + z: each end is at another corner.
  const mat4 skew(mat3(vec3(1, 1, -1), vec3(1, -1, 1), vec3(-1, 1, 1)));
  expect_near(transformed(box, skew).min, {1 + 2 - 7, 1 - 4 + 3, -2 + 2 + 3});
  expect_near(transformed(box, skew).max, {2 + 4 - 3, 2 - 2 + 7, -1 + 4 + 7});
}

TEST(PosedWorld, PartsStandWhereTheTimePutsThem) {
  const Balls source(2);
  const PosedWorld world(source, 0.5f);
  expect_near(world.bounds().min, {-10, 0, -10});
  expect_near(world.bounds().max, {10, 5.5f, 10});
  const std::vector<RayQuery> down = {{{0, 10, 0}, {0, -2, 0}},
                                      {{5, 10, 0}, {0, -2, 0}},
                                      {{5, 10, 0}, {0, 2, 0}},
                                      {{-5, 2.5f, 0}, {1, 0, 0}}};
  std::vector<RayHit> hits(4);
  std::vector<std::uint8_t> moves(4, 7);
  world.intersect(down, hits, moves);
  EXPECT_NEAR(hits[0].distance, 2.25f, rounding) << "the upper ball's top, in units of the direction";
  EXPECT_EQ(hits[0].group, 2);
  EXPECT_EQ(hits[1].distance, 5) << "the floor beside the balls";
  EXPECT_EQ(hits[1].group, 0);
  expect_near(hits[1].normal, {0, 1, 0});
  EXPECT_TRUE(hits[2].escaped());
  EXPECT_EQ(hits[2].normal, vec3(0)) << "nothing was met";
  EXPECT_NEAR(hits[3].distance, 4, rounding);
  EXPECT_EQ(hits[3].group, 1);
  EXPECT_EQ(moves, (std::vector<std::uint8_t>{1, 0, 0, 1}));
  world.intersect(down, hits);
  EXPECT_EQ(hits[0].group, 2) << "nobody has to ask what moves";
  // Fewer rays than there is room for: the rest is not touched.
  hits.assign(4, {}), moves.assign(4, 9);
  world.intersect(std::span(down).first(2), std::span(hits).first(2), std::span(moves).first(2));
  EXPECT_EQ(hits[2].group, -1);
  EXPECT_EQ(moves[2], 9);
}

/// A ball of half axes 2, 1 and ½, turned by a quarter about y so that the long one lies along z, at (3, 4,
/// 5).
TEST(PosedWorld, AScaledBallHasTheNormalsOfAnEllipsoid) {
  const Balls source(1);
  mat4 pose = glm::translate(mat4(1), vec3(3, 4, 5));
  pose = glm::scale(glm::rotate(pose, pi / 2, vec3(0, 1, 0)), vec3(2, 1, 0.5f));
  const PosedWorld world(source, std::vector<mat4>{mat4(99), pose});
  expect_near(world.bounds().min, {-10, 0, -10});
  expect_near(world.bounds().max, {10, 5, 10});
  // Down along x = 3 and z = 6: half way out on the long axis, y = √3/2 above the middle.
  const RayQuery ray{{3, 10, 6}, {0, -0.5f, 0}};
  RayHit hit;
  world.intersect({&ray, 1}, {&hit, 1});
  const float height = std::sqrt(3.0f) / 2;
  EXPECT_NEAR(hit.distance, (6 - height) / 0.5f, 1e-5f);  // float rounding of numbers near 10
  expect_near(hit.normal, glm::normalize(vec3(0, height, 1.0f / 4)));
  expect_near(hit.albedo, vec3(0.2f));
  // A ray that ends before it meets nothing of it.
  RayQuery shorter = ray;
  shorter.t_max = 10;
  world.intersect({&shorter, 1}, {&hit, 1});
  EXPECT_TRUE(hit.escaped());
}

TEST(PosedWorld, SegmentsAreBlockedByAnyPart) {
  const Balls source(2);
  const PosedWorld world(source, 0);
  const vec3 above(0, 9, 0), beside(5, 9, 0);
  const std::vector<std::pair<RayQuery, bool>> segments = {
      {{above, {0, -1, 0}, 3}, false},     {{above, {0, -1, 0}, 5}, true},  // the upper ball begins at 5
      {{beside, {0, -1, 0}, 8}, false},    {{beside, {0, -1, 0}, 10}, true},
      {{{-5, 2, 0}, {1, 0, 0}, 9}, true},  // the lower ball
      {{{-5, 2, 2}, {1, 0, 0}, 9}, false}, {{above, {0, 1, 0}, infinity}, false}};
  std::vector<RayQuery> rays;
  for (const auto& [ray, blocked] : segments) rays.push_back(ray);
  std::vector<std::uint8_t> blocked(rays.size(), 9);
  world.occluded(rays, blocked);
  for (std::size_t i = 0; i < rays.size(); ++i) {
    EXPECT_EQ(blocked[i], segments[i].second ? 1 : 0) << i;
    EXPECT_EQ(world.occluded(rays[i]), segments[i].second) << i;
  }
  EXPECT_TRUE(world.visible(above, {0, 5.5f, 0}));
  EXPECT_FALSE(world.visible(above, {0, 4.5f, 0}));
  EXPECT_FALSE(world.visible({-5, 4, 0}, {5, 4, 0}));
  EXPECT_TRUE(world.visible({-5, 4, 0}, {-1.5f, 4, 0})) << "it ends before the ball";
}

TEST(PosedWorld, GlassOfAnyPartPartsWhatSeesEachOther) {
  class Veiled : public Balls {
   public:
    Veiled() : Balls(2) {}
    void intersect(int part, std::span<const RayQuery> rays, std::span<RayHit> hits) const override {
      Balls::intersect(part, rays, hits);
      if (part != glass) return;
      for (RayHit& hit : hits) {
        if (!hit.escaped()) hit = {.through = vec3(1, 0.5f, 1)};
      }
    }
    int glass = -1;
  };
  Veiled source;
  const PosedWorld world(source, 0);
  const vec3 low(-5, 2, 0), far(5, 2, 0), high(-5, 4, 0), beside(-5, 2, 3);
  EXPECT_FALSE(world.joined(low, far) || world.joined(high, {5, 4, 0}) || world.joined(low, {-5, -1, 0}));
  EXPECT_TRUE(world.joined(low, high) && world.joined(beside, {5, 2, 3}));
  EXPECT_TRUE(world.joined(low, {-1.5f, 2, 0})) << "it ends before the ball";
  for (source.glass = 0; source.glass < 3; ++source.glass)
    EXPECT_FALSE(world.joined(low, far) || world.joined(high, {5, 4, 0}) || world.joined(low, {-5, -1, 0}));
}

TEST(PosedWorld, WhatIsScaledToNothingIsNotThere) {
  const Balls source(2);
  const std::vector<mat4> poses = {mat4(1), glm::translate(mat4(1), vec3(0, 40, 0)),
                                   glm::scale(glm::translate(mat4(1), vec3(0, 80, 0)), vec3(1, 0, 1))};
  const PosedWorld world(source, poses);
  EXPECT_EQ(world.bounds().max.y, 41);
  EXPECT_TRUE(world.occluded({{0, 60, 0}, {0, -1, 0}, 30}));
  EXPECT_FALSE(world.occluded({{0, 100, 0}, {0, -1, 0}, 30}));
  // So small that its inverse is no float, or no place at all.
  const mat4 at = glm::translate(mat4(1), vec3(0, 80, 0));
  for (const float scale : {1e-13f, std::nanf("")}) {
    const std::vector<mat4> tiny = {mat4(1), poses[1], glm::scale(at, vec3(scale))};
    EXPECT_EQ(PosedWorld(source, tiny).bounds().max.y, 41);
    EXPECT_FALSE(PosedWorld(source, tiny).occluded({{0, 82, 0}, {0, -1, 0}, 4}));
  }
  // Small, but there: 1/det is still a float, twice that were none.
  const std::vector<mat4> least = {mat4(1), poses[1], glm::scale(at, vec3(1.6e-13f))};
  EXPECT_EQ(PosedWorld(source, least).bounds().max.y, 80);
  const std::vector<mat4> small = {mat4(1), poses[1],
                                   glm::scale(glm::translate(mat4(1), vec3(0, 80, 0)), vec3(0.01f))};
  EXPECT_NEAR(PosedWorld(source, small).bounds().max.y, 80.01f, 1e-5f);
}

TEST(PosedWorld, APartWithoutTrianglesHasNoPlace) {
  Balls source(2);
  source.empty_part = 2;
  const PosedWorld world(source, 0);
  EXPECT_EQ(world.bounds().max.y, 3);
  source.empty_part = 0;
  const PosedWorld no_floor(source, 0);
  expect_near(no_floor.bounds().min, {-1, 1, -1});
  expect_near(no_floor.bounds().max, {1, 5, 1});
}

/// A surface that stays and the same one on a part that nobody moved: what is built on the normal, a frame
/// around it, must not depend on which it is.
TEST(PosedWorld, NormalsOfAllPartsAreTheSameToTheSignOfAZero) {
  class TwoFloors : public Balls {
   public:
    TwoFloors() : Balls(1) {}
    void intersect(int part, std::span<const RayQuery> rays, std::span<RayHit> hits) const override {
      Balls::intersect(0, rays, hits);
      if (part == first) hits[0].distance /= 2;
    }
    int first = 0;
  };
  TwoFloors source;
  const RayQuery ray{{1, 2, 3}, {0, -1, 0}};
  RayHit hits[2];
  for (int first = 0; first < 2; ++first) {
    source.first = first;
    std::uint8_t moves = 2;
    PosedWorld(source, std::vector<mat4>{mat4(1), mat4(1)})
        .intersect({&ray, 1}, {&hits[first], 1}, {&moves, 1});
    EXPECT_EQ(moves, first);
  }
  for (int c = 0; c < 3; ++c)
    EXPECT_EQ(std::bit_cast<std::uint32_t>(hits[0].normal[c]),
              std::bit_cast<std::uint32_t>(hits[1].normal[c]))
        << c;
}

TEST(PosedWorld, NeedsAPoseForEachPart) {
  const Balls source(2);
  const std::vector<mat4> two(2, mat4(1)), three(3, mat4(1)), four(4, mat4(1));
  const std::string said = "posed world: there is not one pose for each part";
  EXPECT_EQ(message_of([&] { PosedWorld(source, std::span(two)); }), said);
  EXPECT_EQ(message_of([&] { PosedWorld(source, std::span(three)); }), "no error");
  EXPECT_EQ(message_of([&] { PosedWorld(source, std::span(four)); }), said);
}

TEST(TransportSource, WhatNobodyAnswersIsSaidOrNothing) {
  class Dark : public DirectLight {
    void irradiance(int, std::span<const SurfacePoint>, std::span<vec3>) const override {}
    bool may_shadow(int, const SurfacePoint&, const scene::Bounds&) const override { return false; }
    vec3 emitted(int, const RayQuery&, float) const override { return vec3(0); }
  };
  const Dark light;
  EXPECT_EQ(message_of([&] { light.flux(0); }), "direct light: it cannot emit photons");
  EXPECT_EQ(message_of([&] { light.emit(0, {}); }), "direct light: it cannot emit photons");
  EXPECT_EQ(Balls(0).environment_group(), -1);
}

}  // namespace
}  // namespace ssphh::rays
