// The octahedral map: there and back, and across its edges.

#include <gtest/gtest.h>

#include <ssphh/core/octahedral.h>
#include <ssphh/core/random.h>
#include <ssphh/core/sphere.h>

namespace ssphh {
namespace {

TEST(Octahedral, ThereAndBack) {
  Pcg32 random(1);
  for (int i = 0; i < 1000; ++i) {
    const vec3 d = sample_uniform_sphere(random.uniform2());
    EXPECT_LT(glm::distance(octahedral_direction(octahedral_place(d)), d), 1e-6f);
  }
  EXPECT_EQ(octahedral_place({0, 0, 2}), vec2(0));
  EXPECT_EQ(octahedral_place({3, 0, 0}), vec2(1, 0));
  EXPECT_EQ(octahedral_place({0, -1, 0}), vec2(0, -1));
}

TEST(Octahedral, PlacesOutsideAreThoseAcrossTheEdge) {
  for (const float along : {-0.9f, -0.3f, 0.2f, 0.7f}) {
    for (const float side : {-1.0f, 1.0f}) {
      const float outside = 1e-3f * side;
      EXPECT_LT(glm::distance(octahedral_direction({side + outside, along}),
                              octahedral_direction({side - outside, -along})),
                1e-6f);
      EXPECT_LT(glm::distance(octahedral_direction({along, side + outside}),
                              octahedral_direction({-along, side - outside})),
                1e-6f);
    }
  }
}

TEST(Octahedral, TexelsAreRowByRow) {
  EXPECT_LT(glm::distance(octahedral_texel(5, 4), glm::normalize(vec3(-1, -1, 2))), 1e-6f);
  EXPECT_LT(glm::distance(octahedral_texel(6, 4), glm::normalize(vec3(1, -1, 2))), 1e-6f);
  EXPECT_LT(glm::distance(octahedral_texel(15, 4), glm::normalize(vec3(1, 1, -2))), 1e-6f);
}

}  // namespace
}  // namespace ssphh
