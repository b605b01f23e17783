/// Virtual point lights against closed forms and path tracing.

#include <cmath>

#include <gtest/gtest.h>

#include <ssphh/core/parallel.h>
#include <ssphh/methods/method_list.h>
#include <ssphh/study/leak.h>
#include <ssphh/study/lookup_error.h>
#include <ssphh/study/surface_points.h>
#include <ssphh/trace/path_tracer.h>

#include "transport_fixtures.h"
#include "z_test.h"

namespace ssphh::test {
namespace {

/// The method vpl of a scene, brought up to date.
struct Vpls {
  Vpls(const scene::Scene& scene, const trace::TransportScene& source, std::vector<std::string> settings) {
    settings.emplace_back("check_points=" + std::to_string(check_points));
    const methods::MethodEntry& entry = methods::find_method("vpl");
    method = entry.make({scene, source}, {"vpl", entry.parameters, settings}, {});
    method->update(rays::lighting_at(source, 0), {});
  }
  double number(const std::string& name) const {
    for (const auto& [n, value] : method->numbers()) {
      if (n == name) return value;
    }
    return NAN;
  }
  std::vector<vec3> at(const std::vector<rays::SurfacePoint>& points) const {
    return study::look_up(method->light(), points);
  }
  static inline int check_points = 0;
  std::unique_ptr<methods::Method> method;
};

/// A diffuse scene with lamps of several kinds, and points away from its corners, where unbounded virtual
/// lights have no variance worth the name.
struct LampRoom {
  LampRoom() : scene(coloured_room({2, 1.5f, 1})) {
    scene::Light light;
    light.name = "bulb", light.type = scene::LightType::sphere, light.radius = 0.1f, light.intensity = 8;
    light.node = scene.sphls[2].node;
    scene.lights.push_back(light);
    light.name = "spot", light.type = scene::LightType::spot, light.intensity = 1;
    light.node = scene.sphls[0].node;
    scene.lights.push_back(light);
    scene::validate(scene);
  }
  scene::Scene scene;
  const std::vector<rays::SurfacePoint> points = {{{0, -0.2f, 0}, {0, 1, 0}},
                                                  {{0.2f, 0.1f, -0.3f}, {1, 0, 0}},
                                                  {{-0.3f, 0, 0.2f}, glm::normalize(vec3(-1, -1, 1))}};
};

/// Means over independent seeds, [point][channel].
std::vector<std::array<Samples, 3>> over_seeds(const LampRoom& room, const trace::TransportScene& source,
                                               const std::vector<std::string>& settings, int seeds) {
  std::vector<std::array<Samples, 3>> samples(room.points.size());
  for (int seed = 0; seed < seeds; ++seed) {
    auto with_seed = settings;
    with_seed.push_back("seed=" + std::to_string(seed));
    const std::vector<vec3> e = Vpls(room.scene, source, with_seed).at(room.points);
    for (std::size_t i = 0; i < e.size(); ++i) {
      for (int c = 0; c < 3; ++c) samples[i][c].add(double(e[i][c]));
    }
  }
  return samples;
}

class VplMean : public testing::TestWithParam<int> {};

TEST_P(VplMean, IsWhatPathsFind) {
  const int depth = GetParam();
  const LampRoom room;
  const trace::TransportScene source(room.scene);
  const auto traced =
      trace::PathTracer(room.scene).surface_irradiance(room.points, {depth, 1, 1 << 15, 5}, {});
  const auto vpl = over_seeds(room, source, {"photons=256", "clamp=0", "depth=" + std::to_string(depth)}, 64);
  for (std::size_t i = 0; i < room.points.size(); ++i) {
    for (int c = 0; c < 3; ++c) {
      const Samples& samples = vpl[i][c];
      EXPECT_TRUE(difference_is_noise(samples.mean() - double(traced[i].indirect[c]),
                                      samples.variance_of_mean() + double(traced[i].indirect_variance[c]),
                                      {1e-3, 2 * 3 * 3}, 1e-4 * samples.mean()))
          << "point " << i << ", channel " << c << ", traced " << traced[i].indirect[c];
    }
  }
}

INSTANTIATE_TEST_SUITE_P(Depth, VplMean, testing::Values(2, 25));

TEST(Vpl, FurnaceHoldsEveryBounce) {
  const float albedo = 0.6f;
  const scene::Scene scene = GlowingBox::painted(albedo);
  const trace::TransportScene source(scene);
  // At the middle no wall is near: spheres lose nothing there, nor do bounded points.
  const std::vector<rays::SurfacePoint> middle = {{vec3(0), {0, 1, 0}}, {vec3(0), {1, 0, 0}}};
  for (const char* kind : {"kind=point", "kind=sphere"}) {
    for (const vec3& e : Vpls(scene, source, {"photons=8192", kind}).at(middle))
      EXPECT_NEAR(e.g / (pi * albedo / (1 - albedo)), 1, 0.02f) << kind;
  }
}

TEST(Vpl, ErrorFallsWithTheCount) {
  const scene::Scene scene = scene::make_builtin("cornell");
  const trace::TransportScene source(scene);
  const auto points = study::reachable_points(source, positions_of(places_of(scene)), 0, {100, 1, 0.05f});
  const auto truth = trace::PathTracer(scene).surface_irradiance(points, {25, 1, 512, 3}, {});
  double last = 10;
  for (const char* photons : {"photons=16", "photons=256", "photons=4096"}) {
    const Vpls vpl(scene, source, {photons, "clamp=0"});
    const double error = study::lookup_error(vpl.at(points), truth).luminance.mean_error;
    RecordProperty(photons, std::to_string(error));
    EXPECT_LT(error, 0.7 * last) << photons;
    last = error;
  }
  EXPECT_LT(last, 0.15);
}

TEST(Vpl, TheBoundLosesWhatItSaysAndSpheresKeepIt) {
  const LampRoom room;
  const trace::TransportScene source(room.scene);
  const auto points = study::reachable_points(source, positions_of(places_of(room.scene)), 0, {200, 2});
  Vpls::check_points = 64;
  const Vpls open(room.scene, source, {"photons=2048", "clamp=0"});
  const Vpls bounded(room.scene, source, {"photons=2048", "clamp=0.3"});
  const Vpls spheres(room.scene, source, {"photons=2048", "kind=sphere"});
  Vpls::check_points = 0;
  EXPECT_EQ(open.number("lost_energy"), 0);
  const auto mean = [&](const Vpls& v) {
    double sum = 0;
    for (const vec3& e : v.at(points)) sum += double(luminance(e)) / static_cast<double>(points.size());
    return sum;
  };
  double truth = 0;
  for (const auto& e : trace::PathTracer(room.scene).surface_irradiance(points, {25, 1, 256, 3}, {}))
    truth += double(luminance(e.indirect)) / static_cast<double>(points.size());
  const double lost = 1 - mean(bounded) / truth;
  EXPECT_GT(lost, 0.05);
  // Few points are asked, and the unbounded sum it is compared with is noisy.
  EXPECT_NEAR(bounded.number("lost_energy"), lost, 0.1);
  // Hašan et al.'s spheres reach into walls: a few percent are missing in corners.
  EXPECT_NEAR(mean(spheres) / truth, 1, 0.1);
}

TEST(Vpl, CutsErrAsLittleAsAsked) {
  const scene::Scene scene = scene::make_builtin("cornell");
  const trace::TransportScene source(scene);
  const auto points = study::reachable_points(source, positions_of(places_of(scene)), 0, {50, 1});
  for (const char* kind : {"kind=point", "kind=sphere"}) {
    Vpls::check_points = 16;
    const Vpls all(scene, source, {"photons=1024", kind});
    const Vpls exact(scene, source, {"photons=1024", kind, "cluster_error=1e-7"});
    const Vpls cut(scene, source, {"photons=1024", kind, "cluster_error=0.02"});
    Vpls::check_points = 0;
    const auto a = all.at(points), e = exact.at(points), c = cut.at(points);
    double error = 0;
    for (std::size_t i = 0; i < points.size(); ++i) {
      const double light = double(luminance(a[i]));
      EXPECT_NEAR(double(luminance(e[i])), light, 1e-3 * light);
      error += std::abs(double(luminance(c[i])) - light) / light / static_cast<double>(points.size());
    }
    // The bound holds for each cluster; their errors add up at random.
    EXPECT_LT(error, 0.04) << kind;
    EXPECT_LT(cut.number("lights_per_point"), 0.5 * all.number("vpls")) << kind;
    EXPECT_GT(cut.method->memory().lookup, all.method->memory().lookup);
  }
}

TEST(Vpl, SameBitsForAnyNumberOfThreads) {
  const LampRoom room;
  const trace::TransportScene source(room.scene);
  const int before = thread_count();
  std::vector<std::vector<vec3>> light;
  for (const int threads : {1, 4}) {
    set_thread_count(threads);
    light.push_back(
        Vpls(room.scene, source, {"photons=2000", "cluster_error=0.02", "kind=sphere"}).at(room.points));
  }
  set_thread_count(before);
  EXPECT_EQ(light[0], light[1]);
}

}  // namespace
}  // namespace ssphh::test
