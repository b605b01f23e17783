/// What a long queue costs: the broker's state machine alone, without sockets.

#include <array>
#include <chrono>
#include <string>

#include <benchmark/benchmark.h>
#include <malloc.h>

#include <ssphh/majordomo/broker_core.h>

namespace {

using namespace ssphh::majordomo;
using Clock = std::chrono::steady_clock;

/// `queued` requests of ten clients wait, then 1000 workers come and answer them
/// all.
void long_queue(benchmark::State& state) {
  const auto queued = static_cast<int>(state.range(0));
  constexpr int workers = 1000;
  double bytes = 0;
  for (auto _ : state) {
    const auto before = mallinfo2().uordblks;
    std::uint64_t n = 0;
    BrokerCore core({}, {}, [&n] {
      ++n;
      return std::array<std::uint64_t, 2>{n * 0x9e3779b97f4a7c15ull, n};
    });
    Millis now = 0;
    const auto start = Clock::now();
    for (int i = 0; i < queued; ++i) {
      now = i / 100;
      core.receive(now, "client" + std::to_string(i % 10), {"", "MDPC01", "echo", std::string(100, 'x')});
    }
    bytes = static_cast<double>(mallinfo2().uordblks - before) / queued;
    for (int i = 0; i < workers; ++i)
      core.receive(now, "w" + std::to_string(i), {"", "MDPW01", "\x01", "echo"});
    int answered = 0;
    while (answered < queued) {
      const BrokerOutputs out = core.take();
      for (const Outgoing& message : out.messages) {
        if (message.head.at(1) == "MDPC01") ++answered;
        if (message.head.at(1) == "MDPW01" && message.head.at(2) == "\x02")
          core.receive(now, message.peer, {"", "MDPW01", "\x03", message.head.at(3), "", "reply"});
      }
      ++now;
      if (core.next_deadline() <= now) core.tick(now);
    }
    state.SetIterationTime(std::chrono::duration<double>(Clock::now() - start).count());
  }
  state.counters["requests_per_s"] = benchmark::Counter(
      static_cast<double>(queued) * static_cast<double>(state.iterations()), benchmark::Counter::kIsRate);
  state.counters["bytes_per_request"] = bytes;
}
BENCHMARK(long_queue)
    ->ArgName("queued")
    ->Arg(1000)
    ->Arg(10'000)
    ->Arg(100'000)
    ->UseManualTime()
    ->Iterations(3)
    ->Unit(benchmark::kMillisecond);

}  // namespace

BENCHMARK_MAIN();
