/// Frames of a game: a lamp moves through two rooms, a worker brings the light up to date, a game's thread
/// draws with what is finished and never rests.

#include <algorithm>
#include <atomic>
#include <chrono>
#include <cmath>
#include <ctime>
#include <thread>

#include <benchmark/benchmark.h>
#include <sys/resource.h>

#include <ssphh/core/parallel.h>
#include <ssphh/core/snapshots.h>
#include <ssphh/place/place.h>
#include <ssphh/probes/lookup.h>
#include <ssphh/scene/builtin.h>
#include <ssphh/trace/path_tracer.h>
#include <ssphh/trace/transport_scene.h>
#include <ssphh/transport/relight_session.h>
#include <ssphh/transport/session_sets.h>

#include "count_allocations.h"

namespace ssphh {
namespace {

constexpr int frames = 3000, warm_up = 100;

struct Cost {
  double wall_ms, processor_ms;
};

/// Of this thread.
double processor_ms() {
  timespec now;
  clock_gettime(CLOCK_THREAD_CPUTIME_ID, &now);
  return 1e3 * static_cast<double>(now.tv_sec) + 1e-6 * static_cast<double>(now.tv_nsec);
}

void report(benchmark::State& state, const char* of, std::vector<Cost> costs, double Cost::*time) {
  std::ranges::sort(costs, {}, time);
  const auto at = [&](double share) {
    return costs[static_cast<std::size_t>(share * static_cast<double>(costs.size() - 1))].*time;
  };
  state.counters[std::string(of) + "median_ms"] = at(0.5);
  state.counters[std::string(of) + "p99_by_median"] = at(0.99) / at(0.5);
  state.counters[std::string(of) + "longest_by_median"] = at(1) / at(0.5);
}

/// Looks light up without a rest, as long as it lives.
class BusyGame {
 public:
  BusyGame(const Snapshots<probes::IrradianceLookup>& light, const vec3& middle)
      : thread_([this, &light, middle] {
          for (int i = 0; !over_; ++i) {
            const float turn = 0.01f * static_cast<float>(i);
            const rays::SurfacePoint at{middle + vec3(std::sin(turn), 0, std::cos(turn)), {0, 1, 0}};
            benchmark::DoNotOptimize(light.read()->irradiance(at));
            ++lookups_;
          }
        }) {}
  ~BusyGame() {
    over_ = true;
    thread_.join();
  }
  BusyGame(const BusyGame&) = delete;
  BusyGame& operator=(const BusyGame&) = delete;
  std::int64_t lookups() const { return lookups_; }

 private:
  std::atomic<bool> over_ = false;
  std::atomic<std::int64_t> lookups_ = 0;
  std::thread thread_;
};

/// Argument: threads of the session. Wall time is that of update(); where other programs run, the time of its
/// processor tells more, of one thread.
void two_rooms(benchmark::State& state) {
  const int threads = thread_count();
  set_thread_count(static_cast<int>(state.range(0)));
  const scene::Scene scene = scene::make_builtin("two-rooms");
  const trace::TransportScene source(scene);
  const trace::PathTracer eye(scene);
  place::PlaceParams place = place::place_params(scene, 1.0f);
  place.spacing = 0.7f;
  std::vector<scene::ProbePlace> places;
  for (const auto& probe : place::place_probes(source, place).probes)
    places.push_back({probe.name, probe.position, 0.1f});
  transport::RelightSession session(source, std::move(places), {}, 1.0f);
  scene::LightingState lit = session.lighting();
  vec4& lamp = lit.lights[0].world[3];
  const vec4 home = lamp;
  session.update(lit);
  probes::ProbeSet set = transport::lookup_set(session);
  Snapshots<probes::IrradianceLookup> light{probes::IrradianceLookup(set, eye)};
  BusyGame game(light, vec3(home));

  std::vector<Cost> costs;
  costs.reserve(warm_up + frames);
  const auto frame = [&] {
    const float phase = 0.1f * static_cast<float>(costs.size());
    lamp = home + 0.4f * vec4(std::sin(phase), 0, std::cos(phase), 0);
    const auto start = std::chrono::steady_clock::now();
    const double before = processor_ms();
    session.update(lit);
    const double processor = processor_ms() - before;
    const std::chrono::duration<double, std::milli> wall = std::chrono::steady_clock::now() - start;
    costs.push_back({wall.count(), processor});
    transport::refresh(set, session);
    light.publish([&](probes::IrradianceLookup& next) { next.swap_light(set); });
  };
  for (int i = 0; i < warm_up; ++i) frame();
  rusage at_first, at_last;
  getrusage(RUSAGE_SELF, &at_first);
  const long allocated = test::allocations();
  for (auto _ : state) frame();
  state.counters["allocations"] = static_cast<double>(test::allocations() - allocated);
  getrusage(RUSAGE_SELF, &at_last);
  state.counters["page_faults"] = static_cast<double>(at_last.ru_minflt - at_first.ru_minflt);
  state.counters["lost_the_core"] = static_cast<double>(at_last.ru_nivcsw - at_first.ru_nivcsw);
  state.counters["lookups"] = static_cast<double>(game.lookups());
  costs.erase(costs.begin(), costs.begin() + warm_up);
  report(state, "", costs, &Cost::wall_ms);
  report(state, "processor_", costs, &Cost::processor_ms);
  set_thread_count(threads);
}
BENCHMARK(two_rooms)
    ->ArgName("threads")
    ->Arg(1)
    ->Arg(2)
    ->Unit(benchmark::kMillisecond)
    ->Iterations(frames)
    ->UseRealTime();

}  // namespace
}  // namespace ssphh

BENCHMARK_MAIN();
