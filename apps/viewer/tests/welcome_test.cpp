// The window without a scene says what can be done, and does it.

#include "panel_stage.h"

namespace ssphh::viewer {
namespace {

class Welcome : public PanelStage {
 protected:
  Welcome() { start(800, 600), rest(); }
};

TEST_F(Welcome, ButtonsOpenAFileOrABuiltInScene) {
  EXPECT_FALSE(shows("ssphh view")) << "nobody has to type a command";
  click_text("Open? (Ctrl+O)");
  ASSERT_TRUE(app().dialog);
  EXPECT_EQ(app().dialog->what, FileDialog::For::open);
  app().dialog.reset();
  rest();
  load_ = [](const std::string& source) -> scene::Scene { throw Error(source, "asked for"); };
  click_text("Look at two rooms");
  finish_work();
  EXPECT_EQ(app().message, "builtin:two-rooms: asked for");
}

}  // namespace
}  // namespace ssphh::viewer
