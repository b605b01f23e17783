/// Voxel cone tracing against path-traced irradiance at surface points, and its answer to change.

#include <gtest/gtest.h>

#include <ssphh/core/parallel.h>
#include <ssphh/core/random.h>
#include <ssphh/methods/method_list.h>
#include <ssphh/scene/builtin.h>
#include <ssphh/scene/query.h>
#include <ssphh/study/surface_points.h>
#include <ssphh/trace/path_tracer.h>
#include <ssphh/trace/transport_scene.h>

namespace ssphh {
namespace {

using Settings = std::vector<std::string>;

std::unique_ptr<methods::Method> make_vct(const scene::Scene& scene, const rays::TransportSource& source,
                                          const Settings& settings) {
  const methods::MethodEntry& entry = methods::find_method("vct");
  return entry.make({scene, source}, methods::MethodParameters("vct", entry.parameters, settings), {});
}

std::vector<vec3> irradiance_at(const methods::Method& method,
                                const std::vector<rays::SurfacePoint>& points) {
  std::vector<vec3> values;
  for (const rays::SurfacePoint& point : points) values.push_back(method.light().irradiance(point));
  return values;
}

/// A built-in scene, points on its surfaces, and the path tracer's one bounce there.
struct Subject {
  explicit Subject(const std::string& name, int count = 150, int spp = 256, float at = 0)
      : scene(scene::make_builtin(name)), source(scene), time(at) {
    std::vector<vec3> origins;
    for (const scene::ProbePlace& place : scene::sphl_places(scene)) origins.push_back(place.position);
    points = study::reachable_points(source, origins, time, {count, 1});
    const trace::PathTracer tracer(scene, time);
    for (const auto& e : tracer.surface_irradiance(points, {2, 1, spp, 1}, {}))
      truth.push_back(static_cast<double>(luminance(e.indirect)));
  }

  std::vector<vec3> lit(Settings settings, int bounces = 1) const {
    settings.push_back("bounces=" + std::to_string(bounces));
    const auto method = make_vct(scene, source, settings);
    method->update(rays::lighting_at(source, time), {});
    return irradiance_at(*method, points);
  }

  /// Sum of light over the truth's, mean distance in shares of the true mean, and the share of the light that
  /// is where the truth is none.
  struct Result {
    double ratio = 0, error = 0, leak = 0;
  };
  Result compare(const Settings& settings) const {
    const std::vector<vec3> found = lit(settings);
    double sum = 0, all = 0, distance = 0, dark = 0;
    for (std::size_t i = 0; i < points.size(); ++i) {
      const auto e = static_cast<double>(luminance(found[i]));
      sum += truth[i], all += e, distance += std::abs(e - truth[i]);
      if (!(truth[i] > 0)) dark += e;
    }
    return {all / sum, distance / sum, dark / all};
  }

  scene::Scene scene;
  trace::TransportScene source;
  float time;
  std::vector<rays::SurfacePoint> points;
  std::vector<double> truth;
};

TEST(Vct, ErrorFallsWithResolution) {
  const Subject cornell("cornell", 150, 1024);
  double last = 1;
  for (const char* resolution : {"16", "32", "64"}) {
    const auto result = cornell.compare({std::string("resolution=") + resolution, "cones=256"});
    RecordProperty(std::string("error_") + resolution, std::to_string(result.error));
    RecordProperty(std::string("ratio_") + resolution, std::to_string(result.ratio));
    EXPECT_LT(result.error, last) << resolution;
    EXPECT_NEAR(result.ratio, 1, 0.08) << resolution;
    last = result.error;
  }
  EXPECT_LT(last, 0.1);
}

TEST(Vct, MoreConesAreBetter) {
  const Subject cornell("cornell");
  const double few = cornell.compare({"resolution=64", "cones=6"}).error;
  const double some = cornell.compare({"resolution=64", "cones=16"}).error;
  const double many = cornell.compare({"resolution=64", "cones=64"}).error;
  EXPECT_LT(some, few);
  EXPECT_LT(many, some);
}

TEST(Vct, EveryBounceOfAClosedRoom) {
  // builtin:box: Le = 1 and ρ = 1/2 on every wall, so that d bounces bring π (1/2 + … + 1/2^d).
  const Subject box("box", 150, 1);
  double expected = 0;
  double last = 1;
  for (const char* resolution : {"16", "32", "64"}) {
    const double error = [&] {
      double sum = 0;
      for (const vec3& e : box.lit({std::string("resolution=") + resolution}))
        sum += std::abs(static_cast<double>(e.x) / (pi_d / 2) - 1);
      return sum / static_cast<double>(box.points.size());
    }();
    EXPECT_LT(error, last) << resolution;
    last = error;
  }
  EXPECT_LT(last, 0.03);
  for (int bounces = 1; bounces <= 4; ++bounces) {
    expected += pi_d * std::ldexp(1.0, -bounces);
    double mean = 0;
    for (const vec3& e : box.lit({"resolution=32"}, bounces)) mean += static_cast<double>(e.x);
    mean /= static_cast<double>(box.points.size());
    EXPECT_NEAR(mean / expected, 1, 0.08) << bounces;  // 4 % is lost at each bounce: 0.96 … 0.935
  }
}

TEST(Vct, GlossyLobesSeeWhatIsThere) {
  // The same radiance from everywhere: whatever the lobe, and however much of it the surface hides.
  // Away from edges, where cones along a wall lose the part that the wall cuts off.
  const Subject box("box", 1, 1);
  const auto method = make_vct(box.scene, box.source, {"resolution=64", "bounces=1"});
  method->update(rays::lighting_at(box.source, 0), {});
  for (int i = 0; i < 12; ++i) {
    Pcg32 random(1, static_cast<std::uint64_t>(i));
    const int axis = i % 3;
    rays::SurfacePoint point{0.8f * (random.uniform3() - 0.5f), vec3(0)};
    point.position[axis] = -1, point.normal[axis] = 1;
    const Frame frame = Frame::around(point.normal);
    for (const float roughness : {0.0f, 0.3f, 1.0f}) {
      for (const float slant : {0.0f, 1.0f, 4.0f}) {
        const vec3 r = frame.to_world(glm::normalize(vec3(slant, 0, 1)));
        EXPECT_NEAR(method->light().glossy(point, r, roughness).x, 0.5f, 0.05f) << roughness << ' ' << slant;
      }
    }
  }
}

TEST(Vct, AShutDoorLeaksNoMoreThanItsVoxels) {
  const Subject rooms("two-rooms", 300, 64);
  const double coarse = rooms.compare({"resolution=16"}).leak, middle = rooms.compare({"resolution=64"}).leak;
  const double fine = rooms.compare({"resolution=128"}).leak;
  RecordProperty("leak_percent_16_64_128", std::to_string(100 * coarse) + " " + std::to_string(100 * middle) +
                                               " " + std::to_string(100 * fine));
  EXPECT_LT(middle, coarse);
  EXPECT_LT(fine, middle);
  EXPECT_LT(fine, 0.006);
  EXPECT_GT(fine, 0) << "then the page on failures is wrong";
}

TEST(Vct, SparseAndDenseAreTheSameToTheBit) {
  const Subject cornell("cornell", 50, 1);
  EXPECT_EQ(cornell.lit({"resolution=32", "storage=sparse"}, 2),
            cornell.lit({"resolution=32", "storage=dense"}, 2));
}

TEST(Vct, TheNumberOfThreadsDoesNotMatter) {
  const Subject rooms("two-rooms", 50, 1, 0.5f);
  set_thread_count(1);
  const std::vector<vec3> one = rooms.lit({"resolution=32"}, 2);
  set_thread_count(7);
  const std::vector<vec3> seven = rooms.lit({"resolution=32"}, 2);
  set_thread_count(0);
  EXPECT_EQ(one, seven);
}

TEST(Vct, FramesAreAsIfMadeAnew) {
  const Subject rooms("two-rooms", 50, 1, 1);
  const Settings settings = {"resolution=32", "bounces=2", "bounce_cones=4"};
  const auto follows = make_vct(rooms.scene, rooms.source, settings);
  const auto fresh = [&](const scene::LightingState& state) {
    const auto method = make_vct(rooms.scene, rooms.source, settings);
    method->update(state, {});
    return irradiance_at(*method, rooms.points);
  };
  scene::LightingState state = rays::lighting_at(rooms.source, 0);
  follows->update(state, {});
  std::vector<std::vector<vec3>> frames{irradiance_at(*follows, rooms.points)};
  const auto step = [&](const char* what) {
    follows->update(state, {});
    frames.push_back(irradiance_at(*follows, rooms.points));
    EXPECT_EQ(frames.back(), fresh(state)) << what;
    EXPECT_NE(frames.back(), frames[frames.size() - 2]) << what;
  };
  state.time = 0.4f;
  step("the door opens");
  state.lights[0].world[3].z += 0.5f;
  step("the lamp moves");
  state.group_scales[0] = vec3(0.5f, 1, 2);
  step("its group is recoloured");
  state = rays::lighting_at(rooms.source, 0);
  step("all as before");
  EXPECT_EQ(frames.back(), frames.front());
}

TEST(Vct, MemoryIsReported) {
  const Subject cornell("cornell", 1, 1);
  const auto bytes = [&](Settings settings) {
    settings.push_back("bounces=1");
    const auto method = make_vct(cornell.scene, cornell.source, settings);
    method->update(rays::lighting_at(cornell.source, 0), {});
    return static_cast<double>(method->memory().lookup);
  };
  // 16 bytes for each of six sides; 64³ · 8/7 voxels.
  EXPECT_NEAR(bytes({"resolution=64", "storage=dense"}), 64.0 * 64 * 64 * 8 / 7 * 96,
              64 * 64 * 64 * 96 * 0.03);
  EXPECT_LT(bytes({"resolution=64"}), 0.6 * bytes({"resolution=64", "storage=dense"}));
  const double growth = bytes({"resolution=64"}) / bytes({"resolution=32"});
  EXPECT_GT(growth, 3);
  EXPECT_LT(growth, 5);
}

}  // namespace
}  // namespace ssphh
