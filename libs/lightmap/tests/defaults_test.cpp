/// What is asked for when nobody says otherwise, every number once, and what stands in a value before
/// anything is put into it: callers, the tool's help and the pages of docs/ rely on them.

#include <gtest/gtest.h>

#include <ssphh/lightmap/encode.h>
#include <ssphh/lightmap/layout.h>
#include <ssphh/lightmap/light.h>
#include <ssphh/lightmap/texels.h>

namespace ssphh::lightmap {
namespace {

TEST(Defaults, OfAtlases) {
  const ChartParams charts;
  EXPECT_EQ(charts.uvs, UvChoice::automatic);
  EXPECT_EQ(charts.cone, 0.87f);
  EXPECT_FALSE(charts.moving);
  EXPECT_EQ(charts.crease, 0.35f);
  const LayoutParams layout;
  EXPECT_FALSE(layout.size);
  EXPECT_FALSE(layout.density);
  EXPECT_EQ(layout.least, 4);
}

TEST(Defaults, OfResults) {
  const Chart chart;
  EXPECT_EQ(chart.instance, 0u);
  EXPECT_EQ(chart.size, vec2(0));
  EXPECT_EQ(chart.halvings, 0);
  const FlatTriangle triangle;
  EXPECT_EQ(triangle.triangle, 0u);
  EXPECT_EQ(triangle.open, 0);
  const PlacedChart placed;
  EXPECT_EQ(placed.first, glm::ivec2(0));
  EXPECT_EQ(placed.count, glm::ivec2(2));
  EXPECT_EQ(placed.scale, vec2(1));
  const Layout layout;
  EXPECT_EQ(layout.width, 0);
  EXPECT_EQ(layout.height, 0);
  EXPECT_EQ(layout.density, 0);
  const Face face{};
  EXPECT_EQ(face.front, vec3(0));
  EXPECT_EQ(face.open, 0);
  EXPECT_FALSE(face.moves);
  const Texel texel;
  EXPECT_EQ(texel.index, 0u);
  EXPECT_EQ(texel.face, 0u);
  EXPECT_EQ(texel.share, vec3(1, 0, 0));
  EXPECT_EQ(texel.way, vec2(0));
  EXPECT_EQ(Texels().width, 0);
  EXPECT_EQ(Texels().height, 0);
  EXPECT_EQ(Places().hidden_count, 0u);
  EXPECT_EQ(Rgbm().scale, 1);
}

}  // namespace
}  // namespace ssphh::lightmap
