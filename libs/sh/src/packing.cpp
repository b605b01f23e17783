#include <algorithm>
#include <array>
#include <cmath>
#include <cstring>

#include <fmt/format.h>
#include <glm/gtc/packing.hpp>

#include <ssphh/core/bytes.h>
#include <ssphh/core/math.h>
#include <ssphh/sh/bc6h.h>
#include <ssphh/sh/irradiance.h>
#include <ssphh/sh/packing.h>
#include <ssphh/sh/zh3.h>

#include "irradiance_map.h"
#include "rgb9e5.h"

namespace ssphh::sh {
namespace {

constexpr const char* where = "packing of light";

/// Values are multiples of 2^exponent, with half floats' eleven bits: the largest lies under 2^15 then, and
/// rounds to 2^15 at most. Of rounded values the same number comes.
int half_exponent(std::span<const vec3> values) {
  float largest = 0;
  for (const vec3& v : values) largest = std::max(largest, max_component(glm::abs(v)));
  if (largest == 0) return 0;
  int exponent = std::ilogb(largest) - 14;
  if (std::ldexp(largest, -exponent) >= 0x1p15f - 0x1p3f) ++exponent;  // what rounds up to 2^15
  return std::clamp(exponent, -128, 127);
}

void pack_half(const RadianceSh& f, ByteWriter& out) {
  const int exponent = half_exponent(f.values);
  out.value(static_cast<std::int8_t>(exponent));
  for (const vec3& v : f.values)
    for (int c = 0; c < 3; ++c) out.value(glm::packHalf1x16(std::ldexp(v[c], -exponent)));
}

RadianceSh unpack_half(ByteReader& in, int degree) {
  RadianceSh f(degree);
  const int exponent = in.value<std::int8_t>("exponent");
  for (vec3& v : f.values)
    for (int c = 0; c < 3; ++c)
      v[c] = std::ldexp(glm::unpackHalf1x16(in.value<std::uint16_t>("half")), exponent);
  return f;
}

/// The most that a coefficient of band l has in shares of coefficient 0 where no light is negative:
/// |∫ L Y_lm| ≤ max |Y_lm| ∫ L, and |Y_lm| ≤ √(2l+1) Y_00.
float most_in_band(int l) {
  return std::sqrt(static_cast<float>(2 * l + 1));
}

/// One byte a channel of a coefficient of band l beside coefficient 0.
std::array<std::int8_t, 3> to_shares(const vec3& value, const vec3& mean, int l) {
  std::array<std::int8_t, 3> shares{};
  for (int c = 0; c < 3; ++c) {
    if (!(mean[c] > 0)) continue;
    const float share = value[c] / (most_in_band(l) * mean[c]);
    shares[c] = static_cast<std::int8_t>(std::round(127 * std::clamp(share, -1.0f, 1.0f)));
  }
  return shares;
}

vec3 from_shares(const std::array<std::int8_t, 3>& shares, const vec3& mean, int l) {
  return vec3(shares[0], shares[1], shares[2]) / 127.0f * (most_in_band(l) * mean);
}

/// Writes what stands for `value` and returns what will be read for it.
vec3 pack_shares(const vec3& value, const vec3& mean, int l, ByteWriter& out) {
  const std::array<std::int8_t, 3> shares = to_shares(value, mean, l);
  out.array(std::span<const std::int8_t>(shares));
  return from_shares(shares, mean, l);
}

vec3 unpack_shares(ByteReader& in, const vec3& mean, int l) {
  std::array<std::int8_t, 3> shares;
  in.raw("shares", std::span<std::int8_t>(shares));
  return from_shares(shares, mean, l);
}

vec3 pack_mean(const vec3& mean, ByteWriter& out) {
  if (max_component(mean) > rgb9e5_most)
    refuse(where, fmt::format("coefficient 0 is {:g}; RGB9E5 holds {:g}: pack it as half",
                              max_component(mean), rgb9e5_most));
  const std::uint32_t word = to_rgb9e5(mean);
  out.value(word);
  return from_rgb9e5(word);
}

void pack_bytes(const RadianceSh& f, ByteWriter& out) {
  const vec3 mean = pack_mean(f[0], out);
  for (int l = 1; l <= f.degree(); ++l)
    for (int m = -l; m <= l; ++m) pack_shares(f[coefficient_index(l, m)], mean, l, out);
}

RadianceSh unpack_bytes(ByteReader& in, int degree) {
  RadianceSh f(degree);
  f[0] = from_rgb9e5(in.value<std::uint32_t>("mean"));
  for (int l = 1; l <= degree; ++l)
    for (int m = -l; m <= l; ++m) f[coefficient_index(l, m)] = unpack_shares(in, f[0], l);
  return f;
}

void pack_zh3(const RadianceSh& f, ByteWriter& out) {
  std::array<vec3, 4> linear;
  linear[0] = pack_mean(f[0], out);
  for (int k = 1; k < 4; ++k) linear[k] = pack_shares(f[k], linear[0], 1, out);
  pack_shares(zh3_about(linear, f).zonal, linear[0], 2, out);  // about the axis that the reader will find
}

RadianceSh unpack_zh3(ByteReader& in) {
  Zh3 zh3;
  zh3.linear[0] = from_rgb9e5(in.value<std::uint32_t>("mean"));
  for (int k = 1; k < 4; ++k) zh3.linear[k] = unpack_shares(in, zh3.linear[0], 1);
  zh3.zonal = unpack_shares(in, zh3.linear[0], 2);
  return to_sh(zh3);
}

/// What irradiance is raised by, in shares of its mean: dark sides of light that is nowhere negative have
/// more than that, and colours lie closer together.
constexpr float raised = 0.5f;

const IrradianceMap& map_of(int degree) {
  static const IrradianceMap coarse(4, 2), fine(8, 4);
  return degree == 2 ? coarse : fine;
}

/// The map's place of texel i of a block.
std::size_t place_of(int side, std::size_t block, std::size_t i) {
  const auto width = static_cast<std::size_t>(side);
  return (4 * (block / (width / 4)) + i / 4) * width + 4 * (block % (width / 4)) + i % 4;
}

void pack_bc6h(const RadianceSh& f, ByteWriter& out) {
  const IrradianceMap& map = map_of(f.degree());
  const float unit = static_cast<float>(cosine_band_factor(0) * std::sqrt(1 / (4 * pi_d)));
  const vec3 mean = unit * glm::max(f[0], vec3(0));
  std::vector<vec3> texels = map.texels(f);
  for (vec3& texel : texels) {
    texel = glm::max(texel + raised * mean, vec3(0));
    for (int c = 0; c < 3; ++c)
      if (mean[c] == 0) texel[c] = 0;
  }
  const int exponent = half_exponent(texels);
  out.value(static_cast<std::int8_t>(exponent));
  for (std::size_t block = 0; block < texels.size() / 16; ++block) {
    Bc6hColours colours;
    for (std::size_t i = 0; i < 16; ++i)
      for (int c = 0; c < 3; ++c)
        colours[i][c] = std::ldexp(texels[place_of(map.side(), block, i)][c], -exponent);
    const Bc6hBlock bytes = to_bc6h(colours);
    out.array(std::span<const std::byte>(bytes));
  }
}

RadianceSh unpack_bc6h(ByteReader& in, int degree) {
  const IrradianceMap& map = map_of(degree);
  const int exponent = in.value<std::int8_t>("exponent");
  std::vector<vec3> texels(static_cast<std::size_t>(map.side() * map.side()));
  for (std::size_t block = 0; block < texels.size() / 16; ++block) {
    Bc6hBlock bytes;
    in.raw("BC6H", std::span<std::byte>(bytes));
    const Bc6hColours colours = from_bc6h(bytes);
    for (std::size_t i = 0; i < 16; ++i)
      for (int c = 0; c < 3; ++c)
        texels[place_of(map.side(), block, i)][c] = std::ldexp(colours[i][c], exponent);
  }
  RadianceSh f = map.radiance(texels);
  f[0] /= 1 + raised;
  return f;
}

void require_packs(Packing packing, int degree) {
  if (!packs(packing, degree)) refuse(where, fmt::format("{} has no degree {}", name_of(packing), degree));
}

}  // namespace

void pack(const RadianceSh& f, Packing packing, std::vector<std::byte>& out) {
  const int degree = f.degree();
  require(degree >= 0 && f.values.size() == static_cast<std::size_t>(coefficient_count(degree)), where,
          "the coefficients are of no degree");
  require_packs(packing, degree);
  for (const vec3& v : f.values) require(is_finite(v), where, "holds a number that is not finite");
  ByteWriter packed;
  switch (packing) {
    case Packing::none:
      packed.array(std::span<const vec3>(f.values));
      break;
    case Packing::half:
      pack_half(f, packed);
      break;
    case Packing::rgb9e5:
      pack_bytes(f, packed);
      break;
    case Packing::zh3:
      pack_zh3(f, packed);
      break;
    case Packing::bc6h:
      pack_bc6h(f, packed);
      break;
  }
  out.insert(out.end(), packed.bytes().begin(), packed.bytes().end());
}

RadianceSh unpack(std::span<const std::byte> bytes, Packing packing, int degree) {
  require_packs(packing, degree);
  require(bytes.size() == packed_bytes(packing, degree), where,
          "there are more or fewer bytes than it takes");
  ByteReader in(bytes, where);
  switch (packing) {
    case Packing::none:
      break;
    case Packing::half:
      return unpack_half(in, degree);
    case Packing::rgb9e5:
      return unpack_bytes(in, degree);
    case Packing::zh3:
      return unpack_zh3(in);
    case Packing::bc6h:
      return unpack_bc6h(in, degree);
  }
  RadianceSh f(degree);
  std::memcpy(f.values.data(), bytes.data(), bytes.size());
  return f;
}

}  // namespace ssphh::sh
