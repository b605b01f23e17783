#pragma once
/// How a block of BC6H lays out what it holds.

#include <array>
#include <cstdint>
#include <span>
#include <vector>

#include <glm/vec3.hpp>

namespace ssphh::sh::bc6h {

/// A bit of an end: of line 0 the ends 0 and 1, of line 1 the ends 2 and 3.
struct Bit {
  int end, channel, place;
};

struct Mode {
  std::uint32_t number;
  int number_bits;  ///< bits of the block that say its mode
  int regions;      ///< 1 or 2: lines of colours
  int end_bits;     ///< of a channel of an end
  glm::ivec3
      delta;  ///< bits of the differences to end 0 that stand for the other ends; 0: they stand themselves
  std::vector<Bit> bits;  ///< in the block's order, behind the mode's number

  int ends() const { return 2 * regions; }
  int index_bits() const { return regions == 1 ? 4 : 3; }
};

std::span<const Mode> modes();

inline constexpr int shape_count = 32;
/// Region of texel i of a block of two regions.
int region_of(int shape, int i);
/// The texel of a region whose index has no highest bit: it is 0.
int anchor_of(int shape, int region);

}  // namespace ssphh::sh::bc6h
