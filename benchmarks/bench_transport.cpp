/// Light transport between probes: frames of a relight session, and the kernels on synthetic networks from a
/// hundred to a million surfels and probes, beside the machine's memory bandwidth and FMA rate.

#include <algorithm>
#include <chrono>
#include <filesystem>
#include <map>
#include <thread>

#include <benchmark/benchmark.h>
#include <embree3/rtcore.h>

#include <ssphh/core/parallel.h>
#include <ssphh/core/random.h>
#include <ssphh/core/sphere.h>
#include <ssphh/place/place.h>
#include <ssphh/scene/builtin.h>
#include <ssphh/trace/transport_scene.h>
#include <ssphh/transport/network.h>
#include <ssphh/transport/projection.h>
#include <ssphh/transport/relight_session.h>
#include <ssphh/transport/solve.h>

#include "link_file.h"
#include "peak_fma.h"

namespace ssphh {
namespace {

using Clock = std::chrono::steady_clock;
double seconds_since(Clock::time_point start) {
  return std::chrono::duration<double>(Clock::now() - start).count();
}

/// Bytes per second of reading an array far larger than the caches, on all threads: best of five.
double read_bandwidth() {
  static const double rate = [] {
    std::vector<float> data(std::size_t{64} << 20, 1.0f);
    std::vector<double> sums((data.size() >> 16) + 1);
    double best = 0;
    for (int run = 0; run < 5; ++run) {
      const auto start = Clock::now();
      parallel_for(data.size(), 1 << 16, [&](std::size_t begin, std::size_t end) {
        using float8 = float __attribute__((vector_size(32)));
        float8 sum[4] = {};
        for (std::size_t i = begin; i + 32 <= end; i += 32) {
          for (std::size_t k = 0; k < 4; ++k) {
            float8 v;
            __builtin_memcpy(&v, data.data() + i + 8 * k, sizeof(v));
            sum[k] += v;
          }
        }
        const float8 total = (sum[0] + sum[1]) + (sum[2] + sum[3]);
        sums[begin >> 16] = static_cast<double>(total[0] + total[1] + total[2] + total[3] + total[4] +
                                                total[5] + total[6] + total[7]);
      });
      benchmark::DoNotOptimize(sums.data());
      best = std::max(best, static_cast<double>(data.size() * sizeof(float)) / seconds_since(start));
    }
    return best;
  }();
  return rate;
}

/// A network as space-filling order leaves it: links go to surfels near by, with some far ones.
void write_synthetic_links(std::size_t count, std::size_t per_row, transport::LinkRows& rows,
                           std::vector<transport::Link>& links, transport::LinkFileWriter* file = nullptr) {
  Pcg32 rng(count);
  std::vector<transport::Link> row(per_row);
  const float reach = std::min(static_cast<float>(count), 4096.0f);
  for (std::size_t i = 0; i < count; ++i) {
    for (std::size_t k = 0; k < per_row; ++k) {
      const bool far = k % 16 == 15;
      const float offset =
          (rng.uniform() - 0.5f) * (far ? std::min(static_cast<float>(count), 65536.0f) : reach);
      const auto at = static_cast<std::int64_t>(i) + static_cast<std::int64_t>(offset);
      const auto n = static_cast<std::int64_t>(count);
      row[k] = {static_cast<std::uint32_t>(((at % n) + n) % n), 1 / static_cast<float>(per_row)};
    }
    std::sort(row.begin(), row.end(),
              [](const transport::Link& a, const transport::Link& b) { return a.patch < b.patch; });
    if (file) {
      file->add_row(row);
    } else {
      links.insert(links.end(), row.begin(), row.end());
    }
  }
  for (std::size_t i = 0; !file && i < count; ++i)
    rows.rows.push_back({{links.data() + i * per_row, per_row}, {}});
}

void solve_synthetic(benchmark::State& state, const transport::LinkRows& rows) {
  const std::size_t count = rows.rows.size();
  const std::vector<vec3> albedo(count, vec3(0.7f));
  const std::vector<transport::Irradiance4> direct(count, transport::Irradiance4(1, 1, 1, 0));
  std::vector<transport::Irradiance4> indirect;
  transport::Solver solver;
  int iterations = 0;
  double seconds = 0;
  for (auto _ : state) {
    indirect.clear();
    const auto start = Clock::now();
    iterations = solver.solve(rows, albedo, direct, 0.7, {1e-3f, 300}, indirect).iterations;
    seconds += seconds_since(start);
    benchmark::DoNotOptimize(indirect.data());
  }
  const double per_iteration = seconds / static_cast<double>(state.iterations()) / iterations;
  const auto links = static_cast<double>(rows.link_count());
  // Streamed per iteration: the links once, and seven vectors of 12 to 32 bytes per surfel.
  const double bytes = 8 * links + 32.0 * double(count) + (12 + 5 * 16.0 + 16) * double(count);
  state.counters["iterations"] = iterations;
  state.counters["us/iteration"] = 1e6 * per_iteration;
  state.counters["ns/link"] = 1e9 * per_iteration / links;
  state.counters["bytes/surfel"] = (8 * links + (32 + 12 + 6 * 16.0) * double(count)) / double(count);
  state.counters["bandwidth_share"] = bytes / per_iteration / read_bandwidth();
}

constexpr std::size_t links_per_surfel = 64;

void solve(benchmark::State& state) {
  transport::LinkRows rows;
  std::vector<transport::Link> links;
  links.reserve(static_cast<std::size_t>(state.range(0)) * links_per_surfel);
  write_synthetic_links(static_cast<std::size_t>(state.range(0)), links_per_surfel, rows, links);
  solve_synthetic(state, rows);
}
BENCHMARK(solve)->RangeMultiplier(10)->Range(100, 1'000'000)->Unit(benchmark::kMillisecond)->UseRealTime();

/// The same from a memory-mapped file: what the page cache does not hold comes from the disk.
void solve_from_disk(benchmark::State& state) {
  const auto path = std::filesystem::temp_directory_path() / "ssphh-bench.links";
  const auto count = static_cast<std::size_t>(state.range(0));
  {
    transport::LinkRows rows;
    std::vector<transport::Link> links;
    transport::LinkFileWriter file(path);
    write_synthetic_links(count, links_per_surfel, rows, links, &file);
    file.finish();
  }
  {
    const transport::MappedLinks mapped(path);
    state.counters["file_MB"] = static_cast<double>(mapped.bytes()) / 1e6;
    solve_synthetic(state, mapped.rows());
  }
  std::filesystem::remove(path);
}
BENCHMARK(solve_from_disk)->Arg(1'000'000)->Unit(benchmark::kMillisecond)->UseRealTime()->Iterations(1);

/// Arguments: probes, degree. The radiances are gathered as a session does: 384 patches per probe.
void project(benchmark::State& state) {
  const auto probes = static_cast<std::size_t>(state.range(0));
  const int degree = static_cast<int>(state.range(1));
  constexpr int directions = 384;
  std::vector<vec3> fan;
  for (int q = 0; q < directions; ++q) fan.push_back(spherical_fibonacci(q, directions));
  const transport::DirectionProjector projector(degree, fan);
  std::vector<sh::RadianceSh> out(probes, sh::RadianceSh(degree));
  const std::vector<float> radiance(3 * projector.stride(), 0.5f);
  double seconds = 0;
  for (auto _ : state) {
    const auto start = Clock::now();
    parallel_for(probes, 8, [&](std::size_t begin, std::size_t end) {
      for (std::size_t i = begin; i < end; ++i) projector.project(radiance, out[i]);
    });
    seconds += seconds_since(start);
    benchmark::DoNotOptimize(out.data());
  }
  const double fma = double(probes) * 3 * directions * sh::coefficient_count(degree);
  const double time = seconds / static_cast<double>(state.iterations());
  state.counters["ns/probe"] = 1e9 * time / double(probes);
  state.counters["bytes/probe"] = 12.0 * sh::coefficient_count(degree);
  state.counters["fma_share"] = fma / time / (benchmarks::peak_fma_rate() * thread_count());
}
BENCHMARK(project)
    ->ArgNames({"probes", "degree"})
    ->ArgsProduct({{100, 10'000, 1'000'000}, {2}})
    ->ArgsProduct({{100, 10'000}, {4, 9}})
    ->Unit(benchmark::kMillisecond)
    ->UseRealTime();

/// A scene with its session, made once.
struct Relit {
  scene::Scene scene;
  trace::TransportScene source;
  double build_seconds = 0;
  std::unique_ptr<transport::RelightSession> session;

  Relit(const std::string& name, float spacing) : scene(scene::make_builtin(name)), source(scene) {
    place::PlaceParams place = place::place_params(scene, 1.0f);
    place.spacing = spacing;
    std::vector<scene::ProbePlace> places;
    for (const auto& probe : place::place_probes(source, place).probes)
      places.push_back({probe.name, probe.position, 0.1f});
    const auto start = Clock::now();
    session = std::make_unique<transport::RelightSession>(source, std::move(places),
                                                          transport::RelightParams{}, 1.0f);
    build_seconds = seconds_since(start);
    session->update(session->lighting());
  }
};

Relit& relit(const std::string& name, float spacing) {
  static std::map<std::string, std::unique_ptr<Relit>> known;
  auto& slot = known[name];
  if (!slot) slot = std::make_unique<Relit>(name, spacing);
  return *slot;
}

/// Median of each stage over frames.
void report_frames(benchmark::State& state, const Relit& scene,
                   const std::vector<transport::RelightReport>& frames) {
  const auto median = [&](auto value) {
    std::vector<double> values;
    for (const transport::RelightReport& frame : frames) values.push_back(static_cast<double>(value(frame)));
    std::nth_element(values.begin(), values.begin() + static_cast<std::ptrdiff_t>(values.size() / 2),
                     values.end());
    return values[values.size() / 2];
  };
  const transport::TransportNetwork& network = scene.session->network();
  state.counters["probes"] = static_cast<double>(scene.session->places().size());
  state.counters["surfels"] = static_cast<double>(network.surfel_count());
  state.counters["links"] = static_cast<double>(network.links().link_count());
  state.counters["build_ms"] = 1e3 * scene.build_seconds;
  state.counters["median_ms"] = median([](const auto& f) { return f.total_ms(); });
  state.counters["pose_ms"] = median([](const auto& f) { return f.pose_ms; });
  state.counters["direct_ms"] = median([](const auto& f) { return f.direct_ms; });
  state.counters["solve_ms"] = median([](const auto& f) { return f.solve_ms; });
  state.counters["project_ms"] = median([](const auto& f) { return f.project_ms; });
  state.counters["iterations"] = median([](const auto& f) { return f.solve.iterations; });
  state.counters["rays"] = median([](const auto& f) { return f.pose_rays + f.direct_rays; });
}

/// Shadow rays per second of a bare Embree loop over the segments that a moved lamp asks for, on all threads.
double bare_shadow_rate(const Relit& scene, const vec3& lamp) {
  // Vertices of all triangles, flattened.
  const std::vector<mat4> world = scene::world_matrices(scene.scene, 1.0f);
  std::vector<vec3> vertices;
  for (const scene::Instance& instance : scene.scene.instances) {
    if (instance.mesh < 0) continue;
    const scene::Mesh& mesh = scene.scene.meshes[instance.mesh];
    const mat4 to_world = instance.node < 0 ? mat4(1) : world[instance.node];
    for (const uvec3& t : mesh.triangles) {
      for (int c = 0; c < 3; ++c) vertices.emplace_back(to_world * vec4(mesh.positions[t[c]], 1));
    }
  }
  std::vector<std::uint32_t> indices(vertices.size());
  for (std::size_t i = 0; i < indices.size(); ++i) indices[i] = static_cast<std::uint32_t>(i);
  const std::size_t triangles = indices.size() / 3;
  vertices.emplace_back(0);

  RTCDevice device = rtcNewDevice(nullptr);
  RTCScene embree = rtcNewScene(device);
  rtcSetSceneFlags(embree, RTC_SCENE_FLAG_ROBUST);
  rtcSetSceneBuildQuality(embree, RTC_BUILD_QUALITY_HIGH);
  RTCGeometry geometry = rtcNewGeometry(device, RTC_GEOMETRY_TYPE_TRIANGLE);
  rtcSetSharedGeometryBuffer(geometry, RTC_BUFFER_TYPE_VERTEX, 0, RTC_FORMAT_FLOAT3, vertices.data(), 0,
                             sizeof(vec3), vertices.size() - 1);
  rtcSetSharedGeometryBuffer(geometry, RTC_BUFFER_TYPE_INDEX, 0, RTC_FORMAT_UINT3, indices.data(), 0,
                             sizeof(uvec3), triangles);
  rtcCommitGeometry(geometry);
  rtcAttachGeometry(embree, geometry);
  rtcReleaseGeometry(geometry);
  rtcCommitScene(embree);

  std::vector<RTCRay> rays;
  for (const rays::SurfacePoint& p : scene.session->network().samples()) {
    const vec3 origin = p.position + 1e-3f * p.normal, d = lamp - origin;
    if (!(glm::dot(d, p.normal) > 0)) continue;
    RTCRay ray{};
    ray.org_x = origin.x, ray.org_y = origin.y, ray.org_z = origin.z;
    ray.dir_x = d.x, ray.dir_y = d.y, ray.dir_z = d.z;
    ray.tfar = 0.999f;
    ray.mask = ~0u;
    rays.push_back(ray);
  }
  double best = 0;
  for (int run = 0; run < 20; ++run) {
    std::vector<RTCRay> copy = rays;
    const auto start = Clock::now();
    parallel_for(copy.size(), 1024, [&](std::size_t begin, std::size_t end) {
      RTCIntersectContext context;
      rtcInitIntersectContext(&context);
      for (std::size_t i = begin; i < end; ++i) rtcOccluded1(embree, &context, &copy[i]);
    });
    best = std::max(best, static_cast<double>(copy.size()) / seconds_since(start));
  }
  rtcReleaseScene(embree);
  rtcReleaseDevice(device);
  return best;
}

void moving_lamp(benchmark::State& state, const std::string& name, float spacing, int light) {
  Relit& scene = relit(name, spacing);
  scene::LightingState lit = scene.session->lighting();
  vec4& place = lit.lights[light].world[3];
  const vec4 home = place;
  std::vector<transport::RelightReport> frames;
  int frame = 0;
  for (auto _ : state) {
    const float phase = 0.1f * static_cast<float>(frame++);
    place = home + 0.4f * vec4(std::sin(phase), 0, std::cos(phase), 0);
    frames.push_back(scene.session->update(lit));
  }
  report_frames(state, scene, frames);
  double rays = 0, ms = 0;
  for (const transport::RelightReport& f : frames)
    rays += static_cast<double>(f.direct_rays), ms += f.direct_ms;
  state.counters["direct_Mrays/s"] = rays / ms / 1e3;
  state.counters["share_of_bare_embree"] = rays / (1e-3 * ms) / bare_shadow_rate(scene, vec3(home));
}
BENCHMARK_CAPTURE(moving_lamp, two_rooms, "two-rooms", 0.7f, 0)
    ->Unit(benchmark::kMillisecond)
    ->Iterations(100);
BENCHMARK_CAPTURE(moving_lamp, gallery1, "gallery1", 1.5f, 0)->Unit(benchmark::kMillisecond)->Iterations(100);
BENCHMARK_CAPTURE(moving_lamp, gallery3, "gallery3", 1.5f, 0)->Unit(benchmark::kMillisecond)->Iterations(100);

/// Arguments: K prepared poses, 0 for exact ones.
void moving_door(benchmark::State& state) {
  Relit& scene = relit("two-rooms", 0.7f);
  transport::RelightParams params;
  params.poses = static_cast<int>(state.range(0));
  transport::RelightSession session(scene.source, scene.session->places(), params, 0);
  session.update(session.lighting());
  // The exact answer, for the error of blending.
  transport::RelightSession exact(scene.source, scene.session->places(), {}, 0);
  exact.update(exact.lighting());
  scene::LightingState lit = session.lighting();
  std::vector<transport::RelightReport> frames;
  double error2[2] = {}, truth2[2] = {};
  int frame = 0;
  for (auto _ : state) {
    // Times that no number of poses meets often.
    const float time = 0.5f - 0.5f * std::cos(0.0317f * static_cast<float>(++frame));
    lit.time = time;
    frames.push_back(session.update(lit));
    state.PauseTiming();
    exact.update(lit);
    for (std::size_t i = 0; i < session.places().size(); ++i) {
      const int room = session.places()[i].position.x > 0;
      const double truth = double(exact.reflected()[i][0].y), value = double(session.reflected()[i][0].y);
      error2[room] += (value - truth) * (value - truth);
      truth2[room] += truth * truth;
    }
    state.ResumeTiming();
  }
  report_frames(state, scene, frames);
  state.counters["rms_error_A"] = std::sqrt(error2[0] / truth2[0]);
  state.counters["rms_error_B"] = std::sqrt(error2[1] / truth2[1]);
  state.counters["poses_MB"] = static_cast<double>(session.network().pose_bytes()) / 1e6;
}
BENCHMARK(moving_door)
    ->ArgName("poses")
    ->Arg(0)
    ->Arg(2)
    ->Arg(5)
    ->Arg(9)
    ->Arg(17)
    ->Arg(33)
    ->Arg(65)
    ->Unit(benchmark::kMillisecond)
    ->Iterations(99);

void nothing_moves(benchmark::State& state) {
  Relit& scene = relit("two-rooms", 0.7f);
  for (auto _ : state) benchmark::DoNotOptimize(scene.session->update(scene.session->lighting()));
}
BENCHMARK(nothing_moves)->Unit(benchmark::kMicrosecond);

}  // namespace
}  // namespace ssphh

BENCHMARK_MAIN();
