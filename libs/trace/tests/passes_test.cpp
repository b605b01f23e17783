/// Many passes of one sample are one pass of as many: every image of a render, also where rays miss.

#include <gtest/gtest.h>

#include "hand_made.h"

namespace ssphh::test {
namespace {

/// A pixel of 4 m: half of it a near quad, a quarter one that lies deeper, the last quarter nothing.
trace::RenderState pixel(int passes, int spp) {
  scene::Scene scene;
  add_object(scene, scene::make_quad(vec3(-2, 2, 2), vec3(2, 0, 0), vec3(0, 0, -4)),
             lambertian(vec3(0.2f, 0.4f, 0.6f)));
  add_object(scene, scene::make_quad(vec3(0, 0, 2), vec3(1, 0, 0), vec3(0, 0, -4)),
             lambertian(vec3(0.8f, 0.1f, 0.3f)));
  add_constant_sky(scene, vec3(1, 2, 3));
  trace::RenderParams params = view_down(vec3(0), 4, 1, 3);
  params.path = {1, passes, spp, 5};
  return render(scene, params);
}

TEST(Passes, OfOneSampleEachGiveThePictureOfOnePass) {
  constexpr int count = 600;
  const trace::RenderState one = pixel(1, count), many = pixel(count, 1);
  const auto expect_equal = [&](const image::Image& a, const image::Image& b, const char* name) {
    ASSERT_EQ(a.pixels.size(), b.pixels.size());
    // Rounding of 600 additions.
    for (std::size_t i = 0; i < a.pixels.size(); ++i)
      EXPECT_NEAR(trace::resolve(b, count).pixels[i], a.pixels[i], 2e-4f) << name << " " << i;
  };
  expect_equal(one.color, many.color, "color");
  expect_equal(one.direct, many.direct, "direct");
  expect_equal(one.albedo, many.albedo, "albedo");
  expect_equal(one.normal, many.normal, "normal");
  expect_equal(one.depth, many.depth, "depth");
  expect_equal(one.coverage, many.coverage, "coverage");
  // Means over the samples that hit: (½ · 1 m + ¼ · 3 m) / ¾. Stratified samples: better than 1/√600.
  EXPECT_NEAR(one.coverage.pixels[0], 0.75f, 0.02f);
  EXPECT_NEAR(one.depth.pixels[0], 5.0f / 3, 0.04f);
}

}  // namespace
}  // namespace ssphh::test
