// Several views side by side: which there are, what a press in one does, and what is drawn when.

#include <algorithm>
#include <array>
#include <numeric>

#include <GLFW/glfw3.h>
#include <gmock/gmock.h>

#include <ssphh/image/io.h>
#include <ssphh/image/transfer.h>

#include "gl_stage.h"
#include "model/view_layout.h"
#include "panel_stage.h"

namespace ssphh::viewer {
namespace {

vec2 middle(const Pane& pane) {
  const Rect2& r = pane.viewport;
  return {r.x + 0.5f * r.width, r.y + 0.5f * r.height};
}

class SideBySide : public PanelStage {
 protected:
  SideBySide() {
    start(1200, 800);
    app().take_document(document("two-rooms"));
    app().view = look_at({-1, 1.5f, 1.9f}, {-4, 1, 0}, 1);
    frames(2);
  }
  void show(int count) {
    app().settings.views = count;
    frames(2);
  }
  /// Where a point stands in a view of the window.
  vec2 on_window(const Pane& pane, const vec3& point) {
    const vec3 p = project(pane.view, point, pane.viewport.aspect());
    return {pane.viewport.x + p.x * pane.viewport.width, pane.viewport.y + (1 - p.y) * pane.viewport.height};
  }
  vec3 lamp() { return light_position(app().document.lighting().lights[0].world); }
};

TEST_F(SideBySide, TheKeyGoesOnFromOneToTwoAndFour) {
  EXPECT_TRUE(app().others.empty());
  EXPECT_EQ(app().viewport.width, app().area.width);
  const View before = app().view;
  for (const std::size_t beside : {1u, 3u, 0u}) {
    press({GLFW_KEY_M});
    ASSERT_EQ(app().others.size(), beside);
    EXPECT_EQ(app().view, before);
    for (const Pane& other : app().others) {
      EXPECT_TRUE(other.beside);
      EXPECT_EQ(view_name(other.view), (std::array{"", "top", "front", "right"}[other.place]));
    }
  }
  EXPECT_EQ(app().viewport.width, app().area.width);
}

TEST_F(SideBySide, FewerKeepTheOneAtWorkAndThoseOfTheFirstPlaces) {
  show(4);
  for (int place = 0; place < 4; ++place) {
    show(4);
    const auto at_place = [&](const Pane& pane) { return pane.place == place; };
    const auto other = std::ranges::find_if(app().others, at_place);
    const Pane& pane = other == app().others.end() ? static_cast<const Pane&>(app()) : *other;
    const vec2 there = middle(pane);
    app().take_view_at(there.x, there.y);
    const View view = app().view;
    for (const int count : {3, 2}) {
      show(count);
      EXPECT_EQ(app().view, view) << place;
      std::vector<int> places{app().place};
      for (const Pane& p : app().others) places.push_back(p.place);
      std::vector<int> wanted(count);
      std::iota(wanted.begin(), wanted.end(), 0);
      EXPECT_THAT(places, testing::UnorderedElementsAreArray(wanted));
    }
  }
}

TEST_F(SideBySide, SignsAreWholeWordsInNarrowViewsOfDenseScreens) {
  start(800, 600, 2);
  app().take_document(document("two-rooms"));
  app().view = look_at({-1, 1.5f, 1.9f}, {-4, 1, 0}, 1);
  show(4);
  press({GLFW_KEY_V});
  ASSERT_TRUE(app().walking);
  for (int i = 0; i < 3; ++i) {
    std::vector<unsigned char> none;
    window_->begin_frame({});
    draw_panels(app());
    for (Pane& other : app().others) {
      const PaneTurn turn(app(), other);
      draw_overlay(app(), none);
    }
    draw_overlay(app(), none);
    window_->end_frame();
  }
  for (const DrawnThing& thing : all_things()) {
    if (thing.text == "walking" || thing.text == "top") {
      EXPECT_FALSE(thing.cut) << thing.text;
    }
    EXPECT_NE(thing.text, "perspective, walking") << "there is no room for it";
  }
  EXPECT_TRUE(shows("walking"));
}

TEST_F(SideBySide, AreNamedAndTheOneAtWorkIsFramed) {
  show(4);
  std::vector<unsigned char> none;
  app().window.begin_frame({});
  draw_panels(app());
  for (Pane& other : app().others) {
    const PaneTurn turn(app(), other);
    draw_overlay(app(), none);
  }
  draw_overlay(app(), none);
  app().window.end_frame();
  for (const char* name : {"perspective", "top", "front", "right"}) EXPECT_TRUE(shows(name)) << name;
  EXPECT_FALSE(app().beside);
}

TEST_F(SideBySide, AClickSelectsInEachAndMakesItTheOneAtWork) {
  show(4);
  for (int place = 0; place < 4; ++place) {
    app().selection = {};
    const auto at_place = [&](const Pane& pane) { return pane.place == place; };
    const auto other = std::ranges::find_if(app().others, at_place);
    const Pane& pane = other == app().others.end() ? static_cast<const Pane&>(app()) : *other;
    if (place == 0) app().view = look_at(lamp() + vec3(1, -0.2f, 0), lamp(), 1);
    const View view = pane.view;
    const vec2 at = on_window(pane, lamp());
    click(at.x, at.y);
    EXPECT_EQ(app().selection, (Selection{Kind::light, 0})) << place;
    EXPECT_EQ(app().place, place);
    EXPECT_EQ(app().view, view) << "a click moves nothing";
    EXPECT_FALSE(app().beside);
    EXPECT_EQ(std::ranges::count_if(app().others, &Pane::beside), 3);
  }
}

TEST_F(SideBySide, DragsWheelAndKeysMoveTheirViewAlone) {
  show(2);
  const View first = app().view, second = app().others[0].view;
  const vec2 there = middle(app().others[0]);
  drag(there.x, there.y, there.x + 30, there.y, 2);
  EXPECT_EQ(app().place, 1);
  EXPECT_NE(app().view, second);
  EXPECT_EQ(app().others[0].view, first);
  const vec2 here = middle(app().others[0]);
  mouse(here.x, here.y);
  window_->wheel = 2;
  mouse(here.x, here.y), frame();
  EXPECT_EQ(app().place, 0) << "the wheel, too, is of the view under the mouse";
  EXPECT_EQ(app().view, wheeled(first, 2));
  press({GLFW_KEY_KP_3});
  EXPECT_GT(glm::dot(app().view.forward(), vec3(-1, 0, 0)), 0.999f);
  app().view_back();
  EXPECT_EQ(app().view, wheeled(first, 2)) << "each has its own views of before";
}

TEST_F(SideBySide, ADragGoesOnAcrossTheBorderInItsOwnView) {
  show(2);
  const View other = app().others[0].view;
  const vec2 from = middle(app()), to = middle(app().others[0]);
  drag(from.x, from.y, to.x, to.y, 1);
  EXPECT_EQ(app().place, 0);
  EXPECT_EQ(app().others[0].view, other);
}

TEST_F(SideBySide, WalkingIsOfOneViewAndStandsInIt) {
  show(2);
  press({GLFW_KEY_V});
  ASSERT_TRUE(app().walking);
  window_->clock += 60;
  frames(2);
  EXPECT_TRUE(shows("walking")) << "long after its message is gone";
  const vec2 there = middle(app().others[0]);
  click(there.x, there.y);
  EXPECT_FALSE(app().walking);
  EXPECT_TRUE(app().others[0].walking);
  show(1);
  EXPECT_FALSE(shows("walking"));
  press({GLFW_KEY_KP_3}), press({GLFW_KEY_KP_5}), app().go_to_camera(""), press({GLFW_KEY_V});
  window_->clock += 60;
  frames(2);
  EXPECT_TRUE(shows("walking, V ends"));
}

TEST_F(SideBySide, AnotherSceneIsShownInAsManyWithTheFirstAtWork) {
  show(4);
  const vec2 there = middle(app().others[2]);
  click(there.x, there.y);
  app().take_document(document("cornell"));
  frames(2);
  EXPECT_EQ(app().place, 0);
  EXPECT_EQ(app().others.size(), 3u);
  EXPECT_EQ(view_name(app().view), "perspective");
}

class DrawnViews : public GlStage {
 protected:
  void prepare() override {
    options_.records = 256;
    options_.transport = {.directions = 64, .surfel_size = 0.5f, .link_rays = 8};
    options_.settings = {{"exposure", "0"}, {"views", "4"}};
  }
  void ready() override {
    app().open("builtin:two-rooms");
    app().view = look_at({-1, 1.5f, 1.9f}, {-4, 1, 0}, 1);
    settle();
  }
  void settle() {
    turn();
    EXPECT_TRUE(turn_until([&] { return app().settled(); }, [&] { turn(); }));
  }
  std::vector<int> counts() {
    std::vector<int> all(4);
    all[app().place] = app().screen.pictures;
    for (const Pane& other : app().others) all[other.place] = other.screen.pictures;
    return all;
  }
};

TEST_F(DrawnViews, HoldWhatTheyHoldAlone) {
  for (int i = 0; i < 3; ++i) {
    const image::Rgba8 beside = app().others[i].picture.pixels();
    const vec2 there = middle(app().others[i]);
    app().take_view_at(there.x, there.y);
    settle();
    EXPECT_EQ(app().picture.pixels().rgba, beside.rgba) << view_name(app().view);
    EXPECT_GT(*std::ranges::max_element(beside.rgba, {}, [](int v) { return v == 255 ? 0 : v; }), 20);
  }
}

TEST_F(DrawnViews, AreDrawnAnewWhereSomethingOfTheirsChanges) {
  std::vector<int> before = counts();
  app().view = turned(app().view, 0.1f, 0);
  settle();
  std::vector<int> now = counts();
  EXPECT_GT(now[0], before[0]);
  EXPECT_EQ((std::vector(now.begin() + 1, now.end())), (std::vector(before.begin() + 1, before.end())));
  app().edit("dim", [](Edits& e) { e.lights[0].intensity *= 0.5f; });
  settle();
  before = std::exchange(now, counts());
  for (int i = 0; i < 4; ++i) EXPECT_GT(now[i], before[i]) << i;
}

TEST_F(DrawnViews, OutlineTheSelectionInEach) {
  const auto outline = [](const Pane& pane) {
    std::vector<float> pixels;
    if (!pane.outline_gl) return pixels;
    const gl::Texture& texture = pane.outline_gl->picture();
    pixels.resize(4 * static_cast<std::size_t>(texture.width()) * static_cast<std::size_t>(texture.height()));
    texture.read(pixels, 4);
    return pixels;
  };
  for (const Pane& other : app().others) EXPECT_FALSE(other.screen.outline);
  // The door: seen in some views, hidden in others
  const auto& nodes = app().document.scene->nodes;
  const auto door = std::ranges::find_if(nodes, [](const scene::Node& n) { return n.movable; });
  ASSERT_NE(door, nodes.end());
  int node = static_cast<int>(door - nodes.begin());
  for (const scene::Instance& instance : app().document.scene->instances)
    if (nodes[instance.node].movable) node = instance.node;
  app().select({Kind::object, node});
  for (int i = 0; i < 8; ++i) turn();
  settle();
  EXPECT_TRUE(app().screen.outline);
  for (int i = 0; i < 3; ++i) {
    ASSERT_TRUE(app().others[i].screen.outline) << view_name(app().others[i].view);
    const std::vector<float> beside = outline(app().others[i]);
    const vec2 there = middle(app().others[i]);
    app().take_view_at(there.x, there.y);
    app().screen.outline.reset();
    settle();
    turn();
    EXPECT_TRUE(outline(app()) == beside) << view_name(app().view) << ": as if it stood alone";
  }
}

TEST_F(DrawnViews, TheOneAtWorkIsDrawnFirstWhileSomebodyMovesIt) {
  const std::vector<int> before = counts();
  app().edit("dim", [](Edits& e) { e.lights[0].intensity *= 0.5f; });
  for (int i = 0; i < 20; ++i) {
    app().view = turned(app().view, 0.01f, 0);
    turn();
  }
  const std::vector<int> now = counts();
  EXPECT_GE(now[0], before[0] + 19);
  EXPECT_EQ((std::vector(now.begin() + 1, now.end())), (std::vector(before.begin() + 1, before.end())))
      << "the others wait until it is whole";
  settle();
  for (int i = 0; i < 4; ++i) EXPECT_GT(counts()[i], before[i]) << i;
}

TEST_F(DrawnViews, AScreenshotHasThemWhereTheyStand) {
  app().screenshot("all.png", false);
  const image::Image all = image::read_image("all.png");
  EXPECT_EQ(all.width, 64);
  EXPECT_EQ(all.height, 48);
  for (const Pane& other : app().others) {
    const image::Rgba8 part = other.picture.pixels();
    const int x = static_cast<int>(other.viewport.x) + 3, y = static_cast<int>(other.viewport.y) + 4;
    const std::size_t i = 4 * (static_cast<std::size_t>(4) * part.width + 3);
    EXPECT_NEAR(all.rgb(x, y).x, image::srgb8_to_linear(part.rgba[i]), 1e-6f);
  }
}

}  // namespace
}  // namespace ssphh::viewer
