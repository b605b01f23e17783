// Turning about a point within a room, and framing through no window.

#include <gtest/gtest.h>

#include <ssphh/scene/builtin.h>
#include <ssphh/trace/transport_scene.h>

#include "model/framing.h"
#include "model/pick.h"

namespace ssphh::viewer {
namespace {

class Orbit : public testing::Test {
 protected:
  scene::Scene scene_ = scene::make_builtin("two-rooms");
  trace::TransportScene source_{scene_};
  rays::PosedWorld world_{source_, 0};
  View view_ = look_at({-3.5f, 1.5f, 0.5f}, {-0.5f, 1.2f, 0}, 0.9f);
  vec3 point_ = pick_surface(source_, 0, pixel_ray(view_, {0.5f, 0.5f}, 1))->position;
};

TEST_F(Orbit, PassesNoWallAndKeepsThePointInItsPlace) {
  bool leaves = false;
  View through = view_;
  for (int i = 0; i < 120; ++i) {
    const View before = through;
    through = orbited_about(through, point_, 0.05f, 0);
    leaves |= !world_.visible(before.eye, through.eye);
  }
  ASSERT_TRUE(leaves) << "or there is nothing to keep it from";
  View view = view_;
  for (int i = 0; i < 120; ++i) {
    const View next = orbited_within(view, point_, 0.05f, 0, world_);
    ASSERT_TRUE(world_.visible(view.eye, next.eye)) << i;
    const vec3 to = glm::normalize(point_ - next.eye);
    ASSERT_NEAR(glm::dot(to, next.forward()), 1, 1e-4f) << i;
    ASSERT_NEAR(next.focus, glm::distance(next.eye, point_), 1e-3f) << i;
    view = next;
  }
  EXPECT_GT(glm::distance(view.eye, view_.eye), 0.5f) << "it does turn";
}

TEST_F(Orbit, IsAsAlwaysWhereNothingStandsInTheWay) {
  EXPECT_EQ(orbited_within(view_, point_, 0.02f, -0.01f, world_),
            orbited_about(view_, point_, 0.02f, -0.01f));
  View parallel = view_;
  parallel.orthographic = true;
  EXPECT_EQ(orbited_within(parallel, point_, 2, 0, world_), orbited_about(parallel, point_, 2, 0));
}

TEST(Window, KeepsTheEyeInsideThoughOneSeesThroughIt) {
  scene::Scene scene;
  scene::Material glass;
  glass.transmission = 1;
  scene.materials = {glass};
  scene::Mesh pane;
  pane.positions = {{-9, -9, 3.5f}, {9, -9, 3.5f}, {9, 9, 3.5f}, {-9, 9, 3.5f}};
  pane.triangles = {{0, 1, 2}, {0, 2, 3}};
  pane.material = 0;
  scene.meshes = {pane};
  scene.nodes.resize(1);
  scene.instances = {{0, 0, -1, ""}};
  const trace::TransportScene source(scene);
  const rays::PosedWorld world(source, 0);
  ASSERT_TRUE(world.visible({0, 0, 3}, {0, 0, 4}));
  const View view = look_at({0, 0, 3}, {0, 0, 0}, 0.9f);
  const scene::Bounds thing{vec3(-1), vec3(1)};
  ASSERT_GT(framed(view, thing, 1).eye.z, 3.5f) << "or the pane is in nobody's way";
  const View framed = framed_within(view, thing, 1, world);
  EXPECT_LT(framed.eye.z, 3.5f);
  EXPECT_GT(framed.eye.z, 3) << "but it goes back as far as there is room";
  EXPECT_LT(orbited_within(look_at({0, 3.1f, 0}, vec3(0), 0.9f), vec3(0), 0, -1.3f, world).eye.z, 3.5f);
  // From outside it is framed from outside
  EXPECT_GT(framed_within(look_at({0, 0, 7}, vec3(0), 0.9f), thing, 1, world).eye.z, 3.5f);
}

}  // namespace
}  // namespace ssphh::viewer
