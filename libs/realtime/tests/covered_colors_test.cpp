#include "covered_colors.h"

#include <gtest/gtest.h>

namespace ssphh::realtime {
namespace {

using Rgba = std::array<int, 4>;

scene::Texture texture_of(int width, int height, const auto& color_at) {
  scene::Texture texture{"", width, height, {}};
  for (int y = 0; y < height; ++y)
    for (int x = 0; x < width; ++x)
      for (const int value : color_at(x, y)) texture.rgba.push_back(static_cast<std::uint8_t>(value));
  return texture;
}

TEST(CoveredColors, WhatIsCutAwayHasTheHueOfWhatIsAroundIt) {
  // A leaf on white of which nothing is seen, and a red one far from it; sizes that are no powers of two.
  const scene::Texture texture = texture_of(365, 271, [](int x, int y) -> Rgba {
    if (x > 40 && x < 80 && y % 5 == 0) return {20, 160, 30, 255};
    if (x > 300) return {200, 10, 10, 255};
    return {255, 255, 255, 0};
  });
  const std::vector<std::uint8_t> found = covered_colors(texture);
  ASSERT_EQ(found.size(), texture.rgba.size());
  for (int y = 0; y < 271; ++y) {
    for (int x = 0; x < 365; ++x) {
      const std::size_t i = 4 * (static_cast<std::size_t>(y) * 365 + static_cast<std::size_t>(x));
      ASSERT_EQ(found[i + 3], texture.rgba[i + 3]);
      ASSERT_LT(found[i + 2], 31) << "nothing is white at " << x << ' ' << y;
      if (texture.rgba[i + 3] == 255) {
        ASSERT_TRUE(std::equal(&found[i], &found[i] + 3, &texture.rgba[i]));
      }
      if (x > 48 && x < 64) {
        ASSERT_EQ(found[i + 1], 160) << "the leaf's green between its ribs, at " << x << ' ' << y;
      }
    }
  }
}

TEST(CoveredColors, AreMeansByCoverage) {
  const scene::Texture three = texture_of(3, 1, [](int x, int) -> Rgba {
    return x == 0 ? Rgba{100, 0, 0, 255} : x == 1 ? Rgba{200, 0, 0, 51} : Rgba{255, 255, 255, 0};
  });
  // (100 + .2 · 200) / 1.2.
  EXPECT_EQ(covered_colors(three), (std::vector<std::uint8_t>{100, 0, 0, 255, 200, 0, 0, 51, 117, 0, 0, 0}));
}

TEST(CoveredColors, OfWhatCoversAllOrNothingAreAsTheyWere) {
  for (const int alpha : {0, 255}) {
    const scene::Texture texture = texture_of(7, 5, [&](int x, int y) -> Rgba {
      return {30 * x, 40 * y, 200, alpha};
    });
    EXPECT_EQ(covered_colors(texture), texture.rgba);
  }
  EXPECT_TRUE(covered_colors({}).empty());
}

}  // namespace
}  // namespace ssphh::realtime
