#include "bc6h_modes.h"

#include <string_view>

namespace ssphh::sh::bc6h {
namespace {

/// Region 1 has the texels of the bits that are set, texel 0 the lowest.
constexpr std::uint16_t shapes[shape_count] = {
    0xcccc, 0x8888, 0xeeee, 0xecc8, 0xc880, 0xfeec, 0xfec8, 0xec80, 0xc800, 0xffec, 0xfe80,
    0xe800, 0xffe8, 0xff00, 0xfff0, 0xf000, 0xf710, 0x008e, 0x7100, 0x08ce, 0x008c, 0x7310,
    0x3100, 0x8cce, 0x088c, 0x3110, 0x6666, 0x366c, 0x17e8, 0x0ff0, 0x718e, 0x399c};
constexpr std::uint8_t anchors[shape_count] = {15, 15, 15, 15, 15, 15, 15, 15, 15, 15, 15, 15, 15, 15, 15, 15,
                                               15, 2,  8,  2,  2,  8,  8,  15, 2,  8,  2,  2,  8,  8,  2,  2};

int number(std::string_view& text) {
  int value = 0;
  for (; !text.empty() && text[0] >= '0' && text[0] <= '9'; text.remove_prefix(1))
    value = 10 * value + (text[0] - '0');
  return value;
}

/// Of the specification's notation: rw, rx, ry, rz are red of ends 0 to 3; digits are bits, a-b those from a
/// to b.
std::vector<Bit> bits_of(std::string_view text) {
  std::vector<Bit> bits;
  while (!text.empty()) {
    if (text[0] == ' ') text.remove_prefix(1);
    Bit bit{static_cast<int>(std::string_view("wxyz").find(text[1])),
            static_cast<int>(std::string_view("rgb").find(text[0])), 0};
    text.remove_prefix(2);
    bit.place = number(text);
    int last = bit.place;
    if (!text.empty() && text[0] == '-') text.remove_prefix(1), last = number(text);
    for (const int step = last < bit.place ? -1 : 1; bits.push_back(bit), bit.place != last;)
      bit.place += step;
  }
  return bits;
}

Mode mode(std::uint32_t number, int regions, int end_bits, const glm::ivec3& delta, std::string_view bits) {
  return {number, number < 2 ? 2 : 5, regions, end_bits, delta, bits_of(bits)};
}

}  // namespace

std::span<const Mode> modes() {
  // The specification's table.
  static const std::vector<Mode> all = {
      mode(0x00, 2, 10, {5, 5, 5},
           "gy4 by4 bz4 rw0-9 gw0-9 bw0-9 rx0-4 gz4 gy0-3 gx0-4 bz0 gz0-3 bx0-4 bz1 by0-3 ry0-4 bz2 rz0-4 "
           "bz3"),
      mode(0x01, 2, 7, {6, 6, 6},
           "gy5 gz4 gz5 rw0-6 bz0 bz1 by4 gw0-6 by5 bz2 gy4 bw0-6 bz3 bz5 bz4 rx0-5 gy0-3 gx0-5 gz0-3 bx0-5 "
           "by0-3 ry0-5 rz0-5"),
      mode(
          0x02, 2, 11, {5, 4, 4},
          "rw0-9 gw0-9 bw0-9 rx0-4 rw10 gy0-3 gx0-3 gw10 bz0 gz0-3 bx0-3 bw10 bz1 by0-3 ry0-4 bz2 rz0-4 bz3"),
      mode(0x06, 2, 11, {4, 5, 4},
           "rw0-9 gw0-9 bw0-9 rx0-3 rw10 gz4 gy0-3 gx0-4 gw10 gz0-3 bx0-3 bw10 bz1 by0-3 ry0-3 bz0 bz2 rz0-3 "
           "gy4 bz3"),
      mode(0x0a, 2, 11, {4, 4, 5},
           "rw0-9 gw0-9 bw0-9 rx0-3 rw10 by4 gy0-3 gx0-3 gw10 bz0 gz0-3 bx0-4 bw10 by0-3 ry0-3 bz1 bz2 rz0-3 "
           "bz4 bz3"),
      mode(0x0e, 2, 9, {5, 5, 5},
           "rw0-8 by4 gw0-8 gy4 bw0-8 bz4 rx0-4 gz4 gy0-3 gx0-4 bz0 gz0-3 bx0-4 bz1 by0-3 ry0-4 bz2 rz0-4 "
           "bz3"),
      mode(0x12, 2, 8, {6, 5, 5},
           "rw0-7 gz4 by4 gw0-7 bz2 gy4 bw0-7 bz3 bz4 rx0-5 gy0-3 gx0-4 bz0 gz0-3 bx0-4 bz1 by0-3 ry0-5 "
           "rz0-5"),
      mode(0x16, 2, 8, {5, 6, 5},
           "rw0-7 bz0 by4 gw0-7 gy5 gy4 bw0-7 gz5 bz4 rx0-4 gz4 gy0-3 gx0-5 gz0-3 bx0-4 bz1 by0-3 ry0-4 bz2 "
           "rz0-4 bz3"),
      mode(0x1a, 2, 8, {5, 5, 6},
           "rw0-7 bz1 by4 gw0-7 by5 gy4 bw0-7 bz5 bz4 rx0-4 gz4 gy0-3 gx0-4 bz0 gz0-3 bx0-5 by0-3 ry0-4 bz2 "
           "rz0-4 bz3"),
      mode(0x1e, 2, 6, {0, 0, 0},
           "rw0-5 gz4 bz0 bz1 by4 gw0-5 gy5 by5 bz2 gy4 bw0-5 gz5 bz3 bz5 bz4 rx0-5 gy0-3 gx0-5 gz0-3 bx0-5 "
           "by0-3 ry0-5 rz0-5"),
      mode(0x03, 1, 10, {0, 0, 0}, "rw0-9 gw0-9 bw0-9 rx0-9 gx0-9 bx0-9"),
      mode(0x07, 1, 11, {9, 9, 9}, "rw0-9 gw0-9 bw0-9 rx0-8 rw10 gx0-8 gw10 bx0-8 bw10"),
      mode(0x0b, 1, 12, {8, 8, 8}, "rw0-9 gw0-9 bw0-9 rx0-7 rw11-10 gx0-7 gw11-10 bx0-7 bw11-10"),
      mode(0x0f, 1, 16, {4, 4, 4}, "rw0-9 gw0-9 bw0-9 rx0-3 rw15-10 gx0-3 gw15-10 bx0-3 bw15-10"),
  };
  return all;
}

int region_of(int shape, int i) {
  return shapes[shape] >> i & 1;
}

int anchor_of(int shape, int region) {
  return region == 0 ? 0 : anchors[shape];
}

}  // namespace ssphh::sh::bc6h
