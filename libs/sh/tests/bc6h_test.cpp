// Blocks of BC6H: what they must hold exactly, and how near they come to what lies on a line or two. That the
// bits mean what they mean to GPUs: libs/realtime/tests/bc6h_test.cpp.

#include <array>
#include <cmath>
#include <cstdint>
#include <limits>

#include <glm/gtc/packing.hpp>
#include <gtest/gtest.h>

#include <ssphh/core/math.h>
#include <ssphh/core/random.h>
#include <ssphh/sh/bc6h.h>

namespace ssphh::sh {
namespace {

Bc6hColours through(const Bc6hColours& colours) {
  return from_bc6h(to_bc6h(colours));
}

float worst(const Bc6hColours& a, const Bc6hColours& b) {
  float most = 0;
  for (std::size_t i = 0; i < 16; ++i) most = std::max(most, max_component(glm::abs(a[i] - b[i])));
  return most;
}

TEST(Bc6h, OneColourIsKept) {
  // Half floats of 12 bits and more of 16, and what rounds to them.
  for (const vec3 colour : {vec3(0), vec3(1), vec3(0.25f, 17, 3000), vec3(65504), vec3(1e-5f, 1, 2)}) {
    Bc6hColours all;
    all.fill(colour);
    const Bc6hColours back = through(all);
    for (const vec3& c : back) EXPECT_EQ(c, back[0]);
    for (int c = 0; c < 3; ++c) EXPECT_NEAR(back[0][c], colour[c], 0x1p-9f * colour[c] + 2e-7f);
  }
}

TEST(Bc6h, WeightsOfALineAreThoseOfTheFormat) {
  // Mode 11: five bits 00011, six ends of ten bits, here 0 and all ones, then indices of four bits, the first
  // of three. Weights of 64ths as in "BC6H Format" of Direct3D's documentation.
  constexpr std::array<int, 16> weights{0, 4, 9, 13, 17, 21, 26, 30, 34, 38, 43, 47, 51, 55, 60, 64};
  std::array<int, 128> bits{1, 1};
  for (std::size_t i = 35; i < 65; ++i) bits[i] = 1;
  for (std::size_t pixel = 0; pixel < 16; ++pixel) {
    for (std::size_t b = 0; b < 4; ++b)
      if (pixel > 0) bits[64 + 4 * pixel + b] = static_cast<int>(pixel >> b & 1);
  }
  Bc6hBlock block{};
  for (std::size_t i = 0; i < 128; ++i) block[i / 8] |= static_cast<std::byte>(bits[i] << i % 8);
  const Bc6hColours colours = from_bc6h(block);
  for (std::size_t i = 0; i < 16; ++i) {
    const int half = ((0xffff * weights[i] + 32) >> 6) * 31 >> 6;
    EXPECT_EQ(colours[i], vec3(glm::unpackHalf1x16(static_cast<std::uint16_t>(half)))) << i;
  }
}

TEST(Bc6h, WhatDoesNotFitIsCut) {
  Bc6hColours colours;
  for (std::size_t i = 0; i < 16; ++i) colours[i] = i < 8 ? vec3(-1, 2, 1e9f) : vec3(-5, 2, 1e30f);
  for (const vec3& c : through(colours)) {
    EXPECT_EQ(c.x, 0);
    EXPECT_NEAR(c.y, 2, 0.01f);
    EXPECT_GT(c.z, 65000);
    EXPECT_LE(c.z, bc6h_most);
  }
}

TEST(Bc6h, WhatDoesNotFitSpoilsNoOther) {
  Bc6hColours colours;
  for (std::size_t i = 0; i < 16; ++i) colours[i] = vec3(i % 4 < 2 ? 100 : 60000);
  Bc6hColours cut = colours;
  colours[3] = {1e30f, std::numeric_limits<float>::infinity(), 60000}, cut[3] = {bc6h_most, bc6h_most, 60000};
  colours[4] = {NAN, -1e30f, 100}, cut[4] = {0, 0, 100};
  EXPECT_EQ(to_bc6h(colours), to_bc6h(cut));
}

TEST(Bc6h, ALineOfColoursIsFollowedInSixteenSteps) {
  Pcg32 random(3);
  for (int round = 0; round < 200; ++round) {
    const vec3 a = 1.0f + random.uniform3(), b = 1.0f + random.uniform3();
    Bc6hColours colours;
    for (vec3& c : colours) c = glm::mix(a, b, random.uniform());
    // Half a step, and half as much for ends on a grid of 1/16 (10 bits, in [1, 2)).
    EXPECT_LT(worst(through(colours), colours), glm::distance(a, b) / 15 + 1.0f / 32) << round;
  }
}

TEST(Bc6h, TwoSidesOfOtherColoursAreFollowedByTwoLines) {
  // Red light from the left, green light from the right, as in cornell: one line would make both brown.
  Pcg32 random(4);
  for (int round = 0; round < 100; ++round) {
    Bc6hColours colours;
    for (std::size_t i = 0; i < 16; ++i) {
      const float t = 1 + random.uniform();
      const bool second = round % 2 == 0 ? i % 4 >= 2 : i >= 8;
      colours[i] = second ? vec3(1, 1 + t, 1) : vec3(1 + t, 1, 1);
    }
    EXPECT_LT(worst(through(colours), colours), 0.25f) << round;
  }
}

TEST(Bc6h, MoreTriesAreNoWorse) {
  // A block that BC6H holds exactly is found again, or one that is nearly as near.
  Pcg32 random(5);
  double sum = 0;
  for (int round = 0; round < 300; ++round) {
    Bc6hBlock block;
    for (std::byte& b : block) b = static_cast<std::byte>(random.next());
    block[0] = (block[0] & std::byte(0xe0)) | std::byte(0x03);  // one line, ends of ten bits
    const Bc6hColours colours = from_bc6h(block);
    float most = 0;
    for (const vec3& c : colours) most = std::max(most, max_component(c));
    sum += static_cast<double>(worst(through(colours), colours) / most) / 300;
  }
  EXPECT_LT(sum, 0.03);
}

TEST(Bc6h, ReservedModesAreBlack) {
  for (const int number : {0x13, 0x17, 0x1b, 0x1f}) {
    Bc6hBlock block;
    block.fill(std::byte(0xff));
    block[0] = static_cast<std::byte>(0xe0 | number);
    EXPECT_EQ(from_bc6h(block), Bc6hColours{}) << number;
  }
}

}  // namespace
}  // namespace ssphh::sh
