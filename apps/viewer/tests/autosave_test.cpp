// What a session leaves when it ends without its question, and the next one finds.

#include "model/autosave.h"

#include <csignal>

#include <GLFW/glfw3.h>
#include <gmock/gmock.h>
#include <sys/wait.h>
#include <unistd.h>

#include <ssphh/core/file.h>
#include <ssphh/scene_io/load.h>

#include "panel_stage.h"

namespace ssphh::viewer {
namespace {

namespace fs = std::filesystem;
using testing::HasSubstr;
using Then = Question::Then;

class Autosaved : public PanelStage {
 protected:
  Autosaved() { options_.autosave = folder_; }

  void restart() {
    start(1000, 1500);
    app().take_document(make_document("builtin:stage", scene::make_builtin("two-rooms"), 0));
  }
  /// As a kill ends the process: nothing is tidied up but what the system does. Files stay, locks go.
  void crash() {
    const fs::path aside = dir_.path() / "aside";
    fs::copy(folder_, aside);
    start(1000, 1500);
    fs::remove_all(folder_);
    fs::rename(aside, folder_);
    for (const fs::directory_entry& entry : fs::directory_iterator(folder_)) {
      if (entry.path().extension() == ".lock") fs::remove(entry.path());
    }
  }
  void edit(float intensity = 0.5f) {
    app().document.edit_at_once("dim", [&](Edits& e) { e.lights[0].intensity = intensity; });
  }
  /// Time goes by, and what is written in it is.
  void pass(double seconds) {
    app().keep_unsaved();
    window_->clock += seconds;
    app().keep_unsaved();
    while (app().keeping()) {
      std::this_thread::sleep_for(std::chrono::milliseconds(1));
      app().keep_unsaved();
    }
  }
  /// Files of the folder with this ending.
  std::vector<fs::path> kept(const std::string& ending) {
    std::vector<fs::path> out;
    std::error_code none;
    for (const fs::directory_entry& entry : fs::directory_iterator(folder_, none)) {
      if (entry.path().string().ends_with(ending)) out.push_back(entry.path());
    }
    return out;
  }
  std::vector<Kept> left(const std::string& source = {}) { return Autosave(folder_).left(source); }

  fs::path folder_ = dir_.path() / "state" / "autosave";
};

TEST_F(Autosaved, AfterAMinuteOfEditsThatNoFileHas) {
  restart();
  pass(1000);
  EXPECT_FALSE(fs::exists(folder_)) << "nothing was changed";
  edit();
  pass(59);
  EXPECT_TRUE(kept(".json").empty());
  pass(2);
  ASSERT_EQ(kept(".json").size(), 1u);
  ASSERT_EQ(kept(".glb").size(), 1u);
  EXPECT_EQ(scene_io::load_scene(kept(".glb")[0].string()).lights[0].intensity, 0.5f);
  EXPECT_TRUE(left().empty()) << "this session is still there";
  EXPECT_TRUE(app().document.dirty());
  const auto written = fs::last_write_time(kept(".json")[0]);
  pass(1000);
  EXPECT_EQ(fs::last_write_time(kept(".json")[0]), written) << "the same is not written again";
  edit(0.25f);
  pass(61);
  EXPECT_EQ(scene_io::load_scene(kept(".glb")[0].string()).lights[0].intensity, 0.25f);
  app().undo(), app().undo();
  app().keep_unsaved();
  EXPECT_TRUE(kept("").empty()) << "nothing is left that could be lost";
}

TEST_F(Autosaved, SavedAndDiscardedWorkLeavesNothing) {
  restart();
  edit(), pass(61);
  EXPECT_EQ(kept(".json").size(), 1u);
  app().save();
  app().keep_unsaved();
  EXPECT_TRUE(kept("").empty());
  edit(3), pass(61);
  EXPECT_EQ(kept(".json").size(), 1u);
  window_->close();
  EXPECT_FALSE(app().may_close());
  app().answer(Answer::discard);
  app_.reset();
  EXPECT_TRUE(kept("").empty());
}

TEST_F(Autosaved, WhatASignalEndsIsKeptAtOnce) {
  restart();
  edit();
  app_.reset();
  ASSERT_EQ(left().size(), 1u);
  EXPECT_EQ(left()[0].source, "builtin:stage");
  EXPECT_TRUE(left()[0].scene);
  EXPECT_FALSE(left()[0].probes);
  EXPECT_TRUE(left("builtin:other").empty());
}

TEST_F(Autosaved, AKilledProcessLosesItsLockAndNotItsFiles) {
  int ready[2];
  ASSERT_EQ(::pipe(ready), 0);
  const pid_t child = ::fork();
  if (child == 0) {
    Autosave autosave(folder_);
    const Kept kept{autosave.name_for("builtin:stage"), "builtin:stage", "", {}};
    write_kept(kept, nullptr, nullptr);
    [[maybe_unused]] const auto told = ::write(ready[1], "x", 1);
    for (;;) ::pause();
  }
  char byte = 0;
  ASSERT_EQ(::read(ready[0], &byte, 1), 1);
  EXPECT_TRUE(left().empty()) << "it lives";
  Autosave other(folder_);
  EXPECT_THAT(other.name_for("builtin:stage").string(), testing::EndsWith("-2")) << "two windows, one scene";
  ::kill(child, SIGKILL);
  ::waitpid(child, nullptr, 0);
  EXPECT_EQ(left().size(), 1u);
  ::close(ready[0]), ::close(ready[1]);
}

TEST_F(Autosaved, TheNextSessionAsks) {
  restart();
  edit(), pass(61);
  crash();
  app().offer_recovery();
  EXPECT_EQ(app().question.then, Then::recover) << "an empty window asks for whatever there is";
  app().question = {};
  app().take_document(make_document("builtin:stage", scene::make_builtin("two-rooms"), 0));
  app().offer_recovery();
  rest();
  const std::string asked = drawn_listing();
  EXPECT_THAT(asked, HasSubstr("builtin:stage"));
  EXPECT_THAT(asked, HasSubstr("Recover (R)"));
  press({GLFW_KEY_ESCAPE});
  EXPECT_EQ(app().question.then, Then::nothing);
  EXPECT_EQ(left().size(), 1u) << "it can be asked again";
  app().offer_recovery();
  rest();
  press({GLFW_KEY_D});
  EXPECT_TRUE(left().empty());
  app().offer_recovery();
  EXPECT_EQ(app().question.then, Then::nothing);
}

TEST_F(Autosaved, BrokenOnesAreLeftOut) {
  restart();
  edit();
  app_.reset();
  ASSERT_EQ(left().size(), 1u);
  write_file(folder_ / "x.json", std::string_view("{"));
  write_file(folder_ / "y.json", std::string_view(R"({"format": "ssphh-autosave", "version": 1})"));
  EXPECT_EQ(left().size(), 1u);
  fs::remove(kept(".glb")[0]);
  start(1000, 1500);
  app().offer_recovery();
  app().answer(Answer::recover);
  EXPECT_TRUE(app().message_is_error);
  EXPECT_FALSE(app().scene_open());
}

TEST_F(Autosaved, NotWhereNobodyIs) {
  restart();
  options_.script = "x";
  edit(), pass(1000);
  app_.reset();
  EXPECT_FALSE(fs::exists(folder_));
}

TEST_F(Autosaved, AFolderThatCannotBeWrittenIsComplainedAbout) {
  options_.autosave = "/proc/nowhere";
  restart();
  edit(), pass(61);
  EXPECT_TRUE(app().message_is_error);
  app().say("on");
  pass(30);
  EXPECT_FALSE(app().message_is_error);
}

TEST_F(Autosaved, ABakeThatIsDoneCounts) {
  restart();
  take_probes();
  EXPECT_FALSE(app().unsaved()) << "of a file";
  app().light.not_saved("GEN");
  EXPECT_TRUE(app().unsaved());
  EXPECT_THAT(app().what_is_lost(), "What GEN has found is not saved.");
  pass(61);
  EXPECT_EQ(kept(".sphl").size(), 1u);
  EXPECT_TRUE(kept(".glb").empty()) << "the scene has no edits";
  const auto probes = app().light.set().probes.size();
  crash();
  app().take_document(make_document("builtin:stage", scene::make_builtin("two-rooms"), 0));
  app().offer_recovery();
  app().answer(Answer::recover);
  EXPECT_FALSE(app().message_is_error) << app().message;
  ASSERT_FALSE(app().light.empty());
  EXPECT_EQ(app().light.set().probes.size(), probes);
  EXPECT_TRUE(app().unsaved()) << "it still is in no file";
  EXPECT_EQ(kept(".sphl").size(), 1u) << "nor is it dropped";
  EXPECT_TRUE(left().empty());
  app().save();
  EXPECT_THAT(app().report.written, testing::ElementsAre("stage-01.sphl")) << "the scene was not edited";
  EXPECT_FALSE(app().unsaved());
  app().keep_unsaved();
  EXPECT_TRUE(kept("").empty());
}

TEST_F(Autosaved, AnAnswerSavesBoth) {
  restart();
  take_probes();
  edit();
  app().light.not_saved("VIZ");
  window_->close();
  EXPECT_FALSE(app().may_close());
  app().answer(Answer::save);
  EXPECT_TRUE(window_->closed);
  EXPECT_THAT(app().report.written, testing::ElementsAre("stage-01.glb", "stage-01.sphl"));
  app().light.not_saved("VIZ");
  app().light.clear();
  EXPECT_FALSE(app().unsaved()) << "what replaces it was asked for";
}

}  // namespace
}  // namespace ssphh::viewer
