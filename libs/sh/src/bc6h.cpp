#include <algorithm>
#include <cmath>
#include <cstdint>
#include <limits>
#include <optional>

#include <glm/gtc/packing.hpp>

#include <ssphh/core/math.h>
#include <ssphh/sh/bc6h.h>

#include "bc6h_modes.h"

namespace ssphh::sh {
namespace {

using bc6h::Bit;
using bc6h::Mode;
using glm::ivec3;

/// Ends 0 and 1 of line 0, 2 and 3 of line 1.
using Ends = std::array<ivec3, 4>;

constexpr int weights_of_two[] = {0, 9, 18, 27, 37, 46, 55, 64};
constexpr int weights_of_one[] = {0, 4, 9, 13, 17, 21, 26, 30, 34, 38, 43, 47, 51, 55, 60, 64};

std::span<const int> weights(const Mode& mode) {
  return mode.regions == 1 ? std::span<const int>(weights_of_one) : std::span<const int>(weights_of_two);
}

/// What an end stands for in 0..0xffff.
int unquantized(int end, int bits) {
  if (bits >= 15 || end == 0) return end;
  return end == (1 << bits) - 1 ? 0xffff : ((end << 16) + 0x8000) >> bits;
}

ivec3 unquantized(const ivec3& end, int bits) {
  return {unquantized(end.x, bits), unquantized(end.y, bits), unquantized(end.z, bits)};
}

/// Bits of three half floats between two ends.
ivec3 between(const ivec3& a, const ivec3& b, int weight) {
  return ((a * (64 - weight) + b * weight + 32) >> 6) * 31 >> 6;
}

vec3 of_half_bits(const ivec3& bits) {
  vec3 colour;
  for (int c = 0; c < 3; ++c) colour[c] = glm::unpackHalf1x16(static_cast<std::uint16_t>(bits[c]));
  return colour;
}

vec3 cut(const vec3& colour) {
  vec3 held(0);
  for (int c = 0; c < 3; ++c)
    if (colour[c] > 0) held[c] = std::min(colour[c], bc6h_most);
  return held;
}

vec3 to_half_bits(const vec3& colour) {
  vec3 bits;
  for (int c = 0; c < 3; ++c) bits[c] = glm::packHalf1x16(colour[c]);
  return bits;
}

int region_of(const Mode& mode, int shape, int i) {
  return mode.regions == 1 ? 0 : bc6h::region_of(shape, i);
}

bool is_anchor(const Mode& mode, int shape, int i) {
  return i == bc6h::anchor_of(shape, region_of(mode, shape, i));
}

/// The block's bits, the lowest of byte 0 first.
class BlockBits {
 public:
  explicit BlockBits(Bc6hBlock& block) : block_(block) {}
  int get(int count) {
    int value = 0;
    for (int i = 0; i < count; ++i, ++at_)
      value |= static_cast<int>(block_[at_ / 8] >> (at_ % 8) & std::byte(1)) << i;
    return value;
  }
  void put(int value, int count) {
    for (int i = 0; i < count; ++i, ++at_)
      if (value >> i & 1) block_[at_ / 8] |= std::byte(1) << (at_ % 8);
  }

 private:
  Bc6hBlock& block_;
  std::size_t at_ = 0;
};

// How colours become a block: lines in the space of half floats' bits, in which colours lie evenly on them.

struct Line {
  vec3 ends[2];
};

/// Its covariance's largest eigenvector, and how far off the line through it the colours lie, as sum of
/// squares.
struct Axis {
  vec3 middle{0}, direction{0};
  float off = 0;
};

Axis axis_of(std::span<const vec3> colours) {
  Axis axis;
  for (const vec3& colour : colours) axis.middle += colour / static_cast<float>(colours.size());
  mat3 covariance(0);
  for (const vec3& colour : colours)
    covariance += glm::outerProduct(colour - axis.middle, colour - axis.middle);
  const float all = covariance[0][0] + covariance[1][1] + covariance[2][2];
  if (all == 0) return axis;
  int largest = 0;
  for (int c = 1; c < 3; ++c)
    if (covariance[c][c] > covariance[largest][largest]) largest = c;
  axis.direction = glm::normalize(covariance[largest]);
  for (int round = 0; round < 8; ++round) axis.direction = glm::normalize(covariance * axis.direction);
  axis.off = std::max(all - glm::dot(axis.direction, covariance * axis.direction), 0.0f);
  return axis;
}

Line line_along(const Axis& axis, std::span<const vec3> colours) {
  float least = std::numeric_limits<float>::max(), most = -least;
  for (const vec3& colour : colours) {
    const float along = glm::dot(colour - axis.middle, axis.direction);
    least = std::min(least, along), most = std::max(most, along);
  }
  return {{axis.middle + least * axis.direction, axis.middle + most * axis.direction}};
}

/// Ends of least squares for colours at these places between them; the old ones where all are at one place.
Line refitted(const Line& old, std::span<const vec3> colours, std::span<const float> places) {
  float aa = 0, ab = 0, bb = 0;
  vec3 a(0), b(0);
  for (std::size_t i = 0; i < colours.size(); ++i) {
    const float t = places[i], s = 1 - t;
    aa += s * s, ab += s * t, bb += t * t;
    a += s * colours[i], b += t * colours[i];
  }
  const float determinant = aa * bb - ab * ab;
  if (determinant < 1e-6f) return old;
  return {{(bb * a - ab * b) / determinant, (aa * b - ab * a) / determinant}};
}

/// The ends that a mode can have, near to those of the lines.
Ends quantized(const Mode& mode, const Line (&lines)[2]) {
  const int most = (1 << mode.end_bits) - 1;
  Ends ends{};
  for (int e = 0; e < mode.ends(); ++e) {
    for (int c = 0; c < 3; ++c) {
      const float unit = 0x1p16f * 31 / 64 / static_cast<float>(1 << mode.end_bits);
      ends[e][c] = std::clamp(static_cast<int>(std::floor(lines[e / 2].ends[e % 2][c] / unit)), 0, most);
      if (e == 0 || mode.delta[c] == 0) continue;
      const int reach = 1 << (mode.delta[c] - 1);
      ends[e][c] = std::clamp(ends[e][c], ends[0][c] - reach, ends[0][c] + reach - 1);
    }
  }
  return ends;
}

struct Encoded {
  const Mode* mode;
  int shape;
  Ends ends;
  std::array<int, 16> index;
  float error;
};

/// With the nearest index of each colour; the highest bit of the anchors' is 0.
Encoded with_indices(const Mode& mode, int shape, const Ends& ends, const Bc6hColours& colours) {
  const std::span<const int> steps = weights(mode);
  vec3 palette[2][16];
  for (int line = 0; line < mode.regions; ++line)
    for (std::size_t k = 0; k < steps.size(); ++k)
      palette[line][k] = of_half_bits(between(unquantized(ends[2 * line], mode.end_bits),
                                              unquantized(ends[2 * line + 1], mode.end_bits), steps[k]));
  Encoded found{&mode, shape, ends, {}, 0};
  for (int i = 0; i < 16; ++i) {
    const std::size_t count = is_anchor(mode, shape, i) ? steps.size() / 2 : steps.size();
    float least = std::numeric_limits<float>::max();
    for (std::size_t k = 0; k < count; ++k) {
      const vec3 off = palette[region_of(mode, shape, i)][k] - colours[i];
      if (const float square = glm::dot(off, off); square < least)
        least = square, found.index[i] = static_cast<int>(k);
    }
    found.error += least;
  }
  return found;
}

/// Texels of a region of a shape, or all.
struct Region {
  std::array<int, 16> texel;
  std::array<vec3, 16> colour;
  std::size_t count = 0;

  Region(const Bc6hColours& bits, int regions, int shape, int region) {
    for (int i = 0; i < 16; ++i)
      if (regions == 1 || bc6h::region_of(shape, i) == region) texel[count] = i, colour[count++] = bits[i];
  }
  std::span<const vec3> colours() const { return {colour.data(), count}; }
};

/// The anchor is nearer to the first end.
Line begun_at_anchor(const Line& line, const vec3& anchor) {
  return glm::distance(anchor, line.ends[0]) <= glm::distance(anchor, line.ends[1])
             ? line
             : Line{{line.ends[1], line.ends[0]}};
}

constexpr int rounds = 3;
constexpr int shapes_tried = 4;

/// The best of all modes with so many regions.
Encoded best_of(int regions, int shape, const Bc6hColours& colours, const Bc6hColours& bits) {
  std::vector<Region> parts;
  Line lines[2]{};
  for (int r = 0; r < regions; ++r) {
    parts.emplace_back(bits, regions, shape, r);
    lines[r] = line_along(axis_of(parts[r].colours()), parts[r].colours());
  }
  std::optional<Encoded> best;
  for (int round = 0; round < rounds; ++round) {
    for (int r = 0; r < regions; ++r) lines[r] = begun_at_anchor(lines[r], bits[bc6h::anchor_of(shape, r)]);
    std::optional<Encoded> now;
    for (const Mode& mode : bc6h::modes()) {
      if (mode.regions != regions) continue;
      const Encoded tried = with_indices(mode, shape, quantized(mode, lines), colours);
      if (!now || tried.error < now->error) now = tried;
    }
    if (!best || now->error < best->error) best = now;
    for (int r = 0; r < regions; ++r) {
      std::array<float, 16> places;
      for (std::size_t i = 0; i < parts[r].count; ++i)
        places[i] = static_cast<float>(weights(*now->mode)[now->index[parts[r].texel[i]]]) / 64;
      lines[r] = refitted(lines[r], parts[r].colours(), std::span(places).first(parts[r].count));
    }
  }
  return *best;
}

/// Shapes whose colours lie nearest to two lines.
std::array<int, shapes_tried> promising_shapes(const Bc6hColours& bits) {
  std::array<std::pair<float, int>, bc6h::shape_count> off;
  for (int shape = 0; shape < bc6h::shape_count; ++shape) {
    off[shape] = {0, shape};
    for (int r = 0; r < 2; ++r) off[shape].first += axis_of(Region(bits, 2, shape, r).colours()).off;
  }
  std::ranges::partial_sort(off, off.begin() + shapes_tried);
  std::array<int, shapes_tried> shapes;
  for (int i = 0; i < shapes_tried; ++i) shapes[i] = off[i].second;
  return shapes;
}

}  // namespace

Bc6hBlock to_bc6h(const Bc6hColours& any) {
  Bc6hColours colours, bits;
  std::ranges::transform(any, colours.begin(), cut);
  std::ranges::transform(colours, bits.begin(), to_half_bits);
  Encoded best = best_of(1, 0, colours, bits);
  if (best.error > 0)
    for (const int shape : promising_shapes(bits))
      if (const Encoded tried = best_of(2, shape, colours, bits); tried.error < best.error) best = tried;

  Bc6hBlock block{};
  BlockBits out(block);
  const Mode& mode = *best.mode;
  out.put(static_cast<int>(mode.number), mode.number_bits);
  for (const Bit& bit : mode.bits) {
    const bool stands = bit.end == 0 || mode.delta[bit.channel] == 0;
    const int value = best.ends[bit.end][bit.channel] - (stands ? 0 : best.ends[0][bit.channel]);
    out.put(value >> bit.place & 1, 1);
  }
  if (mode.regions == 2) out.put(best.shape, 5);
  for (int i = 0; i < 16; ++i)
    out.put(best.index[i], mode.index_bits() - (is_anchor(mode, best.shape, i) ? 1 : 0));
  return block;
}

Bc6hColours from_bc6h(const Bc6hBlock& block) {
  Bc6hBlock bytes = block;
  BlockBits in(bytes);
  int number = in.get(2);
  if (number > 1) number |= in.get(3) << 2;
  const auto mode = std::ranges::find(bc6h::modes(), static_cast<std::uint32_t>(number), &Mode::number);
  if (mode == bc6h::modes().end()) return {};

  Ends ends{};
  for (const Bit& bit : mode->bits) ends[bit.end][bit.channel] |= in.get(1) << bit.place;
  for (int e = 1; e < mode->ends(); ++e) {
    for (int c = 0; c < 3; ++c) {
      if (mode->delta[c] == 0) continue;
      const int sign = 1 << (mode->delta[c] - 1);
      ends[e][c] = (ends[0][c] + (ends[e][c] ^ sign) - sign) & ((1 << mode->end_bits) - 1);
    }
  }
  for (ivec3& end : ends) end = unquantized(end, mode->end_bits);
  const int shape = mode->regions == 2 ? in.get(5) : 0;
  Bc6hColours colours;
  for (int i = 0; i < 16; ++i) {
    const int index = in.get(mode->index_bits() - (is_anchor(*mode, shape, i) ? 1 : 0));
    const std::size_t line = 2 * region_of(*mode, shape, i);
    colours[i] = of_half_bits(between(ends[line], ends[line + 1], weights(*mode)[index]));
  }
  return colours;
}

}  // namespace ssphh::sh
