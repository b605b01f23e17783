// Lamps as an artist makes and changes them: by the panel, keys, and handles in the picture.

#include <gmock/gmock.h>

#include "panel_stage.h"

namespace ssphh::viewer {
namespace {

using testing::HasSubstr;

class LampInput : public PanelStage {
 protected:
  const std::vector<LightEdit>& lights() { return app().document.edits().lights; }
  LightEdit chosen() { return lights().at(static_cast<std::size_t>(app().selection.index)); }
  vec3 direction() {
    return light_direction(
        app().document.lighting().lights.at(static_cast<std::size_t>(app().selection.index)).world);
  }
  vec2 on_screen(const vec3& point) {
    const Rect2& r = app().viewport;
    const vec3 p = project(app().view, point, r.aspect());
    return {r.x + p.x * r.width, r.y + (1 - p.y) * r.height};
  }
  void add(const char* kind) {
    open("Light");
    click_text("Add?");
    click_text(kind);
  }
};

TEST_F(LampInput, EveryKindIsAddedInThePictureAndSelected) {
  const std::pair<const char*, scene::LightType> kinds[] = {
      {"Point", scene::LightType::point},           {"Spot, with a cone", scene::LightType::spot},
      {"Sun", scene::LightType::directional},       {"Sphere", scene::LightType::sphere},
      {"Rectangle", scene::LightType::rectangle},   {"Disc", scene::LightType::disc},
      {"SPHL, a soft beam", scene::LightType::sphl}};
  const std::size_t before = lights().size();
  for (const auto& [name, type] : kinds) {
    add(name);
    ASSERT_TRUE(app().selection.is(Kind::light)) << name;
    EXPECT_EQ(chosen().lamp.type, type) << name;
    EXPECT_EQ(app().document.scene->lights.back().type, type) << name;
    if (!has_place(type)) continue;
    const vec3 at = *app().selected_position();
    const vec3 seen = project(app().view, at, app().viewport.aspect());
    EXPECT_NEAR(seen.x, 0.5f, 0.1f) << name;
    EXPECT_NEAR(seen.y, 0.5f, 0.1f) << name;
    EXPECT_TRUE(posed().visible(app().view.eye, at)) << "before the wall, not behind it";
  }
  EXPECT_EQ(lights().size(), before + std::size(kinds));
  press({GLFW_KEY_Z}, true);
  EXPECT_EQ(lights().size(), before + std::size(kinds) - 1);
  press({GLFW_KEY_Y}, true);
  EXPECT_EQ(lights().size(), before + std::size(kinds));
}

TEST_F(LampInput, ARectangleIsSizedDimmedTurnedAndAimedByHand) {
  add("Rectangle");
  const LightEdit before = chosen();
  pull("width", 20);
  EXPECT_GT(chosen().lamp.size.x, before.lamp.size.x);
  EXPECT_EQ(chosen().lamp.size.y, before.lamp.size.y);
  EXPECT_EQ(chosen().intensity, before.intensity) << "as bright, and more light";
  EXPECT_EQ(app().document.scene->lights.back().size, chosen().lamp.size) << "renderers have it";
  pull("power", -10);
  EXPECT_LT(chosen().intensity, before.intensity);
  press({GLFW_KEY_Z}, true);
  EXPECT_EQ(chosen().intensity, before.intensity);
  press({GLFW_KEY_Z}, true);
  EXPECT_EQ(chosen(), before) << "each a step of undo";

  app().turn_selected({0.4f, -1, 0.05f});
  EXPECT_LT(glm::distance(direction(), glm::normalize(vec3(0.4f, -1, 0.05f))), 1e-5f);
  const vec3 side((*chosen().world)[0]);
  app().turn_selected({0.4f, -1, -0.05f});
  EXPECT_LT(glm::distance(vec3((*chosen().world)[0]), side), 0.1f) << "it does not spin";
  const mat4 aimed = *chosen().world;
  pull("turn", 30);
  EXPECT_LT(glm::distance(vec3((*chosen().world)[2]), vec3(aimed[2])), 1e-5f);
  EXPECT_GT(glm::distance(vec3((*chosen().world)[0]), vec3(aimed[0])), 0.05f);
}

TEST_F(LampInput, KeysDuplicateDeleteAndUndoKeepsTheSelection) {
  const std::size_t before = lights().size();
  app().selection = {Kind::light, 1};
  press({GLFW_KEY_D}, true);
  ASSERT_EQ(lights().size(), before + 1);
  EXPECT_EQ(chosen().lamp.name, "spot 1");
  EXPECT_EQ(chosen().lamp.type, scene::LightType::spot);
  EXPECT_EQ(chosen().intensity, lights()[1].intensity);
  EXPECT_GT(
      glm::distance(*app().selected_position(), light_position(app().document.lighting().lights[1].world)),
      0.1f)
      << "beside it, so that both are seen";
  app().selection = {Kind::light, 2};
  const std::string third = lights()[2].lamp.name;
  press({GLFW_KEY_Z}, true);
  EXPECT_EQ(chosen().lamp.name, third);
  app().selection = {Kind::light, 0};
  press({GLFW_KEY_DELETE});
  EXPECT_EQ(lights().size(), before - 1);
  EXPECT_EQ(app().selection, Selection{});
  app().selection = {Kind::light, 1};
  press({GLFW_KEY_Z}, true);
  EXPECT_EQ(chosen().lamp.name, third) << "the same lamp, at another index";
}

TEST_F(LampInput, NumbersAreDraggedAndTypedOnesBeyondBoundsRefused) {
  app().selection = {Kind::light, 1};
  open("Light");
  pull("outer cone", -20);
  EXPECT_NEAR(glm::degrees(chosen().lamp.outer_cone), 45 - 20 * 0.9f, 0.1f);
  EXPECT_EQ(app().document.history.undo_name(), "outer cone of spot");
  const float cone = chosen().lamp.outer_cone;
  // Ctrl and a click types
  const DrawnThing at = widget("outer cone");
  InjectedInput ctrl;
  ctrl.mouse = {0.5f * (at.from.x + at.to.x), 0.5f * (at.from.y + at.to.y)}, ctrl.ctrl = true;
  ctrl.keys = {GLFW_KEY_LEFT_CONTROL};
  frame(ctrl);
  ctrl.buttons = {true, false, false};
  frame(ctrl);
  ctrl.buttons = {};
  frame(ctrl), frame();
  window_->typed = "120";
  frame(), frame();
  press({GLFW_KEY_ENTER});
  EXPECT_TRUE(app().message_is_error);
  EXPECT_THAT(app().message, HasSubstr("120"));
  EXPECT_THAT(app().message, HasSubstr("is not within 0.5 to 90"));
  EXPECT_EQ(chosen().lamp.outer_cone, cone);
}

TEST_F(LampInput, IsAimedAtTheClickedPoint) {
  app().selection = {Kind::light, 1};
  const vec3 from = *app().selected_position();
  const vec2 pixel = on_screen({1, 0.5f, 0});
  const auto surface = pick_surface(*app().picking(), 0,
                                    pixel_ray(app().view,
                                              vec2((pixel.x - app().viewport.x) / app().viewport.width,
                                                   1 - (pixel.y - app().viewport.y) / app().viewport.height),
                                              app().viewport.aspect()));
  ASSERT_TRUE(surface);
  press({'X'});
  EXPECT_TRUE(app().aim_mode);
  const View before = app().view;
  click(pixel.x, pixel.y);
  EXPECT_FALSE(app().aim_mode);
  EXPECT_EQ(app().view, before);
  EXPECT_EQ(app().selection, (Selection{Kind::light, 1})) << "what was clicked is not selected";
  EXPECT_LT(glm::distance(direction(), glm::normalize(surface->position - from)), 0.01f);
  EXPECT_EQ(app().document.history.undo_name(), "aim spot");
  press({GLFW_KEY_Z}, true);
  EXPECT_EQ(direction(), vec3(0, 0, -1));
  app().selection = {Kind::light, 0};
  press({'X'});
  EXPECT_FALSE(app().aim_mode) << "a point lamp shines everywhere";
}

TEST_F(LampInput, TheHandleOfItsDirectionIsDraggedOverSurfaces) {
  app().selection = {Kind::light, 1};
  app().view = look_at({0.5f, 1.5f, 6}, {0, 1, 0}, 1);
  app().turn_selected({0.6f, -1, -0.2f});
  rest();
  const vec3 from = *app().selected_position();
  const vec2 handle = on_screen(from + aim_length(app()) * direction());
  ASSERT_TRUE(aim_under_mouse(app(), handle.x, handle.y));
  const vec2 to = handle + vec2(60, 10);
  drag(handle.x, handle.y, to.x, to.y);
  const auto surface = pick_surface(*app().picking(), 0,
                                    pixel_ray(app().view,
                                              vec2((to.x - app().viewport.x) / app().viewport.width,
                                                   1 - (to.y - app().viewport.y) / app().viewport.height),
                                              app().viewport.aspect()));
  ASSERT_TRUE(surface);
  EXPECT_LT(glm::distance(direction(), glm::normalize(surface->position - from)), 0.01f);
  EXPECT_EQ(app().selection, (Selection{Kind::light, 1}));
}

TEST_F(LampInput, ASunIsTurnedByItsHandleAndPutIntoTheSky) {
  const int sun = 2;
  app().selection = {Kind::light, sun};
  ASSERT_EQ(chosen().lamp.type, scene::LightType::directional);
  app().turn_selected({0.5f, -1, 0});
  rest();
  const vec3 origin = *app().aim_origin();
  EXPECT_EQ(origin, app().view.center());
  const vec2 handle = on_screen(origin + aim_length(app()) * direction());
  const float before = direction().x;
  drag(handle.x, handle.y, handle.x + 40, handle.y);
  EXPECT_GT(direction().x, before + 0.05f);
  EXPECT_NEAR(glm::length(direction()), 1, 1e-5f);
  app().view = look_at({0, 2, 30}, {0, 12, 0}, 1);
  rest();
  press({'X'});
  const Rect2& r = app().viewport;
  const rays::RayQuery ray = pixel_ray(app().view, {0.5f, 0.9f}, r.aspect());
  ASSERT_FALSE(pick_surface(*app().picking(), 0, ray));
  click(r.x + 0.5f * r.width, r.y + 0.1f * r.height);
  EXPECT_LT(glm::distance(direction(), -ray.direction), 0.01f);
}

TEST_F(LampInput, IsRenamedAndANameThatIsTakenRefused) {
  app().selection = {Kind::light, 1};
  open("Light");
  const auto type = [&](const char* name) {
    const DrawnThing at = widget("name");
    click(at.from.x + 8, 0.5f * (at.from.y + at.to.y));
    window_->typed = name;
    frame(), frame();
    press({GLFW_KEY_ENTER});
    rest();
  };
  type("desk");
  EXPECT_EQ(chosen().lamp.name, "desk");
  type("lamp");
  EXPECT_EQ(chosen().lamp.name, "desk");
  EXPECT_THAT(app().message, HasSubstr("already"));
  press({GLFW_KEY_ESCAPE});
}

TEST_F(LampInput, FixedProbesAreToldApart) {
  take_probes();
  add("Point");
  EXPECT_THAT(app().message, HasSubstr("The probes of file.sphl were lit without it"));
}

}  // namespace
}  // namespace ssphh::viewer
