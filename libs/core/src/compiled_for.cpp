#include "compiled_for.h"

#if defined(__AVX512F__)
const int ssphh_compiled_for = SSPHH_COMPILED_FOR_AVX2 | SSPHH_COMPILED_FOR_AVX512;
#elif defined(__AVX2__)
const int ssphh_compiled_for = SSPHH_COMPILED_FOR_AVX2;
#else
const int ssphh_compiled_for = 0;
#endif
