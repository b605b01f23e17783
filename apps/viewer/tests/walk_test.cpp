// Walking: at eye height, up to walls and along them, over what is low, and never out of the world.

#include "model/walk.h"

#include <ssphh/trace/transport_scene.h>

#include "model/walk_scale.h"
#include "panel_stage.h"

namespace ssphh::viewer {
namespace {

/// Axis-aligned boxes, each by two of its corners.
scene::Scene boxes(const std::vector<std::pair<vec3, vec3>>& of) {
  scene::Scene scene;
  for (const auto& [low, high] : of) {
    scene::Mesh& mesh = scene.meshes.emplace_back();
    for (unsigned i = 0; i < 8; ++i)
      mesh.positions.push_back({i & 1 ? high.x : low.x, i & 2 ? high.y : low.y, i & 4 ? high.z : low.z});
    constexpr unsigned sides[6][4] = {{0, 2, 3, 1}, {4, 5, 7, 6}, {0, 1, 5, 4},
                                      {2, 6, 7, 3}, {0, 4, 6, 2}, {1, 3, 7, 5}};
    for (const auto& q : sides) {
      mesh.triangles.push_back({q[0], q[1], q[2]});
      mesh.triangles.push_back({q[0], q[2], q[3]});
    }
    scene.nodes.emplace_back().name = "box";
    const auto last = static_cast<int>(scene.nodes.size()) - 1;
    scene.instances.push_back({last, last, -1, {}});
  }
  return scene;
}

struct Ground {
  explicit Ground(const std::vector<std::pair<vec3, vec3>>& of) : scene(boxes(of)), source(scene) {}
  /// Seconds of walking at its speed, forward and to the right.
  View after(View view, float seconds, const vec2& way = {0, 1}) const {
    for (float t = 0; t < seconds; t += 0.05f)
      view = walked(view, walker.speed() * 0.05f * way, walker, world, 0.05f);
    return view;
  }
  View from(const vec3& place, const vec3& toward = {1, 0, 0}) const {
    return *stood(look_at(place + vec3(0, 1, 0), place + vec3(0, 1, 0) + toward, 1), walker, world);
  }
  scene::Scene scene;
  trace::TransportScene source;
  rays::PosedWorld world{source, 0};
  Walker walker;
};

const std::pair<vec3, vec3> floor_of_ten{{-5, -0.1f, -5}, {5, 0, 5}};

TEST(Walk, StandsAtEyeHeightAndGoesOnTheLevelWhereverItLooks) {
  const Ground ground({floor_of_ten});
  for (const float tilt : {-0.9f, 0.0f, 0.9f}) {
    const View view = ground.from({-4, 0, 0}, {1, tilt, 0});
    EXPECT_NEAR(view.eye.y, 1.65f, 1e-4f);
    const View there = ground.after(view, 2);
    EXPECT_NEAR(there.eye.x, -4 + 2 * ground.walker.speed(), 0.1f);
    EXPECT_NEAR(there.eye.y, 1.65f, 1e-4f);
    EXPECT_EQ(there.orientation, view.orientation);
  }
}

TEST(Walk, StopsBeforeWallsAndSlidesAlongThem) {
  const Ground ground({floor_of_ten, {{2, 0, -5}, {2.2f, 3, 5}}});
  const View straight = ground.after(ground.from({0, 0, 0}), 5);
  EXPECT_NEAR(straight.eye.x, 2 - ground.walker.radius(), 0.02f);
  EXPECT_NEAR(straight.eye.z, 0, 0.01f);
  const View slanted = ground.after(ground.from({0, 0, 0}, {1, 0, 1}), 4);
  EXPECT_NEAR(slanted.eye.x, 2 - ground.walker.radius(), 0.02f);
  EXPECT_GT(slanted.eye.z, 2.5f) << "along the wall";
  const View aside = ground.after(ground.from({1.9f, 0, 0}, {0, 0, 1}), 1);
  EXPECT_NEAR(aside.eye.x, 2 - ground.walker.radius(), 0.03f) << "no nearer than its body allows";
}

TEST(Walk, ComesToRestInACorner) {
  const Ground ground({floor_of_ten, {{2, 0, -5}, {2.2f, 3, 5}}, {{-5, 0, 2}, {5, 3, 2.2f}}});
  const View corner = ground.after(ground.from({0, 0, 0}, {1, 0, 0.8f}), 8);
  EXPECT_NEAR(corner.eye.x, 2 - ground.walker.radius(), 0.03f);
  EXPECT_NEAR(corner.eye.z, 2 - ground.walker.radius(), 0.03f);
  EXPECT_EQ(ground.after(corner, 1).eye, corner.eye) << "it does not tremble";
}

TEST(Walk, StepsOnWhatIsLowAndDownAgainAndNotOnATable) {
  const Ground low({floor_of_ten, {{1, 0, -1}, {2.5f, 0.35f, 1}}});
  const View start = low.from({0, 0, 0});
  EXPECT_NEAR(low.after(start, 1.3f).eye.y, 2.0f, 0.01f);
  EXPECT_NEAR(low.after(start, 3).eye.y, 1.65f, 0.01f);
  EXPECT_GT(low.after(start, 3).eye.x, 3);
  // A thin top, between the heights at which rays look for walls
  const Ground table({floor_of_ten, {{1, 0.72f, -1}, {2.5f, 0.75f, 1}}});
  const View before = table.after(table.from({0, 0, 0}), 3);
  EXPECT_LT(before.eye.x, 1);
  EXPECT_GT(before.eye.x, 0.5f);
}

TEST(Walk, FallsDownLedgesAndNotOutOfTheWorld) {
  const Ground ground({floor_of_ten, {{-5, 2.9f, -5}, {-2, 3, 5}}});
  const View ledge = ground.from({-3, 3, 0});
  EXPECT_NEAR(ledge.eye.y, 4.65f, 1e-4f);
  EXPECT_NEAR(ground.after(ledge, 3).eye.y, 1.65f, 0.01f);
  const View rim = ground.after(ledge, 30);
  EXPECT_LE(rim.eye.x, 5);
  EXPECT_GT(rim.eye.x, 4.5f);
  EXPECT_NEAR(rim.eye.y, 1.65f, 0.01f);
  EXPECT_FALSE(stood(look_at({8, 1, 0}, {9, 1, 0}, 1), ground.walker, ground.world));
}

TEST(Walk, GoesOnBentUnderALowCeilingAndStandsUpBeyondIt) {
  const Ground ground({floor_of_ten, {{-5, 1.1f, -5}, {0, 1.2f, 5}}, {{-3, 0, -2}, {3, 3, -1}}});
  const View low = *stood(look_at({-3, 0.5f, 0}, {1, 0.5f, 0}, 1), ground.walker, ground.world);
  EXPECT_LT(low.eye.y, 1.1f);
  const View on = ground.after(low, 1);
  EXPECT_NEAR(on.eye.x, -3 + ground.walker.speed(), 0.1f);
  EXPECT_NEAR(on.eye.y, low.eye.y, 0.02f);
  const View wall = ground.after(turned(low, 0.5f * pi, 0), 5);
  EXPECT_LT(wall.eye.z, low.eye.z) << "it goes there";
  EXPECT_GT(wall.eye.z, -1) << "and stops before the wall";
  const View beyond = ground.after(low, 4);
  EXPECT_GT(beyond.eye.x, 1);
  EXPECT_NEAR(beyond.eye.y, 1.65f, 0.01f);
  EXPECT_GT(ground.after(turned(beyond, pi, 0), 4).eye.x, -0.1f) << "no longer under what is low";
}

TEST(Walk, BeginsOnTheGroundAheadWhereNoneIsBelow) {
  const Ground ground({floor_of_ten, {{2, 0, -5}, {2.2f, 3, 5}}});
  const auto at = [&](const vec3& eye, const vec3& toward) {
    return above_ground(look_at(eye, toward, 1), ground.world);
  };
  const View here = look_at({1, 1, 0}, {2, 1, 0}, 1);
  EXPECT_EQ(*above_ground(here, ground.world), here);
  const auto ahead = at({-9, 2, 0}, {2, 1.5f, 0});
  ASSERT_TRUE(ahead);
  EXPECT_GE(ahead->eye.x, -5);
  EXPECT_LT(ahead->eye.x, -4.5f) << "the first: 32 places on eleven metres";
  EXPECT_FALSE(at({-9, 2, 0}, {-10, 2, 0})) << "it looks away";
}

TEST(Walk, StandsStillWithoutAWay) {
  // Grounds high above 0, as in scenes of other units: rays meet them within rounding.
  for (int i = 0; i < 40; ++i) {
    const float high = 100 + 0.137f * static_cast<float>(i);
    const Ground ground({{{-5, -0.1f, -5}, {5, high, 5}}, {{0.1f, high, -1}, {1, high + 0.3f, 1}}});
    View view = ground.after(ground.from({-0.1f * static_cast<float>(i % 5), high, 0}), 2, {0, 0});
    for (int turn = 0; turn < 20; ++turn) {
      const View next = walked(view, {0, 0}, ground.walker, ground.world, 0.05f);
      ASSERT_EQ(next, view) << high << ", turn " << turn;
      view = next;
    }
  }
}

TEST(Walk, PassesANarrowGap) {
  const Ground ground({floor_of_ten, {{2, 0, -5}, {2.2f, 3, -0.3f}}, {{2, 0, 0.3f}, {2.2f, 3, 5}}});
  EXPECT_GT(ground.after(ground.from({0, 0, 0.05f}), 4).eye.x, 3);
}

TEST(Walk, IsAsTallAsTheSceneAllows) {
  const auto of_height = [](float h) { return walker_for({vec3(0), vec3(5, h, 5)}).eye; };
  EXPECT_FLOAT_EQ(of_height(4), 1.65f);
  EXPECT_FLOAT_EQ(of_height(0.01f), 0.006f);
  EXPECT_FLOAT_EQ(walker_for({}).eye, 1.65f);
}

TEST(Walk, IsTallerInARoomOfMillimetres) {
  const Ground room({{{-5e3f, -100, -5e3f}, {5e3f, 0, 5e3f}}, {{-5e3f, 2700, -5e3f}, {5e3f, 2800, 5e3f}}});
  const View inside = look_at({0, 900, 0}, {1, 900, 0}, 1);
  EXPECT_FLOAT_EQ(walker_in(inside, {}, room.world).eye, 0.6f * 2700);
  const Ground hall({floor_of_ten, {{-5, 30, -5}, {5, 31, 5}}});
  EXPECT_FLOAT_EQ(walker_in(look_at({0, 1, 0}, {1, 1, 0}, 1), {}, hall.world).eye, 1.65f);
  const Ground open({floor_of_ten});
  EXPECT_FLOAT_EQ(walker_in(look_at({0, 900, 0}, {1, 900, 0}, 1), {}, open.world).eye, 1.65f)
      << "under the sky nothing tells";
}

class WalkInput : public PanelStage {
 protected:
  WalkInput() { app().view = look_at({-3.5f, 1, 0.5f}, {0, 1, 0.5f}, 1); }
  void hold(std::vector<int> keys, int turns) {
    InjectedInput input;
    input.keys = std::move(keys);
    for (int i = 0; i < turns; ++i) frame(input, 0.05f);
    frame();
  }
};

TEST_F(WalkInput, KeysWalkAndNoWallIsPassed) {
  press({'V'});
  ASSERT_TRUE(app().walking);
  EXPECT_NEAR(app().view.eye.y, 1.65f, 1e-3f);
  const vec3 start = app().view.eye;
  vec3 before = start;
  for (int i = 0; i < 12; ++i) {
    hold({i % 3 == 2 ? 'D' : 'W'}, 20);
    EXPECT_TRUE(posed().visible(before, app().view.eye)) << i;
    before = app().view.eye;
    app().view = turned(app().view, 0.7f, 0);
  }
  EXPECT_NEAR(app().view.eye.y, 1.65f, 1e-3f);
  EXPECT_GT(glm::distance(app().view.eye, start), 0.5f);
  const View view = app().view;
  drag(400, 700, 500, 700);
  EXPECT_EQ(app().view.eye, view.eye) << "drags look around";
  EXPECT_NE(app().view.orientation, view.orientation);
  window_->wheel = 3;
  mouse(600, 700);
  EXPECT_EQ(app().view.eye, view.eye);
  press({GLFW_KEY_ESCAPE});
  EXPECT_FALSE(app().walking);
}

TEST_F(WalkInput, ThePanelHasAButtonAndTheEyesHeight) {
  open("Camera");
  click_text("Walk (V)");
  EXPECT_TRUE(app().walking);
  click_text("Stop walking (V)");
  EXPECT_FALSE(app().walking);
  const float eye = app().walker.eye;
  pull("eye height [m]", -30);
  EXPECT_LT(app().walker.eye, eye);
}

TEST_F(WalkInput, WithoutGroundItIsTold) {
  app().view = look_at({100, 1, 0}, {0, 1, 0}, 1);
  press({'V'});
  EXPECT_FALSE(app().walking);
  EXPECT_EQ(app().message, "there is no ground to walk on, below or ahead; go above some first");
  app().view = look_at({-3.5f, 1, 0.5f}, {0, 1, 0.5f}, 1);
  press({'V'});
  app().view_along({0, 0, -1});
  if (!app().view.orthographic) app().toggle_orthographic();
  frame({}, 0.05f);
  EXPECT_FALSE(app().walking) << "an orthographic view walks nowhere";
}

}  // namespace
}  // namespace ssphh::viewer
