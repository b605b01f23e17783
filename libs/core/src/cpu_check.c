/// Tells of a CPU that lacks what this library was compiled for, before the first of its instructions that
/// such a CPU does not have: C is compiled for any machine, and this runs ahead of C++'s initialisers.

#include <stdlib.h>
#include <string.h>
#include <unistd.h>

#include "compiled_for.h"

#if defined(__x86_64__)
static void tell(const char* text) {
  const ssize_t written = write(STDERR_FILENO, text, strlen(text));
  (void)written;  // nobody is left to be told
}

__attribute__((constructor(101))) static void check(void) {
  __builtin_cpu_init();
  const char* lacks = NULL;
  if (ssphh_compiled_for & SSPHH_COMPILED_FOR_AVX2 &&
      !(__builtin_cpu_supports("avx2") && __builtin_cpu_supports("fma") && __builtin_cpu_supports("bmi2")))
    lacks = "AVX2, FMA and BMI2";
  if (ssphh_compiled_for & SSPHH_COMPILED_FOR_AVX512 && !__builtin_cpu_supports("avx512f")) lacks = "AVX-512";
  if (!lacks) return;
  tell("ssphh: error: this build needs a CPU with ");
  tell(lacks);
  tell(", which this machine lacks: build it with -DSSPHH_ARCH=\n");
  _Exit(1);
}
#endif

const int ssphh_cpu_check = 1;
