// A picture of the sky that is dropped on the window is what surrounds the scene.

#include <gmock/gmock.h>

#include <ssphh/image/io.h>
#include <ssphh/scene_io/load.h>

#include "gl_stage.h"
#include "model/document.h"
#include "model/sky_edit.h"
#include "panel_stage.h"

namespace ssphh::viewer {
namespace {

using testing::HasSubstr;

/// Of one radiance but for a spot of light.
image::Image sky(const vec3& radiance, int width = 64, int height = 32) {
  image::Image picture(width, height);
  for (int y = 0; y < height; ++y) {
    for (int x = 0; x < width; ++x) picture.set_rgb(x, y, x < 8 && y < 8 ? 4.0f * radiance : radiance);
  }
  return picture;
}

class SkyDrop : public PanelStage {
 protected:
  SkyDrop() {
    image::write_image("dawn.hdr", sky({1, 0.5f, 0.25f}));
    image::write_image("noon.exr", sky({3, 3, 3}));
  }
  void drop(const std::vector<std::string>& files) { app().take_dropped(files); }
};

TEST_F(SkyDrop, SurroundsTheSceneAndIsUndone) {
  const auto before = app().document.scene;
  ASSERT_FALSE(before->environment);
  drop({"dawn.hdr"});
  ASSERT_TRUE(app().document.scene->environment);
  EXPECT_LT(glm::distance(app().document.scene->environment->equirect.rgb(40, 20), vec3(1, 0.5f, 0.25f)),
            0.01f);
  EXPECT_EQ(app().message, "dawn.hdr is the sky");
  EXPECT_TRUE(app().document.dirty());
  drop({"noon.exr"});
  EXPECT_EQ(app().document.scene->environment->equirect.rgb(40, 20), vec3(3));
  press({GLFW_KEY_Z}, true);
  EXPECT_NEAR(app().document.scene->environment->equirect.rgb(40, 20).x, 1, 0.01f);
  press({GLFW_KEY_Z}, true);
  EXPECT_EQ(app().document.scene, before);
}

TEST_F(SkyDrop, IsSavedInGlbAndOverlay) {
  app().take_document(document("two-rooms"));
  drop({"noon.exr"});
  app().document.edit("turn", [](Edits& e) { e.environment_rotation = 0.5f; });
  for (const char* file : {"mine.glb", "own.ssphh.json"}) {
    app().save_scene(file);
    const scene::Scene again = scene_io::load_scene(file);
    ASSERT_TRUE(again.environment) << file;
    EXPECT_EQ(again.environment->equirect.pixels, sky({3, 3, 3}).pixels) << file;
    EXPECT_NEAR(again.environment->rotation, 0.5f, 1e-5f) << file;
  }
}

TEST_F(SkyDrop, TakesThePlaceOfAComputedOne) {
  app().take_document(document("house"));
  ASSERT_TRUE(shown_sky(app().document));
  scene::SunSkyParams other = *shown_sky(app().document);
  other.elevation = 0.3f;
  change_sky(app().document, other);
  drop({"noon.exr"});
  EXPECT_FALSE(shown_sky(app().document));
  EXPECT_FALSE(app().document.lighting().environment_image);
  press({GLFW_KEY_Z}, true);
  EXPECT_EQ(shown_sky(app().document)->elevation, 0.3f);
}

TEST_F(SkyDrop, ThePanelChoosesOneAndGivesTheScenesOwnBack) {
  open("Light");
  click_text("Sky from a picture?");
  ASSERT_TRUE(app().dialog);
  app().dialog->browser.type("dawn.hdr");
  app().choose_file();
  EXPECT_FALSE(app().dialog);
  rest();
  EXPECT_TRUE(shows("dawn.hdr"));
  click_text("The scene's own");
  EXPECT_FALSE(app().document.scene->environment);
}

TEST_F(SkyDrop, OneThatCannotBeIsTold) {
  image::write_image("square.exr", sky({1, 1, 1}, 32, 32));
  drop({"square.exr"});
  EXPECT_THAT(app().message, HasSubstr("32 by 32 pixels are no picture of the whole sky"));
  drop({"none.hdr"});
  EXPECT_TRUE(app().message_is_error);
  EXPECT_FALSE(app().document.dirty());
  start(400, 300);
  drop({"dawn.hdr"});
  EXPECT_THAT(app().message, HasSubstr("no scene is open"));
}

TEST_F(SkyDrop, OfManyTheFirstIsTaken) {
  std::vector<std::string> many;
  for (int i = 0; i < 20; ++i) {
    many.push_back(fmt::format("sky-{}.exr", i));
    image::write_image(many.back(), sky(vec3(static_cast<float>(i + 1))));
  }
  drop(many);
  EXPECT_EQ(app().document.scene->environment->equirect.rgb(40, 20), vec3(1));
}

class SkyLight : public GlStage {
 protected:
  void prepare() override { options_.records = 0, options_.settings = {{"exposure", "0"}}; }
  void ready() override { app().open("builtin:cornell"); }
  image::Image linear() {
    app().inspecting = true;
    play("settle");
    return app().picture.linear();
  }
};

TEST_F(SkyLight, IsThatOfASceneThatHasThePicture) {
  image::write_image("dawn.exr", sky({1, 0.5f, 0.25f}));
  const image::Image without = linear();
  app().take_surroundings("dawn.exr");
  const image::Image dropped = linear();
  EXPECT_NE(dropped.pixels, without.pixels);
  app().undo();
  EXPECT_EQ(linear().pixels, without.pixels);
  app().redo();
  EXPECT_EQ(linear().pixels, dropped.pixels);
  load_ = [](const std::string&) {
    scene::Scene scene = scene::make_builtin("cornell");
    scene.environment.emplace().equirect = sky({1, 0.5f, 0.25f});
    return scene;
  };
  app().open("with.glb");
  const image::Image own = linear();
  double difference = 0, all = 0;
  for (std::size_t i = 0; i < own.pixels.size(); ++i) {
    difference += std::abs(own.pixels[i] - dropped.pixels[i]);
    all += own.pixels[i];
  }
  EXPECT_LT(difference, 0.01 * all);
}

}  // namespace
}  // namespace ssphh::viewer
