// What the window's panels show and what clicks on them change.

#include <GLFW/glfw3.h>

#include "app_stage.h"
#include "drawn.h"

namespace ssphh::viewer {
namespace {

class Panels : public AppStage {
 protected:
  Panels() {
    start(900, 700);
    app().take_document(document("two-rooms"));
    frames(2);
  }
};

TEST_F(Panels, EachTabShowsItsValues) {
  for (const char* tab : {"Light", "Probes", "Surfaces", "Camera", "Picture", "Times"}) {
    app().open_tab = tab;
    frames(3);
    expect_drawn(std::string("tab-") + tab, drawn_listing());
  }
}

}  // namespace
}  // namespace ssphh::viewer
