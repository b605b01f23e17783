// Files that the user chooses, by keys and mouse.

#include <fstream>

#include <GLFW/glfw3.h>
#include <gmock/gmock.h>

#include <ssphh/core/file.h>

#include "panel_stage.h"

namespace ssphh::viewer {
namespace {

namespace fs = std::filesystem;
using For = FileDialog::For;
using testing::ElementsAre;

class Dialog : public PanelStage {
 protected:
  Dialog() {
    fs::create_directory("models");
    std::ofstream("models/hut.glb") << "x";
    std::ofstream("scene-a.glb") << "x";
    std::ofstream("scene-b.glb") << "x";
    load_ = [this](const std::string& source) -> scene::Scene {
      loaded_.push_back(source);
      throw Error(source, "was asked for");
    };
  }
  void type(const std::string& text) {
    window_->typed = text;
    frames(2);
  }
  std::string here(const std::string& name) { return (fs::current_path() / name).string(); }

  std::vector<std::string> loaded_;
};

TEST_F(Dialog, KeysFindAScene) {
  press({'O'}, true);
  ASSERT_TRUE(app().dialog);
  frames(3);
  press({'P'});
  EXPECT_FALSE(app().settings.balls) << "letters are typed";
  press({GLFW_KEY_DOWN});
  press({GLFW_KEY_ENTER});
  frames(2);
  EXPECT_EQ(app().dialog->browser.folder(), here("models"));
  press({GLFW_KEY_BACKSPACE});
  EXPECT_EQ(app().dialog->browser.folder(), fs::current_path());
  press({GLFW_KEY_DOWN}), press({GLFW_KEY_DOWN}), press({GLFW_KEY_UP});
  frames(2);
  press({GLFW_KEY_ENTER});
  finish_work();
  EXPECT_THAT(loaded_, ElementsAre(here("scene-a.glb")));
  ASSERT_TRUE(app().dialog);
  EXPECT_THAT(app().dialog->problem, testing::HasSubstr("was asked for")) << "it stays to be mended";
  press({GLFW_KEY_ESCAPE});
  EXPECT_FALSE(app().dialog);
  rest();
  press({'P'});
  EXPECT_TRUE(app().settings.balls) << "keys are the window's again";
}

TEST_F(Dialog, WhatIsTypedIsCompleted) {
  app().ask_for_file(For::open);
  frames(4);
  type("mo");
  EXPECT_EQ(app().dialog->browser.typed(), "mo");
  press({GLFW_KEY_TAB});
  EXPECT_EQ(app().dialog->browser.typed(), "models/");
  type("h");
  press({GLFW_KEY_TAB});
  frames(2);
  EXPECT_EQ(app().dialog->browser.typed(), "models/hut.glb");
  press({GLFW_KEY_BACKSPACE});
  EXPECT_EQ(app().dialog->browser.typed(), "models/hut.gl") << "a letter of what is typed";
  EXPECT_EQ(app().dialog->browser.folder(), fs::current_path());
  type("b");
  press({GLFW_KEY_ENTER});
  finish_work();
  EXPECT_THAT(loaded_, ElementsAre(here("models/hut.glb")));
}

TEST_F(Dialog, TheMouseChoosesToo) {
  app().ask_for_file(For::open);
  frames(3);
  click_text("scene-b.glb");
  click_text("Open (Enter)");
  finish_work(), frames(3);
  EXPECT_THAT(loaded_, ElementsAre(here("scene-b.glb")));
  click_text("Up");
  EXPECT_EQ(app().dialog->browser.folder(), fs::current_path().parent_path());
  click_text("Cancel (Escape)");
  EXPECT_FALSE(app().dialog);
}

TEST_F(Dialog, EditsAreAskedAboutBeforeAnotherSceneComes) {
  app().document.edit_at_once("dim", [](Edits& e) { e.lights[0].intensity = 0.5f; });
  app().ask_for_file(For::open);
  frames(3);
  click_text("scene-a.glb");
  click_text("Open (Enter)");
  EXPECT_FALSE(app().dialog);
  EXPECT_EQ(app().question.then, Question::Then::open);
  EXPECT_EQ(app().question.source, here("scene-a.glb"));
}

TEST_F(Dialog, ASceneIsSavedUnderAName) {
  press({'S'}, true, true);
  ASSERT_TRUE(app().dialog);
  frames(4);
  EXPECT_EQ(app().dialog->browser.typed(), "stage-01.glb");
  press({GLFW_KEY_ENTER});
  EXPECT_FALSE(app().dialog);
  EXPECT_EQ(app().document.file, here("stage-01.glb"));
  // Over another file only when it is chosen twice.
  press({'S'}, true, true);
  frames(4);
  click_text("scene-b.glb");
  frames(3);
  EXPECT_EQ(app().dialog->browser.typed(), "scene-b.glb");
  press({GLFW_KEY_ENTER});
  frames(3);
  ASSERT_TRUE(app().dialog);
  EXPECT_TRUE(shows("scene-b.glb is there already"));
  EXPECT_EQ(read_text_file("scene-b.glb"), "x");
  press({GLFW_KEY_ENTER});
  EXPECT_FALSE(app().dialog);
  EXPECT_GT(fs::file_size("scene-b.glb"), 1000u);
  // Over its own at once.
  press({'S'}, true, true);
  frames(4);
  press({GLFW_KEY_ENTER});
  EXPECT_FALSE(app().dialog);
}

TEST_F(Dialog, AnotherNameAfterTheWarningIsNotTheSame) {
  app().ask_for_file(For::scene);
  frames(4);
  click_text("scene-a.glb"), frames(2), press({GLFW_KEY_ENTER}), frames(2);
  EXPECT_FALSE(app().dialog->replaces.empty());
  click_text("scene-b.glb"), frames(2);
  EXPECT_TRUE(app().dialog->replaces.empty());
  press({GLFW_KEY_ENTER});
  ASSERT_TRUE(app().dialog);
  EXPECT_EQ(read_text_file("scene-a.glb") + read_text_file("scene-b.glb"), "xx");
}

TEST_F(Dialog, ProbesGetTheirEnding) {
  take_probes();
  app().ask_for_file(For::probes);
  frames(4);
  for (int i = 0; i < 20; ++i) press({GLFW_KEY_BACKSPACE});
  EXPECT_EQ(app().dialog->browser.typed(), "");
  EXPECT_EQ(app().dialog->browser.folder(), fs::current_path()) << "a name is taken back, not the folder";
  type("light");
  press({GLFW_KEY_ENTER});
  EXPECT_FALSE(app().dialog);
  EXPECT_THAT(app().report.written, ElementsAre(here("light.sphl")));
}

class Recent : public Dialog {
 protected:
  Recent() { options_.preferences = dir_.path() / "config" / "preferences.json"; }
};

TEST_F(Recent, ScenesStandInTheMenu) {
  app().remember_scene("scene-a.glb");
  app().remember_scene("gone.glb");
  app().remember_scene("builtin:cornell");
  EXPECT_THAT(read_preferences(options_.preferences).recent,
              ElementsAre(here("gone.glb"), here("scene-a.glb")));
  const auto unfold = [&] {
    rest();
    const DrawnThing file = text("File");
    click(file.from.x + 3, file.from.y + 5), frames(3);
    const DrawnThing entry = text("Open recent");
    click(entry.from.x + 3, entry.from.y + 5), frames(3);
  };
  unfold();
  const DrawnThing gone = text(here("gone.glb"));
  click(gone.from.x + 3, gone.from.y + 5), frames(2);
  EXPECT_TRUE(loaded_.empty()) << "it is not there";
  const DrawnThing remove = text("Remove");
  click(remove.from.x + 3, remove.from.y + 5), frames(3);
  EXPECT_THAT(read_preferences(options_.preferences).recent, ElementsAre(here("scene-a.glb")));
  const DrawnThing there = text(here("scene-a.glb"));
  click(there.from.x + 3, there.from.y + 5), frames(2), finish_work();
  EXPECT_THAT(loaded_, ElementsAre(here("scene-a.glb")));
}

TEST_F(Recent, WhatIsSavedIsAmongThemAndAnotherSessionKnows) {
  app().save();
  EXPECT_THAT(app().preferences.recent, ElementsAre(here("stage-01.glb")));
  start(400, 300);
  EXPECT_THAT(app().preferences.recent, ElementsAre(here("stage-01.glb")));
  options_.script = "x";
  app().remember_scene("scene-a.glb");
  EXPECT_EQ(read_preferences(options_.preferences).recent.size(), 1u) << "scripts leave no traces";
  write_file(options_.preferences, std::string_view("{"));
  start(400, 300);
  EXPECT_TRUE(app().message_is_error) << "a broken file is named";
}

}  // namespace
}  // namespace ssphh::viewer
