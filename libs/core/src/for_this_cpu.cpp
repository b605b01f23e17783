#include <cstdlib>
#include <cstring>

#include <ssphh/core/for_this_cpu.h>

namespace ssphh {

bool uses_avx2() {
#if defined(__x86_64__)
  static const bool uses = [] {
    const char* wanted = std::getenv("SSPHH_AVX2");
    return !(wanted && std::strcmp(wanted, "0") == 0) && __builtin_cpu_supports("avx2");
  }();
  return uses;
#else
  return false;
#endif
}

}  // namespace ssphh
