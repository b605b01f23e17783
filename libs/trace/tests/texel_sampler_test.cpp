#include "texel_sampler.h"

#include <ssphh/core/random.h>
#include <ssphh/core/sphere.h>

#include "z_test.h"

namespace ssphh::test {
namespace {

TEST(TexelSampler, SolidAngleIsTheExactOne) {
  for (const int size : {1, 3, 64, 1024}) {
    for (const int x : {0, size / 2, size - 1}) {
      // acos near a right angle keeps 1e-16 absolute.
      EXPECT_NEAR(trace::TexelSampler(2, x, size - 1, size).solid_angle(),
                  texel_solid_angle(x, size - 1, size), 1e-14);
    }
  }
}

TEST(TexelSampler, DirectionsStayInTheirTexel) {
  const int size = 7;
  Pcg32 random(3);
  for (int i = 0; i < 2000; ++i) {
    const int face = i % 6, x = (i / 6) % size, y = (i / 42) % size;
    const CubePoint p = cube_point(trace::TexelSampler(face, x, y, size).direction(random.uniform2()));
    ASSERT_EQ(p.face, face);
    // A millionth of a face is what float directions resolve.
    EXPECT_GE(p.s * size, static_cast<float>(x) - 1e-5f);
    EXPECT_LE(p.s * size, static_cast<float>(x + 1) + 1e-5f);
    EXPECT_GE(p.t * size, static_cast<float>(y) - 1e-5f);
    EXPECT_LE(p.t * size, static_cast<float>(y + 1) + 1e-5f);
  }
}

TEST(TexelSampler, DirectionsAreUniformInSolidAngle) {
  // Share of the samples in each quarter of a whole face and of an off-centre texel = share of its solid
  // angle.
  for (const int size : {1, 4}) {
    const trace::TexelSampler texel(4, size - 1, 0, size);
    const int fine = 2 * size;
    Samples inside[2][2];
    Pcg32 random(17);
    for (int i = 0; i < 40000; ++i) {
      const CubePoint p = cube_point(texel.direction(random.uniform2()));
      const int x = std::min(static_cast<int>(p.s * static_cast<float>(fine)), fine - 1) - (fine - 2);
      const int y = std::min(static_cast<int>(p.t * static_cast<float>(fine)), fine - 1);
      for (int a = 0; a < 2; ++a) {
        for (int b = 0; b < 2; ++b) inside[a][b].add(a == x && b == y ? 1 : 0);
      }
    }
    for (int a = 0; a < 2; ++a) {
      for (int b = 0; b < 2; ++b) {
        const double share = texel_solid_angle(fine - 2 + a, b, fine) / texel_solid_angle(size - 1, 0, size);
        EXPECT_TRUE(mean_is(inside[a][b], share, {1e-3, 8})) << size << " " << a << b;
      }
    }
  }
}

}  // namespace
}  // namespace ssphh::test
