// Qualities that are chosen in the window, and what they cost.

#include "model/quality.h"

#include <gmock/gmock.h>

#include <ssphh/bake/effort.h>
#include <ssphh/transport/network.h>

#include "gl_stage.h"
#include "model/preferences.h"
#include "panel_stage.h"

namespace ssphh::viewer {
namespace {

using testing::HasSubstr;

TEST(ViewerQuality, SpendsAsMuchAsABakeOfThatQuality) {
  transport::TransportParams own;
  own.samples = 5, own.surfel_size = 0.25f;
  for (const auto& [quality, of_bake] : {std::pair{Quality::draft, bake::Quality::draft},
                                         {Quality::good, bake::Quality::good},
                                         {Quality::best, bake::Quality::best}}) {
    const QualityEffort effort = effort_of(quality, own);
    const bake::Effort wanted = bake::effort_of(of_bake);
    EXPECT_EQ(effort.spp, wanted.spp);
    EXPECT_EQ(effort.face_size, bake::BakeParams{}.face_size);
    EXPECT_EQ(effort.records, wanted.records);
    transport::TransportParams params = own;
    params.directions = wanted.directions, params.link_rays = wanted.link_rays;
    params.surfels_per_radius = wanted.surfels_per_radius, params.most_surfels = wanted.most_surfels;
    EXPECT_EQ(effort.transport, params);
  }
  const QualityEffort window = effort_of(Quality::window, own);
  EXPECT_EQ(window.transport, own);
  EXPECT_EQ(window.spp, 8);
  EXPECT_EQ(window.face_size, 20);
  EXPECT_EQ(window.records, transport::usual_records);
}

TEST(ViewerQuality, PathsAreThoseOfTheGlanceAndOfTheWhole) {
  bake::BakeParams fine;
  fine.face_size = 64, fine.path.spp = 16;
  EXPECT_EQ(paths_per_probe(fine), 6.0 * (64 * 64 * 16 + 32 * 32 * 2));
  fine.face_size = 8, fine.path.spp = 1;
  EXPECT_EQ(passes_of(fine).size(), 1u);
  EXPECT_EQ(paths_per_probe(fine), 6.0 * 64);
}

TEST(ViewerQuality, CostIsThatOfNowInProportion) {
  LightKnown known;
  const LightCost alone = cost_of(Quality::draft, known);
  EXPECT_EQ(alone.paths, 6.0 * (64 * 64 * 4 + 32 * 32));
  EXPECT_EQ(alone.seconds, 0);
  EXPECT_EQ(alone.surfels, 30000);
  EXPECT_EQ(cost_text(Quality::draft, known),
            "GEN: 104 thousand paths a probe\nlive: up to 30 thousand surfels");
  known.probes = 10;
  known.paths_per_second = 1e5;
  known.transport = effort_of(Quality::window).transport;
  known.surfels = 1000, known.live_seconds = 2;
  const LightCost same = cost_of(Quality::window, known);
  EXPECT_EQ(same.surfels, 1000);
  EXPECT_DOUBLE_EQ(same.live_seconds, 2);
  EXPECT_DOUBLE_EQ(same.seconds, 10 * 6.0 * (20 * 20 * 8 + 10 * 10) / 1e5);
  const LightCost best = cost_of(Quality::best, known);
  EXPECT_NEAR(best.surfels, 1000 * 2.8 * 2.8, 0.01);
  EXPECT_DOUBLE_EQ(best.live_seconds, 2 * (best.surfels * 256 + 10 * 4096) / (1000.0 * 128 + 10 * 384));
  EXPECT_DOUBLE_EQ(best.bytes, 64e6 + 2000 * best.surfels + 45 * (best.surfels * 256 + 10 * 4096));
  EXPECT_EQ(cost_text(Quality::best, known),
            "GEN: 16.2 million paths, with VIZ some\u00a03\u00a0min\n"
            "live: up to 7840 surfels, 0.2\u00a0GB, some\u00a031\u00a0s");
}

class QualityPicker : public PanelStage {
 protected:
  QualityPicker() {
    options_.preferences = dir_ / "config" / "preferences.json";
    begin();
  }
  void begin() {
    start(1000, 1500);
    app().take_document(document("two-rooms"));
    open("Probes");
  }
};

TEST_F(QualityPicker, SetsTheNumbersOfGenAndIsKept) {
  EXPECT_TRUE(shows("GEN: "));
  app().use_quality(Quality::best);
  EXPECT_EQ(app().bake_params.path.spp, 64);
  EXPECT_EQ(app().bake_params.face_size, 64);
  EXPECT_FALSE(app().quality_by_hand());
  app().bake_params.path.spp = 3;
  rest();
  EXPECT_TRUE(shows("best, by hand"));
  app().use_quality(Quality::best);
  EXPECT_EQ(app().bake_params.path.spp, 64) << "chosen again";
  app().keep_look();
  EXPECT_EQ(read_preferences(options_.preferences).look.quality, Quality::best);
  begin();
  EXPECT_EQ(app().settings.quality, Quality::best);
  EXPECT_EQ(app().bake_params.path.spp, 64);
  options_.settings = {{"quality", "draft"}};
  begin();
  EXPECT_EQ(app().bake_params.path.spp, 4) << "the command line comes first";
}

TEST_F(QualityPicker, ListsWhatEachCosts) {
  click_widget("quality");
  for (const char* name : {"window", "draft", "good", "best"}) EXPECT_TRUE(shows(name)) << name;
  click_text("good");
  EXPECT_EQ(app().settings.quality, Quality::good);
}

class LiveQuality : public GlStage {
 protected:
  void prepare() override { options_.probes = "scene", options_.records = 0; }
  void ready() override { app().open("builtin:two-rooms"); }
  const transport::TransportParams& made_with() {
    return app().light.live_light()->session().network().params();
  }
};

TEST_F(LiveQuality, ThatIsAnotherHasLiveLightFoundAnewInTheBackground) {
  app().light_scene_probes();
  app().settings.quality = Quality::draft;
  play("");
  EXPECT_EQ(made_with().link_rays, 64) << "also where light was on its way";
  play("set quality window");
  EXPECT_EQ(made_with().link_rays, options_.transport.link_rays);
  EXPECT_EQ(made_with().directions, options_.transport.directions);
  EXPECT_GT(app().light_known().live_seconds, 0);
  EXPECT_EQ(app().light_known().probes, 6u);
  const int before = app().light.works();
  app().turn({});
  EXPECT_FALSE(app().job.running()) << "once";
  EXPECT_EQ(app().light.works(), before);
}

}  // namespace
}  // namespace ssphh::viewer
