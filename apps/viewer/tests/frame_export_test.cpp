// The bookmarks' path drawn as pictures while the window is open.

#include "frame_export.h"

#include <gmock/gmock.h>

#include <ssphh/core/file.h>
#include <ssphh/image/io.h>

#include "gl_stage.h"
#include "panel_stage.h"

namespace ssphh::viewer {
namespace {

class Frames : public GlStage {
 protected:
  void prepare() override { options_.records = 0, options_.settings = {{"exposure", "0"}}; }
  void ready() override {
    app().open("builtin:cornell");
    for (const float x : {0.0f, 0.4f}) {
      app().view = moved(app().view, {x, 0, 0});
      app().add_bookmark();
    }
  }
  bool finish() {
    return turn_until([&] { return !app().frames; }, [&] { turn(); });
  }
};

TEST_F(Frames, AreWrittenOneByOneAndTheViewComesBack) {
  const View before = app().view = moved(app().view, {0, 0.1f, 0});
  std::filesystem::create_directory("shots");
  write_file("shots/frame-0007.png", std::string_view("old"));
  export_frames(app(), "shots", 1);
  EXPECT_EQ(app().frames->count(), 3);
  ASSERT_TRUE(finish());
  for (const char* frame : {"shots/frame-0000.png", "shots/frame-0002.png"})
    EXPECT_EQ(image::read_image(frame).width, 64) << frame;
  EXPECT_NE(read_file("shots/frame-0000.png"), read_file("shots/frame-0002.png"));
  EXPECT_FALSE(std::filesystem::exists("shots/frame-0007.png")) << "of an older, longer one";
  EXPECT_EQ(app().view, before);
  EXPECT_TRUE(app().follows_exposure);
  EXPECT_THAT(app().message, testing::HasSubstr("wrote 3 frames in "));
}

TEST_F(Frames, AreAsWholeAsAPictureThatStandsStill) {
  export_frames(app(), "shots", 1);
  ASSERT_TRUE(finish());
  app().go_to(app().bookmarks.keys[0]);
  turn();
  ASSERT_TRUE(turn_until([&] { return app().settled(); }, [&] { turn(); }));
  app().screenshot("still.png", false);
  EXPECT_EQ(read_file("shots/frame-0000.png"), read_file("still.png")) << "edges are smooth";
}

TEST_F(Frames, EscapeStopsThem) {
  const View before = app().view = moved(app().view, {0, 0.1f, 0});
  export_frames(app(), "shots", 100);
  turn();
  InjectedInput escape;
  escape.keys = {GLFW_KEY_ESCAPE};
  turn(escape);
  EXPECT_FALSE(app().frames);
  EXPECT_EQ(app().view, before);
}

class FramesPanel : public PanelStage {};

TEST_F(FramesPanel, AButtonDrawsThemAndAsksBeforeItReplacesSome) {
  open("Camera");
  EXPECT_FALSE(shows("Draw the frames")) << "there is no path";
  app().add_bookmark(), app().add_bookmark();
  rest();
  EXPECT_FALSE(shows("ssphh view")) << "nobody has to type a command";
  std::filesystem::create_directory("frames");
  write_file("frames/frame-0000.png", std::string_view("mine"));
  click_text("Draw the frames");
  EXPECT_FALSE(app().frames);
  EXPECT_THAT(app().message, testing::HasSubstr("is there already"));
  click_text("Replace the frames there");
  ASSERT_TRUE(app().frames);
  EXPECT_TRUE(shows("frame 1 of 61"));
  click_text("Stop (Escape)");
  EXPECT_FALSE(app().frames);
}

TEST_F(FramesPanel, WithoutAPathOrAFolderTheyAreRefused) {
  EXPECT_THROW(export_frames(app(), "x", 30), Error);
  app().add_bookmark();
  EXPECT_THROW(export_frames(app(), "/proc/nowhere", 30), Error);
  EXPECT_FALSE(app().frames);
  EXPECT_TRUE(app().follows_exposure);
}

}  // namespace
}  // namespace ssphh::viewer
