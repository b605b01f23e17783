// Progress of long work: every stage ends with what it said it would do.

#include <gmock/gmock.h>

#include <ssphh/bake/transport_bake.h>
#include <ssphh/place/init.h>
#include <ssphh/scene/builtin.h>
#include <ssphh/transport/relight_session.h>

#include "method_fixtures.h"
#include "progress_recorder.h"

namespace ssphh {
namespace {

using testing::ElementsAre;

testing::Matcher<std::string> some(const std::string& stage, const std::string& unit) {
  return testing::AllOf(testing::StartsWith(stage + ": "), testing::EndsWith(" " + unit));
}

TEST(Stages, OfTransportBakes) {
  const scene::Scene scene = scene::make_builtin("box");
  const trace::TransportScene source(scene);
  bake::TransportBakeParams params;
  params.transport = {.directions = 64, .surfel_size = 0.5f, .link_rays = 8, .samples = 2};
  params.viz = params.fit = true;
  test::ProgressRecorder progress;
  bake::TransportBakeReport report;
  bake::bake_transport(source, place::init_from_scene(scene, 1), params, report, {&progress, nullptr});
  EXPECT_THAT(progress.finished(),
              ElementsAre("probe G-buffers: 5 probes", some("finding surfels", "surfels"),
                          some("finding surfels", "surfels"), some("linking surfels", "surfels"),
                          "solving: 1 light groups", "VIZ from links: 5 probes", some("gathering", "points"),
                          some("training", "lights"), some("fitting", "points")));
}

TEST(Stages, OfPosesFoundBeforehand) {
  const scene::Scene scene = scene::make_builtin("two-rooms");
  const trace::TransportScene source(scene);
  transport::RelightParams params;
  params.transport = {.directions = 32, .surfel_size = 0.5f, .link_rays = 8, .samples = 2};
  params.poses = 3;
  test::ProgressRecorder progress;
  const transport::RelightSession session(source, {{"p", vec3(-1, 1, 0), 0.1f}}, params, 0,
                                          {&progress, nullptr});
  const std::vector<std::string> done = progress.finished();
  EXPECT_EQ(done.front(), "probe G-buffers: 1 probes");
  EXPECT_EQ(done.back(), "poses: 3 poses");
}

TEST(Stages, OfPointsInReach) {
  const scene::Scene scene = scene::make_builtin("box");
  const trace::TransportScene source(scene);
  test::ProgressRecorder progress;
  study::reachable_points(source, std::vector<vec3>{vec3(0)}, 0, {300, 1}, {&progress, nullptr});
  EXPECT_THAT(progress.finished(), ElementsAre("surface points: 300 points"));
}

TEST(Stages, OfMethods) {
  const scene::Scene scene = scene::make_builtin("box");
  const trace::TransportScene source(scene);
  const auto of = [&](const std::string& name, const std::vector<std::string>& settings) {
    test::ProgressRecorder progress;
    const methods::MethodEntry& entry = methods::find_method(name);
    const auto method = entry.make(
        {scene, source}, methods::MethodParameters(name, entry.parameters, settings), {&progress, nullptr});
    method->update(rays::lighting_at(source, 0), {&progress, nullptr});
    return progress.finished();
  };
  EXPECT_THAT(of("ddgi", {"probes=8", "rays=8", "warmup=3"}), testing::Contains("warm-up: 3 frames"));
  EXPECT_THAT(of("vct", {"resolution=8", "bounces=1"}), testing::Each(some("voxels", "patches")));
  EXPECT_THAT(
      of("prt", {"places=scene", "directions=16", "rays=16", "edge=1", "surfel_size=0.5", "interreflect=2"}),
      testing::IsSupersetOf({some("rays of vertices", "vertices"),
                             testing::Matcher<std::string>("transfer vectors: 3 bounces")}));
}

}  // namespace
}  // namespace ssphh
