// The shipped program's library: lookups in a cooked file of two small rooms, light that changes.

#include <benchmark/benchmark.h>

#include "cooked_room.h"

namespace {

using namespace ssphh;

const test::OpenedFile& file(bool records) {
  static const test::OpenedFile with(
      test::cook_two_rooms(test::set_of_two_rooms(test::OnSurfaces::records), 32)),
      without(test::cook_two_rooms(test::set_of_two_rooms(test::OnSurfaces::nothing), 32));
  return records ? with : without;
}

/// 1,000 places in one call, of three groups' light.
void batch(benchmark::State& state) {
  const bool records = state.range(0) == 0;
  const ssphh_runtime* runtime = file(records).runtime;
  std::vector<ssphh_runtime_place> places;
  for (const auto& [x, n, moves] :
       records ? test::places_on_surfaces(1000, 2) : test::places_in_the_open(1000, 2))
    places.push_back({{x.x, x.y, x.z}, {n.x, n.y, n.z}});
  std::vector<float> rgb(3 * places.size());
  const unsigned flags = records ? SSPHH_RUNTIME_STILL : SSPHH_RUNTIME_OPEN;
  for (auto _ : state)
    ssphh_runtime_irradiance_batch(runtime, flags, places.data(), places.size(), rgb.data());
  state.SetLabel(records ? "records" : "probes");
  state.SetItemsProcessed(state.iterations() * static_cast<std::int64_t>(places.size()));
}
BENCHMARK(batch)->Name("runtime_batch")->ArgName("kind")->Arg(0)->Arg(1);

void swap_light(benchmark::State& state) {
  const test::OpenedFile& light = file(true);
  for (auto _ : state) ssphh_runtime_swap_light(light.runtime, light.bytes().data(), light.bytes().size());
}
BENCHMARK(swap_light)->Name("runtime_swap_light");

void open(benchmark::State& state) {
  const std::vector<std::byte>& bytes = file(true).bytes();
  std::vector<std::byte> memory(4096);
  ssphh_runtime* runtime;
  for (auto _ : state) ssphh_runtime_open(bytes.data(), bytes.size(), memory.data(), memory.size(), &runtime);
  state.SetBytesProcessed(state.iterations() * static_cast<std::int64_t>(bytes.size()));
}
BENCHMARK(open)->Name("runtime_open");

}  // namespace

BENCHMARK_MAIN();
