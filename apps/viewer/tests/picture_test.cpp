// The real-time picture in the App: what edits, settings, probes and ground truth make of it.

#include "picture.h"

#include <algorithm>

#include <gmock/gmock.h>

#include <ssphh/core/file.h>
#include <ssphh/probes/probe_file.h>

#include "drawn.h"
#include "gl_stage.h"

namespace ssphh::viewer {
namespace {

using testing::HasSubstr;

TEST(PictureSettings, EachDebugViewIsTheRenderersView) {
  const std::pair<DebugView, realtime::View> views[] = {
      {DebugView::none, realtime::View::lit},          {DebugView::direct, realtime::View::direct},
      {DebugView::indirect, realtime::View::indirect}, {DebugView::leak, realtime::View::indirect},
      {DebugView::albedo, realtime::View::albedo},     {DebugView::normal, realtime::View::normal},
      {DebugView::shadow, realtime::View::shadow},     {DebugView::sphl, realtime::View::chosen_sphl}};
  for (const auto& [debug, view] : views) {
    Settings s;
    s.debug = debug;
    EXPECT_EQ(frame_settings(s).view, view) << name_of(debug);
    EXPECT_EQ(shown_tone(s).curve == s.curve, debug < DebugView::albedo || debug == DebugView::leak);
    EXPECT_EQ(needs_truth(s), debug == DebugView::leak);
    EXPECT_EQ(frame_settings(s).indirect_scale, debug == DebugView::leak ? 1 : 3);
  }
  Settings s;
  s.show = Show::truth;
  EXPECT_TRUE(needs_truth(s));
  s.show = Show::realtime;
  s.exposure = 2, s.curve = image::ToneCurve::filmic;
  s.lookup = probes::LookupMethod::light, s.weights = probes::WeightMethod::trilinear;
  const realtime::FrameSettings f = frame_settings(s);
  EXPECT_EQ(f.tone.exposure, 2);
  EXPECT_EQ(f.tone.curve, image::ToneCurve::filmic);
  EXPECT_EQ(f.tone.gamma, 0);
  EXPECT_EQ(f.lookup, probes::LookupMethod::light);
  EXPECT_EQ(f.weights, probes::WeightMethod::trilinear);
}

TEST(PictureSettings, ThoseOfTheScreenAndTheTruthLeaveThePictureAsItIs) {
  const std::set<std::string> others = {"scale",       "show",      "wipe",      "block",       "against",
                                        "truth-depth", "truth-spp", "graph",     "names",       "play",
                                        "speed",       "histogram", "waveform",  "false-color", "draw",
                                        "quality",     "snap",      "snap-step", "snap-angle",  "views"};
  for (const SettingName& setting : setting_names()) {
    Settings changed;
    const std::string now = setting.get(changed);
    if (setting.choices.empty())
      setting.set(changed, now == "1" ? "2" : "1");
    else
      setting.set(changed, setting.choices[0] == now ? setting.choices[1] : setting.choices[0]);
    ASSERT_NE(changed, Settings{}) << setting.name;
    EXPECT_EQ(same_picture(Settings{}, changed), others.contains(setting.name)) << setting.name;
  }
  EXPECT_TRUE(same_picture({}, {}));
}

/// One App after the other in one context: compiling the renderer's shaders is what takes time.
class PictureTest : public GlStage {
 protected:
  void prepare() override {
    options_.time = 0.25f;
    options_.records = 0;  // tests of live light look at records
    options_.settings = {{"exposure", "0"}};
  }
  void ready() override { window_->tick = 1.0 / 1024; }

  void settle() {
    turn();
    const auto done = [&] { return app().settled() || app().message_is_error; };
    ASSERT_TRUE(turn_until(done, [&] { turn(); })) << "does not settle";
    if (app().message_is_error) FAIL() << app().message;
  }
  std::vector<std::uint8_t> shot(const std::string& script = "") {
    play(script);
    return app().picture.pixels().rgba;
  }
  static double mean(const std::vector<std::uint8_t>& rgba) {
    double sum = 0;
    for (std::size_t i = 0; i < rgba.size(); ++i) sum += i % 4 == 3 ? 0 : rgba[i];
    return sum / static_cast<double>(rgba.size());
  }
  static int farthest(const std::vector<std::uint8_t>& a, const std::vector<std::uint8_t>& b) {
    int most = 0;
    for (std::size_t i = 0; i < a.size(); ++i) most = std::max(most, std::abs(a[i] - b[i]));
    return a.size() == b.size() ? most : 999;
  }
  image::Rgba8 file(const std::string& name) { return image::decode_rgba8(read_file(name), name); }

  /// What suits the picture, at once when all has settled; by hand it stays.
  void exposure_follows_the_light() {
    play("view -1 1.5 1.9 -2.4 1 0\nset exposure auto");
    const float full = app().settings.exposure;
    const double look = mean(shot());
    EXPECT_GT(look, 60);
    EXPECT_LT(look, 200);
    play("group lamp 0.125");
    EXPECT_NEAR(app().settings.exposure, full + 3, 0.26f);
    EXPECT_NEAR(mean(shot()), look, 12);
    play("set debug albedo");
    EXPECT_EQ(frame_settings(app().settings).tone.exposure, 0) << "no light is shown";
    play("set debug indirect");
    EXPECT_NEAR(frame_settings(app().settings).tone.exposure, full + 3, 0.26f) << "beside all light";
    play("set debug none\nset exposure -1\ngroup lamp 0.5");
    EXPECT_EQ(app().settings.exposure, -1);
    play("set exposure auto");
    const float lit = app().settings.exposure;
    play("group lamp 0");
    EXPECT_EQ(app().settings.exposure, lit) << "darkness suits any";
    play("undo\nundo\nundo\nset exposure 0");
  }

  /// Until a picture of another size is whole, the last one is what is seen and written.
  void another_size() {
    const std::vector<std::uint8_t> before = shot();
    app().picture.resize(16, 12);
    EXPECT_EQ(app().picture.width(), 16);
    app().screenshot("before.png", false);
    EXPECT_EQ(file("before.png").rgba, before);
    EXPECT_EQ(file("before.png").width, 64);
    Picture none;
    none.resize(16, 12);
    EXPECT_TRUE(none.pixels().rgba.empty());
  }

  /// Edits reach the picture, and taken back leave it as it was.
  void edits_and_undo() {
    play("view -1 1.5 1.9 -2.4 1 0");
    const auto first = shot();
    EXPECT_GT(mean(first), 20);
    for (const char* edit : {"light lamp off", "light lamp color 1 0 0", "light lamp position -3 1 0",
                             "group lamp 0.2", "set exposure -2"}) {
      play(edit);
      const auto changed = app().picture.pixels().rgba;
      EXPECT_GT(farthest(changed, first), 12) << edit;
      play(std::string(edit).starts_with("set") ? "set exposure 0" : "undo");
      EXPECT_LE(farthest(app().picture.pixels().rgba, first), 3) << edit;
    }
  }

  void truth_beside() {
    play("set truth-spp 2\nset truth-depth 3\nset show truth");
    ASSERT_TRUE(app().picture.has_truth());
    const ReferenceImage truth = app().reference.image();
    EXPECT_EQ(truth.passes, 2);
    EXPECT_EQ(truth.color->width, 64);
    EXPECT_EQ(truth.color->height, 48);
    EXPECT_EQ(app().picture.truth_pixels().rgba,
              image::to_display(*truth.color, {0, image::ToneCurve::filmic, 0}).rgba);
    play("screenshot truth.png\nset show pixelated\nset block 8");
    EXPECT_EQ(file("truth.png").rgba, image::to_display(*truth.color, {0, image::ToneCurve::filmic, 0}).rgba);
    const Difference blocks = difference(*truth.color, app().picture.linear(), Show::pixelated, 8);
    EXPECT_EQ(app().picture.truth_pixels().rgba, blocks.picture.rgba);
    EXPECT_EQ(app().picture.shown_difference()->scale, blocks.scale);
    EXPECT_EQ(app().reference.image().color, truth.color) << "the truth is traced once";
    play("set show wipe\nset wipe 0.25\nscreenshot wipe.png");
    const image::Rgba8 wipe = file("wipe.png");
    for (std::size_t i = 0; i < wipe.rgba.size(); ++i) {
      const bool left = i / 4 % 64 < 16;
      ASSERT_EQ(wipe.rgba[i], left ? app().picture.pixels().rgba[i] : app().picture.truth_pixels().rgba[i])
          << i;
    }
    // The window shows both, too: the picture, and right of the line the truth.
    const ImDrawList& list = *ImGui::GetDrawData()->CmdLists[0];
    ASSERT_GE(list.VtxBuffer.Size, 8);
    EXPECT_EQ(list.VtxBuffer[0].pos.x, 0);
    EXPECT_EQ(list.VtxBuffer[0].uv.y, 1);
    EXPECT_EQ(list.VtxBuffer[2].pos.x, 64);
    EXPECT_EQ(list.VtxBuffer[2].pos.y, 48);
    EXPECT_EQ(list.VtxBuffer[2].uv.x, 1);
    EXPECT_EQ(list.VtxBuffer[2].uv.y, 0);
    EXPECT_EQ(list.VtxBuffer[4].pos.x, 16);
    EXPECT_EQ(list.VtxBuffer[4].uv.x, 0.25f);
    EXPECT_EQ(list.VtxBuffer[4].uv.y, 0);
    EXPECT_EQ(list.VtxBuffer[6].pos.x, 64);
    EXPECT_EQ(list.VtxBuffer[6].uv.y, 1);
    play("set debug leak");
    EXPECT_EQ(app().picture.truth_pixels().rgba,
              leak_picture(*app().reference.image().indirect, app().picture.linear()).picture.rgba);
    play("set debug none\nset against ambient");
    EXPECT_EQ(app().reference.status().name, "ambient");
    play("set against path\nlight lamp off");
    EXPECT_EQ(mean(app().picture.truth_pixels().rgba), 255 / 4.0 * 0) << "edits reach the truth";
    play("undo\nset show realtime\nset truth-spp 256");
    EXPECT_EQ(file("wipe.png").width, 64);
  }

  void probes_of_files() {
    EXPECT_TRUE(app().light.live());
    const auto live = shot("light lamp intensity 3");
    app().save_probes("live.sphl");
    EXPECT_EQ(probes::read_probe_file("live.sphl").probes.size(), 6u);
    app().use_probes("live.sphl");
    EXPECT_EQ(app().question.then, Question::Then::take_probes) << "of another lamp than the scene's";
    app().answer(Answer::stay);
    EXPECT_TRUE(app().light.live());
    options_.force = true;
    play("probes live.sphl");
    EXPECT_EQ(app().light.origin(), "live.sphl");
    EXPECT_FALSE(app().light.live());
    EXPECT_EQ(app().document.edits().sphls.size(), 6u);
    EXPECT_EQ(app().document.edits().sphls[2].name, "doorway");
    EXPECT_EQ(app().document.edits().sphls[2].source, -1);
    EXPECT_EQ(app().document.history.undo_name(), "probes of a file");
    EXPECT_EQ(app().message, "live.sphl: 6 probes");
    EXPECT_LE(farthest(app().picture.pixels().rgba, live), 3) << "the file has the light of now";
    const double full = mean(shot("set debug indirect"));
    EXPECT_NEAR(mean(shot("set exposure 1\ngroup lamp 0.5")), full, 1) << "groups scale what is fixed";
    play("undo\nset exposure 0");
    app().save_probes("again.sphl");
    EXPECT_EQ(probes::read_probe_file("again.sphl"), probes::read_probe_file("live.sphl"));
    EXPECT_LT(mean(shot("probes off")), 0.5) << "no indirect light without probes";
    EXPECT_TRUE(app().light.empty());
    EXPECT_NEAR(mean(shot("probes scene")), full, 1)
        << "of lamps as they are now, not as they are in the scene";
    play("set debug none");
  }

  void generated() {
    app().bake_params.path.spp = 4, app().bake_params.face_size = 8, app().bake_params.path.max_depth = 2;
    play("viz");
    const std::size_t edges = probes::edge_count(app().light.set());
    EXPECT_GT(edges, 4u);
    EXPECT_EQ(app().message, fmt::format("VIZ: {} edges", edges));
    EXPECT_TRUE(app().light.live()) << "VIZ leaves the light alone";
    play("set show truth\nset truth-spp 1\nset debug indirect\nset weights mls");
    const auto linear = [&](const std::string& script) {
      play(script);
      return app().picture.linear();
    };
    const image::Image none = linear("");
    const image::Image self = linear("set hier on\nset layer self");
    const image::Image neighbor = linear("set layer neighbor");
    const image::Image sum = linear("set layer sum");
    EXPECT_TRUE(app().light.set().hierarchy.has_value());
    EXPECT_EQ(self.pixels, none.pixels) << "the probes' own light alone is what there is without HIER";
    double most = 0;
    for (std::size_t i = 0; i < sum.pixels.size(); ++i) {
      most = std::max(most, static_cast<double>(neighbor.pixels[i]));
      // Half floats in the renderer: some 2^-10 of each.
      ASSERT_NEAR(sum.pixels[i], self.pixels[i] + neighbor.pixels[i], 4e-3f * sum.pixels[i] + 1e-3f) << i;
    }
    EXPECT_GT(most, 0.001);
    play("set hier off");
    EXPECT_FALSE(app().light.set().hierarchy.has_value());
    EXPECT_EQ(app().picture.linear().pixels, none.pixels);
    play("light lamp intensity 2");
    EXPECT_EQ(probes::edge_count(app().light.set()), edges) << "edges outlive lamps";
    play("set show realtime\nset debug none\nundo\ngen");
    EXPECT_EQ(app().light.origin(), "GEN");
    EXPECT_FALSE(app().light.live());
    EXPECT_EQ(app().light.set().degree, 9);
    EXPECT_GT(probes::edge_count(app().light.set()), 4u);
    EXPECT_EQ(app().message, "GEN is done");
    EXPECT_GT(luminance(app().light.set().probes[0].self[0]), 0.1f);
    app().document.edit("none", [](Edits& e) { e.sphls.clear(); });
    EXPECT_THROW(app().start_gen(false), Error);
    EXPECT_THROW(app().light_scene_probes(), Error);
    play("");
    EXPECT_TRUE(app().light.empty());
    EXPECT_EQ(app().message, "there are no SPHLs left: direct light only");
  }

  /// Balls, and the names of those that the eye sees.
  void balls_and_names() {
    const auto without = shot("view -3.1 1.5 0.5 -3.1 1.5 -0.9\ntime 0");
    const auto with = shot("set balls on\nset ball-size 0.2");
    const std::size_t middle = 4 * (24 * 64 + 32);
    EXPECT_NE(with[middle], without[middle]);
    EXPECT_GT(farthest(with, without), 3);
    EXPECT_NE(with, shot("set ball-size 0.1"));
    EXPECT_NE(with, shot("set ball-size 0.2\nselect sphl \"A west\""));
    play("select light lamp");
    EXPECT_NE(with, shot("set ball irradiance"));
    EXPECT_NE(with, shot("set ball radiance\nset lobes on"));
    EXPECT_EQ(with, shot("set lobes off"));
    EXPECT_EQ(without, shot("set balls off"));
    play("view -4 1.5 0 0 1.4 0\nset names on");
    std::string initials;  // The picture is too narrow for whole names.
    const auto look = [&] {
      initials.clear();
      turn();
      for (const DrawnThing& thing : drawn_things(*ImGui::GetBackgroundDrawList()))
        initials += thing.text.substr(0, 1);
    };
    look();
    EXPECT_THAT(initials, testing::AllOf(HasSubstr("A"), testing::Not(HasSubstr("B"))))
        << "B is behind the wall";
    play("time 1");
    look();
    EXPECT_THAT(initials, HasSubstr("B")) << "through the open door";
    play("time 0");
    look();
    EXPECT_THAT(initials, testing::Not(HasSubstr("B")));
    play("set names off");
    look();
    EXPECT_EQ(initials, "");
  }

  /// Light is found anew once things have been still for three tenths of a second.
  void waits_for_the_user() {
    window_->tick = 0;
    turn();
    const std::vector<SphlEdit> sphls = edits_of(*app().document.scene).sphls;
    app().document.edit("back, in the dark", [&](Edits& e) { e.sphls = sphls, e.lights[0].on = false; });
    turn();
    EXPECT_FALSE(app().settled());
    window_->clock += 0.29;
    turn();
    EXPECT_FALSE(app().job.running());
    EXPECT_TRUE(app().light.empty());
    window_->clock += 0.02;
    mouse_held(true);
    EXPECT_FALSE(app().job.running()) << "not while a button is held";
    mouse_held(false);
    EXPECT_TRUE(app().job.running() || !app().light.empty());
    settle();
    EXPECT_EQ(app().light.set().probes.size(), 6u);
    EXPECT_EQ(app().light.set().probes[0].self[0], vec3(0))
        << "new light is that of the lamps as they are now";
    // Truth starts a quarter of a second after the last change.
    app().settings.show = Show::truth;
    app().settings.truth_passes = 1;
    play("view 0 1 0 1 1 0.5");
    app().view.eye.y += 0.1f;
    turn();
    window_->clock += 0.24;
    turn();
    EXPECT_EQ(app().reference.image().passes, 0);
    EXPECT_FALSE(app().reference.status().running);
    window_->clock += 0.02;
    turn();
    EXPECT_TRUE(app().reference.status().running || app().reference.image().passes > 0);
    settle();
    app().settings.show = Show::realtime;
    turn();
    window_->tick = 1.0 / 1024;
  }
  void mouse_held(bool held) {
    InjectedInput input;
    input.mouse = {32, 40}, input.buttons = {held, false, false};
    turn(input);
  }
};

TEST_F(PictureTest, FollowsTheSession) {
  app().open("builtin:two-rooms");
  EXPECT_EQ(app().message, "builtin:two-rooms: 68 triangles, lights: 1, SPHLs: 6");
  EXPECT_EQ(app().document.time, 0.25f);
  app().light_scene_probes();
  settle();
  EXPECT_EQ(app().light.origin(), "live");
  EXPECT_EQ(app().picture.width(), 64);
  EXPECT_EQ(app().picture.height(), 48);
  const FrameTimes::Stage& panels = app().times.stages().back();
  EXPECT_FALSE(panels.name.empty());
  play("set scale 0.5");
  EXPECT_EQ(app().picture.width(), 32);
  EXPECT_EQ(app().picture.height(), 24);
  play("set scale 1\ntime 0");
  const auto part = [&](const char* name, const auto& check) {
    SCOPED_TRACE(name);
    if (!HasFatalFailure()) check();
  };
  part("exposure", [&] { exposure_follows_the_light(); });
  part("edits", [&] { edits_and_undo(); });
  part("truth", [&] { truth_beside(); });
  part("files", [&] { probes_of_files(); });
  part("balls", [&] { balls_and_names(); });
  part("gen", [&] { generated(); });
  part("waits", [&] { waits_for_the_user(); });
  part("size", [&] { another_size(); });
  if (HasFatalFailure()) return;
  app().open("builtin:cornell");
  EXPECT_TRUE(app().light.empty());
  EXPECT_EQ(app().document.time, 0) << "the options' time is the first scene's";
}

}  // namespace
}  // namespace ssphh::viewer
