// Blending of octahedral maps: without a seam, of second order.

#include "texel_blend.h"

#include <gtest/gtest.h>

#include <ssphh/core/random.h>
#include <ssphh/core/sphere.h>

namespace ssphh::methods::ddgi {
namespace {

/// Blended texel values of a function of direction.
template <class F>
float blend(const F& f, const vec3& direction, int n) {
  const TexelBlend b = blend_texels(direction, n);
  float sum = 0;
  for (std::size_t k = 0; k < 4; ++k) sum += b.weight[k] * f(octahedral_texel(b.texel[k], n));
  return sum;
}

TEST(TexelBlend, BlendingHasNoSeam) {
  // Where the lower half is cut open, both sides of the cut give one value.
  const auto f = [](const vec3& d) { return d.x + 2 * d.y * d.z; };
  Pcg32 random(2);
  for (int i = 0; i < 1000; ++i) {
    const float t = 2 * random.uniform() - 1, e = 1e-5f;
    const bool along_x = i % 2 == 0;
    const vec3 edge = along_x ? vec3(t, 0, -1 + std::abs(t)) : vec3(0, t, -1 + std::abs(t));
    const vec3 aside = along_x ? vec3(0, e, 0) : vec3(e, 0, 0);
    EXPECT_NEAR(blend(f, edge + aside, 8), blend(f, edge - aside, 8), 1e-3f);
  }
}

TEST(TexelBlend, BlendingTendsToTheFunction) {
  const auto f = [](const vec3& d) { return 1 + d.x - 0.5f * d.y + d.x * d.z; };
  double error[2] = {};
  for (int k = 0; k < 2; ++k) {
    Pcg32 random(3);
    for (int i = 0; i < 2000; ++i) {
      const vec3 d = sample_uniform_sphere(random.uniform2());
      error[k] += static_cast<double>(std::abs(blend(f, d, k == 0 ? 8 : 16) - f(d))) / 2000;
    }
  }
  EXPECT_LT(error[0], 0.05);
  // Bilinear blending is of second order.
  EXPECT_LT(error[1], error[0] / 3);
}

TEST(TexelBlend, NeighboursAcrossEdgesAreNear) {
  for (const int n : {8, 16}) {
    for (int i = 0; i < 4 * n; ++i) {
      // Directions just outside of each texel's centre toward the map's edge.
      const float at = (static_cast<float>(i % n) + 0.5f) / static_cast<float>(n), e = 1e-4f;
      const vec2 place = i < n       ? vec2(at, e)
                         : i < 2 * n ? vec2(at, 1 - e)
                         : i < 3 * n ? vec2(e, at)
                                     : vec2(1 - e, at);
      const vec3 d = octahedral_direction(2.0f * place - 1.0f);
      const TexelBlend b = blend_texels(d, n);
      for (std::size_t k = 0; k < 4; ++k) {
        ASSERT_GE(b.texel[k], 0);
        ASSERT_LT(b.texel[k], n * n);
        EXPECT_LT(glm::distance(octahedral_texel(b.texel[k], n), d), 6.0f / static_cast<float>(n));
      }
    }
  }
}

}  // namespace
}  // namespace ssphh::methods::ddgi
