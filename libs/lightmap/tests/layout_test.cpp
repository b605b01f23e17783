#include <gmock/gmock.h>

#include <ssphh/core/random.h>

#include "error_message.h"
#include "rooms.h"

namespace ssphh::lightmap {
namespace {

using testing::HasSubstr;

void expect_apart(std::span<const glm::ivec2> at, std::span<const glm::ivec2> sizes, int width, int height) {
  std::vector<int> owner(static_cast<std::size_t>(width) * static_cast<std::size_t>(height), -1);
  for (std::size_t i = 0; i < at.size(); ++i) {
    ASSERT_TRUE(at[i].x >= 0 && at[i].y >= 0 && at[i].x + sizes[i].x <= width &&
                at[i].y + sizes[i].y <= height);
    for (int y = at[i].y; y < at[i].y + sizes[i].y; ++y) {
      for (int x = at[i].x; x < at[i].x + sizes[i].x; ++x) {
        int& known = owner[static_cast<std::size_t>(y) * static_cast<std::size_t>(width) +
                           static_cast<std::size_t>(x)];
        ASSERT_EQ(known, -1);
        known = static_cast<int>(i);
      }
    }
  }
}

TEST(Pack, RectanglesLieApartAndClose) {
  Pcg32 random(11);
  for (const int largest : {12, 40, 150}) {
    std::vector<glm::ivec2> sizes;
    int area = 0;
    while (area < 200000) {
      sizes.emplace_back(1 + static_cast<int>(random.uniform() * static_cast<float>(largest)),
                         1 + static_cast<int>(random.uniform() * static_cast<float>(largest)));
      area += sizes.back().x * sizes.back().y;
    }
    const std::optional<Packing> packing = pack(sizes, 512, 4096);
    ASSERT_TRUE(packing);
    expect_apart(packing->at, sizes, 512, packing->height);
    EXPECT_GT(static_cast<double>(area) / (512.0 * packing->height), 0.8) << largest;
  }
}

TEST(Pack, FillsARowExactly) {
  const std::vector<glm::ivec2> sizes(4, {8, 8});
  const std::optional<Packing> packing = pack(sizes, 16, 16);
  ASSERT_TRUE(packing);
  EXPECT_EQ(packing->height, 16);
  expect_apart(packing->at, sizes, 16, 16);
}

TEST(Pack, GivesNothingWhereTheyDoNotFit) {
  const std::vector<glm::ivec2> wide = {{17, 1}}, high = {{1, 17}}, many(5, {8, 8});
  EXPECT_FALSE(pack(wide, 16, 16));
  EXPECT_FALSE(pack(high, 16, 16));
  EXPECT_FALSE(pack(many, 16, 16));
  EXPECT_EQ(pack({}, 16, 16)->height, 0);
}

std::vector<Chart> rooms(int count) {
  std::vector<scene::Mesh> meshes;
  for (int i = 0; i < count; ++i) {
    meshes.push_back(scene::make_box(vec3(0), vec3(1 + 0.3f * static_cast<float>(i % 7), 2.5f, 3)));
    meshes.push_back(scene::make_sphere(0.4f, 16, 8));
  }
  return make_charts(scene_of(meshes), 0).charts;
}

TEST(Layout, SmallChartsGetFourTexelsAlongTheirLongerSideWhereTheyFit) {
  const std::vector<Chart> charts(40, {0, {}, vec2(0.04f, 0.02f)});
  for (const PlacedChart& place : lay_out(charts, {.size = 256, .density = 8.0f}).places)
    EXPECT_EQ(place.count, glm::ivec2(5, 3));
  for (const PlacedChart& place : lay_out(charts, {.size = 256, .density = 8.0f, .least = 1}).places)
    EXPECT_EQ(place.count, glm::ivec2(2, 2));
  // 40 of 9 × 7 texels, gutters included, are more than 48², 40 of 6 × 6 are not.
  for (const PlacedChart& place : lay_out(charts, {.size = 48, .density = 8.0f}).places)
    EXPECT_EQ(place.count, glm::ivec2(2, 2));
}

TEST(Layout, ChartsAndTheirGuttersLieApart) {
  const std::vector<Chart> charts = rooms(12);
  for (const int size : {256, 512, 1024}) {
    const Layout layout = lay_out(charts, {.size = size});
    EXPECT_EQ(layout.width, size);
    EXPECT_LE(layout.height, size);
    std::vector<glm::ivec2> at, sizes;
    for (std::size_t i = 0; i < charts.size(); ++i) {
      const PlacedChart& place = layout.places[i];
      at.push_back(place.first - gutter), sizes.push_back(place.count + 2 * gutter);
      // The border passes through texel centres.
      const vec2 low = place.texel(vec2(0)), high = place.texel(charts[i].size);
      EXPECT_EQ(low, vec2(place.first) + 0.5f);
      EXPECT_NEAR(high.x, static_cast<float>(place.first.x + place.count.x) - 0.5f, 1e-3f);
      EXPECT_NEAR(high.y, static_cast<float>(place.first.y + place.count.y) - 0.5f, 1e-3f);
    }
    expect_apart(at, sizes, layout.width, layout.height);
  }
}

TEST(Layout, TheDensityAskedForIsThatOfEveryChart) {
  const std::vector<Chart> charts = rooms(2);
  const Layout layout = lay_out(charts, {.density = 20.0f, .least = 1});
  EXPECT_EQ(layout.density, 20);
  for (std::size_t i = 0; i < charts.size(); ++i) {
    const vec2 texels = charts[i].size * 20.0f, steps = layout.places[i].count - 1;
    EXPECT_LE(std::abs(texels.x - steps.x), texels.x < 0.5f ? 1 : 0.501f);
    EXPECT_LE(std::abs(texels.y - steps.y), texels.y < 0.5f ? 1 : 0.501f);
  }
}

TEST(Layout, WhatDoesNotFitSaysWhatWould) {
  const std::vector<Chart> charts = rooms(12);
  const std::string message = test::message_of([&] { lay_out(charts, {.size = 256, .density = 500.0f}); });
  EXPECT_THAT(message, HasSubstr("500 texels per metre do not fit into 256 × 256 texels"));
  const std::size_t at = message.find("--texels-per-metre ");
  ASSERT_NE(at, std::string::npos);
  const float would = std::stof(message.substr(at + 19));
  EXPECT_NO_THROW(lay_out(charts, {.size = 256, .density = would}));
  EXPECT_ANY_THROW(lay_out(charts, {.size = 256, .density = 1.1f * would}));
  EXPECT_THAT(test::message_of([&] { lay_out(charts, {.size = 16}); }), HasSubstr("try --size 32"));
  EXPECT_THAT(test::message_of([&] { lay_out({}, {}); }), HasSubstr("no still surface"));
  EXPECT_THAT(test::message_of([&] { lay_out(charts, {.size = 8}); }), HasSubstr("16 to 8192"));
  EXPECT_THAT(test::message_of([&] { lay_out(charts, {.size = 1 << 20}); }), HasSubstr("16 to 8192"));
  EXPECT_THAT(test::message_of([&] { lay_out(charts, {.density = 1e30f}); }),
              HasSubstr("do not fit into 8192"));
}

TEST(Layout, ByDefaultGrowsUntilThereAreEnoughTexels) {
  EXPECT_EQ(lay_out(rooms(1)).width, 1024);
  const std::vector<Chart> hall =
      make_charts(scene_of({scene::make_box(vec3(0), vec3(100, 10, 60))}), 0).charts;
  const Layout large = lay_out(hall);
  EXPECT_EQ(large.width, 2048);
  EXPECT_GE(large.density, 8);
  const std::vector<Chart> field =
      make_charts(scene_of({scene::make_box(vec3(0), vec3(5000, 10, 5000))}), 0).charts;
  EXPECT_EQ(lay_out(field).width, 4096);
}

}  // namespace
}  // namespace ssphh::lightmap
