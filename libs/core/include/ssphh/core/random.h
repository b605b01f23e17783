#pragma once
/// Deterministic random numbers: hashing, PCG32, and Owen-scrambled Sobol points whose value depends only on
/// (seed, pixel, sample, dimension), never on the order of evaluation.

#include <array>
#include <cstdint>

#include <ssphh/core/math.h>
#include <ssphh/core/sobol.h>

namespace ssphh {

/// SplitMix64 finaliser: a bijective 64-bit mix.
constexpr std::uint64_t mix64(std::uint64_t x) {
  x += 0x9e3779b97f4a7c15ull;
  x = (x ^ (x >> 30)) * 0xbf58476d1ce4e5b9ull;
  x = (x ^ (x >> 27)) * 0x94d049bb133111ebull;
  return x ^ (x >> 31);
}

constexpr std::uint64_t hash_combine(std::uint64_t a, std::uint64_t b) {
  return mix64(a ^ mix64(b));
}

/// Uniform in [0, 1) from the top 24 bits.
constexpr float to_unit_float(std::uint32_t bits) {
  return static_cast<float>(bits >> 8) * 0x1p-24f;
}

/// PCG32 (O'Neill 2014), for places where a stratified sequence has no use.
class Pcg32 {
 public:
  explicit Pcg32(std::uint64_t seed, std::uint64_t stream = 0) : increment_((mix64(stream) << 1) | 1) {
    next();
    state_ += mix64(seed);
    next();
  }
  std::uint32_t next() {
    const std::uint64_t old = state_;
    state_ = old * 6364136223846793005ull + increment_;
    const auto shifted = static_cast<std::uint32_t>(((old >> 18) ^ old) >> 27);
    const auto rotation = static_cast<std::uint32_t>(old >> 59);
    return (shifted >> rotation) | (shifted << ((32 - rotation) & 31));
  }
  float uniform() { return to_unit_float(next()); }
  vec2 uniform2() {
    const float x = uniform();
    return {x, uniform()};
  }
  vec3 uniform3() {
    const vec2 xy = uniform2();
    return {xy, uniform()};
  }

 private:
  std::uint64_t state_ = 0;
  std::uint64_t increment_;
};

/// One sample of a padded, shuffled and Owen-scrambled (0,2)-sequence (Burley, Practical Hash-based Owen
/// Scrambling, JCGT 2020). Samples index 0..2^k−1 of one `pixel_seed` are well distributed in every
/// consecutive pair of dimensions; different pixel seeds are independent.
class SampleSequence {
 public:
  SampleSequence(std::uint64_t pixel_seed, std::uint32_t index) : seed_(pixel_seed), index_(index) {}

  // Inline: with the dimension known at compile time, half of the hashing is done there.

  /// The next dimension, in [0, 1).
  float next() {
    const std::uint64_t h = hash_combine(seed_, dimension_++);
    const std::uint32_t index = owen_scramble(index_, static_cast<std::uint32_t>(h));
    return to_unit_float(reverse_bits(owen_scramble_reversed(index, static_cast<std::uint32_t>(h >> 32))));
  }
  /// The next two dimensions, jointly stratified.
  vec2 next2() {
    const std::uint64_t h = hash_combine(seed_, dimension_++);
    const std::uint64_t h2 = mix64(h);
    const std::uint32_t index = owen_scramble(index_, static_cast<std::uint32_t>(h));
    const std::uint32_t x = owen_scramble_reversed(index, static_cast<std::uint32_t>(h >> 32));
    const std::uint32_t y = owen_scramble_reversed(sobol1_reversed(index), static_cast<std::uint32_t>(h2));
    return {to_unit_float(reverse_bits(x)), to_unit_float(reverse_bits(y))};
  }

 private:
  std::uint64_t seed_;
  std::uint32_t index_;
  std::uint32_t dimension_ = 0;
};

/// Four pairs of dimensions at once, each stratified as SampleSequence::next2 is and independent of the
/// others; other values than a SampleSequence gives.
std::array<vec2, 4> sample_pairs(std::uint64_t seed, std::uint32_t index);

/// Seed of a pixel or texel from the user's seed and its position.
constexpr std::uint64_t pixel_seed(std::uint64_t seed, std::uint32_t x, std::uint32_t y,
                                   std::uint32_t face = 0) {
  return hash_combine(hash_combine(seed, (std::uint64_t{x} << 32) | y), face);
}

}  // namespace ssphh
