#pragma once
/// The few loops that wide registers speed up, compiled twice: for every machine, and for AVX2. Memory that
/// both see is of floats, or says alignas(32): vectors of 32 bytes are aligned otherwise where there is no
/// AVX.

namespace ssphh {

/// Whether for_this_cpu() takes AVX2: this machine has it, and the environment does not say SSPHH_AVX2=0.
bool uses_avx2();

/// Of a lambda for for_this_cpu(), and of functions that it calls: they become a part of each version.
#define SSPHH_IN_LOOP __attribute__((always_inline))

#if defined(__x86_64__) && !defined(__AVX2__)
template <class Loop>
__attribute__((target("avx2"))) void run_by_avx2(const Loop& loop) {
  loop();
}
#endif

/// Calls `loop`, which is `[&]() SSPHH_IN_LOOP { … }`, in the version for this machine. Both give the same
/// bits: AVX2 brings no fused multiply-add with it, and sums keep their order.
template <class Loop>
inline void for_this_cpu(const Loop& loop) {
#if defined(__x86_64__) && !defined(__AVX2__)
  static const bool avx2 = uses_avx2();
  if (avx2) return run_by_avx2(loop);
#endif
  loop();
}

}  // namespace ssphh
