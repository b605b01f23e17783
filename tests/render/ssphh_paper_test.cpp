/// The method ssphh-paper against the steps that it is made of, and how it follows lamps and doors.

#include <gtest/gtest.h>

#include <ssphh/bake/bake.h>
#include <ssphh/core/log.h>
#include <ssphh/methods/method_list.h>
#include <ssphh/place/init.h>
#include <ssphh/probes/hier.h>
#include <ssphh/probes/lookup.h>
#include <ssphh/scene/builtin.h>
#include <ssphh/study/leak.h>
#include <ssphh/study/surface_points.h>
#include <ssphh/trace/path_tracer.h>
#include <ssphh/trace/transport_scene.h>

namespace ssphh {
namespace {

class SsphhPaper : public testing::Test {
 protected:
  SsphhPaper() { set_log_level(LogLevel::error); }  // a dark room is meant

  std::unique_ptr<methods::Method> make(std::vector<std::string> settings = {}) const {
    settings.insert(settings.end(), {"degree=3", "face=8", "spp=4", "viz_spp=2", "depth=4", "viz_depth=2"});
    const methods::MethodEntry& entry = methods::find_method("ssphh-paper");
    return entry.make({scene_, source_}, methods::MethodParameters(entry.name, entry.parameters, settings),
                      {});
  }
  std::vector<vec3> after(methods::Method& method, const scene::LightingState& state) const {
    method.update(state, {});
    return study::look_up(method.light(), points_);
  }

  const scene::Scene scene_ = scene::make_builtin("two-rooms");
  const trace::TransportScene source_{scene_};
  const std::vector<vec3> origins_{vec3(-1, 1, 0), vec3(1, 1, 0)};
  const std::vector<rays::SurfacePoint> points_ = study::reachable_points(source_, origins_, 0, {48, 0});
};

TEST_F(SsphhPaper, IsItsStepsOneAfterTheOther) {
  const trace::PathTracer tracer(scene_, 0.5f);
  bake::BakeParams params;
  params.face_size = 8;
  params.path = {4, 1, 4, 0};
  params.viz_path = {2, 1, 2, 0};
  params.viz_params.paths = rays::PathSet::diffuse;
  bake::BakeReport report;
  probes::ProbeSet set = bake::bake(tracer, place::init_from_scene(scene_, 3), params, {}, report);
  const probes::HierParams strongest{probes::HierOperator::coefficient, 2, 1e-4f};
  probes::hier(set, strongest);
  const probes::LightLookup light(set, tracer);
  const auto method = make({"neighbors=2", "threshold=1e-4"});
  EXPECT_EQ(after(*method, rays::lighting_at(source_, 0.5f)), study::look_up(light, points_));
  // And the others of its choices.
  probes::hier(set, {probes::HierOperator::raw, -1, 0});
  const probes::IrradianceLookup irradiance(set, tracer);
  EXPECT_EQ(after(*make({"operator=raw", "lookup=irradiance"}), rays::lighting_at(source_, 0.5f)),
            study::look_up(irradiance, points_));
  probes::LookupParams self;
  self.layer = probes::ProbeLayer::self;
  EXPECT_EQ(after(*make({"layer=self"}), rays::lighting_at(source_, 0.5f)),
            study::look_up(probes::LightLookup(set, tracer, self), points_));
}

TEST_F(SsphhPaper, ForgetsWhatWas) {
  const auto moved = make(), fresh = make();
  scene::LightingState shut = rays::lighting_at(source_, 0), open = rays::lighting_at(source_, 1);
  open.lights[0].intensity *= 0.5f;
  const std::vector<vec3> before = after(*moved, shut), now = after(*moved, open);
  EXPECT_NE(before, now);
  EXPECT_EQ(now, after(*fresh, open));
}

TEST_F(SsphhPaper, DimmingAGroupIsASumThatTracesNothing) {
  const auto method = make();
  scene::LightingState state = rays::lighting_at(source_, 1);
  const std::vector<vec3> before = after(*method, state);
  state.group_scales.assign(state.group_scales.size(), vec3(0.25f, 0.5f, 2));
  const std::vector<vec3> dimmed = after(*method, state);
  for (std::size_t i = 0; i < points_.size(); ++i) {
    for (int c = 0; c < 3; ++c)
      EXPECT_NEAR(dimmed[i][c], before[i][c] * state.group_scales[0][c], 1e-5f * (1e-3f + before[i][c])) << i;
  }
}

TEST_F(SsphhPaper, PlacesSphlsWhereTheSceneHasNone) {
  scene::Scene bare = scene_;
  bare.sphls.clear();
  const methods::MethodEntry& entry = methods::find_method("ssphh-paper");
  const std::vector<std::string> settings{"face=4", "spp=1", "viz_spp=1", "degree=1", "probes=5"};
  const auto method =
      entry.make({bare, source_}, methods::MethodParameters(entry.name, entry.parameters, settings), {});
  method->update(rays::lighting_at(source_, 1), {});
  EXPECT_EQ(method->numbers()[0].second, 5);
}

}  // namespace
}  // namespace ssphh
