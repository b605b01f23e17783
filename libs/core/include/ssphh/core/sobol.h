#pragma once
/// The bits behind SampleSequence, inline for the inner loops of renderers: two-dimensional Sobol points with
/// hash-based Owen scrambling (Burley, Practical Hash-based Owen Scrambling, JCGT 2020).

#include <cstdint>

namespace ssphh {

inline std::uint32_t reverse_bits(std::uint32_t x) {
  x = __builtin_bswap32(x);
  x = ((x & 0x0f0f0f0fu) << 4) | ((x >> 4) & 0x0f0f0f0fu);
  x = ((x & 0x33333333u) << 2) | ((x >> 2) & 0x33333333u);
  return ((x & 0x55555555u) << 1) | ((x >> 1) & 0x55555555u);
}

/// Laine and Karras' permutation on reversed bits: every bit is changed by the bits below it only.
inline std::uint32_t owen_scramble_reversed(std::uint32_t x, std::uint32_t seed) {
  x ^= x * 0x3d20adeau;
  x += seed;
  x *= (seed >> 16) | 1;
  x ^= x * 0x05526c56u;
  x ^= x * 0x53a22864u;
  return x;
}

inline std::uint32_t owen_scramble(std::uint32_t x, std::uint32_t seed) {
  return reverse_bits(owen_scramble_reversed(reverse_bits(x), seed));
}

/// Second Sobol dimension, bit-reversed: its generator matrix is Pascal's triangle modulo 2, which factors
/// into five shifts. (The first dimension, bit-reversed, is the index.)
inline std::uint32_t sobol1_reversed(std::uint32_t index) {
  index ^= (index >> 16) & 0x0000ffffu;
  index ^= (index >> 8) & 0x00ff00ffu;
  index ^= (index >> 4) & 0x0f0f0f0fu;
  index ^= (index >> 2) & 0x33333333u;
  index ^= (index >> 1) & 0x55555555u;
  return index;
}

}  // namespace ssphh
