#pragma once
/// What C++ of this library was compiled for (SSPHH_ARCH), as data: asking for it runs none of it.

#ifdef __cplusplus
extern "C" {
#endif

enum { SSPHH_COMPILED_FOR_AVX2 = 1, SSPHH_COMPILED_FOR_AVX512 = 2 };
extern const int ssphh_compiled_for;

#ifdef __cplusplus
}
#endif
