// Photometric profiles as an artist gives them to lamps: by the model, dropped on the window, in the panel.

#include "model/lamp_profile.h"

#include <gmock/gmock.h>

#include <ssphh/core/file.h>

#include "model/lamp_aim.h"
#include "panel_stage.h"
#include "temp_dir.h"

namespace ssphh::viewer {
namespace {

using testing::HasSubstr;

const std::string ies =
    "IESNA:LM-63-2002\nTILT=NONE\n1 -1 1 3 2 1 2 0 0 0 1 1 0\n0 45 90\n0 90\n"
    "250 100 0 250 200 50\n";

scene::LampProfile made() {
  return {"made.ies",
          std::make_shared<const scene::PhotometricTable>(scene::PhotometricTable{
              scene::Photometry::c, {0, 90}, {0, 90, 180, 270, 360}, {8, 0, 8, 4, 8, 0, 8, 4, 8, 0}})};
}

TEST(LampProfile, OfAPointLampAimsItDownAndIsTakenAgain) {
  LightEdit lamp = new_lamp(scene::LightType::point, "x", {1, 2, 3}, 1, 0);
  const float before = lamp.intensity;
  EXPECT_FALSE(has_direction(lamp.lamp.type, lamp.lamp.profile));
  set_profile(lamp, made(), *lamp.world);
  EXPECT_TRUE(has_direction(lamp.lamp.type, lamp.lamp.profile));
  EXPECT_EQ(light_direction(*lamp.world), vec3(0, -1, 0));
  EXPECT_EQ(light_position(*lamp.world), vec3(1, 2, 3));
  EXPECT_EQ(lamp.intensity, before) << "as bright as it was";
  EXPECT_EQ(lamp_of(light_of(lamp.lamp, vec3(1), 1)), lamp.lamp);
  // Another one leaves the way it was aimed.
  lamp.world = with_direction(*lamp.world, {1, 0, 0});
  set_profile(lamp, made(), *lamp.world);
  EXPECT_NEAR(light_direction(*lamp.world).x, 1, 1e-6f);
  set_profile(lamp, {}, *lamp.world);
  EXPECT_TRUE(lamp.lamp.profile.empty());
  LightEdit sphere = new_lamp(scene::LightType::sphere, "ball", {}, 1, 0);
  EXPECT_THROW(set_profile(sphere, made(), *sphere.world), Error);
}

TEST(LampProfile, CurvesAreSharesAlongDirections) {
  // 1 − θ/90° in the plane of x; 1 − θ/180° in that of y
  for (const float turn : {0.0f, pi / 2}) {
    for (const vec3& p : profile_curve(made(), turn)) {
      if (glm::length(p) < 1e-3f) continue;
      const float angle = std::acos(glm::clamp(-p.z / glm::length(p), -1.0f, 1.0f));
      EXPECT_NEAR(glm::length(p), 1 - angle / (turn == 0 ? pi / 2 : pi), 1e-3f);
      EXPECT_NEAR(turn == 0 ? p.y : p.x, 0, 1e-6f);
    }
  }
  LightEdit lamp = new_lamp(scene::LightType::point, "x", {1, 2, 3}, 1, 0);
  set_profile(lamp, made(), *lamp.world);
  const auto lines = lamp_lines(lamp.lamp, *lamp.world, 2);
  ASSERT_EQ(lines.size(), 3u) << "its aim and two curves";
  float farthest = 0;
  for (const vec3& p : lines[1]) farthest = std::max(farthest, glm::distance(p, vec3(1, 2, 3)));
  EXPECT_NEAR(farthest, 2, 1e-4f);
}

TEST(LampProfile, KeepsItsTurnWhereItIsAimedElsewhere) {
  LightEdit lamp = new_lamp(scene::LightType::point, "x", {1, 2, 3}, 1, 0);
  set_profile(lamp, made(), *lamp.world);
  for (const float turn : {-3.0f, -0.5f, 0.0f, 2.0f}) {
    const mat4 turned = with_turn(*lamp.world, turn);
    EXPECT_NEAR(turn_of(turned), turn, 1e-5f);
    EXPECT_EQ(light_direction(turned), light_direction(*lamp.world));
    EXPECT_EQ(light_position(turned), vec3(1, 2, 3));
    const mat4 elsewhere = aimed(lamp.lamp, turned, {1, -2, 0.5f});
    EXPECT_NEAR(turn_of(elsewhere), turn, 1e-5f);
    EXPECT_NEAR(glm::dot(light_direction(elsewhere), glm::normalize(vec3(1, -2, 0.5f))), 1, 1e-6f);
  }
  // A quarter, seen from behind: what shone along x shines along y.
  const mat4 straight = with_turn(mat4(1), 0), quarter = with_turn(mat4(1), pi / 2);
  EXPECT_NEAR(glm::dot(vec3(quarter[0]), vec3(straight[1])), 1, 1e-6f);
}

class LampProfileInput : public PanelStage {
 protected:
  LampProfileInput() { write_file(dir_ / "washer.ies", ies); }
  void drop(const std::string& file) {
    app().take_dropped({(dir_ / file).string()});
    frames(2);
  }
  const LightEdit& lamp(std::size_t i) { return app().document.edits().lights.at(i); }
  test::TempDir dir_;
};

TEST_F(LampProfileInput, OneThatIsDroppedShapesTheSelectedLamp) {
  drop("washer.ies");
  EXPECT_TRUE(app().message_is_error);
  EXPECT_THAT(app().message, HasSubstr("select a point or spot lamp first"));
  app().selection = {Kind::light, 1};
  const float before = lamp(1).intensity;
  drop("washer.ies");
  EXPECT_FALSE(app().message_is_error) << app().message;
  EXPECT_EQ(lamp(1).lamp.profile.name, "washer.ies");
  EXPECT_TRUE(app().document.scene->lights[1].has_profile());
  EXPECT_EQ(lamp(1).intensity, before);
  EXPECT_EQ(app().document.history.undo_name(), "profile of spot");
  write_file(dir_ / "broken.ies", "TILT=NONE\n1 2");
  drop("broken.ies");
  EXPECT_TRUE(app().message_is_error);
  EXPECT_THAT(app().message, HasSubstr("broken.ies:2: the file ends where the multiplier should be"));
  EXPECT_EQ(lamp(1).lamp.profile.name, "washer.ies") << "what was there stays";
  press({GLFW_KEY_Z}, true);
  EXPECT_TRUE(lamp(1).lamp.profile.empty());
  app().selection = {Kind::light, 3};
  drop("washer.ies");
  EXPECT_THAT(app().message, HasSubstr("a sphere lamp has no photometric profile"));
}

TEST_F(LampProfileInput, ThePanelShowsItTakesItsIntensityAndTakesItAway) {
  app().selection = {Kind::light, 1};
  open("Light");
  EXPECT_TRUE(shows("choose .ies"));
  drop("washer.ies");
  rest();
  EXPECT_TRUE(shows("washer.ies"));
  EXPECT_TRUE(app().can_aim());
  click_text("as measured: 250 cd");
  EXPECT_EQ(lamp(1).intensity, 250);
  click_text("without");
  EXPECT_TRUE(lamp(1).lamp.profile.empty());
  rest();
  click_text("choose .ies?");
  ASSERT_TRUE(app().dialog);
  app().ask_for_file(FileDialog::For::profile, std::filesystem::path(dir_.path()));
  app().dialog->browser.type("washer.ies");
  app().choose_file();
  EXPECT_FALSE(app().dialog) << app().dialog->problem;
  EXPECT_EQ(lamp(1).lamp.profile.name, "washer.ies");
}

}  // namespace
}  // namespace ssphh::viewer
