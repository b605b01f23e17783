#include <ssphh/core/random.h>

namespace ssphh {
namespace {

std::uint32_t reverse_bits(std::uint32_t x) {
  x = __builtin_bswap32(x);
  x = ((x & 0x0f0f0f0fu) << 4) | ((x >> 4) & 0x0f0f0f0fu);
  x = ((x & 0x33333333u) << 2) | ((x >> 2) & 0x33333333u);
  return ((x & 0x55555555u) << 1) | ((x >> 1) & 0x55555555u);
}

// Laine and Karras' permutation on reversed bits: every bit is changed by the bits below it only.
std::uint32_t owen_scramble_reversed(std::uint32_t x, std::uint32_t seed) {
  x ^= x * 0x3d20adeau;
  x += seed;
  x *= (seed >> 16) | 1;
  x ^= x * 0x05526c56u;
  x ^= x * 0x53a22864u;
  return x;
}

std::uint32_t owen_scramble(std::uint32_t x, std::uint32_t seed) {
  return reverse_bits(owen_scramble_reversed(reverse_bits(x), seed));
}

// Second Sobol dimension, bit-reversed: its generator matrix is Pascal's triangle modulo 2, which factors
// into five shifts.
std::uint32_t sobol1_reversed(std::uint32_t index) {
  index ^= (index >> 16) & 0x0000ffffu;
  index ^= (index >> 8) & 0x00ff00ffu;
  index ^= (index >> 4) & 0x0f0f0f0fu;
  index ^= (index >> 2) & 0x33333333u;
  index ^= (index >> 1) & 0x55555555u;
  return index;
}

}  // namespace

float SampleSequence::next() {
  const std::uint64_t h = hash_combine(seed_, dimension_++);
  const std::uint32_t index = owen_scramble(index_, static_cast<std::uint32_t>(h));
  return to_unit_float(reverse_bits(owen_scramble_reversed(index, static_cast<std::uint32_t>(h >> 32))));
}

vec2 SampleSequence::next2() {
  const std::uint64_t h = hash_combine(seed_, dimension_++);
  const std::uint64_t h2 = mix64(h);
  const std::uint32_t index = owen_scramble(index_, static_cast<std::uint32_t>(h));
  const std::uint32_t x = owen_scramble_reversed(index, static_cast<std::uint32_t>(h >> 32));
  const std::uint32_t y = owen_scramble_reversed(sobol1_reversed(index), static_cast<std::uint32_t>(h2));
  return {to_unit_float(reverse_bits(x)), to_unit_float(reverse_bits(y))};
}

}  // namespace ssphh
