// Nothing is lost without a question.

#include <GLFW/glfw3.h>
#include <gmock/gmock.h>

#include "panel_stage.h"

namespace ssphh::viewer {
namespace {

using testing::HasSubstr;
using Then = Question::Then;

class Asked : public PanelStage {
 protected:
  void edit() {
    app().document.edit_at_once("dim", [](Edits& e) { e.lights[0].intensity = 0.5f; });
  }
  /// As the user asks for it and the session looks after it.
  bool closes() {
    window_->close();
    return window_->should_close() && app().may_close();
  }
  void bake(const char* name) {
    app().job.start(name, [](const Control& control) -> BackgroundJob::Finish {
      while (!control.cancelled()) std::this_thread::sleep_for(std::chrono::milliseconds(1));
      return {};
    });
  }
  std::string texts() {
    rest();
    return drawn_listing();
  }
};

TEST_F(Asked, WithoutEditsTheWindowCloses) {
  EXPECT_TRUE(closes());
  edit();
  app().undo();
  EXPECT_TRUE(closes());
  EXPECT_EQ(app().question.then, Then::nothing);
}

TEST_F(Asked, TheWindowStaysUntilTheUserHasChosen) {
  edit();
  EXPECT_FALSE(closes());
  EXPECT_FALSE(window_->closed) << "it stays";
  const std::string asked = texts();
  EXPECT_THAT(asked, HasSubstr("builtin:stage has changes that are not saved."));
  EXPECT_THAT(asked, HasSubstr("Save and close (S)"));
  // What is asked stands before all other keys.
  press({'P'}), press({GLFW_KEY_Z}, true);
  EXPECT_FALSE(app().settings.balls);
  EXPECT_TRUE(app().document.dirty());
  press({GLFW_KEY_ESCAPE});
  EXPECT_EQ(app().question.then, Then::nothing);
  EXPECT_THAT(texts(), testing::Not(HasSubstr("not saved")));
  EXPECT_FALSE(window_->closed);
  press({'P'});
  EXPECT_TRUE(app().settings.balls) << "keys answer again";
  EXPECT_FALSE(closes());
  rest();
  press({GLFW_KEY_D});
  EXPECT_TRUE(window_->closed && app().may_close());
  EXPECT_TRUE(app().report.written.empty());
}

TEST_F(Asked, SavingIsAnAnswer) {
  edit();
  EXPECT_FALSE(closes());
  rest();
  press({GLFW_KEY_ENTER});
  EXPECT_TRUE(window_->closed && app().may_close());
  EXPECT_EQ(app().report.written.size(), 1u);
  EXPECT_TRUE(std::filesystem::exists(app().report.written.at(0)));
  EXPECT_FALSE(app().document.dirty());
}

TEST_F(Asked, TheMouseAnswersToo) {
  edit();
  EXPECT_FALSE(closes());
  rest();
  click_text("Stay (Escape)");
  EXPECT_EQ(app().question.then, Then::nothing);
  EXPECT_FALSE(window_->closed);
  EXPECT_FALSE(closes());
  rest();
  click_text("Save and close (S)");
  EXPECT_TRUE(window_->closed);
  EXPECT_EQ(app().report.written.size(), 1u);
}

TEST_F(Asked, WhatCannotBeSavedKeepsTheWindow) {
  edit();
  std::filesystem::remove_all(dir_.path());  // The folder in which it would be saved
  EXPECT_FALSE(closes());
  app().answer(Answer::save);
  EXPECT_FALSE(window_->closed);
  EXPECT_TRUE(app().message_is_error);
  EXPECT_TRUE(app().document.dirty());
}

TEST_F(Asked, AnotherSceneWaitsForTheAnswer) {
  std::vector<std::string> loaded;
  load_ = [&](const std::string& source) -> scene::Scene {
    loaded.push_back(source);
    throw Error(source, "was asked for");
  };
  edit();
  window_->dropped = {"a.glb"};
  for (const std::string& file : window_->take_dropped()) app().request_open(file);
  EXPECT_EQ(app().question.then, Then::open);
  EXPECT_THAT(texts(), HasSubstr("To be opened: a.glb"));
  EXPECT_TRUE(loaded.empty());
  press({GLFW_KEY_ESCAPE});
  EXPECT_TRUE(loaded.empty());
  app().request_open("b.ssphh.json");
  rest();
  press({GLFW_KEY_D});
  finish_work();
  EXPECT_THAT(loaded, testing::ElementsAre("b.ssphh.json"));
  EXPECT_EQ(app().message, "b.ssphh.json: was asked for");
  EXPECT_TRUE(app().document.dirty()) << "what is refused takes nothing away";
  EXPECT_THROW(app().request_open("x.json"), Error) << "a camera path replaces no scene";
  EXPECT_THROW(app().request_open("x.sphl"), Error);
  EXPECT_EQ(app().question.then, Then::nothing);
}

TEST_F(Asked, ABakeIsNotStoppedUnasked) {
  bake("GEN");
  EXPECT_FALSE(closes());
  const std::string asked = texts();
  EXPECT_THAT(asked, HasSubstr("GEN is not done yet."));
  EXPECT_THAT(asked, testing::Not(HasSubstr("Save and")));
  press({GLFW_KEY_S});
  EXPECT_FALSE(window_->closed);
  app().job.cancel();
  while (app().job.running()) std::this_thread::sleep_for(std::chrono::milliseconds(1));
  rest();
  EXPECT_TRUE(window_->closed) << "there is nothing left to ask about";
  window_->closed = false;
  bake("lighting probes");
  EXPECT_TRUE(closes()) << "it begins by itself another time";
}

TEST_F(Asked, NobodyWhereNobodyIs) {
  edit();
  for (std::string* option : {&options_.script, &options_.screenshot, &options_.export_dir}) {
    *option = "x";
    EXPECT_TRUE(closes());
    option->clear();
  }
  options_.frames = 3;
  EXPECT_TRUE(closes());
}

TEST_F(Asked, ProbesOfAnotherSceneAreTakenOnlyOnDemand) {
  take_probes();
  probes::ProbeSet set = app().light.set();
  set.generator.scene = "elsewhere.glb";
  set.generator.scene_hash = {7, 7};
  probes::write_probe_file(set, "other.sphl");
  app().light.clear();
  app().request_open("other.sphl");
  EXPECT_EQ(app().question.then, Then::take_probes);
  EXPECT_TRUE(app().light.empty());
  EXPECT_THAT(texts(), HasSubstr("Take it anyway (T)"));
  EXPECT_THAT(texts(), HasSubstr("elsewhere.glb"));
  press({GLFW_KEY_ESCAPE});
  EXPECT_TRUE(app().light.empty());
  app().request_open("other.sphl");
  rest();
  press({GLFW_KEY_T});
  EXPECT_EQ(app().light.origin(), "other.sphl");
  // Nobody is there to answer
  options_.script = "x";
  EXPECT_THROW(app().request_open("other.sphl"), Error);
}

}  // namespace
}  // namespace ssphh::viewer
