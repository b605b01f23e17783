/// The path tracer's ray rate beside bare Embree on the same rays, and the seconds of GEN and VIZ.

#include <algorithm>
#include <chrono>
#include <cstdlib>
#include <filesystem>
#include <map>

#include <benchmark/benchmark.h>
#include <embree3/rtcore.h>

#include <ssphh/core/parallel.h>
#include <ssphh/scene/builtin.h>
#include <ssphh/scene_io/load.h>
#include <ssphh/trace/path_tracer.h>

#include "ray_recording.h"

namespace ssphh {
namespace {

using Clock = std::chrono::steady_clock;

double seconds_since(Clock::time_point start) {
  return std::chrono::duration<double>(Clock::now() - start).count();
}

/// Dabrovic's Sponza with its customary camera and lamp, if $SSPHH_SCENES has the file.
std::optional<scene::Scene> sponza() {
  const char* folder = std::getenv("SSPHH_SCENES");
  if (!folder || !std::filesystem::exists(std::filesystem::path(folder) / "sponza/sponza.glb"))
    return std::nullopt;
  return scene_io::load_scene(SSPHH_SOURCE_DIR "/examples/scenes/sponza.ssphh.json");
}

/// Every triangle cut into four at the middles of its edges; the surface stays what it is.
void split(scene::Mesh& mesh) {
  std::map<std::pair<std::uint32_t, std::uint32_t>, std::uint32_t> middles;
  const auto middle = [&](std::uint32_t a, std::uint32_t b) {
    const auto [place, added] = middles.emplace(std::minmax(a, b), mesh.positions.size());
    const auto add = [&](auto& values) {
      if (!values.empty()) values.push_back(0.5f * (values[a] + values[b]));
    };
    if (added) {
      add(mesh.positions), add(mesh.normals), add(mesh.uvs[0]), add(mesh.uvs[1]), add(mesh.colors);
      if (!mesh.tangents.empty()) mesh.tangents.push_back(mesh.tangents[a]);
    }
    return place->second;
  };
  std::vector<uvec3> parts;
  for (const uvec3& t : mesh.triangles) {
    const std::uint32_t xy = middle(t.x, t.y), yz = middle(t.y, t.z), zx = middle(t.z, t.x);
    parts.insert(parts.end(), {{t.x, xy, zx}, {xy, t.y, yz}, {zx, yz, t.z}, {xy, yz, zx}});
  }
  mesh.triangles = std::move(parts);
}

/// Splits the finest meshes that leave the scene with at most `triangles`, each at most once.
scene::Scene refined(scene::Scene scene, std::uint64_t triangles) {
  std::vector<scene::Mesh*> meshes;
  for (scene::Mesh& mesh : scene.meshes) meshes.push_back(&mesh);
  std::stable_sort(meshes.begin(), meshes.end(),
                   [](const auto* a, const auto* b) { return a->triangles.size() > b->triangles.size(); });
  std::uint64_t total = scene::triangle_count(scene);
  for (scene::Mesh* mesh : meshes) {
    if (total + 3 * mesh->triangles.size() > triangles) continue;
    total += 3 * mesh->triangles.size();
    split(*mesh);
  }
  return scene;
}

/// A trailing "_260k" asks for the scene refined to about the triangles of Crytek's Sponza.
std::optional<scene::Scene> scene_named(const std::string& name) {
  const std::string base = name.substr(0, name.find("_260k"));
  std::optional<scene::Scene> scene = base == "sponza" ? sponza() : scene::make_builtin(base);
  return scene && base != name ? refined(std::move(*scene), 266'000) : std::move(scene);
}

/// All instances in world space, straight into Embree.
class BareEmbree {
 public:
  explicit BareEmbree(const scene::Scene& scene)
      : device_(rtcNewDevice(nullptr)), scene_(rtcNewScene(device_)) {
    rtcSetSceneFlags(scene_, RTC_SCENE_FLAG_ROBUST);
    rtcSetSceneBuildQuality(scene_, RTC_BUILD_QUALITY_HIGH);
    const std::vector<mat4> world = scene::world_matrices(scene);
    for (const scene::Instance& instance : scene.instances) {
      const scene::Mesh& mesh = scene.meshes[instance.mesh];
      RTCGeometry geometry = rtcNewGeometry(device_, RTC_GEOMETRY_TYPE_TRIANGLE);
      auto* vertices = static_cast<vec3*>(rtcSetNewGeometryBuffer(
          geometry, RTC_BUFFER_TYPE_VERTEX, 0, RTC_FORMAT_FLOAT3, sizeof(vec3), mesh.positions.size()));
      for (const vec3& p : mesh.positions) *vertices++ = vec3(world[instance.node] * vec4(p, 1));
      void* indices = rtcSetNewGeometryBuffer(geometry, RTC_BUFFER_TYPE_INDEX, 0, RTC_FORMAT_UINT3,
                                              sizeof(uvec3), mesh.triangles.size());
      std::copy(mesh.triangles.begin(), mesh.triangles.end(), static_cast<uvec3*>(indices));
      rtcCommitGeometry(geometry);
      rtcAttachGeometry(scene_, geometry);
      rtcReleaseGeometry(geometry);
    }
    rtcCommitScene(scene_);
  }
  ~BareEmbree() {
    rtcReleaseScene(scene_);
    rtcReleaseDevice(device_);
  }
  BareEmbree(const BareEmbree&) = delete;
  BareEmbree& operator=(const BareEmbree&) = delete;

  /// Traces a ray as it was recorded; whether something was hit.
  bool trace(const trace::RecordedRay& recorded) const {
    RTCIntersectContext context;
    rtcInitIntersectContext(&context);
    RTCRayHit r;
    r.ray.org_x = recorded.origin.x, r.ray.org_y = recorded.origin.y, r.ray.org_z = recorded.origin.z;
    r.ray.dir_x = recorded.direction.x, r.ray.dir_y = recorded.direction.y,
    r.ray.dir_z = recorded.direction.z;
    r.ray.tnear = 0, r.ray.tfar = recorded.t_max;
    r.ray.time = 0, r.ray.mask = ~0u, r.ray.id = 0, r.ray.flags = 0;
    if (recorded.occlusion) {
      rtcOccluded1(scene_, &context, &r.ray);
      return r.ray.tfar < 0;
    }
    r.hit.geomID = r.hit.instID[0] = RTC_INVALID_GEOMETRY_ID;
    rtcIntersect1(scene_, &context, &r);
    return r.hit.geomID != RTC_INVALID_GEOMETRY_ID;
  }

 private:
  RTCDevice device_;
  RTCScene scene_;
};

/// Per iteration one render and one replay of its rays through bare Embree, in the tasks and order of the
/// render; the two alternate, so that both see the same machine.
void ray_rate(benchmark::State& state, const std::string& name) {
  const std::optional<scene::Scene> scene = scene_named(name);
  if (!scene) return state.SkipWithError("real scene absent (set SSPHH_SCENES)");
  const trace::PathTracer tracer(*scene);
  trace::RenderParams params;
  params.width = 480, params.height = 270;
  params.camera = scene::camera_pose(*scene, "");
  params.path = {3, 1, 4, 1};

  // Record the rays once.
  trace::RayRecording recording;
  {
    trace::set_ray_recording(&recording);
    trace::RenderState image;
    tracer.render(params, image);
    trace::set_ray_recording(nullptr);
  }
  std::vector<const std::vector<trace::RecordedRay>*> tasks;
  std::uint64_t rays = 0, shadow_rays = 0;
  for (const auto& [id, task] : recording.tasks()) {
    tasks.push_back(&task);
    rays += task.size();
    for (const trace::RecordedRay& ray : task) shadow_rays += ray.occlusion;
  }
  const BareEmbree bare(*scene);

  double render_seconds = 0, bare_seconds = 0;
  for (auto _ : state) {
    Clock::time_point start = Clock::now();
    trace::RenderState image;
    tracer.render(params, image);
    const double seconds = seconds_since(start);
    render_seconds += seconds;
    state.SetIterationTime(seconds);
    benchmark::DoNotOptimize(image.rays);

    start = Clock::now();
    std::atomic<std::uint64_t> hits{0};
    parallel_for(tasks.size(), 1, [&](std::size_t begin, std::size_t end) {
      std::uint64_t found = 0;
      for (std::size_t t = begin; t < end; ++t) {
        for (const trace::RecordedRay& ray : *tasks[t]) found += bare.trace(ray);
      }
      hits += found;
    });
    bare_seconds += seconds_since(start);
    benchmark::DoNotOptimize(hits.load());
  }
  const double total = static_cast<double>(rays) * static_cast<double>(state.iterations());
  state.counters["tracer_Mrays_per_s"] = total / render_seconds * 1e-6;
  state.counters["embree_Mrays_per_s"] = total / bare_seconds * 1e-6;
  state.counters["share_percent"] = 100 * bare_seconds / render_seconds;
  state.counters["shadow_percent"] = 100.0 * static_cast<double>(shadow_rays) / static_cast<double>(rays);
  state.counters["triangles"] = static_cast<double>(scene::triangle_count(*scene));
}
BENCHMARK_CAPTURE(ray_rate, gallery1, "gallery1")->UseManualTime()->Unit(benchmark::kMillisecond);
BENCHMARK_CAPTURE(ray_rate, gallery3, "gallery3")->UseManualTime()->Unit(benchmark::kMillisecond);
BENCHMARK_CAPTURE(ray_rate, sponza, "sponza")->UseManualTime()->Unit(benchmark::kMillisecond);
BENCHMARK_CAPTURE(ray_rate, gallery3_260k, "gallery3_260k")->UseManualTime()->Unit(benchmark::kMillisecond);
BENCHMARK_CAPTURE(ray_rate, sponza_260k, "sponza_260k")->UseManualTime()->Unit(benchmark::kMillisecond);

/// Six places: the scene's SPHLs, repeated around if there are fewer.
std::vector<rays::CubeRequest> six_probes(const scene::Scene& scene) {
  const std::vector<scene::ProbePlace> places = scene::sphl_places(scene);
  std::vector<rays::CubeRequest> requests;
  for (std::size_t i = 0; i < 6; ++i) {
    const vec3 position =
        places[i % places.size()].position + vec3(0.05f * static_cast<float>(i / places.size()));
    requests.push_back({position, 64, {3, 1, 16, i}});
  }
  return requests;
}

void gen_six_probes(benchmark::State& state, const std::string& name) {
  const scene::Scene scene = scene::make_builtin(name);
  const trace::PathTracer tracer(scene);
  const std::vector<rays::CubeRequest> requests = six_probes(scene);
  const std::uint64_t before = tracer.rays_traced();
  for (auto _ : state) {
    for (const rays::CubeRequest& request : requests)
      benchmark::DoNotOptimize(tracer.incident_radiance(request, {}));
  }
  state.counters["rays"] =
      benchmark::Counter(static_cast<double>(tracer.rays_traced() - before), benchmark::Counter::kIsRate);
}
BENCHMARK_CAPTURE(gen_six_probes, gallery1, "gallery1")->UseRealTime()->Unit(benchmark::kSecond);
BENCHMARK_CAPTURE(gen_six_probes, gallery3, "gallery3")->UseRealTime()->Unit(benchmark::kSecond);

void viz_thirty_pairs(benchmark::State& state, const std::string& name) {
  const scene::Scene scene = scene::make_builtin(name);
  const trace::PathTracer tracer(scene);
  const std::vector<rays::CubeRequest> requests = six_probes(scene);
  const std::uint64_t before = tracer.rays_traced();
  for (auto _ : state) {
    for (std::size_t i = 0; i < requests.size(); ++i) {
      std::vector<rays::GhostSphere> others;
      for (std::size_t j = 0; j < requests.size(); ++j) {
        if (j != i) others.push_back({requests[j].position, 0.1f});
      }
      benchmark::DoNotOptimize(tracer.ghost_radiance(requests[i], others, nullptr, {}));
    }
  }
  state.counters["rays"] =
      benchmark::Counter(static_cast<double>(tracer.rays_traced() - before), benchmark::Counter::kIsRate);
}
BENCHMARK_CAPTURE(viz_thirty_pairs, gallery1, "gallery1")->UseRealTime()->Unit(benchmark::kSecond);
BENCHMARK_CAPTURE(viz_thirty_pairs, gallery3, "gallery3")->UseRealTime()->Unit(benchmark::kSecond);

}  // namespace
}  // namespace ssphh

BENCHMARK_MAIN();
