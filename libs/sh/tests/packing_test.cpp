// Packed light against the bounds of each packing's rounding, and against what it must keep exactly.

#include <cmath>
#include <cstring>

#include <fmt/format.h>
#include <gmock/gmock.h>

#include <ssphh/core/sphere.h>
#include <ssphh/sh/evaluate.h>
#include <ssphh/sh/irradiance.h>
#include <ssphh/sh/packing.h>
#include <ssphh/sh/project.h>
#include <ssphh/sh/rotate.h>
#include <ssphh/sh/zonal.h>

#include "error_message.h"
#include "random_sh.h"

namespace ssphh::sh {
namespace {

constexpr Packing all[] = {Packing::none, Packing::half, Packing::rgb9e5, Packing::zh3, Packing::bc6h};

std::vector<std::byte> packed(const RadianceSh& f, Packing packing) {
  std::vector<std::byte> bytes;
  pack(f, packing, bytes);
  return bytes;
}

RadianceSh through(const RadianceSh& f, Packing packing) {
  return unpack(packed(f, packing), packing, f.degree());
}

/// A few clamped cosines about random axes, each of another colour, in the order of `scale`: nowhere negative
/// before bands end.
RadianceSh random_light(int degree, std::uint64_t seed, float scale = 1) {
  Pcg32 random(seed);
  const ZonalSh lobe = zonal_cosine_lobe(degree);
  RadianceSh f(degree);
  std::vector<float> turned(f.values.size());
  for (int i = 0; i < 4; ++i) {
    rotate_zonal(lobe, vec3(test::random_direction(random)), turned);
    const vec3 colour = scale * random.uniform3();
    for (std::size_t k = 0; k < turned.size(); ++k) f.values[k] += turned[k] * colour;
  }
  return f;
}

/// Most that rounding may take from coefficient k of channel c, as pack() says.
float bound(const RadianceSh& f, Packing packing, int k, int c) {
  float largest = 0;
  for (const vec3& v : f.values) largest = std::max(largest, max_component(glm::abs(v)));
  if (packing == Packing::half) return std::max(0x1p-11f * std::abs(f[k][c]), 0x1.01p-39f * largest);
  const float of_mean = max_component(f[0]) * 0x1p-9f;
  if (k == 0) return of_mean;
  const auto l = static_cast<float>(std::floor(std::sqrt(static_cast<float>(k))));
  const float most = std::sqrt(2 * l + 1);
  return 1.001f * most * ((f[0][c] + of_mean) / 254 + of_mean);
}

TEST(Packing, EveryCoefficientIsWithinItsBound) {
  for (const Packing packing : {Packing::half, Packing::rgb9e5}) {
    for (int degree = 0; degree <= max_degree; ++degree) {
      for (const float scale : {1e-3f, 1.0f, 7777.0f}) {
        const RadianceSh f = random_light(degree, 17 + static_cast<std::uint64_t>(degree), scale);
        const RadianceSh g = through(f, packing);
        for (int k = 0; k < coefficient_count(degree); ++k)
          for (int c = 0; c < 3; ++c)
            EXPECT_NEAR(g[k][c], f[k][c], bound(f, packing, k, c))
                << name_of(packing) << " " << degree << " " << k;
      }
    }
  }
}

TEST(Packing, NoneKeepsEveryBit) {
  const RadianceSh f = test::random_sh(10, 3);
  EXPECT_EQ(through(f, Packing::none), f);
}

TEST(Packing, HalfOfHalfIsTheSameBytes) {
  for (std::uint64_t seed = 0; seed < 300; ++seed) {
    Pcg32 random(seed);
    RadianceSh f = test::random_sh(3, seed);
    for (vec3& v : f.values) v *= std::ldexp(1.0f, static_cast<int>(random.next() % 60) - 30);
    if (seed % 3 == 0) f[1].x = std::ldexp(1 - 0x1p-13f, 40);  // rounds up to the next power of two
    const std::vector<std::byte> once = packed(f, Packing::half);
    EXPECT_EQ(packed(unpack(once, Packing::half, 3), Packing::half), once) << seed;
  }
}

TEST(Packing, BrightLampsDoNotOverflowHalfFloats) {
  RadianceSh f = random_light(4, 5);
  f *= vec3(1e12f);
  const RadianceSh g = through(f, Packing::half);
  for (int k = 0; k < 25; ++k) EXPECT_NEAR(g[k].y, f[k].y, bound(f, Packing::half, k, 1));
  EXPECT_EQ(test::message_of([&] { packed(f, Packing::rgb9e5); }).find("packing of light: coefficient 0 is "),
            0u);
  RadianceSh most(0);
  most[0] = vec3(65408);
  EXPECT_EQ(through(most, Packing::rgb9e5), most);
}

TEST(Packing, AConstantFieldStaysConstant) {
  RadianceSh f(2);
  f[0] = {0.5f, 3, 100};
  for (const Packing packing : all) {
    const RadianceSh g = through(f, packing);
    // A map's constant is constant but for what solving for coefficients rounds.
    const float most = packing == Packing::bc6h ? 2e-5f : 0;
    for (int k = 1; k < 9; ++k) EXPECT_LE(max_component(glm::abs(g[k])), most) << name_of(packing);
    for (int c = 0; c < 3; ++c) EXPECT_NEAR(g[0][c], f[0][c], 100 * 0x1p-9f);
  }
  EXPECT_EQ(through(RadianceSh(2), Packing::half), RadianceSh(2));
  EXPECT_EQ(through(RadianceSh(2), Packing::zh3), RadianceSh(2));
  EXPECT_EQ(through(RadianceSh(4), Packing::bc6h), RadianceSh(4));
}

TEST(Packing, IrradianceOfALinearFieldIsWithinTheBytesBound) {
  // L = 1 + s·ω with |s| = 1: touches 0. Three coefficients of band 1, each with error of √3/254 of S_00,
  // give E an error of at most A_1 √3 √(3/4π) √3/254 S_00 along the worst normal; E's mean is π Y_00 S_00.
  Pcg32 random(4);
  for (int i = 0; i < 100; ++i) {
    const vec3 s(test::random_direction(random));
    RadianceSh f(2);
    f[0] = vec3(std::sqrt(4 * pi));
    const float unit = std::sqrt(4 * pi / 3);
    f[1] = vec3(unit * s.y), f[2] = vec3(unit * s.z), f[3] = vec3(unit * s.x);
    for (const Packing packing : {Packing::half, Packing::rgb9e5, Packing::zh3}) {
      const RadianceSh g = through(f, packing);
      const vec3 n(test::random_direction(random));
      const float of_mean = 0x1p-9f, of_bytes = 2.0f / 3 * 3 / 254 * std::sqrt(3.0f);
      // ZH3's band 2 is 0, and its byte with it.
      EXPECT_NEAR(irradiance(g, n).x / pi, 1 + 2.0f / 3 * glm::dot(s, n), 1.01f * (2 * of_mean + of_bytes));
    }
  }
}

TEST(Packing, SizesAreThoseOfTheTable) {
  EXPECT_EQ(packed_bytes(Packing::none, 2), 108u);
  EXPECT_EQ(packed_bytes(Packing::half, 2), 55u);
  EXPECT_EQ(packed_bytes(Packing::rgb9e5, 2), 28u);
  EXPECT_EQ(packed_bytes(Packing::zh3, 2), 16u);
  EXPECT_EQ(packed_bytes(Packing::bc6h, 2), 17u);
  EXPECT_EQ(packed_bytes(Packing::bc6h, 4), 65u);
  for (const Packing packing : all) {
    for (int d = 0; d <= max_degree; ++d) {
      if (!packs(packing, d)) continue;
      EXPECT_EQ(packed(random_light(d, 1), packing).size(), packed_bytes(packing, d));
    }
  }
}

TEST(Packing, TheTexelIsVulkansRgb9e5) {
  // 1.0 = 256 · 2^(16 − 24); 0.5 and 0.25 with the same exponent (VK_FORMAT_E5B9G9R9_UFLOAT_PACK32).
  RadianceSh f(0);
  f[0] = {1, 0.5f, 0.25f};
  const std::vector<std::byte> bytes = packed(f, Packing::rgb9e5);
  std::uint32_t word = 0;
  std::memcpy(&word, bytes.data(), 4);
  EXPECT_EQ(word, 16u << 27 | 64u << 18 | 128u << 9 | 256u);
  EXPECT_EQ(through(f, Packing::rgb9e5), f);
}

TEST(Packing, WhatCannotBePackedIsRefusedAndAppendsNothing) {
  std::vector<std::byte> bytes;
  RadianceSh f = random_light(2, 8);
  const auto said = [&](const RadianceSh& light, Packing packing) {
    return test::message_of([&] { pack(light, packing, bytes); });
  };
  for (const int degree : {0, 1, 3, 10})
    for (const Packing packing : {Packing::zh3, Packing::bc6h})
      EXPECT_THAT(said(RadianceSh(degree), packing),
                  testing::HasSubstr(fmt::format("{} has no degree {}", name_of(packing), degree)));
  for (const float bad : {NAN, INFINITY, -INFINITY}) {
    f[5].z = bad;
    for (const Packing packing : all) EXPECT_THAT(said(f, packing), testing::HasSubstr("not finite"));
  }
  f.values.resize(8);
  EXPECT_THAT(said(f, Packing::half), testing::HasSubstr("of no degree"));
  EXPECT_TRUE(bytes.empty());
  EXPECT_THROW(unpack(std::vector<std::byte>(27), Packing::rgb9e5, 2), Error);
  EXPECT_THROW(unpack(std::vector<std::byte>(16), Packing::zh3, 1), Error);
  EXPECT_THROW(unpack(std::vector<std::byte>(17), Packing::bc6h, 4), Error);
}

TEST(Packing, IrradianceOfAMapIsNear) {
  // White light of any shape: all colours lie on a line, and the map's steps of 1/15 of its range are what is
  // lost. Light of four colours: the mean error, in shares of the mean irradiance, of 40 functions.
  for (const int degree : {2, 4}) {
    double of_white = 0, of_colours = 0;
    for (std::uint64_t seed = 0; seed < 40; ++seed) {
      for (const bool white : {true, false}) {
        RadianceSh f = random_light(degree, 100 + seed, 0.01f * static_cast<float>(1 + seed));
        if (white)
          for (vec3& v : f.values) v = vec3(luminance(v));
        const RadianceSh g = through(f, Packing::bc6h);
        const vec3 mean = pi * std::sqrt(1 / (4 * pi)) * f[0];
        for (int i = 0; i < 50; ++i) {
          const vec3 n = spherical_fibonacci(i, 50);
          const vec3 off = glm::abs(irradiance(g, n) - irradiance(f, n)) / mean;
          (white ? of_white : of_colours) += static_cast<double>(off.x + off.y + off.z) / (3 * 50 * 40);
          EXPECT_LT(max_component(off), white ? 0.12f : 0.6f) << degree << " " << seed;
        }
      }
    }
    EXPECT_LT(of_white, degree == 2 ? 0.02 : 0.012);
    EXPECT_LT(of_colours, degree == 2 ? 0.09 : 0.03);
  }
}

TEST(Packing, OfMapsOnlyBandThreeIsLost) {
  // A map of many texels gives bands 0, 1, 2 and 4 back; bands over the mean's 1/2 below 0 would be cut.
  RadianceSh f = random_light(4, 12);
  f[10] = vec3(0.1f);
  const RadianceSh g = through(f, Packing::bc6h);
  for (int k = 9; k < 16; ++k) EXPECT_EQ(g[k], vec3(0));
  for (const int k : {0, 1, 2, 3}) EXPECT_LT(glm::distance(g[k], f[k]), 0.05f * glm::length(f[0])) << k;
}

TEST(Packing, MapsOfBrightLampsDoNotOverflow) {
  RadianceSh f = random_light(2, 5), dim = f;
  f *= vec3(0x1p40f);
  const RadianceSh g = through(f, Packing::bc6h), h = through(dim, Packing::bc6h);
  for (int k = 0; k < 9; ++k) EXPECT_EQ(g[k], 0x1p40f * h[k]);
}

TEST(Packing, NegativeLightIsCutAndNotWrapped) {
  RadianceSh f(1);
  f[0] = {1, -1, 0}, f[1] = vec3(5), f[2] = vec3(-5);
  const RadianceSh g = through(f, Packing::rgb9e5);
  EXPECT_EQ(g[0], vec3(1, 0, 0));
  EXPECT_NEAR(g[1].x, std::sqrt(3.0f), 1e-5f);
  EXPECT_NEAR(g[2].x, -std::sqrt(3.0f), 1e-5f);
  EXPECT_EQ(g[1].y, 0);
  EXPECT_EQ(g[1].z, 0);
  RadianceSh negative(2);
  negative[0] = {1, -1, 0}, negative[1] = vec3(0.1f);
  const RadianceSh h = through(negative, Packing::bc6h);
  EXPECT_NEAR(h[0].x, 1, 0.01f);
  for (int k = 0; k < 9; ++k) EXPECT_EQ(vec2(h[k].y, h[k].z), vec2(0)) << k;
}

}  // namespace
}  // namespace ssphh::sh
