#include <algorithm>
#include <array>
#include <cmath>
#include <cstring>

#include <fmt/format.h>
#include <glm/gtc/packing.hpp>

#include <ssphh/core/bytes.h>
#include <ssphh/core/math.h>
#include <ssphh/sh/packing.h>
#include <ssphh/sh/zh3.h>

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
  }
  RadianceSh f(degree);
  std::memcpy(f.values.data(), bytes.data(), bytes.size());
  return f;
}

}  // namespace ssphh::sh
