// Histogram, waveform and false colours as a user sees them: over the real-time and the traced picture, by
// keys, kept for the next session.

#include <gmock/gmock.h>

#include <ssphh/core/file.h>

#include "gl_stage.h"
#include "panel_stage.h"

namespace ssphh::viewer {
namespace {

class ReadPicture : public GlStage {
 protected:
  void prepare() override {
    options_.records = 0;
    options_.settings = {{"exposure", "0"}, {"truth-spp", "4"}};
  }
  void ready() override { window_->tick = 1.0 / 1024; }
  image::Rgba8 shot() {
    app().screenshot("shot.png", false);
    return image::decode_rgba8(read_file("shot.png"), "shot.png");
  }
};

TEST_F(ReadPicture, IsInTheBandsOfItsLuminance) {
  app().open("builtin:two-rooms");
  play("camera room-a\nkey K");
  ASSERT_TRUE(app().settings.false_color);
  ASSERT_FALSE(app().picture.linear().empty());
  EXPECT_EQ(shot().rgba, false_color(app().picture.linear(), 0).rgba);
  play("set exposure 2");
  EXPECT_EQ(shot().rgba, false_color(app().picture.linear(), 2).rgba) << "bands follow the exposure";
  play("set show truth");
  EXPECT_EQ(shot().rgba, false_color(*app().reference.image().color, 2).rgba);
  play("set show wipe");
  const image::Rgba8 both = shot();
  const auto pixel = [](const image::Rgba8& p, int x, int y) {
    const auto at =
        4 * (static_cast<std::size_t>(y) * static_cast<std::size_t>(p.width) + static_cast<std::size_t>(x));
    return std::vector<std::uint8_t>(p.rgba.begin() + static_cast<std::ptrdiff_t>(at),
                                     p.rgba.begin() + static_cast<std::ptrdiff_t>(at) + 3);
  };
  EXPECT_EQ(pixel(both, 3, 20), pixel(false_color(app().picture.linear(), 2), 3, 20));
  EXPECT_EQ(pixel(both, 60, 20), pixel(false_color(*app().reference.image().color, 2), 60, 20));
  play("set show realtime\nkey K");
  EXPECT_NE(shot().rgba, false_color(app().picture.linear(), 2).rgba);
}

TEST_F(ReadPicture, IsCountedAndSoIsTheTruth) {
  app().open("builtin:two-rooms");
  play("camera room-a");
  EXPECT_FALSE(app().histogram);
  play("key J");
  ASSERT_TRUE(app().histogram);
  EXPECT_FALSE(app().truth_histogram);
  const auto mean = [](const StopHistogram& h) {
    float sum = 0, shares = 0;
    for (std::size_t i = 0; i < h.bins.size(); ++i)
      sum += h.bins[i] * static_cast<float>(i), shares += h.bins[i];
    return sum / shares / bins_per_stop;
  };
  const float dim = mean(*app().histogram);
  play("light lamp intensity 16");
  EXPECT_NEAR(mean(*app().histogram), dim + 2, 0.3f) << "four times the light is two stops";
  play("set show wipe");
  ASSERT_TRUE(app().truth_histogram);
  play("key J");
  EXPECT_FALSE(app().histogram);
}

TEST_F(ReadPicture, HasAWaveformOfWhatIsShown) {
  app().open("builtin:two-rooms");
  play("camera room-a");
  EXPECT_FALSE(app().waveform);
  play("key U");
  ASSERT_TRUE(app().waveform);
  const auto of = [&](float ev) { return waveform(app().picture.linear(), ev).channels; };
  EXPECT_EQ(app().waveform->channels, of(0));
  play("set exposure 2");
  EXPECT_EQ(app().waveform->channels, of(2));
  play("set show truth");
  const auto truth = waveform(*app().reference.image().color, 2);
  EXPECT_EQ(app().waveform->channels, truth.channels);
  play("set show wipe");
  play("set wipe 0.25");
  EXPECT_EQ(app().waveform->channels, wiped(waveform(app().picture.linear(), 2), truth, 0.25f).channels);
  play("set show realtime\nkey U");
  EXPECT_FALSE(app().waveform);
}

TEST_F(ReadPicture, WhoseTruthFailsSaysSo) {
  app().open("builtin:two-rooms");
  play("camera room-a");
  scene::Scene scene = *app().document.scene;
  for (scene::Node& node : scene.nodes) node.movable = true;
  app().take_document(make_document("builtin:stage", std::move(scene), 0));
  play("set against prt\nset show wipe");
  EXPECT_THAT(app().message, testing::HasSubstr("no surface that stands still"));
  EXPECT_TRUE(app().message_is_error);
  EXPECT_EQ(app().settings.show, Show::realtime) << "it is not begun again and again";
  EXPECT_FALSE(app().reference.status().running);
  app().message.clear();
  play("set against path\nset show truth");
  EXPECT_EQ(app().message, "");
  EXPECT_TRUE(app().reference.image().color);
}

class Readings : public PanelStage {};

TEST_F(Readings, LegendAndHistogramSayTheirUnits) {
  app().settings.exposure = 0, app().settings.auto_exposure = false;
  press({'K'});
  rest();
  EXPECT_TRUE(shows("stops") && shows("W/(sr m"));
  EXPECT_TRUE(shows("0.18")) << "middle grey";
  EXPECT_TRUE(shows("1.44")) << "three stops above";
  press({'K'});
  app().histogram.emplace().bins[10] = 1;
  press({'J'});
  rest();
  EXPECT_TRUE(shows("luminance, stops from middle grey"));
  EXPECT_FALSE(shows("white line: traced"));
  app().truth_histogram.emplace();
  rest();
  EXPECT_TRUE(shows("white line: traced"));
  EXPECT_FALSE(shows("red, green, blue"));
  app().waveform.emplace();
  press({'U'});
  rest();
  EXPECT_TRUE(shows("red, green, blue over columns"));
}

class KeptLook : public AppStage {};

TEST_F(KeptLook, OfTheWindowComesBack) {
  options_.preferences = dir_ / "config" / "preferences.json";
  start(1280, 800);
  app().turn({});
  app().settings.histogram = app().settings.waveform = true;
  const float usual = app().viewport.x;
  app().side_width = 21.5f;
  turn();
  EXPECT_NE(app().viewport.x, usual);
  const float width = app().viewport.x;
  start(1280, 800);
  turn();
  EXPECT_TRUE(app().settings.histogram);
  EXPECT_TRUE(app().settings.waveform);
  EXPECT_FALSE(app().settings.false_color);
  EXPECT_EQ(app().viewport.x, width);
  app().side_width = 0;
  turn();
  start(1280, 800);
  turn();
  EXPECT_EQ(app().viewport.x, usual) << "a double click on the edge is kept, too";
  // What is drawn without hands is as the options say.
  options_.screenshot = "a.png";
  start(1280, 800);
  EXPECT_FALSE(app().settings.histogram);
}

}  // namespace
}  // namespace ssphh::viewer
