// Where views stand side by side, and what they show at first.

#include "model/view_layout.h"

#include <cmath>

#include <gtest/gtest.h>

#include <ssphh/core/error.h>
#include <ssphh/scene/builtin.h>
#include <ssphh/trace/transport_scene.h>

namespace ssphh::viewer {
namespace {

float shared(const Rect2& a, const Rect2& b) {
  const float wide = std::min(a.x + a.width, b.x + b.width) - std::max(a.x, b.x);
  const float high = std::min(a.y + a.height, b.y + b.height) - std::max(a.y, b.y);
  return std::max(wide, 0.0f) * std::max(high, 0.0f);
}

TEST(ViewLayout, PlacesFillTheAreaAndDoNotMeet) {
  for (const Rect2 area : {Rect2{10, 20, 801, 600}, Rect2{0, 5, 300, 777}}) {
    for (int count = 1; count <= most_views; ++count) {
      float sum = 0;
      for (int i = 0; i < count; ++i) {
        const Rect2 cell = viewer::cell(area, i, count);
        sum += cell.width * cell.height;
        EXPECT_FLOAT_EQ(shared(area, cell), cell.width * cell.height) << count << ": within the area";
        for (int j = 0; j < i; ++j)
          EXPECT_EQ(shared(cell, viewer::cell(area, j, count)), 0) << i << " and " << j << " of " << count;
      }
      // What is left are gaps, two pixels wide and as long as the area's edges.
      EXPECT_GE(sum, area.width * area.height - 2 * (area.width + area.height)) << count;
    }
  }
  EXPECT_THROW(cell({}, 2, 2), Error);
  EXPECT_THROW(cell({}, 0, 5), Error);
}

TEST(ViewLayout, TwoStandBesideEachOtherInAWideAreaAndElseAboveEachOther) {
  EXPECT_EQ(cell({0, 0, 402, 300}, 1, 2).x, 202);
  EXPECT_EQ(cell({0, 0, 300, 402}, 1, 2).y, 202);
  EXPECT_EQ(cell({0, 0, 402, 300}, 0, 3).height, 300) << "of three the first is the large one";
  EXPECT_EQ(cell({0, 0, 402, 302}, 2, 3).y, 152);
}

TEST(ViewLayout, SidesHaveNames) {
  const View view = look_at({4, 2, 5}, {0, 1, 0}, 1);
  EXPECT_EQ(view_name(view), "perspective");
  EXPECT_EQ(view_name(with_other_projection(view)), "orthographic");
  const std::pair<vec3, const char*> sides[] = {{{0, -1, 0}, "top"},   {{0, 0, -1}, "front"},
                                                {{-1, 0, 0}, "right"}, {{0, 1, 0}, "bottom"},
                                                {{0, 0, 1}, "back"},   {{1, 0, 0}, "left"}};
  for (const auto& [direction, name] : sides) {
    const View side = seen_along(view, direction);
    EXPECT_EQ(view_name(with_other_projection(side)), name);
    EXPECT_EQ(view_name(side), "perspective");
  }
}

class Section : public testing::Test {
 protected:
  scene::Scene scene_ = scene::make_builtin("two-rooms");
  trace::TransportScene source_{scene_};
  rays::PosedWorld world_{source_, 0};
  scene::Bounds bounds_ = scene::world_bounds(scene_, scene::world_matrices(scene_));
};

TEST_F(Section, ShowsAllOfTheSceneFromWithinTheRoom) {
  const View view = look_at({-1, 1.5f, 1.9f}, {-4, 1, 0}, 1);
  for (int place = 1; place <= 3; ++place) {
    const vec3 direction = first_direction(place);
    for (const float aspect : {0.5f, 2.0f}) {
      const View cut = section(view, direction, bounds_, aspect, world_);
      EXPECT_TRUE(cut.orthographic);
      EXPECT_GT(glm::dot(cut.forward(), direction), 0.999f);
      EXPECT_TRUE(world_.visible(view.eye, view.eye - glm::dot(view.eye - cut.eye, direction) * direction))
          << "nearer than what is between the eye and the outside";
      float most = 0;
      for (int corner = 0; corner < 8; ++corner) {
        const vec3 at(corner & 1 ? bounds_.max.x : bounds_.min.x, corner & 2 ? bounds_.max.y : bounds_.min.y,
                      corner & 4 ? bounds_.max.z : bounds_.min.z);
        const vec3 p = project(cut, at, aspect);
        most = std::max({most, std::abs(2 * p.x - 1), std::abs(2 * p.y - 1)});
      }
      EXPECT_LE(most, 1) << "all of it is in sight";
      EXPECT_GT(most, 0.9f) << "and fills the view";
    }
  }
}

TEST_F(Section, LeavesOutAWideGroundAroundTheHouse) {
  scene::Bounds wide = bounds_;
  wide.min.x = wide.min.z = -200, wide.max.x = wide.max.z = 200;
  const View view = look_at({-1, 1.5f, 1.9f}, {-4, 1, 0}, 1);
  const View cut = section(view, {0, -1, 0}, wide, 1, world_);
  EXPECT_LT(cut.yheight, 6 * (bounds_.max.x - bounds_.min.x));
  EXPECT_GT(cut.yheight, 0.5f * (bounds_.max.x - bounds_.min.x));
  EXPECT_GT(section(look_at({0, 30, 30}, {0, 0, 0}, 1), {0, -1, 0}, wide, 1, world_).yheight, 400)
      << "from outside there are no walls: all of it";
}

TEST_F(Section, OfWhatIsSeenFromOutsideCutsNothing) {
  const View view = look_at({0, 30, 30}, {0, 0, 0}, 1);
  const View cut = section(view, {0, -1, 0}, bounds_, 1, world_);
  EXPECT_GT(cut.eye.y, bounds_.max.y);
  EXPECT_EQ(section(view, {0, -1, 0}, {}, 1, world_).yheight, with_other_projection(view).yheight);
}

}  // namespace
}  // namespace ssphh::viewer
