/// Dynamic diffuse probes: closed forms of a field that feeds itself, path-traced truth, leaks, and how many
/// frames they need.

#include <cmath>

#include <gtest/gtest.h>

#include <ssphh/core/parallel.h>
#include <ssphh/methods/method_list.h>
#include <ssphh/place/place.h>
#include <ssphh/study/leak.h>
#include <ssphh/study/lookup_error.h>
#include <ssphh/study/surface_points.h>
#include <ssphh/trace/path_tracer.h>

#include "transport_fixtures.h"

namespace ssphh::test {
namespace {

using Settings = std::vector<std::string>;

std::unique_ptr<methods::Method> make(const std::string& name, const scene::Scene& scene,
                                      const trace::TransportScene& source, const Settings& settings) {
  const methods::MethodEntry& entry = methods::find_method(name);
  return entry.make({scene, source}, {name, entry.parameters, settings}, {});
}

double number(const methods::Method& method, const std::string& name) {
  for (const auto& [n, value] : method.numbers()) {
    if (n == name) return value;
  }
  return NAN;
}

std::vector<rays::SurfacePoint> points_of(const scene::Scene& scene, const trace::TransportScene& source,
                                          float time, int count) {
  std::vector<vec3> origins = place::place_params(scene, time).interest;
  for (const scene::ProbePlace& place : scene::sphl_places(scene, time)) origins.push_back(place.position);
  return study::reachable_points(source, origins, time, {count, 1, 0.05f});
}

double error_of(const methods::Method& method, const std::vector<rays::SurfacePoint>& points,
                const std::vector<rays::IrradianceEstimate>& truth) {
  return study::lookup_error(study::look_up(method.light(), points), truth).luminance.mean_error;
}

/// The glowing box, Le = 1: direct irradiance is π everywhere, so that a field E gives radiance ρ (π + E)/π.
struct Furnace {
  explicit Furnace(float albedo) : scene(GlowingBox::painted(albedo)), source(scene) {}
  scene::Scene scene;
  trace::TransportScene source;
  const rays::SurfacePoint point{{0.9f, 0.2f, 0.1f}, {-1, 0, 0}};
};

TEST(Ddgi, FurnaceHoldsEveryBounce) {
  for (const float albedo : {0.3f, 0.8f}) {
    const Furnace furnace(albedo);
    const auto ddgi = make("ddgi", furnace.scene, furnace.source, {"probes=8", "warmup=100"});
    ddgi->update(rays::lighting_at(furnace.source, 0), {});
    const float expected = pi * albedo / (1 - albedo);
    const vec3 e = ddgi->light().irradiance(furnace.point);
    // The bounces that hundred frames leave out, and the walls' direct irradiance by quadrature.
    for (int c = 0; c < 3; ++c) EXPECT_NEAR(e[c] / expected, 1, 0.005f);
    EXPECT_NEAR(ddgi->light().glossy(furnace.point, {0, 1, 0}, 0.3f).g * pi / e.g, 1, 1e-4f);
  }
}

TEST(Ddgi, LightFadesAsHysteresisAndAlbedoSay) {
  // With the lamps off a frame leaves h + (1 − h) ρ of an even field.
  const float albedo = 0.5f, hysteresis = 0.8f;
  const Furnace furnace(albedo);
  const Settings settings = {"probes=8", "warmup=100", "hysteresis=0.8", "rays=64"};
  Settings plain = settings;
  plain.emplace_back("change=0");
  const auto ddgi = make("ddgi", furnace.scene, furnace.source, plain);
  scene::LightingState state = rays::lighting_at(furnace.source, 0);
  ddgi->update(state, {});
  const float before = ddgi->light().irradiance(furnace.point).g;
  for (vec3& scale : state.group_scales) scale = vec3(0);
  for (int frame = 1; frame <= 12; ++frame) {
    ddgi->update(state, {});
    const float expected = std::pow(hysteresis + (1 - hysteresis) * albedo, static_cast<float>(frame));
    EXPECT_NEAR(ddgi->light().irradiance(furnace.point).g / before, expected, 0.01f) << frame;
  }

  // A change by half of the light is more than 0.4: a quarter of the hysteresis is left. Three times 0.1 is
  // less than a half: nothing stays.
  const struct {
    const char* change;
    float stays;
  } cases[] = {{"change=0.4", 0.25f * hysteresis}, {"change=0.1", 0}};
  for (const auto& [change, stays] : cases) {
    Settings alert = settings;
    alert.emplace_back(change);
    const auto quick = make("ddgi", furnace.scene, furnace.source, alert);
    quick->update(rays::lighting_at(furnace.source, 0), {});
    const float start = quick->light().irradiance(furnace.point).g;
    quick->update(state, {});
    EXPECT_NEAR(quick->light().irradiance(furnace.point).g / start, stays + (1 - stays) * albedo, 0.01f)
        << change;
  }
}

TEST(Ddgi, TendsToPathTracingWithMoreProbes) {
  const scene::Scene scene = scene::make_builtin("cornell");
  const trace::TransportScene source(scene);
  const auto points = points_of(scene, source, 0, 200);
  const auto truth = trace::PathTracer(scene).surface_irradiance(points, {25, 1, 512, 3}, {});
  double last = 1;
  for (const char* probes : {"probes=1", "probes=27", "probes=343"}) {
    const auto ddgi = make("ddgi", scene, source, {probes, "rays=48", "warmup=32"});
    ddgi->update(rays::lighting_at(source, 0), {});
    const double error = error_of(*ddgi, points, truth);
    RecordProperty(probes, std::to_string(error));
    EXPECT_LT(error, last) << probes;
    last = error;
  }
  EXPECT_LT(last, 0.15);
}

TEST(Ddgi, SameBitsForAnyNumberOfThreads) {
  const scene::Scene scene = scene::make_builtin("two-rooms");
  const trace::TransportScene source(scene);
  const auto points = points_of(scene, source, 0, 100);
  const int before = thread_count();
  std::vector<std::vector<vec3>> light;
  for (const int threads : {1, 4}) {
    set_thread_count(threads);
    const auto ddgi = make("ddgi", scene, source, {"probes=60", "rays=32", "warmup=4"});
    for (const float time : {0.0f, 0.5f}) ddgi->update(rays::lighting_at(source, time), {});
    light.push_back(study::look_up(ddgi->light(), points));
  }
  set_thread_count(before);
  EXPECT_EQ(light[0], light[1]);
}

TEST(Ddgi, AShutDoorLeaksLittleAndLessThanWithoutVisibility) {
  const scene::Scene scene = scene::make_builtin("two-rooms");
  const trace::TransportScene source(scene);
  const trace::PathTracer tracer(scene, 0);
  const auto points = points_of(scene, source, 0, 300);
  const study::LeakParams params{.path = {.max_depth = 25, .passes = 1, .spp = 64, .seed = 1}};
  double leak[2] = {};
  for (int k = 0; k < 2; ++k) {
    const auto ddgi = make("ddgi", scene, source,
                           {k == 0 ? "visibility=0" : "visibility=1", "spacing=0.7", "rays=48", "warmup=16"});
    ddgi->update(rays::lighting_at(source, 0), {});
    const study::LeakReport report = study::measure_leak(tracer, ddgi->light(), points, params);
    EXPECT_GT(report.dark, 100u);
    leak[k] = report.ratio;
  }
  RecordProperty("leak_percent", std::to_string(100 * leak[1]));
  EXPECT_LT(leak[1], 0.02);
  EXPECT_LT(leak[1], 0.5 * leak[0]);
}

TEST(Ddgi, AnOpenedDoorTakesFrames) {
  const scene::Scene scene = scene::make_builtin("two-rooms");
  const trace::TransportScene source(scene);
  const float open = source.duration();
  const auto points = points_of(scene, source, open, 200);
  const auto truth = trace::PathTracer(scene, open).surface_irradiance(points, {25, 1, 256, 3}, {});
  const auto ddgi =
      make("ddgi", scene, source, {"spacing=1", "rays=64", "warmup=24", "hysteresis=0.9", "change=0"});
  ddgi->update(rays::lighting_at(source, 0), {});
  std::vector<double> errors;
  for (int frame = 0; frame < 33; ++frame) {
    ddgi->update(rays::lighting_at(source, open), {});
    if (frame % 8 == 0) errors.push_back(error_of(*ddgi, points, truth));
  }
  for (std::size_t i = 1; i < 4; ++i) EXPECT_LT(errors[i], errors[i - 1]) << i;
  EXPECT_LT(errors.back(), 0.5 * errors.front());
}

TEST(Ddgi, ARoofSeenFromOutsideStaysDark) {
  // The lit room has a roof of 15 cm; probes stand above that, too.
  scene::Scene scene = coloured_room({3, 3, 3});
  add_body(scene, "roof", scene::make_box({-1.2f, 1.001f, -1.2f}, {1.2f, 1.15f, 1.2f}), vec3(0.5f));
  add_sphl(scene, "outside", {0, 1.8f, 0});
  scene::validate(scene);
  const trace::TransportScene source(scene);
  const auto ddgi = make("ddgi", scene, source, {"spacing=0.4", "rays=64", "warmup=8"});
  ddgi->update(rays::lighting_at(source, 0), {});
  const float inside = ddgi->light().irradiance({{0, -0.99f, 0}, {0, 1, 0}}).g;
  EXPECT_GT(inside, 1);
  for (const vec2& at : {vec2(0), vec2(0.5f, 0.3f), vec2(-0.7f, 0.6f)})
    EXPECT_LT(ddgi->light().irradiance({{at.x, 1.15f, at.y}, {0, 1, 0}}).g, 0.01f * inside) << at.x;
}

TEST(Ddgi, ProbesLeaveWallsOrSleep) {
  // A thick block fills the middle of the room: probes deep inside of it sleep.
  scene::Scene scene = coloured_room({3, 3, 3});
  add_body(scene, "block", scene::make_box({-0.45f, -1, -0.45f}, {0.45f, 0.6f, 0.45f}), vec3(0.5f));
  scene.sphls.clear();
  add_sphl(scene, "above", {0, 0.8f, 0});
  scene::validate(scene);
  const trace::TransportScene source(scene);
  const auto ddgi = make("ddgi", scene, source, {"spacing=0.25", "rays=16", "warmup=1"});
  ddgi->update(rays::lighting_at(source, 0), {});
  EXPECT_EQ(number(*ddgi, "probes"), 512);
  // 4·6·4 stand in the block, the 2·6·2 in its middle too deep to get out.
  EXPECT_LE(number(*ddgi, "active"), 512 - 2 * 6 * 2);
  EXPECT_GT(number(*ddgi, "active"), 512 - 4 * 6 * 4);
  const auto still = make("ddgi", scene, source, {"spacing=0.25", "rays=16", "warmup=1", "relocate=0"});
  still->update(rays::lighting_at(source, 0), {});
  EXPECT_EQ(number(*still, "active"), 512 - 4 * 6 * 4);
}

}  // namespace
}  // namespace ssphh::test
