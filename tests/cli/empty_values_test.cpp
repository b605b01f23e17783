// What the tool's options and results hold before anybody sets them.

#include <gtest/gtest.h>

#include "commands/child_process.h"
#include "commands/command.h"
#include "commands/relight_animation.h"
#include "commands/report_run.h"
#include "options/gl_options.h"
#include "options/place_options.h"
#include "options/render_options.h"
#include "results/relight_report.h"

namespace ssphh::app {
namespace {

TEST(EmptyValues, OfResults) {
  const RelightRun run;
  EXPECT_EQ(run.frames_asked, 0);
  EXPECT_EQ(run.fps, 30);
  EXPECT_EQ(run.build_ms, 0);
  EXPECT_FALSE(run.cancelled);
  EXPECT_EQ(FrameError().frame, 0);
  EXPECT_EQ(PlaceResult().seconds, 0);
  EXPECT_EQ(Track().target, -1);
  const Context context;
  EXPECT_FALSE(context.json);
  EXPECT_EQ(context.seed, 0u);
  EXPECT_EQ(context.threads, 0);
  EXPECT_EQ(context.progress, "auto");
  EXPECT_EQ(context.exit_code, 0);
}

TEST(EmptyValues, OfOptions) {
  const RenderOptions render;
  EXPECT_EQ(render.occlusion, 0);
  EXPECT_EQ(render.exposure, 0);
  EXPECT_EQ(render.indirect_scale, 1);
  EXPECT_FALSE(render.resume);
  EXPECT_FALSE(render.force);
  EXPECT_FALSE(GlLookup().force);
  EXPECT_EQ(FarmChoice().local, 0);
  EXPECT_FALSE(FarmChoice().any());
  const SceneOptions scene;
  EXPECT_FALSE(scene.lambert);
  EXPECT_FALSE(scene.sun_sky);
  EXPECT_EQ(scene.environment_rotation, 0);
  EXPECT_EQ(scene.time, 0);
}

}  // namespace
}  // namespace ssphh::app
