/// What is asked for when nobody says otherwise, every number once, and what stands in a value before
/// anything is put into it: callers, the tool's help and the pages of docs/ rely on them.

#include <gtest/gtest.h>

#include <ssphh/sketch/draw.h>

namespace ssphh::sketch {
namespace {

TEST(Defaults, OfSketches) {
  const DrawParams params;
  EXPECT_EQ(params.white, 1);
  EXPECT_EQ(params.hidden, 0.25f);
  EXPECT_EQ(params.samples, 4);
  const Ray ray;
  EXPECT_EQ(ray.origin, vec3(0));
  EXPECT_EQ(ray.direction, vec3(0, 0, -1));
}

TEST(Defaults, OfWhatIsDrawn) {
  const Line line;
  EXPECT_EQ(line.a, vec3(0));
  EXPECT_EQ(line.b, vec3(0));
  EXPECT_EQ(line.color, vec3(1));
  EXPECT_EQ(line.width, 1.5f);
  const Disc disc;
  EXPECT_EQ(disc.center, vec3(0));
  EXPECT_EQ(disc.normal, vec3(0, 1, 0));
  EXPECT_EQ(disc.radius, 1);
  EXPECT_EQ(disc.color, vec3(1));
  EXPECT_FALSE(disc.light);
  const Box box;
  EXPECT_EQ(box.min, vec3(0));
  EXPECT_EQ(box.max, vec3(1));
  EXPECT_FALSE(box.light);
  const Ball ball;
  EXPECT_EQ(ball.center, vec3(0));
  EXPECT_EQ(ball.radius, 1);
  EXPECT_EQ(ball.color, vec3(1));
  const Lobe lobe;
  EXPECT_EQ(lobe.center, vec3(0));
  EXPECT_EQ(lobe.scale, 1);
  EXPECT_EQ(lobe.positive, vec3(0.0f, 0.165f, 0.45f));
  EXPECT_EQ(lobe.negative, vec3(0.85f, 0.25f, 0.0f));
}

}  // namespace
}  // namespace ssphh::sketch
