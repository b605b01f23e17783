/// What each call of a game's loop costs (docs/embed.md): a session over two-rooms, a set, a lookup.

#include <benchmark/benchmark.h>

#include <ssphh/core/snapshots.h>
#include <ssphh/place/place.h>
#include <ssphh/probes/lookup.h>
#include <ssphh/scene/builtin.h>
#include <ssphh/trace/path_tracer.h>
#include <ssphh/trace/transport_scene.h>
#include <ssphh/transport/fitted_weights.h>
#include <ssphh/transport/network.h>
#include <ssphh/transport/relight_session.h>
#include <ssphh/transport/session_sets.h>

namespace ssphh {
namespace {

/// Two rooms, their door open, with so many records.
struct Loop {
  scene::Scene scene = scene::make_builtin("two-rooms");
  trace::TransportScene source{scene};
  trace::PathTracer eye{scene};
  transport::RelightSession session;
  scene::LightingState state = session.lighting();
  probes::ProbeSet set;

  explicit Loop(int records) : session(source, places(), params(records), 1.0f) {
    session.update(state);
    set = transport::lookup_set(session);
  }
  std::vector<scene::ProbePlace> places() const {
    place::PlaceParams place = place::place_params(scene, 1.0f);
    place.spacing = 0.7f;
    std::vector<scene::ProbePlace> found;
    for (const auto& probe : place::place_probes(source, place).probes)
      found.push_back({probe.name, probe.position, probe.radius});
    return found;
  }
  static transport::RelightParams params(int records) {
    transport::RelightParams params;
    params.records.points = records;
    return params;
  }
  void describe(benchmark::State& of) const {
    of.counters["probes"] = static_cast<double>(set.probes.size());
    of.counters["surfels"] = static_cast<double>(session.network().surfel_count());
    of.counters["records"] = static_cast<double>(set.surface ? set.surface->points.size() : 0);
  }
};

Loop& loop(const benchmark::State& of) {
  static Loop loops[] = {Loop(0), Loop(4096)};
  return loops[of.range(0)];
}

void make_session(benchmark::State& state) {
  Loop& of = loop(state);
  for (auto _ : state)
    benchmark::DoNotOptimize(transport::RelightSession(of.source, of.session.places(),
                                                       Loop::params(state.range(0) ? 4096 : 0), 1.0f));
  of.describe(state);
}

/// `change` of the state before each update.
template <class Change>
void update(benchmark::State& state, const Change& change) {
  Loop& of = loop(state);
  scene::LightingState wanted = of.state;
  int frame = 0;
  for (auto _ : state) {
    change(wanted, ++frame);
    benchmark::DoNotOptimize(of.session.update(wanted));
  }
  of.session.update(of.state);
}
void update_nothing(benchmark::State& state) {
  update(state, [](scene::LightingState&, int) {});
}
void update_factor(benchmark::State& state) {
  update(state, [](scene::LightingState& s, int frame) { s.group_scales[0] = vec3(frame % 2 ? 0.5f : 1); });
}
void update_lamp(benchmark::State& state) {
  update(state,
         [](scene::LightingState& s, int frame) { s.lights[0].world[3].x += frame % 2 ? 0.1f : -0.1f; });
}
void update_door(benchmark::State& state) {
  update(state, [](scene::LightingState& s, int frame) { s.time = 0.01f * static_cast<float>(frame % 97); });
}

void refresh(benchmark::State& state) {
  Loop& of = loop(state);
  for (auto _ : state) transport::refresh(of.set, of.session);
}
void lookup_set(benchmark::State& state) {
  const Loop& of = loop(state);
  for (auto _ : state) benchmark::DoNotOptimize(transport::lookup_set(of.session));
}
void make_lookup(benchmark::State& state) {
  const Loop& of = loop(state);
  for (auto _ : state) benchmark::DoNotOptimize(probes::IrradianceLookup(of.set, of.eye));
}
void swap_light(benchmark::State& state) {
  const Loop& of = loop(state);
  probes::IrradianceLookup lookup(of.set, of.eye);
  for (auto _ : state) lookup.swap_light(of.set);
}
void irradiance(benchmark::State& state) {
  const Loop& of = loop(state);
  const probes::IrradianceLookup lookup(of.set, of.eye);
  const std::vector<rays::SurfacePoint> points = transport::surfel_points(of.session.network());
  std::size_t i = 0;
  for (auto _ : state) benchmark::DoNotOptimize(lookup.irradiance(points[++i * 17 % points.size()]));
}
void glossy(benchmark::State& state) {
  const Loop& of = loop(state);
  const probes::IrradianceLookup lookup(of.set, of.eye);
  const rays::SurfacePoint at{of.set.probes[0].position, {0, 1, 0}};
  for (auto _ : state) benchmark::DoNotOptimize(lookup.glossy(at, {0, 1, 0}, 0.5f));
}
void snapshots(benchmark::State& state) {
  Snapshots<int> box(0);
  for (auto _ : state) {
    box.publish([](int& next) { ++next; });
    benchmark::DoNotOptimize(*box.read());
  }
}

void of_both(benchmark::internal::Benchmark* b) {
  b->ArgName("records")->Arg(0)->Arg(1)->UseRealTime();
}
BENCHMARK(make_session)->Apply(of_both)->Unit(benchmark::kMillisecond);
BENCHMARK(update_nothing)->Apply(of_both)->Unit(benchmark::kNanosecond);
BENCHMARK(update_factor)->Apply(of_both)->Unit(benchmark::kMillisecond);
BENCHMARK(update_lamp)->Apply(of_both)->Unit(benchmark::kMillisecond);
BENCHMARK(update_door)->Apply(of_both)->Unit(benchmark::kMillisecond);
BENCHMARK(refresh)->Apply(of_both)->Unit(benchmark::kMicrosecond);
BENCHMARK(lookup_set)->Apply(of_both)->Unit(benchmark::kMicrosecond);
BENCHMARK(make_lookup)->Apply(of_both)->Unit(benchmark::kMillisecond);
BENCHMARK(swap_light)->Apply(of_both)->Unit(benchmark::kMicrosecond);
BENCHMARK(irradiance)->Apply(of_both)->Unit(benchmark::kNanosecond);
BENCHMARK(glossy)->Apply(of_both)->Unit(benchmark::kNanosecond);
BENCHMARK(snapshots)->Unit(benchmark::kNanosecond);

}  // namespace
}  // namespace ssphh

BENCHMARK_MAIN();
