// Cameras with names: saved, gone to, renamed, given another view and deleted in their panel.

#include <gmock/gmock.h>

#include "panel_stage.h"

namespace ssphh::viewer {
namespace {

using testing::HasSubstr;

class CameraPanel : public PanelStage {
 protected:
  const std::vector<CameraEdit>& cameras() { return app().document.edits().cameras; }
  void type(const char* label, const char* what) {
    const DrawnThing at = widget(label);
    click(at.from.x + 8, 0.5f * (at.from.y + at.to.y));
    window_->typed = what;
    frame(), frame();
    press({GLFW_KEY_ENTER});
    rest();
  }
};

TEST_F(CameraPanel, KeepsViewsUnderNames) {
  open("Camera");
  const std::size_t before = cameras().size();
  const View here = app().view;
  type("new name", "by the door");
  click_text("Save this view as a camera");
  ASSERT_EQ(cameras().size(), before + 1);
  EXPECT_EQ(cameras().back().name, "by the door");
  EXPECT_EQ(cameras().back().view, here);
  EXPECT_THAT(app().what_is_lost(), HasSubstr("not saved")) << "an edit like any other";
  app().view = look_at({1, 1, 1}, {2, 1, 1}, 0.7f);
  const View there = app().view;
  rest();
  click_text("by the door");
  EXPECT_EQ(app().view, here);
  type("name", "corner");
  EXPECT_EQ(cameras().back().name, "corner");
  type("name", "room-a");
  EXPECT_EQ(cameras().back().name, "corner");
  EXPECT_THAT(app().message, HasSubstr("there is a camera \"room-a\" already"));
  press({GLFW_KEY_ESCAPE});
  app().view = there;
  rest();
  click_text("Take this view");
  EXPECT_EQ(cameras().back().view, there);
  click_text("Delete");
  EXPECT_EQ(cameras().size(), before);
  press({GLFW_KEY_Z}, true);
  ASSERT_EQ(cameras().size(), before + 1);
  EXPECT_EQ(cameras().back().view, there);
  click_text("Save this view as a camera");
  EXPECT_EQ(cameras().back().name, "view 1") << "without a name it gets one";
}

}  // namespace
}  // namespace ssphh::viewer
