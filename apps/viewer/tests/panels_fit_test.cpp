// Every word of the window is whole, on small screens and on dense ones.

#include <algorithm>
#include <map>

#include <gmock/gmock.h>

#include "panel_stage.h"

namespace ssphh::viewer {
namespace {

constexpr const char* names[] = {"Light", "Probes", "Surfaces", "Camera", "Picture", "Times", "Scene"};

struct Screen {
  int width, height;
  float scale;
};
constexpr Screen screens[] = {{800, 600, 1}, {1280, 800, 1}, {800, 600, 2}, {1280, 800, 2}};

class PanelsFit : public PanelStage {
 protected:
  void open_on(const Screen& screen) {
    const std::shared_ptr<const scene::Scene> scene = app().document.scene;
    start(screen.width, screen.height, screen.scale);
    app().take_document(make_document("builtin:stage", *scene, 0));
    take_probes();
    where_ = fmt::format("{}x{}, {}x: ", screen.width, screen.height, screen.scale);
  }
  /// Of what is drawn now: texts that are not whole, and those that a widget in their line covers.
  void expect_whole(const std::string& what) {
    const ImDrawData& data = *ImGui::GetDrawData();
    for (int i = 0; i < data.CmdListsCount; ++i) expect_whole(what, drawn_things(*data.CmdLists[i]));
  }
  void expect_whole(const std::string& what, const std::vector<DrawnThing>& things) {
    for (const DrawnThing& thing : things) {
      if (thing.text.empty()) continue;
      EXPECT_FALSE(thing.cut) << where_ << what << ": \"" << thing.text << "\" is cut";
      for (const DrawnThing& over : things) {
        const bool frame = over.text.empty() && over.color == 0x303032ff && over.from.y < thing.from.y + 3 &&
                           over.to.y > thing.from.y + 3;
        EXPECT_FALSE(frame && over.from.x > thing.from.x && over.from.x < thing.end - 0.5f)
            << where_ << what << ": \"" << thing.text << "\" goes on under a widget";
      }
    }
  }

  std::string where_;
};

TEST_F(PanelsFit, EveryWordOfEveryTab) {
  for (const Screen& screen : screens) {
    open_on(screen);
    app().settings.hier = true;
    app().settings.show = Show::pixelated;
    append(app().bookmarks, {"mark", 0, 0.5f, app().view});
    append(app().bookmarks, {"mark", 0, 0.5f, app().view});
    for (const double ms : {1.0, 4.0}) app().times.add("frame", ms), app().times.add("relight", 2 * ms);
    for (const char* tab : names) {
      for (const Selection& chosen : {Selection{Kind::light, 1}, {Kind::sphl, 3}, {Kind::material, 2}}) {
        app().selection = chosen;
        open(tab);
        expect_whole(tab);
      }
      // What lies below, too
      while (std::string(tab) != "Scene") {
        const DrawnThing before = all_things().back();
        window_->wheel = -4;
        mouse(30, 0.7f * static_cast<float>(screen.height));
        frames(1);
        expect_whole(tab);
        const DrawnThing after = all_things().back();
        if (before.text == after.text && before.from.y == after.from.y) break;
      }
    }
    for (const char* name : names) EXPECT_TRUE(shows(name)) << where_ << "no tab is hidden";
  }
}

TEST_F(PanelsFit, ATickBoxStandsBesideItsLabelInNarrowPanelsToo) {
  open_on({800, 600, 2});
  open("Picture");
  const DrawnThing box = widget("automatic");
  EXPECT_NEAR(box.to.x - box.from.x, box.to.y - box.from.y, 1) << "as wide as high";
  click(0.5f * (box.from.x + box.to.x), 0.5f * (box.from.y + box.to.y));
  EXPECT_FALSE(app().settings.auto_exposure);
}

TEST_F(PanelsFit, HelpQuestionsMessagesAndWork) {
  for (const Screen& screen : screens) {
    open_on(screen);
    rest();
    app().help = true;
    rest();
    expect_whole("help");
    const DrawnThing first = text("click");
    EXPECT_GE(first.from.y, 0) << where_;
    if (screen.scale == 1) {
      EXPECT_LT(text("Escape").from.y + 14, static_cast<float>(screen.height)) << where_;
    }
    app().help = false;
    app().say(
        "a message of some length that tells what was done and where it was written to, for whom it minds");
    rest();
    expect_whole("message");
    app().light.clear();
    for (int i = 0; i < 8; ++i) rest();
    expect_whole("offer");
    app().question = {Question::Then::recover, {}, {"a", "/home/someone/scenes/kitchen.glb", "", "12:34"}};
    rest();
    expect_whole("question");
    app().question = {};
    rest();
    app().ask_for_file(FileDialog::For::scene);
    rest();
    expect_whole("files");
    app().dialog.reset();
    rest();
  }
}

TEST_F(PanelsFit, HistogramWaveformAndLegend) {
  for (const Screen& screen : screens) {
    open_on(screen);
    app().settings.histogram = app().settings.waveform = app().settings.false_color = true;
    app().histogram.emplace(), app().truth_histogram.emplace(), app().waveform.emplace();
    for (int i = 0; i < 3; ++i) rest();
    expect_whole("readings");
    EXPECT_TRUE(shows("darker") && shows("white line")) << where_;
    EXPECT_TRUE(shows("+8")) << where_;
    const bool small = screen.width < 1000 && screen.scale > 1;
    EXPECT_NE(shows("red, green, blue"), small) << where_ << "left out where there is no room";
    for (const DrawnThing& thing : all_things()) {
      if (!thing.text.starts_with("red, green")) continue;
      EXPECT_GE(thing.from.y, app().viewport.y) << where_;
    }
  }
}

/// Grounds of the windows of these names, as drawn now.
class OverThePicture : public PanelsFit {
 protected:
  std::map<std::string, Rect2> grounds() {
    std::map<std::string, Rect2> grounds;
    const ImDrawData& data = *ImGui::GetDrawData();
    for (int i = 0; i < data.CmdListsCount; ++i) {
      // The first thing that a window draws is its ground.
      const DrawnThing ground = drawn_things(*data.CmdLists[i]).front();
      grounds[data.CmdLists[i]->_OwnerName] = {ground.from.x, ground.from.y, ground.to.x - ground.from.x,
                                               ground.to.y - ground.from.y};
    }
    return grounds;
  }
};

TEST_F(OverThePicture, ValuesStandBelowTheOfferAndNothingShinesThroughThem) {
  for (const Screen& screen : screens) {
    open_on(screen);
    app().light.clear();
    app().inspecting = true;
    app().inspection.emplace().radiance = vec3(0.008926f, 0.007249f, 0.02231f);
    app().inspection->surface.emplace().object = "block";
    app().inspection->surface->distance = 1.7f;
    const Rect2 v = app().viewport;
    for (const float x : {0.2f, 0.8f}) {
      for (int i = 0; i < 5; ++i) mouse(v.x + x * v.width, v.y + 0.9f * v.height);
      const auto drawn = grounds();
      ASSERT_TRUE(drawn.contains("offer") && drawn.contains("inspector")) << where_;
      const Rect2 offer = drawn.at("offer"), values = drawn.at("inspector");
      EXPECT_GE(values.y, offer.y + offer.height) << where_;
      EXPECT_GE(values.x, 0) << where_;
      EXPECT_LE(values.x + values.width, static_cast<float>(screen.width)) << where_;
      EXPECT_LE(values.y + values.height, static_cast<float>(screen.height)) << where_;
      expect_whole("values");
    }
  }
}

TEST_F(OverThePicture, ValuesEndWithTheWindowHoweverManyProbesLightThePoint) {
  for (const Screen& screen : screens) {
    open_on(screen);
    app().settings.weights = probes::WeightMethod::distance;
    app().inspecting = true;
    app().view = look_at({0.5f, 2, 17}, {0, 1, 0}, 1);
    rest();
    const Rect2 v = app().viewport;
    for (int i = 0; i < 5; ++i) mouse(v.x + 0.5f * v.width, v.y + 0.5f * v.height);
    ASSERT_TRUE(app().inspection && app().inspection->light.shares.size() > 1) << where_;
    const Rect2 values = grounds().at("inspector");
    EXPECT_LE(values.y + values.height, static_cast<float>(screen.height)) << where_;
    expect_whole("values");
  }
}

TEST_F(OverThePicture, NothingElseStandsThereWhileTheKeysAreListed) {
  for (const Screen& screen : screens) {
    open_on(screen);
    app().light.clear();
    app().settings.histogram = true, app().histogram.emplace();
    for (int i = 0; i < 3; ++i) rest();
    EXPECT_TRUE(grounds().contains("offer")) << where_;
    app().help = true;
    for (int i = 0; i < 3; ++i) rest();
    for (const char* name : {"offer", "plots"}) EXPECT_FALSE(grounds().contains(name)) << where_ << name;
    EXPECT_TRUE(grounds().contains("help")) << where_;
  }
}

TEST_F(PanelsFit, WhatIsOverThePictureCoversNothingOfItsKind) {
  for (const Screen& screen : screens) {
    open_on(screen);
    app().settings.histogram = app().settings.waveform = app().settings.false_color = true;
    app().histogram.emplace(), app().truth_histogram.emplace(), app().waveform.emplace();
    for (const bool more : {false, true}) {
      if (more) app().light.clear(), app().say("a message of some length that tells what was done");
      for (int i = 0; i < 4; ++i) rest();
      std::vector<std::pair<std::string, Rect2>> windows;
      const ImDrawData& data = *ImGui::GetDrawData();
      for (int i = 0; i < data.CmdListsCount; ++i) {
        const std::string name = data.CmdLists[i]->_OwnerName;
        if (name != "plots" && name != "legend" && name != "offer" && name != "message") continue;
        // The first thing that a window draws is its ground.
        const DrawnThing ground = drawn_things(*data.CmdLists[i]).front();
        windows.push_back(
            {name, {ground.from.x, ground.from.y, ground.to.x - ground.from.x, ground.to.y - ground.from.y}});
      }
      EXPECT_GE(windows.size(), more ? 2u : 1u) << where_;
      const Rect2& v = app().viewport;
      for (const auto& [name, a] : windows) {
        EXPECT_GE(a.y, v.y) << where_ << name;
        EXPECT_LE(a.x + a.width, v.x + v.width) << where_ << name;
        for (const auto& [other, b] : windows) {
          if (name >= other) continue;
          const bool apart =
              a.x + a.width <= b.x || b.x + b.width <= a.x || a.y + a.height <= b.y || b.y + b.height <= a.y;
          EXPECT_TRUE(apart) << where_ << name << " and " << other;
        }
      }
    }
  }
}

TEST_F(PanelsFit, TheEdgeOfThePanelsFollowsTheMouse) {
  rest();
  const float before = app().viewport.x;
  drag(before - 2, 700, before + 98, 700);
  EXPECT_NEAR(app().viewport.x, before + 98, 3);
  drag(app().viewport.x - 2, 700, 2, 700);
  EXPECT_GT(app().viewport.x, 100) << "words still have room";
  drag(app().viewport.x - 2, 700, 990, 700);
  EXPECT_NEAR(app().viewport.x, 750, 1) << "a part of the picture stays";
  // Wider panels show their labels beside their fields.
  app().side_width = 0;
  rest();
  EXPECT_EQ(app().viewport.x, before);
}

}  // namespace
}  // namespace ssphh::viewer
