#include <ssphh/image/cube_layout.h>
#include <ssphh/image/resample.h>
#include <ssphh/image/sphere_map.h>

#include "property.h"
#include "test_images.h"

namespace ssphh::image {
namespace {

using namespace ssphh::test;

Generator<Layout> any_cube_layout() {
  return one_of<Layout>({Layout::strip_h, Layout::strip_v, Layout::cross_h, Layout::cross_v});
}

CubeMap noise_cube(int size, int channels, std::uint64_t seed) {
  CubeMap cube(size, channels);
  for (Image& face : cube.faces) face = test::noise_image(size, size, channels, 1, seed++);
  return cube;
}

TEST(CubeLayoutProperty, AnyWayThroughStripsAndCrossesKeepsEveryTexel) {
  EXPECT_TRUE(for_all(integers(1, 12), seeds(), lists(any_cube_layout(), 1, 5))
                  .cases(40)
                  .holds([](int size, std::uint64_t seed, const std::vector<Layout>& way) {
                    const CubeMap cube = noise_cube(size, 3, seed);
                    Image image = from_cube(cube, way.front());
                    for (std::size_t i = 1; i < way.size(); ++i)
                      image = convert_layout(image, way[i - 1], way[i]);
                    const CubeMap back = to_cube(image, way.back());
                    for (std::size_t f = 0; f < 6; ++f) {
                      if (back.faces[f].pixels != cube.faces[f].pixels) return false;
                    }
                    return layout_size(image, way.back()) == size;
                  }));
}

TEST(CubeLayoutProperty, EveryLayoutShowsATexelInItsDirection) {
  // Through the geometry rather than the arrangement: equirect and angular places of texels' directions.
  EXPECT_TRUE(for_all(directions()).cases(200).holds([](const vec3& d) {
    const vec2 uv = equirect_uv(d);
    double off = static_cast<double>(glm::distance(equirect_direction(uv.x, uv.y), d));
    const vec2 disc = angular_uv(d);
    const auto back = angular_direction(disc.x, disc.y);
    // Straight back is the rim itself, which rounding may leave.
    if (back)
      off = std::max(off, static_cast<double>(glm::distance(*back, d)));
    else if (d.z < 0.999f)
      return at_most(1, 0) << ": off the disc";
    // u and v in [0, 1] round to 6e-8, times 2π; near the poles the arc cosine loses half of the digits.
    return at_most(off, 1e-3);
  }));
}

TEST(ResizeProperty, BoxKeepsTheMeanAndStaysWithinTheOldValues) {
  EXPECT_TRUE(for_all(integers(1, 20), integers(1, 20), integers(1, 20), integers(1, 20), seeds())
                  .cases(40)
                  .holds([](int width, int height, int to_width, int to_height, std::uint64_t seed) {
                    const Image image = test::noise_image(width, height, 3, 1, seed),
                                other = resize(image, to_width, to_height, Filter::box);
                    const auto [low, high] = std::minmax_element(image.pixels.begin(), image.pixels.end());
                    glm::dvec3 before(0), after(0);
                    for (int i = 0; i < width * height; ++i)
                      before += glm::dvec3(image.rgb(i % width, i / width)) / double(width * height);
                    for (int i = 0; i < to_width * to_height; ++i) {
                      const vec3 c = other.rgb(i % to_width, i / to_width);
                      after += glm::dvec3(c) / double(to_width * to_height);
                      if (!(max_component(c) <= *high * 1.000001f && max_component(-c) <= -*low * 0.999999f))
                        return at_most(1, 0) << ": overshoots";
                    }
                    const glm::dvec3 off = glm::abs(after - before);
                    return at_most(std::max({off.x, off.y, off.z}), 1e-6);  // weights rounded to float
                  }));
}

TEST(ResizeProperty, EveryFilterCommutesWithFlipsAndKeepsConstants) {
  EXPECT_TRUE(for_all(integers(1, 16), integers(1, 16),
                      one_of<Filter>({Filter::box, Filter::bilinear, Filter::mitchell, Filter::lanczos}),
                      seeds())
                  .cases(40)
                  .holds([](int from, int to, Filter filter, std::uint64_t seed) {
                    const Image image = test::noise_image(from, 3, 3, 1, seed);
                    Image flipped(from, 3), constant(from, 3);
                    for (int y = 0; y < 3; ++y) {
                      for (int x = 0; x < from; ++x) {
                        flipped.set_rgb(x, y, image.rgb(from - 1 - x, y));
                        constant.set_rgb(x, y, {0.25f, 3, 7});
                      }
                    }
                    const Image a = resize(image, to, 5, filter), b = resize(flipped, to, 5, filter),
                                c = resize(constant, to, 5, filter);
                    float worst = 0;
                    for (int y = 0; y < 5; ++y) {
                      for (int x = 0; x < to; ++x) {
                        worst = std::max(worst, max_component(glm::abs(a.rgb(x, y) - b.rgb(to - 1 - x, y))));
                        worst = std::max(worst, max_component(glm::abs(c.rgb(x, y) - vec3(0.25f, 3, 7))) / 7);
                      }
                    }
                    return at_most(static_cast<double>(worst), 4e-6);  // weights rounded to float, 2 axes
                  }));
}

}  // namespace
}  // namespace ssphh::image
