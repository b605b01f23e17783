// Scenes as large as a coin and as a town are handled like rooms.

#include "model/lengths.h"

#include <gmock/gmock.h>

#include "panel_stage.h"

namespace ssphh::viewer {
namespace {

TEST(Lengths, AreThoseOfARoomInARoomAndInProportionElsewhere) {
  const auto of_radius = [](float r) { return lengths_of({vec3(-r, 0, 0), vec3(r, 0, 0)}); };
  for (const Lengths& room : {of_radius(5), lengths_of(scene::Bounds{})}) {
    EXPECT_FLOAT_EQ(room.least, 0.1f);
    EXPECT_FLOAT_EQ(room.step, 0.01f);
    EXPECT_EQ(room.decimals, 2);
  }
  const Lengths coin = of_radius(0.004f), town = of_radius(3000);
  EXPECT_FLOAT_EQ(coin.least, 1.6e-4f);
  EXPECT_FLOAT_EQ(coin.step, 1e-5f);
  EXPECT_EQ(coin.decimals, 5);
  EXPECT_FLOAT_EQ(town.least, 0.1f);
  EXPECT_FLOAT_EQ(town.step, 10);
  EXPECT_EQ(town.decimals, 2);
  EXPECT_EQ(of_radius(1e-12f).decimals, 8);
  EXPECT_STREQ(length_format(2), "%.2f");
  EXPECT_STREQ(length_format(99), "%.9f");
}

TEST(Lengths, HaveFourDigitsOfTheirScaleAndNoNegativeZero) {
  EXPECT_EQ(length_text(1.7084f, 1.7f), "1.708");
  EXPECT_EQ(length_text(0.0029817f, 0.003f), "0.002982");
  EXPECT_EQ(length_text(130.08f, 130), "130.1");
  EXPECT_EQ(length_text(13274.5f, 8000), "13274");
  EXPECT_EQ(length_text(-1e-7f, 1), "0.000");
  EXPECT_EQ(length_text(-0.0125f, 1), "-0.013");
  EXPECT_EQ(length_text(1, 0), "1.000000000");
}

class TinyScene : public PanelStage {
 protected:
  TinyScene() {
    app().take_document(document("random?seed=74"));  // six millimetres across
    frames(2);
  }
};

TEST_F(TinyScene, IsFlownThroughAndTurnedAboutAsARoom) {
  const float radius = app().document.bounds.radius();
  ASSERT_LT(radius, 0.005f);
  EXPECT_LT(app().fly_speed, radius);
  EXPECT_GT(app().fly_speed, 0.1f * radius);
  EXPECT_LT(app().view.focus, 4 * radius);
  app().go_to_camera("near");
  EXPECT_LT(app().view.focus, 4 * radius);
}

TEST_F(TinyScene, GetsSphlsAndLampsOfItsOwnSize) {
  app().add_sphl({0, 0.001f, 0});
  EXPECT_LT(app().document.edits().sphls.back().radius, 0.1f * app().document.bounds.radius());
  app().add_lamp(scene::LightType::point);
  const vec3 at = light_position(*app().document.edits().lights.back().world);
  EXPECT_LT(glm::distance(at, app().document.bounds.center()), 2 * app().document.bounds.radius());
}

TEST_F(TinyScene, ItsPlacesAreShownWithTheirDigits) {
  open("Camera");
  EXPECT_TRUE(shows(fmt::format("{:.5f}", app().view.eye.z)));
  app().inspecting = true;
  app().inspection.emplace().surface.emplace();
  app().inspection->surface->position = {0.0012341f, -1e-9f, 0};
  app().inspection->surface->distance = 0.003f;
  app().pinned.reset();
  rest();
  EXPECT_TRUE(shows("0.001234"));
  EXPECT_FALSE(shows("-0.000000"));
  EXPECT_TRUE(shows("0.003000"));
}

}  // namespace
}  // namespace ssphh::viewer
