// What is seen of a scene before all of its light is there.

#include <atomic>
#include <chrono>
#include <filesystem>
#include <memory>
#include <thread>
#include <utility>
#include <vector>

#include "error_message.h"
#include "gl_stage.h"

namespace ssphh::viewer {
namespace {

class FirstPicture : public GlStage {
 protected:
  void prepare() override {
    options_.probes = "off";
    options_.settings = {{"antialias", "off"}};
  }
  void ready() override { app().open("builtin:cornell"); }
};

TEST_F(FirstPicture, IsShownAsSuitsItAndDrawnOnce) {
  ASSERT_TRUE(turn_until([&] { return app().screen.pictures > 0; }, [&] { turn(); }));
  ASSERT_TRUE(app().screen.suits);
  EXPECT_NE(*app().screen.suits, Settings{}.exposure) << "nothing is told by what suits at once";
  EXPECT_EQ(app().settings.exposure, *app().screen.suits);
  const std::vector<std::uint8_t> first = app().picture.pixels().rgba;
  for (int i = 0; i < 5; ++i) turn();
  EXPECT_EQ(app().screen.pictures, 1);
  app().screen.scene_dirty = true;
  ASSERT_TRUE(turn_until([&] { return app().screen.pictures > 1; }, [&] { turn(); }));
  EXPECT_EQ(app().picture.pixels().rgba, first) << "as it would be drawn with that exposure";
}

TEST_F(FirstPicture, AnotherExposureOrCurveIsShownWithoutAFrame) {
  const auto frames = [&] {
    for (const FrameTimes::Stage& stage : app().times.stages())
      if (stage.name == "frame") return stage.ms.count();
    return 0;
  };
  const auto turns = [&](int count) {
    for (int i = 0; i < count; ++i) turn();
  };
  ASSERT_TRUE(turn_until([&] { return app().screen.pictures > 0; }, [&] { turn(); }));
  turns(5);
  const std::vector<std::uint8_t> first = app().picture.pixels().rgba;
  app().settings.auto_exposure = false;
  app().settings.exposure += 1, app().settings.curve = image::ToneCurve::clip;
  app().redraw();
  turns(5);
  EXPECT_EQ(frames(), 1);
  const std::vector<std::uint8_t> other = app().picture.pixels().rgba;
  EXPECT_NE(other, first);
  app().screen.scene_dirty = true;
  app().redraw();
  turns(5);
  EXPECT_EQ(frames(), 2);
  EXPECT_EQ(app().picture.pixels().rgba, other) << "as it is drawn for that exposure";
  // What is looked up otherwise takes a frame
  app().settings.curve = image::ToneCurve::filmic, app().settings.debug = DebugView::direct;
  app().redraw();
  turns(5);
  EXPECT_EQ(frames(), 3);
  // Gliding to what suits takes none after that
  app().settings.debug = DebugView::none;
  app().settings.exposure -= 4, app().settings.auto_exposure = true;
  app().redraw();
  turns(60);
  EXPECT_EQ(app().settings.exposure, *app().screen.suits);
  EXPECT_EQ(frames(), 4);
}

class WaitingPicture : public GlStage {
 protected:
  void prepare() override {
    size_ = {600, 400};
    options_.probes = "off";
  }
  void ready() override { app().open("builtin:cornell"); }
};

TEST_F(WaitingPicture, IsSmallWithoutSmoothEdgesUntilItsLightIsThere) {
  if (!software()) GTEST_SKIP() << "frames are fast: none is drawn small";
  std::atomic<bool> end = false;
  app().job.start("light", [&](const Control&) -> BackgroundJob::Finish {
    while (!end) std::this_thread::sleep_for(std::chrono::milliseconds(1));
    return {};
  });
  ASSERT_TRUE(turn_until([&] { return app().screen.pictures > 0; }, [&] { turn(); }));
  for (int i = 0; i < 40; ++i) turn();
  EXPECT_EQ(app().picture.width(), 240);
  EXPECT_EQ(app().picture.averaged(), 1);
  end = true;
  ASSERT_TRUE(turn_until([&] { return app().settled(); }, [&] { turn(); }));
  EXPECT_EQ(app().picture.width(), 600);
  EXPECT_EQ(app().picture.averaged(), App::smooth_pictures);
}

class LargeFirstPicture : public GlStage {
 protected:
  void prepare() override {
    size_ = {600, 400};
    options_.probes = "auto:2";
    options_.records = 0;
    options_.transport = {.directions = 32, .surfel_size = 0.5f, .link_rays = 8};
    options_.settings = {{"antialias", "off"}};
  }
  void ready() override { app().open_lit("builtin:two-rooms"); }
};

TEST_F(LargeFirstPicture, OfASceneAndOfItsLightAreSmallAndThenWhole) {
  std::vector<int> dark, lit;  // widths of the pictures that became whole
  int pictures = 0;
  ASSERT_TRUE(turn_until([&] { return app().settled() && !lit.empty(); },
                         [&] {
                           turn();
                           if (std::exchange(pictures, app().screen.pictures) != app().screen.pictures)
                             (app().light.empty() ? dark : lit).push_back(app().picture.width());
                         }));
  EXPECT_EQ(lit.front(), software() ? 240 : 600);
  EXPECT_EQ(lit.back(), 600);
  for (const int width : dark) EXPECT_EQ(width, software() ? 240 : 600) << "while light is on its way";
}

class Glance : public GlStage {
 protected:
  void prepare() override {
    options_.probes = "off";
    options_.transport = {.directions = 32, .surfel_size = 0.5f, .link_rays = 8};
  }
  void ready() override { app().open("builtin:two-rooms"); }
};

TEST_F(Glance, IsNotSavedAsTheWholeLight) {
  LiveLightParams params;
  params.relight.transport = options_.transport;
  params.places = app().document.places();
  app().light.take(std::make_shared<LiveLight>(app().document.scene, at_a_glance(params), 0.0f));
  turn();
  EXPECT_EQ(test::message_of([&] { app().save_probes(dir_ / "probes.sphl"); }),
            (dir_ / "probes.sphl").string() +
                ": the probes hold light at a glance (“Light them live” in the panel Probes finds the whole "
                "of it)");
  EXPECT_FALSE(std::filesystem::exists(dir_ / "probes.sphl"));
  app().light_scene_probes();
  ASSERT_TRUE(turn_until([&] { return !app().job.running() && !app().light.is_glance(); }, [&] { turn(); }));
  app().save_probes(dir_ / "probes.sphl");
  EXPECT_TRUE(std::filesystem::exists(dir_ / "probes.sphl"));
}

}  // namespace
}  // namespace ssphh::viewer
