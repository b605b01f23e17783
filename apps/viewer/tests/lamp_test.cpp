// Lamps as values: their numbers, names and shapes, and a scene with other ones.

#include "model/lamp.h"

#include <gmock/gmock.h>

#include <ssphh/scene/builtin.h>

#include "model/document.h"
#include "model/pick.h"

namespace ssphh::viewer {
namespace {

using enum scene::LightType;
using testing::HasSubstr;

template <class Call>
std::string error_of(const Call& call) {
  try {
    call();
  } catch (const Error& e) {
    return e.what();
  }
  return "";
}

std::vector<std::string> names_of_numbers(scene::LightType type) {
  std::vector<std::string> names;
  for (const LampNumber& number : lamp_numbers(new_lamp(type, "x", {}, 1, 0)))
    names.emplace_back(number.name);
  return names;
}

TEST(Lamp, HasTheNumbersOfItsKind) {
  using testing::ElementsAre;
  EXPECT_THAT(names_of_numbers(point), ElementsAre("intensity", "range"));
  EXPECT_THAT(names_of_numbers(spot), ElementsAre("intensity", "outer cone", "inner cone", "range"));
  EXPECT_THAT(names_of_numbers(directional), ElementsAre("intensity", "diameter"));
  EXPECT_THAT(names_of_numbers(sphere), ElementsAre("intensity", "radius"));
  EXPECT_THAT(names_of_numbers(sphl), ElementsAre("intensity", "radius"));
  EXPECT_THAT(names_of_numbers(rectangle), ElementsAre("intensity", "power", "width", "height"));
  EXPECT_THAT(names_of_numbers(disc), ElementsAre("intensity", "power", "radius"));
}

TEST(Lamp, NumbersBeyondTheirBoundsAreRefusedWithASentence) {
  LightEdit lamp = new_lamp(spot, "desk", {}, 1, 0);
  const LightEdit before = lamp;
  EXPECT_EQ(error_of([&] { set_lamp_number(lamp, "outer cone", 120); }),
            "desk: outer cone 120 ° is not within 0.5 to 90 °");
  EXPECT_THAT(error_of([&] { set_lamp_number(lamp, "inner cone", 41); }), HasSubstr("within 0 to 40 °"));
  EXPECT_THAT(error_of([&] { set_lamp_number(lamp, "intensity", std::nanf("")); }),
              HasSubstr("is not within"));
  EXPECT_THAT(error_of([&] { set_lamp_number(lamp, "radius", 1); }), HasSubstr("a spot lamp has no radius"));
  EXPECT_EQ(lamp, before);
  set_lamp_number(lamp, "outer cone", 20);
  EXPECT_FLOAT_EQ(lamp.lamp.outer_cone, glm::radians(20.0f));
  EXPECT_FLOAT_EQ(lamp.lamp.inner_cone, glm::radians(20.0f)) << "never the wider one";
  for (const scene::LightType type : {point, spot, directional, sphere, sphl, rectangle, disc}) {
    LightEdit any = new_lamp(type, "x", {1, 2, 3}, 2, 1);
    for (std::size_t i = 0; i < lamp_numbers(any).size(); ++i) {
      const LampNumber number = lamp_numbers(any)[i];
      EXPECT_LE(number.low, number.value) << number.name;
      EXPECT_GE(number.high, number.value) << number.name;
      set_lamp_number(any, number.name, number.high);
      set_lamp_number(any, number.name, number.low);
    }
  }
}

TEST(Lamp, ANewOneLightsAWallAtItsDistanceAlikeWhateverItsKind) {
  // 0.5 of the picture's white at EV −1: radiance 1, so irradiance π.
  EXPECT_FLOAT_EQ(new_lamp(point, "x", {}, 2, -1).intensity, pi * 4);
  EXPECT_FLOAT_EQ(new_lamp(directional, "x", {}, 2, -1).intensity, pi);
  const LightEdit ball = new_lamp(sphere, "x", {}, 2, -1);
  EXPECT_NEAR(ball.intensity * pi * ball.lamp.radius * ball.lamp.radius / 4, pi, 1e-4f);
  const LightEdit beam = new_lamp(sphl, "x", {}, 2, -1);
  EXPECT_NEAR(beam.intensity * scene::eval_intensity(beam.lamp.emission.frames[0], {0, 0, -1}).x / 4, pi,
              0.2f);
  EXPECT_EQ(light_direction(*beam.world), vec3(0, -1, 0));
  const LightEdit panel = new_lamp(rectangle, "x", {}, 2, -1), plate = new_lamp(disc, "x", {}, 2, -1);
  EXPECT_NEAR(panel.intensity * panel.lamp.size.x * panel.lamp.size.y / 4, pi, 1e-4f);
  EXPECT_NEAR(plate.intensity * pi * plate.lamp.radius * plate.lamp.radius / 4, pi, 1e-4f);
  EXPECT_EQ(light_direction(*panel.world), vec3(0, -1, 0));
}

TEST(Lamp, PowerOfAFlatOneIsPiTimesAreaTimesRadiance) {
  const auto number = [](const LightEdit& lamp, const std::string& name) {
    for (const LampNumber& n : lamp_numbers(lamp))
      if (n.name == name) return n.value;
    return -1.0f;
  };
  LightEdit panel = new_lamp(rectangle, "x", {}, 2, -1);
  set_lamp_number(panel, "width", 2);
  set_lamp_number(panel, "height", 0.5f);
  set_lamp_number(panel, "power", 30);
  EXPECT_FLOAT_EQ(panel.intensity, 30 / pi);
  set_lamp_number(panel, "width", 4);
  EXPECT_FLOAT_EQ(panel.intensity, 30 / pi) << "a larger one is as bright, and gives more light";
  EXPECT_FLOAT_EQ(number(panel, "power"), 60);
  LightEdit plate = new_lamp(disc, "x", {}, 2, -1);
  set_lamp_number(plate, "radius", 2);
  set_lamp_number(plate, "intensity", 3);
  EXPECT_FLOAT_EQ(number(plate, "power"), 12 * pi * pi);
}

TEST(Lamp, LinesShowConesRadiusAndRange) {
  LightEdit lamp = new_lamp(spot, "x", {1, 2, 3}, 1, 0);
  lamp.lamp.range = 5;
  const auto lines = lamp_lines(lamp.lamp, *lamp.world, 2);
  ASSERT_EQ(lines.size(), 1u + 2 + 4 + 3);
  for (const float cone : {0.0f, 1.0f}) {
    const float angle = cone == 0 ? lamp.lamp.outer_cone : lamp.lamp.inner_cone;
    for (const vec3& p : lines[cone == 0 ? 1 : 2])
      EXPECT_NEAR(glm::dot(glm::normalize(p - vec3(1, 2, 3)), vec3(0, -1, 0)), std::cos(angle), 1e-5f);
  }
  for (const vec3& p : lines.back()) EXPECT_NEAR(glm::distance(p, vec3(1, 2, 3)), 5, 1e-5f);
  EXPECT_TRUE(lamp_lines(new_lamp(point, "x", {}, 1, 0).lamp, mat4(1), 2).empty());
  EXPECT_EQ(lamp_lines(new_lamp(sphere, "x", {}, 1, 0).lamp, mat4(1), 2).size(), 3u);
  EXPECT_EQ(lamp_lines(new_lamp(directional, "x", {}, 1, 0).lamp, mat4(1), 2).size(), 1u);
  LightEdit panel = new_lamp(rectangle, "x", {1, 2, 3}, 1, 0);
  panel.lamp.size = {2, 1};
  const auto outline = lamp_lines(panel.lamp, with_position(mat4(3), {1, 2, 3}), 2);
  ASSERT_EQ(outline.size(), 2u) << "its direction, and its sides";
  EXPECT_EQ(outline[1],
            (std::vector<vec3>{{0, 1.5f, 3}, {2, 1.5f, 3}, {2, 2.5f, 3}, {0, 2.5f, 3}, {0, 1.5f, 3}}));
  const LightEdit plate = new_lamp(disc, "x", {1, 2, 3}, 1, 0);
  const auto rim = lamp_lines(plate.lamp, *plate.world, 2);
  ASSERT_EQ(rim.size(), 2u);
  for (const vec3& p : rim[1]) {
    EXPECT_NEAR(glm::distance(p, vec3(1, 2, 3)), plate.lamp.radius, 1e-6f);
    EXPECT_NEAR(p.y, 2, 1e-6f);
  }
}

TEST(Lamp, ABallIsMetOrPassedNearest) {
  const vec3 met = on_ball({{0, 0, 5}, {0, 0, -1}}, {0, 0, 0}, 2);
  EXPECT_EQ(met, vec3(0, 0, 2));
  const vec3 passed = on_ball({{3, 0, 5}, {0, 0, -1}}, {0, 0, 0}, 2);
  EXPECT_EQ(passed, vec3(2, 0, 0));
}

class LampEdits : public testing::Test {
 protected:
  std::vector<std::string> names() const {
    std::vector<std::string> out;
    for (const scene::Light& light : document_.scene->lights) out.push_back(light.name);
    return out;
  }
  void add(scene::LightType type, const std::string& name) {
    document_.edit_at_once("add", [&](Edits& e) {
      e.lights.push_back(new_lamp(type, name, {2, 1.5f, 0.5f}, 1, 0));
    });
  }
  Document document_ = make_document("builtin:two-rooms", scene::make_builtin("two-rooms"), 0);
};

TEST_F(LampEdits, TheSceneHasTheLampsThatThereAre) {
  using testing::ElementsAre;
  const auto opened = document_.scene;
  add(spot, "spot 1");
  EXPECT_THAT(names(), ElementsAre("lamp", "spot 1"));
  EXPECT_EQ(document_.lighting().lights.size(), 2u);
  EXPECT_EQ(light_position(document_.lighting().lights[1].world), vec3(2, 1.5f, 0.5f));
  document_.edit_at_once("delete", [](Edits& e) { e.lights.erase(e.lights.begin()); });
  EXPECT_THAT(names(), ElementsAre("spot 1"));
  document_.undo();
  EXPECT_THAT(names(), ElementsAre("lamp", "spot 1"));
  document_.undo();
  EXPECT_EQ(document_.scene, opened) << "the very scene that was opened";
  document_.redo();
  EXPECT_THAT(names(), ElementsAre("lamp", "spot 1"));
  const auto with_spot = document_.scene;
  document_.edit_at_once("dim", [](Edits& e) { e.lights[1].intensity = 3, e.lights[1].color = {1, 0, 0}; });
  EXPECT_EQ(document_.scene, with_spot) << "nothing that renderers are built for";
  document_.edit_at_once("cone", [](Edits& e) { set_lamp_number(e.lights[1], "outer cone", 20); });
  EXPECT_FLOAT_EQ(document_.scene->lights[1].outer_cone, glm::radians(20.0f));
}

TEST_F(LampEdits, GetNamesOfTheirOwn) {
  add(point, "point 1");
  EXPECT_EQ(new_lamp_name(document_.edits(), "point"), "point 2");
  EXPECT_EQ(new_lamp_name(document_.edits(), "point 1"), "point 2");
  EXPECT_EQ(new_lamp_name(document_.edits(), "lamp"), "lamp 1");
  EXPECT_EQ(new_lamp_name(document_.edits(), "v2"), "v2 1") << "no number of its own";
  Edits edits = document_.edits();
  EXPECT_THAT(error_of([&] { rename_lamp(edits, 1, "lamp"); }),
              HasSubstr("there is a lamp \"lamp\" already"));
  EXPECT_THAT(error_of([&] { rename_lamp(edits, 1, ""); }), HasSubstr("needs a name"));
  rename_lamp(edits, 1, "desk");
  EXPECT_EQ(edits.lights[1].lamp.name, "desk");
  EXPECT_EQ(edits.lights[1].lamp.group, "point 1") << "bakes know the group";
  rename_lamp(edits, 1, "desk");
}

TEST_F(LampEdits, AreSavedInGlb) {
  add(spot, "spot 1");
  document_.edit_at_once("delete", [](Edits& e) { e.lights.erase(e.lights.begin()); });
  const scene::Scene saved = document_.edited();
  ASSERT_EQ(saved.lights.size(), 1u);
  EXPECT_EQ(saved.lights[0].type, spot);
  const mat4 world = scene::world_matrix(saved, saved.lights[0].node);
  EXPECT_EQ(light_position(world), vec3(2, 1.5f, 0.5f));
  EXPECT_EQ(saved.nodes.size(), document_.opened->nodes.size() + 1) << "one node for the lamp";
}

}  // namespace
}  // namespace ssphh::viewer
