/// HIER, surface lookups and probe files. The sets hold random light: the time does not depend on the values.

#include <algorithm>

#include <benchmark/benchmark.h>

#include <ssphh/core/random.h>
#include <ssphh/probes/hier.h>
#include <ssphh/probes/lookup.h>
#include <ssphh/probes/probe_file.h>

#include "dark_space.h"

namespace ssphh {
namespace {

sh::RadianceSh random_light(Pcg32& rng, int degree) {
  sh::RadianceSh light(degree);
  for (vec3& v : light.values) v = 0.1f * (2.0f * rng.uniform3() - 1.0f);
  light[0] = vec3(3);
  return light;
}

/// Probes at random places, each with its `neighbors` successors as edges.
probes::ProbeSet random_set(int count, int degree, int neighbors) {
  Pcg32 rng(1);
  probes::ProbeSet set;
  set.degree = degree;
  set.light_groups.push_back({"lamp", vec3(1)});
  for (int i = 0; i < count; ++i) {
    probes::Probe probe;
    probe.position = 10.0f * rng.uniform3();
    probe.groups.push_back({{}, random_light(rng, degree)});
    std::vector<int> from;
    for (int n = 1; n <= neighbors; ++n) from.push_back((i + n) % count);
    std::sort(from.begin(), from.end());
    for (const int j : from) {
      probes::Edge edge;
      edge.from = j;
      edge.transfer = rng.uniform();
      edge.h = random_light(rng, degree);
      probe.edges.push_back(std::move(edge));
    }
    set.probes.push_back(std::move(probe));
  }
  probes::merge_groups(set);
  return set;
}

/// Arguments: probes, degree, neighbours, operator.
void hier(benchmark::State& state) {
  probes::ProbeSet set = random_set(static_cast<int>(state.range(0)), static_cast<int>(state.range(1)),
                                    static_cast<int>(state.range(2)));
  probes::HierParams params;
  params.op = static_cast<probes::HierOperator>(state.range(3));
  std::size_t edges = 0;
  for (auto _ : state) {
    edges = probes::hier(set, params);
    benchmark::DoNotOptimize(set.hierarchy->sum.data());
  }
  state.counters["edges"] = static_cast<double>(edges);
  state.SetLabel(std::string(name_of(params.op)));
}
BENCHMARK(hier)
    ->ArgNames({"probes", "degree", "neighbors", "operator"})
    ->Args({6, 9, 5, 0})
    ->Args({6, 9, 5, 1})
    ->Args({6, 10, 5, 0})
    ->Args({6, 10, 5, 1})
    ->Args({1000, 9, 8, 0})
    ->Args({1000, 9, 8, 1})
    ->Unit(benchmark::kMicrosecond)
    ->UseRealTime();

/// The cost of the lookup itself, without rays. Arguments: probes, method (0 light, 1 irradiance), glossy.
void lookup(benchmark::State& state) {
  const test::DarkSpace space;
  const probes::ProbeSet set = random_set(static_cast<int>(state.range(0)), 9, 0);
  const auto method = static_cast<probes::LookupMethod>(state.range(1));
  const auto light = probes::make_lookup(method, set, space);
  Pcg32 rng(2);
  std::vector<rays::SurfacePoint> points;
  for (int i = 0; i < 1024; ++i) {
    const vec3 position = 10.0f * rng.uniform3();
    points.push_back({position, sample_uniform_sphere(rng.uniform2())});
  }
  std::size_t i = 0;
  for (auto _ : state) {
    i = (i + 1) % points.size();
    benchmark::DoNotOptimize(state.range(2) ? light->glossy(points[i], points[i].normal, 0.4f)
                                            : light->irradiance(points[i]));
  }
  state.SetItemsProcessed(state.iterations());
  state.SetLabel(std::string(name_of(method)));
}
BENCHMARK(lookup)
    ->ArgNames({"probes", "method", "glossy"})
    ->Args({6, 0, 0})
    ->Args({6, 1, 0})
    ->Args({6, 1, 1})
    ->Args({1000, 0, 0})
    ->Args({1000, 1, 0});

void write_json(benchmark::State& state) {
  const probes::ProbeSet set = random_set(6, 10, 5);
  std::size_t bytes = 0;
  for (auto _ : state) bytes = probes::probes_to_json(set).size();
  state.SetBytesProcessed(static_cast<std::int64_t>(bytes) * state.iterations());
}
void read_json(benchmark::State& state) {
  const std::string text = probes::probes_to_json(random_set(6, 10, 5));
  for (auto _ : state) benchmark::DoNotOptimize(probes::probes_from_json(text, "memory"));
  state.SetBytesProcessed(static_cast<std::int64_t>(text.size()) * state.iterations());
}
void write_binary(benchmark::State& state) {
  const probes::ProbeSet set = random_set(6, 10, 5);
  std::size_t bytes = 0;
  for (auto _ : state) bytes = probes::probes_to_binary(set).size();
  state.SetBytesProcessed(static_cast<std::int64_t>(bytes) * state.iterations());
}
void read_binary(benchmark::State& state) {
  const auto data = probes::probes_to_binary(random_set(6, 10, 5));
  for (auto _ : state) benchmark::DoNotOptimize(probes::probes_from_binary(data, "memory"));
  state.SetBytesProcessed(static_cast<std::int64_t>(data.size()) * state.iterations());
}
BENCHMARK(write_json)->Unit(benchmark::kMicrosecond);
BENCHMARK(read_json)->Unit(benchmark::kMicrosecond);
BENCHMARK(write_binary)->Unit(benchmark::kMicrosecond);
BENCHMARK(read_binary)->Unit(benchmark::kMicrosecond);

}  // namespace
}  // namespace ssphh

BENCHMARK_MAIN();
