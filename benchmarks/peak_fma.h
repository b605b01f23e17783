#pragma once
/// What a core can do at best.

#include <algorithm>
#include <chrono>

#include <benchmark/benchmark.h>

namespace ssphh::benchmarks {

/// Multiply-adds per second (counting each lane) of one core, with the registers that this is compiled for:
/// twelve independent chains, enough to hide the latency of two units. Best of several runs, measured once.
inline double peak_fma_rate() {
#if defined(__AVX__)
  constexpr int lanes = 8;
#else
  constexpr int lanes = 4;
#endif
  using Floats = float __attribute__((vector_size(lanes * sizeof(float))));
  static const double rate = [] {
    constexpr int rounds = 200000, chains = 12;
    double best = 0;
    for (int run = 0; run < 20; ++run) {
      Floats a0{}, a1{}, a2{}, a3{}, a4{}, a5{}, a6{}, a7{}, a8{}, a9{}, a10{}, a11{};
      Floats factor{}, term{};
      factor += 0.999f, term += 0.001f;
      benchmark::DoNotOptimize(factor);
      benchmark::DoNotOptimize(term);
      const auto start = std::chrono::steady_clock::now();
      for (int i = 0; i < rounds; ++i) {
        a0 = a0 * factor + term, a1 = a1 * factor + term, a2 = a2 * factor + term, a3 = a3 * factor + term;
        a4 = a4 * factor + term, a5 = a5 * factor + term, a6 = a6 * factor + term, a7 = a7 * factor + term;
        a8 = a8 * factor + term, a9 = a9 * factor + term, a10 = a10 * factor + term,
        a11 = a11 * factor + term;
        // Keeps the chains apart: the compiler must not see that they are equal.
        asm volatile("" : "+x"(a0), "+x"(a1), "+x"(a2), "+x"(a3), "+x"(a4), "+x"(a5));
        asm volatile("" : "+x"(a6), "+x"(a7), "+x"(a8), "+x"(a9), "+x"(a10), "+x"(a11));
      }
      const std::chrono::duration<double> seconds = std::chrono::steady_clock::now() - start;
      Floats sum = a0 + a1 + a2 + a3 + a4 + a5 + a6 + a7 + a8 + a9 + a10 + a11;
      benchmark::DoNotOptimize(sum);
      best = std::max(best, rounds * double{chains} * lanes / seconds.count());
    }
    return best;
  }();
  return rate;
}

}  // namespace ssphh::benchmarks
