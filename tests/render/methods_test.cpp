// What every method of indirect light promises, whatever it does inside.

#include <map>

#include <gtest/gtest.h>

#include <ssphh/core/parallel.h>
#include <ssphh/methods/method_list.h>
#include <ssphh/study/leak.h>
#include <ssphh/study/surface_points.h>
#include <ssphh/trace/path_tracer.h>

#include "transport_fixtures.h"

namespace ssphh {
namespace {

using test::coloured_room;

std::vector<rays::SurfacePoint> points_of(const rays::TransportSource& source, int count) {
  const vec3 middle(0, 0.1f, 0);
  return study::reachable_points(source, {&middle, 1}, 0, {count, 0});
}

std::unique_ptr<methods::Method> make(const methods::MethodEntry& entry, const scene::Scene& scene,
                                      const rays::TransportSource& source,
                                      const std::vector<std::string>& settings = {}) {
  return entry.make({scene, source}, methods::MethodParameters(entry.name, entry.parameters, settings), {});
}

std::vector<vec3> after(methods::Method& method, const scene::LightingState& state,
                        std::span<const rays::SurfacePoint> points) {
  method.update(state, {});
  return study::look_up(method.light(), points);
}

/// Enough to see what is promised.
std::unique_ptr<methods::Method> make_small(const methods::MethodEntry& entry, const scene::Scene& scene,
                                            const rays::TransportSource& source) {
  static const std::map<std::string, std::vector<std::string>> small = {
      {"ssphh", {"probes=8", "directions=64", "surfel_size=0.4"}},
      {"ssphh-paper", {"degree=3", "face=8", "spp=2", "viz_spp=1"}},
      {"irradiance-volume", {"probes=8", "directions=64", "surfel_size=0.4"}},
      {"prt", {"probes=8", "directions=64", "surfel_size=0.4", "rays=32", "edge=0.5"}},
      {"vpl", {"photons=256", "cluster_error=0.02"}},
      {"vct", {"resolution=32", "bounces=2"}},
      {"ddgi", {"probes=27", "rays=32", "warmup=8"}}};
  const auto found = small.find(entry.name);
  return make(entry, scene, source, found == small.end() ? std::vector<std::string>{} : found->second);
}

class EveryMethod : public testing::TestWithParam<const methods::MethodEntry*> {};

TEST_P(EveryMethod, GivesLightInProportionToTheLamps) {
  const scene::Scene scene = coloured_room(vec3(2, 1, 0.5f));
  const trace::TransportScene source(scene);
  const std::vector<rays::SurfacePoint> points = points_of(source, 32);
  const auto method = make_small(*GetParam(), scene, source);
  scene::LightingState state = rays::lighting_at(source, 0);
  const std::vector<vec3> once = after(*method, state, points);
  const auto brighter = make_small(*GetParam(), scene, source);
  state.group_scales.assign(state.group_scales.size(), vec3(4));
  const std::vector<vec3> four = after(*brighter, state, points);
  const auto dark = make_small(*GetParam(), scene, source);
  state.group_scales.assign(state.group_scales.size(), vec3(0));
  const std::vector<vec3> none = after(*dark, state, points);
  for (std::size_t i = 0; i < points.size(); ++i) {
    for (int c = 0; c < 3; ++c) {
      EXPECT_TRUE(std::isfinite(once[i][c]));
      EXPECT_GE(once[i][c], 0);
      EXPECT_EQ(none[i][c], 0);
      EXPECT_NEAR(four[i][c], 4 * once[i][c], 4e-3f * (once[i][c] + 1e-3f)) << i << " " << c;
    }
  }
}

TEST_P(EveryMethod, GivesTheSameBitsOnOneThread) {
  const scene::Scene scene = coloured_room(vec3(1));
  const trace::TransportScene source(scene);
  const std::vector<rays::SurfacePoint> points = points_of(source, 32);
  const scene::LightingState state = rays::lighting_at(source, 0);
  const std::vector<vec3> many = after(*make_small(*GetParam(), scene, source), state, points);
  set_thread_count(1);
  const std::vector<vec3> one = after(*make_small(*GetParam(), scene, source), state, points);
  set_thread_count(0);
  EXPECT_EQ(one, many);
}

INSTANTIATE_TEST_SUITE_P(Methods, EveryMethod, testing::ValuesIn([] {
                           std::vector<const methods::MethodEntry*> entries;
                           for (const methods::MethodEntry& entry : methods::all_methods())
                             entries.push_back(&entry);
                           return entries;
                         }()),
                         [](const testing::TestParamInfo<const methods::MethodEntry*>& method) {
                           std::string name = method.param->name;
                           std::erase(name, '-');
                           return name;
                         });

// A method that follows events ends where one that never saw another state begins.
TEST(SsphhMethod, ForgetsWhatWas) {
  const scene::Scene scene = scene::make_builtin("two-rooms");
  const trace::TransportScene source(scene);
  const std::vector<vec3> origins = {vec3(-1, 1, 0), vec3(1, 1, 0)};
  const std::vector<rays::SurfacePoint> points = study::reachable_points(source, origins, 0, {64, 0});
  const std::vector<std::string> settings = {"places=scene", "weights=mls", "warm_start=0"};
  const methods::MethodEntry& entry = methods::find_method("ssphh");
  const auto moved = make(entry, scene, source, settings), fresh = make(entry, scene, source, settings);
  const scene::LightingState shut = rays::lighting_at(source, 0), open = rays::lighting_at(source, 1);
  const std::vector<vec3> before = after(*moved, shut, points);
  const std::vector<vec3> now = after(*moved, open, points);
  EXPECT_NE(before, now);
  EXPECT_EQ(now, after(*fresh, open, points));
}

}  // namespace
}  // namespace ssphh
