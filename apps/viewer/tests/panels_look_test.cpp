// What the window's panels, menus and signs look like, drawn thing by drawn thing.

#include "panel_stage.h"

namespace ssphh::viewer {
namespace {

class PanelsLook : public PanelStage {
 protected:
  void expect(const std::string& name) {
    rest();
    expect_drawn(name, drawn_listing());
  }
  /// Texts of all tips that come up where the mouse rests in these columns, once each.
  std::string tips(std::initializer_list<float> columns, float step) {
    std::string all;
    for (const float x : columns) {
      for (float y = 60; y < 1480; y += step) {
        mouse(x, y), mouse(x, y);
        std::string now;
        for (int i = 0; i < ImGui::GetDrawData()->CmdListsCount; ++i) {
          const ImDrawList& list = *ImGui::GetDrawData()->CmdLists[i];
          if (!std::string(list._OwnerName).starts_with("##Tooltip")) continue;
          for (const DrawnThing& thing : drawn_things(list))
            now += thing.text.empty() ? "" : thing.text + "\n";
        }
        if (!now.empty() && all.find(now) == std::string::npos) all += now + "--\n";
      }
    }
    return all;
  }
};

TEST_F(PanelsLook, OfEveryTabAsItBegins) {
  for (const char* tab : {"Light", "Probes", "Surfaces", "Camera", "Picture", "Times"}) {
    open(tab);
    expect(tab);
  }
}

TEST_F(PanelsLook, OfLampsThatAreChosen) {
  open("Light");
  app().document.edit("x", [](Edits& e) { e.lights[1].world = glm::mat4(1), e.lights[2].on = false; });
  for (int i = 0; i < 4; ++i) {
    app().selection = {Kind::light, i};
    expect("lamp-" + std::to_string(i));
  }
}

TEST_F(PanelsLook, OfProbesWithLight) {
  take_probes();
  app().settings.hier = true;
  app().settings.graph = app().settings.names = true;
  app().selection = {Kind::sphl, 3};
  open("Probes");
  expect("probes-fixed");
  app().settings.lookup = probes::LookupMethod::light;
  app().settings.ball_size = 0.25f;
  app().place_mode = true;
  probes::ProbeSet set = app().light.set();
  probes::hier(set, {});
  app().light.take(std::move(set), "again.sphl");
  expect("probes-hierarchy");
}

TEST_F(PanelsLook, OfASurfaceThatIsChosen) {
  app().selection = {Kind::material, 2};
  open("Surfaces");
  expect("surface-chosen");
  app().selection = {Kind::material, 1};
  expect("surface-nameless");
}

TEST_F(PanelsLook, OfBookmarks) {
  for (int i = 0; i < 3; ++i) append(app().bookmarks, {"mark", 0, 0.5f, app().view}, 1.5f);
  app().path_time = 1;
  app().path_plays = true;
  app().view.orthographic = true;
  open("Camera");
  expect("bookmarks");
}

TEST_F(PanelsLook, OfComparisons) {
  open("Picture");
  for (const Show show : {Show::wipe, Show::pixelated, Show::signed_}) {
    app().settings.show = show;
    app().settings.wipe = 0.25f;
    app().settings.debug = show == Show::signed_ ? DebugView::leak : DebugView::none;
    expect("comparison-" + std::string(name_of(show)));
  }
}

TEST_F(PanelsLook, OfTimes) {
  app().report.renderer = "a renderer";
  app().last_stats.draw_calls = 12, app().last_stats.triangles = 345;
  app().last_stats.bytes_uploaded = 10240, app().last_stats.shadow_maps_drawn = 7;
  for (const double ms : {1.0, 4.0, 2.0}) app().times.add("frame", ms), app().times.add("relight", 2 * ms);
  open("Times");
  expect("times");
}

TEST_F(PanelsLook, OfMenus) {
  for (const char* menu : {"File", "Edit", "View", "Help"}) {
    rest();
    const DrawnThing at = text(menu);
    click(at.from.x + 3, at.from.y + 5);
    frames(3);
    expect_drawn(std::string("menu-") + menu, drawn_listing());
    click(990, 1200);
    press({256});  // Escape
  }
}

TEST_F(PanelsLook, OfMessagesAndHelp) {
  app().say("something is told");
  app().help = true;
  expect("message");
  window_->clock += 3.99;
  rest();
  EXPECT_TRUE(shows("something is told"));
  window_->clock += 0.02;
  rest();
  EXPECT_FALSE(shows("something is told"));
  app().complain("something is wrong");
  app().help = false;
  expect("complaint");
  window_->clock += 14.99;
  rest();
  EXPECT_TRUE(shows("something is wrong"));
  window_->clock += 0.02;
  rest();
  EXPECT_FALSE(shows("something is wrong"));
}

TEST_F(PanelsLook, OfWindowsWithoutAScene) {
  start(500, 300);
  expect("empty");
  app().panels = false;
  expect("bare");
  app().take_document(document("two-rooms"));
  app().settings.show = Show::wipe;
  app().document.edit("x", [](Edits& e) { e.sphls.clear(); });
  app().panels = true;
  expect("without-sphls");
}

TEST_F(PanelsLook, TipsTellWhatWidgetsAreFor) {
  take_probes();
  app().settings.hier = true;
  app().selection = {Kind::sphl, 3};
  app().settings.show = Show::pixelated;
  append(app().bookmarks, {"mark", 0, 0.5f, app().view});
  app().times.add("frame", 3);
  const auto expect_tips = [&](const std::string& tab, std::initializer_list<float> columns,
                               float step = 18) {
    open(tab.c_str());
    expect_drawn("tips-" + tab, tips(columns, step));
  };
  expect_tips("Probes", {22, 200});
  expect_tips("Picture", {200});
  app().selection = {Kind::light, 0};
  expect_tips("Light", {22, 200});
  app().selection = {Kind::material, 2};
  expect_tips("Surfaces", {200});
  expect_tips("Camera", {353}, 11);
  expect_tips("Times", {200});
  std::string bar;
  for (const float x : {390.0f, 600.0f}) {
    mouse(x, 1480), mouse(x, 1480);
    bar += drawn_listing().substr(drawn_listing().find("##Tooltip"));
  }
  expect_drawn("tips-bar", bar);
}

TEST_F(PanelsLook, TheLook) {
  std::string all;
  for (const float scale : {1.0f, 2.0f}) {
    ImGui::GetStyle() = {};
    apply_look(scale);
    const ImGuiStyle& s = ImGui::GetStyle();
    all += fmt::format(
        "x{}: rounding {} {} {} {} {}, border {}, padding {},{} {},{} spacing {},{} bar {} grab {}\n", scale,
        s.WindowRounding, s.FrameRounding, s.GrabRounding, s.TabRounding, s.PopupRounding, s.WindowBorderSize,
        s.FramePadding.x, s.FramePadding.y, s.WindowPadding.x, s.WindowPadding.y, s.ItemSpacing.x,
        s.ItemSpacing.y, s.ScrollbarSize, s.GrabMinSize);
  }
  for (int i = 0; i < ImGuiCol_COUNT; ++i) {
    const ImVec4 c = ImGui::GetStyle().Colors[i];
    all += fmt::format("{}: {:.3f} {:.3f} {:.3f} {:.3f}\n", ImGui::GetStyleColorName(i), c.x, c.y, c.z, c.w);
  }
  expect_drawn("look", all);
}

}  // namespace
}  // namespace ssphh::viewer
