// What leaves the picture, and the truth traced of it, as they are while frames are slow.

#include "gl_stage.h"

namespace ssphh::viewer {
namespace {

class StillPicture : public GlStage {
 protected:
  void prepare() override {
    options_.records = 256;
    options_.transport = {.directions = 64, .surfel_size = 0.5f, .link_rays = 8};
    options_.settings = {{"exposure", "0"}, {"show", "wipe"}, {"truth-spp", "1"}, {"truth-depth", "1"}};
  }
  void ready() override {
    app().open("builtin:two-rooms");
    // Over a point where no lamp is.
    app().view = look_at({-1, 1.5f, 1.9f}, {5, 1.5f, 1.9f}, 1);
    while (!app().settled()) {
      window_->clock += 0.05;
      turn();
      std::this_thread::sleep_for(std::chrono::milliseconds(1));
    }
  }

  /// A turn with the mouse at a point, after a frame that took a tenth of a second.
  void mouse_at(float x, float y, std::array<bool, 3> buttons = {}) {
    app().last_stats.cpu_ms = 100;
    InjectedInput input;
    input.mouse = {x, y}, input.buttons = buttons;
    turn(input);
  }
  void expect_same_truth() {
    EXPECT_EQ(app().picture.width(), 64);
    EXPECT_EQ(app().reference.image().color, truth_) << "the truth has begun anew";
  }

  std::shared_ptr<const image::Image> truth_;
};

TEST_F(StillPicture, ASceneGetsItsLightHoweverItIsOpened) {
  // Work for a scene that is gone ends when it can; its result is dropped.
  const auto is_lit = [&] {
    while (!app().job.idle()) {
      std::this_thread::sleep_for(std::chrono::milliseconds(1));
      app().job.poll();
    }
    return !app().light.empty();
  };
  EXPECT_FALSE(is_lit()) << "open() alone leaves the light to its caller";
  window_->dropped = {"builtin:two-rooms"};
  turn();
  EXPECT_TRUE(is_lit());
  load_ = [](const std::string& source) {
    scene::Scene scene = scene::make_builtin("two-rooms");
    if (source == "bare.glb") scene.sphls.clear();
    return scene;
  };
  window_->dropped = {"bare.glb"};
  turn();
  EXPECT_TRUE(is_lit()) << "it has no SPHLs: places are found";
  options_.probes = "auto";
  app().request_open("bare.glb");
  EXPECT_TRUE(is_lit());
  EXPECT_EQ(app().job.status().name, "surface records");
  options_.probes = "off";
  app().request_open("builtin:two-rooms");
  EXPECT_FALSE(is_lit());
  // After a question, too. A probe file is of the first scene.
  options_.probes = "first.sphl";
  app().document.edit_at_once("dim", [](Edits& e) { e.lights[0].intensity = 0.5f; });
  app().request_open("builtin:two-rooms");
  EXPECT_FALSE(is_lit());
  app().answer(Answer::discard);
  EXPECT_TRUE(is_lit());
  EXPECT_FALSE(app().document.dirty());
}

TEST_F(StillPicture, ThePressAndTheWipesLineRestartNothingAndTheViewDoes) {
  truth_ = app().reference.image().color;
  ASSERT_NE(truth_, nullptr);
  mouse_at(32, 24), mouse_at(32, 24, {true});
  EXPECT_EQ(app().drag.what, Drag::What::wipe);
  expect_same_truth();
  mouse_at(48, 24, {true}), mouse_at(48, 24, {true});
  EXPECT_EQ(app().settings.wipe, 0.75f);
  expect_same_truth();
  mouse_at(48, 24), mouse_at(10, 40);
  for (const std::array<bool, 3> button :
       {std::array{true, false, false}, std::array{false, true, false}, std::array{false, false, true}}) {
    mouse_at(10, 40, button), mouse_at(10, 40, button), mouse_at(10, 40);
    expect_same_truth();
  }
  mouse_at(10, 40, {true}), mouse_at(20, 40, {true});
  EXPECT_EQ(app().picture.width(), 26) << "0.4 of its width while the view turns slowly";
  EXPECT_EQ(app().reference.image().color, nullptr);
  mouse_at(20, 40), mouse_at(20, 40);
  EXPECT_EQ(app().picture.width(), 64);
}

}  // namespace
}  // namespace ssphh::viewer
