// What the tool's options and results hold before anybody sets them.

#include <gtest/gtest.h>

#include "commands/bake.h"
#include "commands/bench_frame.h"
#include "commands/child_process.h"
#include "commands/command.h"
#include "commands/export.h"
#include "commands/farm.h"
#include "commands/hier.h"
#include "commands/leak.h"
#include "commands/measure.h"
#include "commands/probe.h"
#include "commands/probe_convert.h"
#include "commands/relight.h"
#include "commands/relight_animation.h"
#include "commands/render.h"
#include "commands/report.h"
#include "commands/report_run.h"
#include "commands/respond.h"
#include "commands/scene.h"
#include "commands/sh.h"
#include "commands/truth.h"
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
  EXPECT_EQ(context.progress, ProgressStyle::automatic);
  EXPECT_EQ(context.exit_code, 0);
}

TEST(EmptyValues, OfWhatCommandsGive) {
  EXPECT_EQ(BakeResult().geometry_builds, 0u);
  EXPECT_EQ(BakeResult().viz, probes::VizMethod::none);
  const BenchFrameResult bench;
  EXPECT_EQ(bench.probes, 0);
  EXPECT_EQ(bench.draw_calls + bench.samples_shaded + bench.largest_upload + bench.memory, 0u);
  EXPECT_EQ(bench.resident, 0);
  EXPECT_EQ(bench.resident_growth, 0);
  EXPECT_EQ(ExportResult().triangles, 0u);
  EXPECT_EQ(FarmDrainResult().told, 0);
  EXPECT_EQ(FarmReleaseResult().released, 0);
  EXPECT_EQ(FarmDropResult().dropped, 0);
  EXPECT_EQ(HierResult().edges, 0u);
  EXPECT_EQ(HierResult().seconds, 0);
  EXPECT_EQ(LeakResult().time, 0);
  EXPECT_EQ(LeakResult().geometry_builds, 0u);
  EXPECT_EQ(MeasureResult().geometry_builds, 0u);
  EXPECT_EQ(ProbeConvertResult().probes, 0u);
  EXPECT_EQ(ProbeConvertResult().bytes, 0u);
  const RelightResult relight;
  EXPECT_EQ(relight.surfels + relight.links, 0u);
  EXPECT_EQ(relight.surfel_size, 0);
  EXPECT_EQ(relight.geometry_builds, 0u);
  const RenderResult render;
  EXPECT_EQ(render.seconds, 0);
  EXPECT_EQ(render.passes, 0);
  EXPECT_EQ(render.paths + render.rays + render.geometry_builds, 0u);
  EXPECT_EQ(GlFigures().samples, 0);
  const ReportResult report;
  EXPECT_EQ(report.commands + report.run + report.cached + report.cells + report.failed + report.page_bytes,
            0u);
  EXPECT_EQ(report.seconds, 0);
  EXPECT_EQ(RunResult().done + RunResult().cached, 0u);
  EXPECT_EQ(RespondResult().before_ms, 0);
  const SceneInfo scene;
  EXPECT_EQ(
      scene.triangles + scene.meshes + scene.instances + scene.materials + scene.textures + scene.lights, 0u);
  EXPECT_EQ(scene.animations + scene.emissive_instances + scene.movable, 0u);
  EXPECT_EQ(scene.animation_seconds, 0);
  EXPECT_EQ(ShIrradianceResult().irradiance, vec3(0));
  const TruthResult truth;
  EXPECT_EQ(truth.mean, glm::dvec3(0));
  EXPECT_EQ(truth.standard_error, glm::dvec3(0));
  EXPECT_EQ(truth.seconds, 0);
  const MethodFigures method;
  EXPECT_EQ(method.bake_seconds, 0);
  EXPECT_EQ(method.update_seconds, 0);
}

TEST(EmptyValues, OfOptions) {
  const RenderOptions render;
  EXPECT_EQ(render.occlusion, 0);
  EXPECT_EQ(render.exposure, std::nullopt) << "what suits the picture";
  EXPECT_EQ(render.indirect_scale, 1);
  EXPECT_FALSE(render.resume);
  EXPECT_FALSE(render.force);
  EXPECT_FALSE(GlLookup().force);
  EXPECT_EQ(FarmChoice().local, 0);
  EXPECT_FALSE(FarmChoice().any());
  const SceneOptions scene;
  EXPECT_FALSE(scene.lambert);
  EXPECT_FALSE(pipeline::sun_sky_of(scene.sky));
  EXPECT_EQ(scene.environment_rotation, 0);
  EXPECT_EQ(scene.time, 0);
}

}  // namespace
}  // namespace ssphh::app
