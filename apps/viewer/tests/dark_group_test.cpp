// A scene that is opened with a dark light group: as dark as without that light, and as bright as ever once
// it is turned up.

#include <ssphh/image/io.h>
#include <ssphh/scene/with_lighting.h>

#include "gl_stage.h"

namespace ssphh::viewer {
namespace {

class DarkGroup : public GlStage {
 protected:
  void prepare() override {
    options_.settings = {{"exposure", "0"}, {"antialias", "off"}};
    load_ = [this](const std::string&) { return scene_; };
  }
  void ready() override {}

  /// Direct light of the scene that is open.
  image::Image light(const std::string& file) {
    turn();
    EXPECT_TRUE(turn_until([&] { return app().settled(); }, [&] { turn(); }));
    app().screenshot(file, false);
    EXPECT_TRUE(turn_until([&] { return std::filesystem::exists(file); }, [&] { turn(); }));
    return image::read_image(file);
  }
  image::Image opened(const scene::Scene& scene, const std::string& file) {
    scene_ = scene;
    app().open("builtin:stage");
    app().view = view_of(scene::camera_pose(scene, ""), 3);
    return light(file);
  }
  /// The most that two pictures differ by; light is of the order of 1.
  static float apart(const image::Image& a, const image::Image& b) {
    float most = 0;
    for (std::size_t i = 0; i < a.pixels.size(); ++i)
      most = std::max(most, std::abs(a.pixels[i] - b.pixels.at(i)));
    return most;
  }

  scene::Scene scene_;
};

TEST_F(DarkGroup, OpensDarkAndIsTurnedUp) {
  const scene::Scene lit = scene::make_builtin("gallery1");
  scene::Scene kept = lit;
  kept.dark_groups = {"cove"};
  const image::Image bright = opened(lit, "lit.exr");
  const image::Image black = opened(scene::without_dark_light(kept), "black.exr");
  ASSERT_GT(apart(bright, black), 0.5f) << "the cove is seen";
  // Half floats in the renderer: 2^-10 of light of at most 4
  EXPECT_LT(apart(opened(kept, "dark.exr"), black), 0.004f);
  app().edit("turn up", [](Edits& e) { e.groups["cove"] = vec3(1); });
  EXPECT_LT(apart(light("up.exr"), bright), 0.004f);
}

}  // namespace
}  // namespace ssphh::viewer
