// The picture as a file of linear light, and that files are replaced on asking alone.

#include "model/linear_picture.h"

#include <fstream>

#include <gmock/gmock.h>

#include <ssphh/core/file.h>
#include <ssphh/image/io.h>

#include "gl_stage.h"
#include "panel_stage.h"

namespace ssphh::viewer {
namespace {

image::Image plain(float value, int width = 4, int height = 2) {
  image::Image picture(width, height);
  for (int y = 0; y < height; ++y) {
    for (int x = 0; x < width; ++x) picture.set_rgb(x, y, vec3(value));
  }
  return picture;
}

TEST(LinearPicture, IsTheMeanOfAllPictures) {
  LinearMean mean;
  for (const float value : {1.0f, 2.0f, 6.0f}) mean.add(plain(value));
  EXPECT_EQ(mean.count(), 3);
  EXPECT_EQ(mean.mean().rgb(3, 1), vec3(3));
}

TEST(LinearPicture, HoldsWhatTheWindowShows) {
  Settings s;
  const image::Image realtime = plain(1);
  ReferenceImage truth;
  EXPECT_EQ(linear_shown(s, realtime, truth)->rgb(0, 0), vec3(1));
  s.show = Show::truth;
  EXPECT_FALSE(linear_shown(s, realtime, truth)) << "it is not there yet";
  truth.color = std::make_shared<const image::Image>(plain(3, 2, 2));
  EXPECT_FALSE(linear_shown(s, realtime, truth)) << "it is of another size";
  truth.color = std::make_shared<const image::Image>(plain(3));
  EXPECT_EQ(linear_shown(s, realtime, truth)->rgb(0, 0), vec3(3));
  s.show = Show::wipe, s.wipe = 0.5f;
  EXPECT_EQ(linear_shown(s, realtime, truth)->rgb(1, 1), vec3(1));
  EXPECT_EQ(linear_shown(s, realtime, truth)->rgb(2, 1), vec3(3));
  s.show = Show::absolute;
  EXPECT_EQ(luminance(linear_shown(s, realtime, truth)->rgb(0, 0)), 2);
  s.show = Show::signed_;
  EXPECT_NEAR(luminance(linear_shown(s, realtime, truth)->rgb(0, 0)), -2, 1e-5f);
  s.show = Show::pixelated, s.block = 2;
  EXPECT_EQ(linear_shown(s, realtime, truth)->width, 4);
}

TEST(LinearPicture, IsKnownByItsEnding) {
  for (const char* name : {"a.exr", "b/a.EXR"}) EXPECT_TRUE(is_linear_picture(name));
  for (const char* name : {"a.png", "exr", "a.exr.png"}) EXPECT_FALSE(is_linear_picture(name));
}

class LinearFiles : public GlStage {
 protected:
  void prepare() override {
    options_.records = 0;
    options_.script = "script";
  }
  void ready() override { app().open("builtin:cornell"); }
  static image::Image read(const std::string& name) { return image::read_image(name); }
};

TEST_F(LinearFiles, HaveSmoothEdgesAndLightThatNoExposureChanges) {
  play(
      "set exposure 0\nscreenshot a.exr\nset exposure 3\nscreenshot b.exr\nset antialias off\nscreenshot "
      "c.exr");
  EXPECT_THAT(app().report.written, testing::ElementsAre("a.exr", "b.exr", "c.exr"));
  const image::Image a = read("a.exr"), b = read("b.exr"), c = read("c.exr");
  ASSERT_EQ(a.width, 64);
  ASSERT_EQ(a.height, 48);
  EXPECT_EQ(a.pixels, b.pixels);
  EXPECT_EQ(app().picture.averaged(), 0) << "without smooth edges";
  EXPECT_NE(a.pixels, c.pixels) << "one frame has steps";
  double mean_a = 0, mean_c = 0;
  for (std::size_t i = 0; i < a.pixels.size(); ++i)
    mean_a += std::min(a.pixels[i], 1.0f), mean_c += std::min(c.pixels[i], 1.0f);
  EXPECT_NEAR(mean_a / mean_c, 1, 0.05);
}

TEST_F(LinearFiles, HoldTheTruthWhereThatIsShown) {
  play("set show truth\nset truth-spp 2\nset truth-depth 1\nsettle\nscreenshot truth.exr");
  EXPECT_EQ(read("truth.exr").rgb(32, 24), app().reference.image().color->rgb(32, 24));
}

TEST_F(LinearFiles, OnesThatCannotBeWrittenAreTold) {
  play("settle");
  app().screenshot("/proc/nowhere/a.exr", false);
  EXPECT_TRUE(turn_until([&] { return app().message_is_error; }, [&] { turn(); }));
  EXPECT_THAT(app().message, testing::HasSubstr("/proc/nowhere/a.exr"));
  EXPECT_TRUE(app().current()) << "it is not tried again";
}

class PictureFiles : public PanelStage {};

TEST_F(PictureFiles, AreChosenInADialogAndReplacedOnAskingAlone) {
  open("Picture");
  click_text("Save picture as?");
  ASSERT_TRUE(app().dialog);
  EXPECT_EQ(app().dialog->browser.typed(), "stage-01.png");
  write_file("here.exr", std::string_view("mine"));
  app().dialog->browser.type("here.exr");
  app().choose_file();
  ASSERT_TRUE(app().dialog) << "asked once more";
  EXPECT_EQ(app().dialog->replaces.filename(), "here.exr");
  EXPECT_EQ(read_text_file("here.exr"), "mine");
  app().choose_file();
  EXPECT_FALSE(app().dialog);
  app().ask_for_file(FileDialog::For::picture);
  app().dialog->browser.type("name");
  app().choose_file();
  EXPECT_THAT(app().dialog->problem, testing::HasSubstr("name.png")) << "there is no picture without OpenGL";
}

TEST_F(PictureFiles, KeysAskForTheName) {
  press({GLFW_KEY_F12}, true);
  ASSERT_TRUE(app().dialog);
  EXPECT_EQ(app().dialog->what, FileDialog::For::picture);
}

}  // namespace
}  // namespace ssphh::viewer
