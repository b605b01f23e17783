// Presses count however many come between two frames.

#include "input_queue.h"

#include <GLFW/glfw3.h>
#include <gmock/gmock.h>

#include "app_stage.h"

namespace ssphh::viewer {
namespace {

using testing::ElementsAre;

class Queue : public AppStage {
 protected:
  Queue() { start(400, 300); }

  InputQueue& queue() { return window_->queue; }
  void tap(int key) { queue().key(key, true), queue().key(key, false); }
  /// Frames until nothing waits; how many.
  int drain() {
    int count = 0;
    do frame(), ++count;
    while (!queue().empty());
    frame();
    return count;
  }
  void take_rooms() {
    app().panels = false;
    app().take_document(document("two-rooms"));
    app().view = look_at({-1, 1.5f, 1.9f}, {-2.4f, 1.5f, 0}, 1);
    frames(2);
  }
};

TEST_F(Queue, EveryTapOfASlowFrameCounts) {
  take_rooms();
  tap(']'), tap(']'), tap(']'), tap('P');
  EXPECT_EQ(drain(), 7) << "what is let go waits for the frame after its press";
  EXPECT_EQ(app().settings.exposure, 1.5f);
  EXPECT_TRUE(app().settings.balls);
  tap('1'), tap('2'), tap('1'), tap('3');
  drain();
  EXPECT_EQ(app().settings.debug, DebugView::indirect) << "in their order";
}

TEST_F(Queue, ModifiersAreThoseOfThePress) {
  take_rooms();
  app().document.edit_at_once("a", [](Edits& e) { e.lights[0].intensity = 5; });
  queue().key(GLFW_KEY_LEFT_CONTROL, true), tap('Z'), queue().key(GLFW_KEY_LEFT_CONTROL, false);
  tap('G'), queue().key(GLFW_KEY_LEFT_CONTROL, true), queue().key(GLFW_KEY_LEFT_SHIFT, true), tap('Z');
  queue().key(GLFW_KEY_LEFT_SHIFT, false), queue().key(GLFW_KEY_LEFT_CONTROL, false);
  drain();
  EXPECT_EQ(app().document.edits().lights[0].intensity, 5) << "undone and done again";
  EXPECT_EQ(app().message, "done again: a");
  EXPECT_TRUE(app().settings.graph) << "G alone";
  EXPECT_FALSE(ImGui::GetIO().KeyCtrl || ImGui::GetIO().KeyShift);
}

TEST_F(Queue, ADragBetweenTwoFramesIsFromItsPressToItsEnd) {
  take_rooms();
  const View before = app().view;
  queue().mouse(10, 10), queue().mouse(100, 250), queue().button(0, true), queue().mouse(110, 250);
  queue().mouse(130, 240), queue().button(0, false), queue().mouse(300, 20);
  drain();
  EXPECT_EQ(app().view, orbited_by(before, {100, 250}, {130, 240}));
  EXPECT_EQ(ImGui::GetIO().MousePos.x, 300);
  queue().wheel(0, 1), queue().wheel(0, 1);
  const View turned = app().view;
  drain();
  EXPECT_EQ(app().view, wheeled(turned, 2));
}

TEST_F(Queue, TextComesInItsOrderAndAtOnce) {
  std::string seen;
  const auto type_frame = [&] {
    ImGuiIO& io = ImGui::GetIO();
    io.WantTextInput = true;
    queue().give(io);
    for (const ImWchar c : io.InputQueueCharacters) seen += static_cast<char>(c);
    io.InputQueueCharacters.clear();
    if (io.KeysDown[GLFW_KEY_BACKSPACE]) seen += '<';
    seen += '|';
  };
  const auto type = [&](char c) {
    queue().key(c, true), queue().character(static_cast<unsigned char>(c)), queue().key(c, false);
  };
  type('A'), type('B'), tap(GLFW_KEY_BACKSPACE), type('C');
  while (!queue().empty()) type_frame();
  EXPECT_EQ(seen, "AB|<|C|");
  queue().key(-1, true), queue().key(512, true), queue().button(3, true), queue().button(-1, true);
  EXPECT_TRUE(queue().empty());
}

TEST_F(Queue, AKeyThatIsHeldGoesOnAndATapDoesNot) {
  take_rooms();
  queue().key(']', true), queue().key('P', true);
  frames(12);
  EXPECT_GT(app().settings.exposure, 2) << "ImGui's clock of the stage has 0.2 s a frame";
  EXPECT_TRUE(app().settings.balls) << "once";
  queue().key(']', false), queue().key('P', false);
  frames(2);
}

TEST_F(Queue, TheWindowDrawsUntilAllHasBeenSeen) {
  while (app().turn({}) == 0) {
  }
  for (int i = 0; i < 7; ++i) tap('H');
  int turns = 0;
  while (app().turn({}) == 0) ++turns;
  EXPECT_TRUE(queue().empty());
  EXPECT_TRUE(app().help) << "seven times on and off";
  EXPECT_GT(turns, 12);
  EXPECT_LT(turns, 20);
}

}  // namespace
}  // namespace ssphh::viewer
