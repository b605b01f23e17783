// What a click finds, and where the eye goes to see it.

#include "model/objects.h"

#include <random>

#include <gtest/gtest.h>

#include <ssphh/scene/builtin.h>
#include <ssphh/trace/transport_scene.h>

#include "model/framing.h"
#include "model/pick.h"

namespace ssphh::viewer {
namespace {

class Rooms : public testing::Test {
 protected:
  rays::RayQuery random_ray() {
    std::uniform_real_distribution<float> u(0.1f, 0.9f), d(-1, 1);
    const scene::Bounds box = scene::world_bounds(scene_, world_);
    vec3 direction(d(random_), d(random_), d(random_));
    if (glm::length(direction) < 0.1f) direction = vec3(0, 0, 1);
    return {box.min + vec3(u(random_), u(random_), u(random_)) * (box.max - box.min),
            glm::normalize(direction)};
  }
  int node(const std::string& name) const {
    for (std::size_t i = 0; i < scene_.nodes.size(); ++i) {
      if (scene_.nodes[i].name == name) return static_cast<int>(i);
    }
    ADD_FAILURE() << "no node " << name;
    return 0;
  }

  std::mt19937 random_{3};
  scene::Scene scene_ = scene::make_builtin("two-rooms");
  std::vector<mat4> world_ = scene::world_matrices(scene_, 0.5f);
  trace::TransportScene source_{scene_};
  rays::PosedWorld posed_{source_, 0.5f};
};

TEST_F(Rooms, AClickFindsWhatEmbreeHits) {
  int hits = 0;
  for (int i = 0; i < 400; ++i) {
    const rays::RayQuery ray = random_ray();
    const auto body = pick_body(scene_, world_, ray);
    const auto surface = pick_surface(source_, 0.5f, ray);
    ASSERT_EQ(body.has_value(), surface.has_value());
    if (!body) continue;
    ++hits;
    EXPECT_NEAR(body->distance, glm::distance(surface->position, ray.origin), 1e-4f * (1 + body->distance));
    // The point is on that instance and on no other that is nearer.
    const int at = scene_.instances[body->instance].node;
    const scene::Bounds box = node_bounds(scene_, world_, at);
    const vec3 p = surface->position;
    EXPECT_TRUE(glm::all(glm::greaterThan(p, box.min - 1e-3f)) &&
                glm::all(glm::lessThan(p, box.max + 1e-3f)));
  }
  EXPECT_GT(hits, 300);
}

TEST_F(Rooms, BothSidesCountAndARaysEnd) {
  scene::Scene scene;
  scene.nodes.resize(2);
  scene.nodes[1].local.translation = {0, 0, -1};
  scene.nodes[1].local.scale = vec3(2);
  scene::Mesh mesh;
  mesh.positions = {{-1, -1, 0}, {1, -1, 0}, {0, 1, 0}};
  mesh.triangles = {{0, 1, 2}};
  scene.meshes = {mesh};
  scene.instances = {{0, 0, -1, ""}, {0, 1, -1, ""}};
  const auto world = scene::world_matrices(scene, 0);
  const auto instance = [&](const rays::RayQuery& ray) {
    const auto body = pick_body(scene, world, ray);
    return body ? body->instance : -1;
  };
  EXPECT_EQ(instance({{0, 0, 1}, {0, 0, -1}}), 0);
  EXPECT_EQ(instance({{0, 0, -3}, {0, 0, 1}}), 1) << "its back";
  EXPECT_EQ(instance({{1.2f, -1.2f, 1}, {0, 0, -1}}), 1) << "beside the nearer one";
  EXPECT_EQ(instance({{0, 0, 1}, {0, 0, -1}, 0.5f}), -1);
  EXPECT_EQ(instance({{0, 0, 1}, {0, 0, 1}}), -1);
  EXPECT_FLOAT_EQ(pick_body(scene, world, {{0, 0, 1}, {0, 0, -2}})->distance, 0.5f);
  EXPECT_EQ(node_bounds(scene, world, 1).min, vec3(-2, -2, -1));
  EXPECT_EQ(material_bounds(scene, world, -1).max, vec3(2, 2, 0));
  EXPECT_TRUE(material_bounds(scene, world, 0).empty());
}

TEST_F(Rooms, APartIsWhatHangsTogether) {
  scene::Scene scene;
  scene.nodes.resize(1);
  scene.nodes[0].local.translation = {0, 0, 5};
  // Two squares of two triangles, one with all its vertices twice; they share no place.
  scene::Mesh mesh;
  mesh.positions = {{0, 0, 0}, {1, 0, 0}, {1, 1, 0}, {0, 1, 0}, {3, 0, 0},
                    {4, 0, 0}, {4, 1, 0}, {3, 0, 0}, {4, 1, 0}, {3, 1, 0}};
  mesh.triangles = {{0, 1, 2}, {4, 5, 6}, {0, 2, 3}, {7, 8, 9}};
  scene.meshes = {mesh};
  scene.instances = {{0, 0, -1, ""}};
  const auto world = scene::world_matrices(scene, 0);
  for (std::size_t triangle = 0; triangle < 4; ++triangle) {
    const bool first = triangle % 2 == 0;
    const scene::Bounds bounds = part_bounds(scene, world, {0, triangle, 1});
    EXPECT_EQ(bounds.min, vec3(first ? 0 : 3, 0, 5)) << triangle;
    EXPECT_EQ(bounds.max, vec3(first ? 1 : 4, 1, 5)) << triangle;
  }
  EXPECT_EQ(pick_body(scene, world, {{3.2f, 0.9f, 9}, {0, 0, -1}})->triangle, 3u);
}

TEST_F(Rooms, TheTreeHasAllBodiesAndWhatHoldsThem) {
  scene::Scene scene;
  scene.nodes.resize(5);
  scene.nodes[0].name = "house";
  scene.nodes[1].parent = 0, scene.nodes[2].parent = 1, scene.nodes[3].parent = 0;
  scene.meshes.resize(1);
  scene.meshes[0].name = "chair";
  scene.instances = {{0, 2, -1, ""}};
  const BodyTree tree = body_tree(scene);
  EXPECT_EQ(tree.roots, std::vector<int>{0});
  EXPECT_EQ(tree.children[0], std::vector<int>{1});
  EXPECT_EQ(tree.children[1], std::vector<int>{2});
  EXPECT_TRUE(tree.body[2] && !tree.body[0] && !tree.body[3]);
  EXPECT_EQ(node_name(scene, 0), "house");
  EXPECT_EQ(node_name(scene, 2), "chair");
  EXPECT_EQ(node_name(scene, 3), "node 3");
}

TEST_F(Rooms, FramingGoesThroughNoWall) {
  const scene::Bounds all = scene::world_bounds(scene_, world_);
  std::uniform_real_distribution<float> u(0.15f, 0.85f), angle(-3, 3);
  int framed_well = 0;
  for (int i = 0; i < 200; ++i) {
    View view;
    view.eye = all.min + vec3(u(random_), u(random_), u(random_)) * (all.max - all.min);
    view = turned(view, angle(random_), 0.2f * angle(random_));
    // Everything: from where the eye is
    const View whole = framed_within(view, all, 1.5f, posed_);
    EXPECT_TRUE(posed_.visible(view.eye, whole.eye)) << "trial " << i;
    // A thing of half a metre that the eye sees
    const rays::RayQuery ray{view.eye, view.forward()};
    const auto surface = pick_surface(source_, 0.5f, ray);
    if (!surface || glm::distance(surface->position, view.eye) < 1) continue;
    const vec3 thing = surface->position + 0.3f * surface->normal;
    if (!posed_.visible(view.eye, thing)) continue;
    scene::Bounds box;
    box.add(thing - 0.25f), box.add(thing + 0.25f);
    const View near = framed_within(view, box, 1.5f, posed_);
    EXPECT_TRUE(posed_.visible(view.eye, near.eye)) << "trial " << i;
    const vec3 seen = project(near, thing, 1.5f);
    EXPECT_NEAR(seen.x, 0.5f, 1e-3f);
    EXPECT_NEAR(seen.y, 0.5f, 1e-3f);
    EXPECT_GT(seen.z, 0);
    framed_well += std::abs(near.focus / framed(view, box, 1.5f).focus - 1) < 0.02f;
  }
  EXPECT_GT(framed_well, 60) << "where there is room the thing fills the picture";
}

TEST_F(Rooms, AThingInTheNextRoomIsSeenFromThere) {
  const View view = look_at({-3.5f, 1.5f, 1}, {-2, 1.2f, 0}, 0.8f);
  scene::Bounds box;
  const vec3 thing(3, 1, -1);
  ASSERT_FALSE(posed_.visible(view.eye, thing));
  box.add(thing - 0.25f), box.add(thing + 0.25f);
  const View there = framed_within(view, box, 1.5f, posed_);
  EXPECT_TRUE(posed_.visible(there.eye, thing - 0.3f * there.forward()));
  EXPECT_NEAR(project(there, thing, 1.5f).x, 0.5f, 1e-3f);
  EXPECT_EQ(framed_within(view, {}, 1.5f, posed_), view);
}

TEST_F(Rooms, InTheOpenItIsFramedAsEver) {
  scene::Scene scene = scene::make_builtin("cornell");
  const auto world = scene::world_matrices(scene, 0);
  const trace::TransportScene source(scene);
  const scene::Bounds box = scene::world_bounds(scene, world);
  // Behind its open side
  const View view = look_at(box.center() + vec3(0, 0, 6 * box.radius()), box.center(), 0.7f);
  const View near = framed_within(view, box, 1.5f, rays::PosedWorld(source, 0));
  EXPECT_NEAR(near.focus, framed(view, box, 1.5f).focus, 1e-3f);
  EXPECT_EQ(near.orientation, view.orientation);
}

TEST_F(Rooms, ATurnAboutAPointLeavesItInItsPlace) {
  for (const bool orthographic : {false, true}) {
    View view = look_at({1, 2, 5}, {0, 1, 0}, 0.9f);
    view.orthographic = orthographic;
    const vec3 point(0.7f, 0.4f, 1);
    const vec3 before = project(view, point, 1.5f);
    const View turned_view = orbited_about(view, point, 0.4f, -0.2f);
    const vec3 after = project(turned_view, point, 1.5f);
    for (int k = 0; k < 3; ++k) EXPECT_NEAR(after[k], before[k], 1e-4f);
    EXPECT_NEAR(glm::distance(turned_view.eye, point), glm::distance(view.eye, point), 1e-4f);
    EXPECT_NEAR(turned_view.focus, before.z, 1e-4f);
    EXPECT_NE(turned_view.orientation, view.orientation);
    EXPECT_EQ(orbited_about(view, view.eye - view.forward(), 0.4f, 0), view);
  }
}

}  // namespace
}  // namespace ssphh::viewer
