#include <ssphh/core/for_this_cpu.h>
#include <ssphh/core/random.h>

namespace ssphh {
namespace {

/// Wellons' "lowbias32": two multiplications are enough, for the seed is hashed already.
SSPHH_IN_LOOP inline std::uint32_t hash(std::uint32_t x) {
  x = (x ^ (x >> 16)) * 0x7feb352du;
  x = (x ^ (x >> 15)) * 0x846ca68bu;
  return x ^ (x >> 16);
}

}  // namespace

std::array<vec2, 4> sample_pairs(std::uint64_t seed, std::uint32_t index) {
  const std::uint64_t h = mix64(seed);
  const auto low = static_cast<std::uint32_t>(h), high = static_cast<std::uint32_t>(h >> 32);
  const std::uint32_t reversed = reverse_bits(index);
  float u[8];
  for_this_cpu([&]() SSPHH_IN_LOOP {
    for (std::uint32_t lane = 0; lane < 8; ++lane) {
      const std::uint32_t shuffled =
          reverse_bits(owen_scramble_reversed(reversed, hash(low + (lane / 2) * 0x9e3779b9u)));
      const std::uint32_t point = lane % 2 == 0 ? shuffled : sobol1_reversed(shuffled);
      const std::uint32_t bits =
          reverse_bits(owen_scramble_reversed(point, hash(high + lane * 0x9e3779b9u))) >> 8;
      u[lane] = static_cast<float>(static_cast<std::int32_t>(bits)) * 0x1p-24f;
    }
  });
  return {vec2(u[0], u[1]), vec2(u[2], u[3]), vec2(u[4], u[5]), vec2(u[6], u[7])};
}

}  // namespace ssphh
