// Scenes that come in while the window goes on, and files that are dropped or change on the disk.

#include <atomic>
#include <csignal>
#include <fstream>

#include <gmock/gmock.h>
#include <sys/resource.h>

#include <ssphh/core/file.h>

#include "gl_stage.h"
#include "panel_stage.h"

namespace ssphh::viewer {
namespace {

using testing::HasSubstr;
namespace fs = std::filesystem;

class Opening : public GlStage {
 protected:
  void prepare() override { options_.probes = "off"; }
  void ready() override {}
  /// A loader that takes as long as the test lets it.
  void load_slowly() {
    load_ = [this](const std::string& source) {
      ++begun_;
      while (!go_on_) std::this_thread::sleep_for(std::chrono::milliseconds(1));
      if (source == "broken.glb") throw Error(source, "is broken");
      return scene::make_builtin(source == "b.glb" ? "two-rooms" : "cornell");
    };
  }
  void wait_for_loader(int count) {
    while (begun_ < count) std::this_thread::sleep_for(std::chrono::milliseconds(1));
  }
  void TearDown() override {
    go_on_ = true;
    GlStage::TearDown();
  }

  std::atomic<int> begun_ = 0;
  std::atomic<bool> go_on_ = false;
};

TEST_F(Opening, InputIsHandledWhileASceneIsLoaded) {
  load_slowly();
  app().request_open("dir/a.glb");
  wait_for_loader(1);
  EXPECT_EQ(app().job.status().name, "loading a.glb");
  const int before = window_->frames;
  InjectedInput key;
  key.keys = {GLFW_KEY_F1};
  turn(key), turn();
  EXPECT_TRUE(app().help) << "a key counts";
  for (int i = 0; i < 5; ++i) window_->clock += 0.25, app().turn({});
  EXPECT_GE(window_->frames - before, 6) << "frames go on, so that seconds are counted";
  go_on_ = true;
  finish_work();
  EXPECT_TRUE(app().scene_open());
  // What is open stays until the next one is there, or is refused.
  go_on_ = false;
  app().request_open("broken.glb");
  wait_for_loader(2);
  turn();
  EXPECT_EQ(app().document.source, "dir/a.glb");
  go_on_ = true;
  finish_work();
  EXPECT_EQ(app().message, "broken.glb: is broken");
  EXPECT_EQ(app().document.source, "dir/a.glb");
}

TEST_F(Opening, CancelAndAnotherSceneWaitForNobody) {
  load_slowly();
  app().request_open("a.glb");
  wait_for_loader(1);
  InjectedInput key;
  key.keys = {GLFW_KEY_ESCAPE};
  turn(key), turn();
  EXPECT_FALSE(app().job.running());
  // The cancelled loader is still at work.
  app().request_open("b.glb");
  turn();
  EXPECT_EQ(app().job.status().name, "loading b.glb");
  EXPECT_TRUE(app().job.running());
  EXPECT_EQ(begun_, 1) << "one after the other";
  go_on_ = true;
  finish_work();
  EXPECT_EQ(app().document.source, "b.glb");
}

TEST_F(Opening, EditsOfMeanwhileAreAskedAbout) {
  load_slowly();
  go_on_ = true;
  app().request_open("a.glb");
  finish_work();
  go_on_ = false;
  app().request_open("b.glb");
  wait_for_loader(2);
  app().document.edit_at_once("dim", [](Edits& e) { e.materials[0].base_color = vec3(0.1f); });
  go_on_ = true;
  finish_work();
  EXPECT_EQ(app().document.source, "a.glb");
  EXPECT_EQ(app().question.then, Question::Then::open);
  app().answer(Answer::discard);
  finish_work();
  EXPECT_EQ(app().document.source, "b.glb");
}

TEST_F(Opening, OfTwentyDroppedFilesTheFirstSceneIsOpened) {
  load_slowly();
  std::vector<std::string> files = {"notes.txt"};
  for (int i = 0; i < 19; ++i) files.push_back(fmt::format("{}.glb", static_cast<char>('a' + i)));
  window_->dropped = files;
  turn();
  EXPECT_EQ(app().message, "19 scenes were dropped; a window shows one: a.glb");
  go_on_ = true;
  finish_work();
  EXPECT_EQ(app().document.source, "a.glb");
  EXPECT_EQ(begun_, 1) << "not one after the other";
  window_->dropped = {"1.png", "2.png", "3.png", "4.png", "5.png"};
  turn();
  EXPECT_THAT(app().message, HasSubstr("1.png, 2.png, 3.png and 2 more: neither a scene"));
  EXPECT_TRUE(app().message_is_error);
  EXPECT_EQ(app().document.source, "a.glb");
  fs::create_directory("folder");
  std::ofstream("folder/c.glb") << "x";
  window_->dropped = {"folder"};
  turn();
  ASSERT_TRUE(app().dialog);
  EXPECT_EQ(app().dialog->browser.folder().filename(), "folder");
  EXPECT_EQ(app().dialog->browser.entries().size(), 1u);
}

TEST_F(Opening, AFileThatChangesIsOfferedAnewAndOneThatIsGoneIsTold) {
  load_slowly();
  go_on_ = true;
  std::ofstream("a.glb") << "x";
  app().request_open("a.glb");
  finish_work();
  const auto look = [&](int times) {
    for (int i = 0; i < times; ++i) window_->clock += 1.01, turn();
  };
  look(3);
  EXPECT_EQ(app().question.then, Question::Then::nothing);
  std::ofstream("a.glb") << "longer";
  look(1);
  EXPECT_EQ(app().question.then, Question::Then::nothing) << "it may be written still";
  look(1);
  EXPECT_EQ(app().question.then, Question::Then::reload);
  app().answer(Answer::stay);
  look(3);
  EXPECT_EQ(app().question.then, Question::Then::nothing) << "asked once";
  std::ofstream("a.glb") << "longer still";
  look(2);
  ASSERT_EQ(app().question.then, Question::Then::reload);
  app().answer(Answer::discard);
  finish_work();
  EXPECT_EQ(begun_, 2);
  fs::remove("a.glb");
  look(2);
  EXPECT_THAT(app().message, HasSubstr("a.glb is gone from the disk"));
  EXPECT_TRUE(app().scene_open());
  app().say("");
  look(3);
  EXPECT_EQ(app().message, "") << "told once";
}

/// As a full disk does, a limit on the size of files makes writing fail in its middle.
TEST_F(Opening, AFullDiskLosesNothing) {
  load_slowly();
  go_on_ = true;
  app().request_open("b.glb");
  finish_work();
  app().document.edit_at_once("dim", [](Edits& e) { e.lights[0].intensity = 0.5f; });
  app().save_scene("kept.glb");
  const std::string good = read_text_file("kept.glb");
  app().document.edit_at_once("dim", [](Edits& e) { e.lights[0].intensity = 0.25f; });
  const auto handler = std::signal(SIGXFSZ, SIG_IGN);
  rlimit before{};
  ASSERT_EQ(getrlimit(RLIMIT_FSIZE, &before), 0);
  const rlimit small{1000, before.rlim_max};
  ASSERT_EQ(setrlimit(RLIMIT_FSIZE, &small), 0);
  InjectedInput key;
  key.keys = {'S'}, key.ctrl = true;
  turn(key), turn();
  setrlimit(RLIMIT_FSIZE, &before);
  std::signal(SIGXFSZ, handler);
  EXPECT_TRUE(app().message_is_error) << app().message;
  EXPECT_THAT(app().message, HasSubstr("kept.glb"));
  EXPECT_EQ(read_text_file("kept.glb"), good) << "the file of before stays whole";
  EXPECT_EQ(std::distance(fs::directory_iterator("."), {}), 1) << "nothing half written is left";
  EXPECT_TRUE(app().unsaved());
  turn(key), turn();
  EXPECT_FALSE(app().unsaved()) << "once there is room";
}

class SlowPicture : public GlStage {
 protected:
  void prepare() override {
    options_.probes = "off";
    options_.settings = {{"exposure", "0"}};
  }
  void ready() override {}
};

/// Each look at the clock takes a millisecond, so that a picture of many pieces takes many turns.
TEST_F(SlowPicture, TheInterfaceGoesOnWhileItIsDrawn) {
  app().open("builtin:cornell");
  while (!app().settled()) turn();
  const auto old = app().picture.pixels().rgba;
  app().open("builtin:two-rooms");
  if (!app().window.renderer().empty() && !gl::Context::adopt_current().info().software)
    GTEST_SKIP() << "a GPU draws it in one piece";
  window_->tick = 0.001;
  InjectedInput key;
  key.keys = {GLFW_KEY_F1};
  int turns = 0;
  double longest = 0;
  while (!app().current()) {
    ASSERT_LT(turns, 200);
    const double before = window_->clock;
    turn(turns == 0 ? key : InjectedInput());
    longest = std::max(longest, window_->clock - before);
    if (turns == 0) {
      EXPECT_FALSE(app().current());
      EXPECT_TRUE(app().help) << "in the middle of a picture";
    }
    if (!app().current()) {
      EXPECT_EQ(app().picture.pixels().rgba, old) << "the last whole one is shown";
    }
    ++turns;
  }
  EXPECT_GE(turns, 2);
  EXPECT_LT(longest, 1 / 30.0) << "30 frames of the interface in a second";
  EXPECT_NE(app().picture.pixels().rgba, old);
  while (!app().settled()) turn();
  const auto pieces = app().picture.pixels().rgba;
  window_->tick = 0;
  app().open("builtin:two-rooms");
  while (!app().settled()) turn();
  EXPECT_EQ(app().picture.pixels().rgba, pieces) << "the same as in one go";
}

}  // namespace
}  // namespace ssphh::viewer
