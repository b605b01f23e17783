/// What stands in a value before anything is put into it: the window, its panels and scripts rely on it.

#include <gtest/gtest.h>

#include "app.h"
#include "balls_gl.h"
#include "model/background_job.h"
#include "model/camera_path.h"
#include "model/comparison.h"
#include "model/document.h"
#include "model/gestures.h"
#include "model/live_light.h"
#include "model/reference.h"
#include "probe_light.h"
#include "viewer.h"

namespace ssphh::viewer {
namespace {

TEST(ViewerValues, OfWhatIsEdited) {
  EXPECT_EQ(LightEdit(), (LightEdit{std::nullopt, vec3(1), 1, true, -1, {}}));
  EXPECT_EQ(SphlEdit(), (SphlEdit{-1, std::nullopt, "", 0.1f, true}));
  EXPECT_EQ(Edits().environment_rotation, 0);
  const Document document;
  EXPECT_EQ(document.time, 0);
  EXPECT_EQ(document.duration, 0);
  EXPECT_TRUE(document.bounds.empty());
}

TEST(ViewerValues, OfViewsAndWaysThroughTheScene) {
  EXPECT_EQ(View(), (View{vec3(0), quat(1, 0, 0, 0), 0.8f, 3, false, 2}));
  EXPECT_EQ(CameraKey(), (CameraKey{"", 0, std::nullopt, View{}}));
  const Grip grip{};
  EXPECT_EQ(grip.axis, -1);
  EXPECT_EQ(grip.start, vec3(0));
  EXPECT_EQ(grip.grabbed, vec3(0));
  EXPECT_EQ(Selection(), (Selection{Kind::none, -1}));
  EXPECT_FALSE(Selection().is(Kind::none));
  const Rect2 picture{};
  EXPECT_EQ(picture.x + picture.y, 0);
  EXPECT_EQ(picture.width, 1);
  EXPECT_EQ(picture.height, 1);
}

TEST(ViewerValues, OfWorkInTheBackground) {
  const JobStatus status{};
  EXPECT_EQ(status.name + status.stage + status.error, "");
  EXPECT_EQ(status.fraction, -1);
  EXPECT_EQ(status.seconds, 0);
  EXPECT_FALSE(status.running);
  const ReferenceParams reference{};
  EXPECT_EQ(reference.time, 0);
  EXPECT_EQ(reference.width, 0);
  EXPECT_EQ(reference.height, 0);
  EXPECT_EQ(reference.method, "path");
  EXPECT_EQ(reference.max_depth, rays::usual_max_depth);
  EXPECT_EQ(reference.passes, 256);
  EXPECT_EQ(ReferenceImage().passes, 0);
  EXPECT_EQ(LiveLightParams().spacing, 0);
  const ProbeLight::Update update{};
  EXPECT_FALSE(update.relit || update.replaced);
  EXPECT_EQ(update.relight_ms, 0);
  EXPECT_EQ(update.hier_ms, 0);
  EXPECT_EQ(update.upload_ms, 0);
  const BallsGl::Look look{};
  EXPECT_EQ(look.radius, 0);
  EXPECT_FALSE(look.lobes);
  EXPECT_EQ(look.selected, -1);
}

TEST(ViewerValues, OfASession) {
  const ViewerOptions options{};
  EXPECT_EQ(options.time, 0);
  EXPECT_FALSE(options.force || options.live);
  EXPECT_EQ(options.width, 1440);
  EXPECT_EQ(options.height, 810);
  EXPECT_TRUE(options.panels);
  EXPECT_EQ(options.fps, 30);
  EXPECT_EQ(options.frames, 0);
  const ViewerReport report{};
  EXPECT_EQ(report.frames, 0);
  EXPECT_EQ(report.probes, 0);
  EXPECT_EQ(report.median_ms, 0);
  EXPECT_EQ(report.p99_ms, 0);
  EXPECT_EQ(report.geometry_builds, 0u);
}

}  // namespace
}  // namespace ssphh::viewer
