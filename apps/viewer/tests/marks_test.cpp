// Marks over the window's picture: those of `ssphh render --draw`, for the light, the pose and the view of
// now.

#include "model/marks.h"

#include <cmath>

#include <gmock/gmock.h>

#include <ssphh/core/file.h>
#include <ssphh/methods/method_list.h>
#include <ssphh/pipeline/draw_marks.h>
#include <ssphh/trace/transport_scene.h>

#include "gl_stage.h"

namespace ssphh::viewer {
namespace {

class MarkedPicture : public GlStage {
 protected:
  void prepare() override {
    options_.records = 0;
    options_.settings = {{"exposure", "1"}, {"tonemap", "clip"}};
  }
  void ready() override {
    window_->tick = 1.0 / 1024;
    app().open_lit("builtin:cornell");
    play("settle");
  }
  image::Rgba8 shot() {
    app().screenshot("shot.png", false);
    return image::decode_rgba8(read_file("shot.png"), "shot.png");
  }
  /// What the command draws over the same radiance.
  image::Rgba8 expected(const sketch::Sketch& marks) {
    const scene::Scene scene = app().document.edited();
    image::Image picture = app().picture.linear();
    trace::RenderParams params;
    params.width = picture.width, params.height = picture.height;
    params.camera = pose_of(app().view);
    const auto geometry = std::make_shared<const trace::SceneGeometry>(scene);
    pipeline::draw_marks(picture, marks, geometry, scene, app().document.time, params, std::exp2(-1.0f));
    return image::to_display(picture, {1, image::ToneCurve::clip, 0});
  }
};

TEST_F(MarkedPicture, OfTheWindowsOwnLight) {
  const image::Rgba8 plain = shot();
  play("set draw hierarchy");
  const sketch::Sketch balls = methods::hierarchy_drawing(app().light.set());
  ASSERT_FALSE(balls.empty());
  const image::Rgba8 first = shot();
  EXPECT_EQ(first.rgba, expected(balls).rgba);
  EXPECT_NE(first.rgba, plain.rgba);
  play("set draw surfels,links");
  sketch::Sketch patches = methods::surfels_drawing(app().light.live_light()->session().network());
  patches += methods::links_drawing(app().light.live_light()->session().network());
  EXPECT_EQ(shot().rgba, expected(patches).rgba);
  play("set draw none");
  EXPECT_EQ(shot().rgba, plain.rgba);
}

TEST_F(MarkedPicture, OfAMethodThatIsMadeForThemFollowsLampsAndView) {
  const auto photons = [&] {
    const scene::Scene scene = app().document.edited();
    const trace::TransportScene source(scene);
    const methods::MethodEntry& vpl = methods::find_method("vpl");
    const auto method = vpl.make({scene, source}, {vpl.name, vpl.parameters}, {});
    method->update(rays::lighting_at(source, 0), {});
    return method->drawing(methods::Drawing::photons);
  };
  play("set draw photons");
  EXPECT_EQ(shot().rgba, expected(photons()).rgba);
  play("view 0.3 1 2.5 0 1 0");
  EXPECT_EQ(shot().rgba, expected(photons()).rgba) << "from elsewhere";
  play("sphl 0.4 1.2 0.1");
  EXPECT_EQ(shot().rgba, expected(photons()).rgba) << "with a node more than was opened";
  play("material white 0.9 0.1 0.1");
  EXPECT_EQ(shot().rgba, expected(photons()).rgba) << "of other surfaces";
}

TEST_F(MarkedPicture, GivesWayToFalseColours) {
  play("set draw hierarchy\nset false-color on");
  EXPECT_EQ(shot().rgba, false_color(app().picture.linear(), 1).rgba);
  play("set false-color off");
  EXPECT_EQ(shot().rgba, expected(methods::hierarchy_drawing(app().light.set())).rgba);
}

TEST(MarksOfMethods, EachHasAMethodThatDrawsIt) {
  for (const std::string& name : names_of<methods::Drawing>()) {
    const methods::Drawing what = *parse_enum<methods::Drawing>(name);
    const methods::MethodEntry& entry = methods::find_method(method_drawing(what));
    EXPECT_EQ(std::ranges::count(entry.drawings, what), 1) << name;
  }
}

TEST(DrawSetting, TakesSeveralAndRefusesWhatThereIsNot) {
  Settings settings;
  set_setting(settings, "draw", "links,surfels,links");
  EXPECT_EQ(settings.draw, (std::vector{methods::Drawing::links, methods::Drawing::surfels}));
  EXPECT_THROW(set_setting(settings, "draw", "voxel"), Error);
  EXPECT_THROW(set_setting(settings, "draw", "none,links"), Error);
  EXPECT_EQ(settings.draw.size(), 2u) << "stays as it was";
}

}  // namespace
}  // namespace ssphh::viewer
