/// Parts of a scene: who belongs to which, and rays against them.

#include <glm/gtc/matrix_transform.hpp>
#include <gtest/gtest.h>

#include <ssphh/core/random.h>
#include <ssphh/core/sphere.h>
#include <ssphh/rays/posed_world.h>
#include <ssphh/scene/builtin.h>
#include <ssphh/scene/query.h>
#include <ssphh/trace/transport_scene.h>

#include "hand_made.h"
#include "posed_scene.h"
#include "robot.h"

namespace ssphh::test {
namespace {

using rays::RayHit;
using rays::RayQuery;

std::vector<mat4> poses_at(const trace::TransportScene& source, float time) {
  std::vector<mat4> poses;
  for (int p = 0; p < source.part_count(); ++p) poses.push_back(source.part_pose(p, time));
  return poses;
}

RayQuery in_frame(const RayQuery& ray, const mat4& pose) {
  const mat4 from_world = glm::inverse(pose);
  return {vec3(from_world * vec4(ray.origin, 1)), mat3(from_world) * ray.direction, ray.t_max};
}

/// Random rays from inside the bounds, of lengths around 1; every third a segment.
std::vector<RayQuery> random_rays(const scene::Bounds& bounds, int count, std::uint64_t seed) {
  Pcg32 random(seed);
  std::vector<RayQuery> rays;
  for (int i = 0; i < count; ++i) {
    RayQuery ray;
    ray.origin = bounds.min + random.uniform3() * (bounds.max - bounds.min);
    ray.direction = (0.1f + 3 * random.uniform()) * sample_uniform_sphere(random.uniform2());
    if (i % 3 == 0) ray.t_max = random.uniform();
    rays.push_back(ray);
  }
  return rays;
}

TEST(TransportScene, TwoRoomsHaveOneDoor) {
  const scene::Scene scene = scene::make_builtin("two-rooms");
  const trace::TransportScene source(scene);
  ASSERT_EQ(source.part_count(), 2);
  EXPECT_EQ(source.part_name(1), "door");
  EXPECT_EQ(source.part_pose(0, 0.5f), mat4(1));
  EXPECT_EQ(source.duration(), 1);
  for (const float time : {0.0f, 0.5f, 1.0f}) {
    // The hinge stands still; the leaf turns by 100 degrees.
    const mat4 pose = source.part_pose(1, time);
    const vec3 leaf = glm::normalize(vec3(pose[2])), closed(0, 0, 1);
    EXPECT_NEAR(glm::dot(leaf, closed), std::cos(time * 100 * pi / 180), 1e-6);
    EXPECT_EQ(pose[3], source.part_pose(1, 0)[3]);
  }
  const scene::Bounds leaf = source.part_bounds(1);
  EXPECT_NEAR(leaf.max.x - leaf.min.x, 0.04f, 1e-6f);
  EXPECT_FALSE(source.part_bounds(0).empty());
  EXPECT_EQ(source.light_names(), std::vector<std::string>{"lamp"});
  EXPECT_EQ(source.light_groups()[source.light_group_of(0)], "lamp");
  EXPECT_FALSE(source.group_emits_from(0, 0));
  EXPECT_FALSE(source.group_emits_from(0, 1));
}

TEST(TransportScene, NearestAnimatedAncestorOwnsAnInstance) {
  const scene::Scene scene = robot();
  const trace::TransportScene source(scene);
  ASSERT_EQ(source.part_count(), 3) << "the swing carries no surface";
  EXPECT_EQ(source.part_name(1), "base");
  EXPECT_EQ(source.part_name(2), "arm");
  const int hand = scene::light_group_index(source.light_groups(), "wrist");
  EXPECT_FALSE(source.group_emits_from(hand, 0));
  EXPECT_FALSE(source.group_emits_from(hand, 1));
  EXPECT_TRUE(source.group_emits_from(hand, 2));
  // The lamp on the swing moves with it.
  EXPECT_NEAR(source.lights(0)[0].world[3].x, 0, 1e-6);
  EXPECT_NEAR(source.lights(1)[0].world[3].x, 0.5, 1e-6);
  EXPECT_NEAR(source.lights(1)[0].world[3].y, 0.8, 1e-6);
}

/// Nearest hits and occlusion of all parts together are those of the posed scene traced whole.
void parts_make_the_whole(scene::Scene scene) {
  scene::mark_movable(scene);
  const trace::TransportScene source(scene);
  for (const float time : {0.0f, 0.3f, 1.0f}) {
    const std::vector<mat4> poses = poses_at(source, time);
    const scene::Scene still = frozen(scene, time);
    const PosedScene whole(still);
    const scene::Bounds bounds = scene::world_bounds(scene, scene::world_matrices(scene, time));
    const std::vector<RayQuery> rays = random_rays(bounds, 10000, 7);
    std::vector<RayHit> nearest(rays.size()), hits(rays.size());
    std::vector<std::uint8_t> any(rays.size()), blocked(rays.size());
    for (int p = 0; p < source.part_count(); ++p) {
      std::vector<RayQuery> local;
      const auto at = static_cast<std::size_t>(p);
      for (const RayQuery& ray : rays) local.push_back(in_frame(ray, poses[at]));
      source.intersect(p, local, hits);
      source.occluded(p, local, blocked);
      for (std::size_t i = 0; i < rays.size(); ++i) {
        ASSERT_EQ(blocked[i] != 0, !hits[i].escaped());
        any[i] |= blocked[i];
        if (hits[i].distance < nearest[i].distance) nearest[i] = hits[i];
        if (hits[i].escaped()) continue;
        EXPECT_LE(glm::dot(hits[i].normal, local[i].direction), 0);
        EXPECT_NEAR(glm::length(hits[i].normal), 1, 1e-5);
      }
    }
    const rays::PosedWorld world(source, time);
    std::vector<RayHit> in_world(rays.size());
    std::vector<std::uint8_t> moves(rays.size()), blocked_in_world(rays.size());
    world.intersect(rays, in_world, moves);
    world.occluded(rays, blocked_in_world);
    EXPECT_EQ(blocked_in_world, any);
    int found = 0, differ = 0;
    trace::RayTask task;
    for (std::size_t i = 0; i < rays.size(); ++i) {
      trace::Hit hit;
      const trace::Ray ray{rays[i].origin, rays[i].direction, rays[i].t_max};
      const bool is_hit = whole.intersect(ray, 0, task, hit);
      EXPECT_EQ(in_world[i].distance, nearest[i].distance);
      EXPECT_EQ(world.occluded(rays[i]), any[i] != 0);
      found += is_hit;
      // Rays that graze an edge, or meet two surfaces at one place, may go either way: rounding.
      if (is_hit != !nearest[i].escaped() || (any[i] != 0) != whole.occluded(ray, 0, task)) {
        ++differ;
      } else if (is_hit && std::abs(hit.distance - nearest[i].distance) > 1e-4f * (1 + hit.distance)) {
        ++differ;
      } else if (is_hit) {
        vec3 origin;
        const shading::Surface surface = whole.surface(hit, -glm::normalize(ray.direction), origin);
        EXPECT_NEAR(glm::distance(in_world[i].normal, surface.geometric_normal), 0, 1e-4f);
        const int node = scene.instances[hit.instance].node;
        const bool is_movable = scene.nodes[node].movable;
        differ += std::abs(luminance(surface.emission) - luminance(nearest[i].emission)) > 1e-6f ||
                  std::abs(luminance(surface.bsdf.diffuse) - luminance(nearest[i].albedo)) > 1e-5f ||
                  whole.is_back(hit, ray.direction) != nearest[i].back || (moves[i] != 0) != is_movable;
      }
    }
    EXPECT_GT(found, 3000);
    EXPECT_LE(differ, 3);
  }
}

TEST(TransportScene, PartsMakeTwoRooms) {
  parts_make_the_whole(scene::make_builtin("two-rooms"));
}

TEST(TransportScene, PartsMakeTheRobot) {
  parts_make_the_whole(robot());
}

TEST(TransportScene, PointsOnAPartAreUniformByArea) {
  scene::Scene scene = robot();
  const trace::TransportScene source(scene);
  // Part 2 holds the hand: a cube of 0.1 m in the frame of the arm.
  const auto points = source.sample_part(2, 1e6);
  EXPECT_NEAR(static_cast<double>(points.size()), 6 * 0.01 * 1e6, 12);
  // Chi-square over 10×10 cells of the side at +x; stratified points vary less than random ones, so only
  // the upper bound speaks.
  const mat4 hand =
      glm::translate(mat4(1), vec3(0, 0.2f, 0.1f)) * glm::mat4_cast(glm::normalize(quat(1, 0.2f, 0, 0.4f)));
  const mat4 back = glm::inverse(hand);
  std::array<int, 100> cells{};
  int on_side = 0;
  for (const rays::PartPoint& p : points) {
    const vec3 x(back * vec4(p.point.position, 1)), n = mat3(back) * p.point.normal;
    EXPECT_NEAR(max_component(glm::abs(x)), 0.05, 1e-6);
    EXPECT_GT(glm::dot(x, n), 0.0499) << "front is outside";
    EXPECT_NEAR(p.albedo.x, 0.7, 1e-6);
    if (n.x < 0.9f) continue;
    ++on_side;
    const auto cell = [](float c) {
      return static_cast<std::size_t>(glm::clamp((c + 0.05f) * 100, 0.0f, 9.0f));
    };
    ++cells[10 * cell(x.y) + cell(x.z)];
  }
  EXPECT_NEAR(on_side, 10000, 2);
  double chi2 = 0;
  for (const int c : cells) chi2 += (c - on_side / 100.0) * (c - on_side / 100.0) / (on_side / 100.0);
  EXPECT_LT(chi2, 148) << "99 degrees of freedom, p = 1e-3";
  EXPECT_EQ(source.sample_part(2, 0).size(), 12u) << "one per triangle at least";
  const auto again = source.sample_part(2, 0);
  EXPECT_EQ(again[5].point.position, source.sample_part(2, 0)[5].point.position);
}

TEST(TransportScene, PointsOnAMirroredPartFaceOutward) {
  scene::Scene scene;
  scene.nodes.resize(2);
  scene.nodes[1].parent = 0;
  scene.nodes[1].local.scale = {-2, 1, 0.5f};
  scene.animations.push_back(
      {"a",
       {{0, scene::AnimationPath::translation, scene::Interpolation::linear, {0, 1}, {vec4(0), vec4(1)}}}});
  scene.materials.emplace_back();
  scene.meshes.push_back(scene::make_box(vec3(-0.1f), vec3(0.1f)));
  scene.meshes[0].material = 0;
  scene.instances.emplace_back().mesh = 0;
  scene.instances[0].node = 1;
  scene::validate(scene);
  const trace::TransportScene source(scene);
  const auto points = source.sample_part(1, 100);
  ASSERT_GE(points.size(), 12u);
  for (const rays::PartPoint& p : points) {
    EXPECT_NEAR(glm::length(p.point.normal), 1, 1e-6f);
    EXPECT_GT(glm::dot(p.point.position, p.point.normal), 0.049f);
  }
}

TEST(TransportScene, UnlitAndMaskedSurfaces) {
  scene::Scene scene;
  scene::Material sign = lambertian(vec3(0.2f, 0.4f, 0.6f));
  sign.unlit = true;
  add_object(scene, scene::make_quad(vec3(-1, 1, 1), vec3(2, 0, 0), vec3(0, 0, -2)), sign, "sign");
  scene::Material veil = lambertian(vec3(0.5f));
  veil.alpha_mode = scene::AlphaMode::blend, veil.alpha = 0.4f;
  add_object(scene, scene::make_quad(vec3(-1, 2, 1), vec3(2, 0, 0), vec3(0, 0, -2)), veil, "veil");
  const trace::TransportScene source(scene);
  const RayQuery down{vec3(0.1f, 3, 0.2f), vec3(0, -1, 0)};
  RayHit hit;
  source.intersect(0, {&down, 1}, {&hit, 1});
  EXPECT_NEAR(hit.distance, 2, 1e-6) << "through the veil";
  EXPECT_EQ(hit.albedo, vec3(0));
  EXPECT_EQ(hit.emission, vec3(0.2f, 0.4f, 0.6f));
  EXPECT_EQ(hit.group, 0);
  scene.materials[1].alpha = 0.6f;
  const trace::TransportScene denser(scene);
  denser.intersect(0, {&down, 1}, {&hit, 1});
  EXPECT_NEAR(hit.distance, 1, 1e-6);
  EXPECT_EQ(hit.group, -1);
}

TEST(TransportScene, RaysAreCounted) {
  const scene::Scene scene = robot();
  const trace::TransportScene source(scene);
  const std::vector<RayQuery> rays = random_rays(source.part_bounds(0), 2000, 1);
  std::vector<RayHit> hits(rays.size());
  source.intersect(0, rays, hits);
  EXPECT_EQ(source.rays_traced(), 2000u);
}

}  // namespace
}  // namespace ssphh::test
