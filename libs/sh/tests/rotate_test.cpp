#include <gtest/gtest.h>

#include <ssphh/sh/evaluate.h>
#include <ssphh/sh/project.h>
#include <ssphh/sh/reconstruct.h>
#include <ssphh/sh/rotate.h>

#include "random_sh.h"

namespace ssphh::sh {
namespace {

using test::largest_difference;
using test::random_sh;

glm::dquat random_rotation(std::uint64_t seed) {
  Pcg32 random(seed);
  const glm::dvec3 axis = test::random_direction(random);
  return glm::angleAxis(2 * pi_d * static_cast<double>(random.uniform()), axis);
}

TEST(Rotation, EqualsReprojectionOfTheTurnedFunction) {
  for (std::uint64_t seed = 0; seed < 5; ++seed) {
    const RadianceSh sh = random_sh(max_degree, seed);
    const glm::dmat3 matrix = glm::mat3_cast(random_rotation(seed));
    const RadianceSh turned = Rotation(max_degree, matrix).apply(sh);
    const RadianceSh truth = project(max_degree, sphere_quadrature(2 * max_degree), [&](const vec3& d) {
      return eval(sh, vec3(glm::transpose(matrix) * glm::dvec3(d)));
    });
    // Single-precision evaluation of 121 terms of size ~1 with directions rounded to 6e-8 (slope up to ~10
    // per band).
    EXPECT_LT(largest_difference(turned, truth), 5e-5f) << seed;
  }
}

// In double precision and element by element: R Y_ln = Σ_m element(l, m, n) Y_lm.
TEST(Rotation, TurnsEveryBasisFunction) {
  const glm::dmat3 matrix = glm::mat3_cast(random_rotation(17));
  const Rotation rotation(max_degree, matrix);
  Pcg32 random(3);
  std::array<double, max_coefficient_count> at{}, from{};
  for (int i = 0; i < 20; ++i) {
    const glm::dvec3 d = test::random_direction(random);
    eval_basis(max_degree, d, at);
    eval_basis(max_degree, glm::transpose(matrix) * d, from);
    for (int l = 0; l <= max_degree; ++l) {
      for (int n = -l; n <= l; ++n) {
        double sum = 0;
        for (int m = -l; m <= l; ++m) {
          sum += rotation.element(l, m, n) * at[coefficient_index(l, m)];
        }
        // Rounding of ten steps of the recursion.
        ASSERT_NEAR(sum, from[coefficient_index(l, n)], 1e-12) << l << ' ' << n;
      }
    }
  }
}

TEST(Rotation, MovesALobeFromDToRd) {
  RadianceSh sh(1);
  sh[3] = vec3(1);  // toward +x
  const RadianceSh turned = Rotation::about_axis(1, vec3(0, 0, 2), pi_d / 2).apply(sh);
  EXPECT_LT(largest_difference(turned[1], vec3(1)), 1e-6f);  // toward +y
  EXPECT_LT(largest_difference(turned[3], vec3(0)), 1e-6f);
}

TEST(Rotation, Composes) {
  const glm::dquat a = random_rotation(1), b = random_rotation(2);
  const Rotation first(max_degree, glm::mat3_cast(a)), second(max_degree, glm::mat3_cast(b));
  const Rotation both(max_degree, glm::mat3_cast(b * a));
  for (int l = 0; l <= max_degree; ++l) {
    for (int m = -l; m <= l; ++m) {
      for (int n = -l; n <= l; ++n) {
        double sum = 0;
        for (int k = -l; k <= l; ++k) sum += second.element(l, m, k) * first.element(l, k, n);
        ASSERT_NEAR(sum, both.element(l, m, n), 1e-12) << l;
      }
    }
  }
}

TEST(Rotation, IsOrthogonalAndIdentityForNoTurn) {
  const Rotation turned(max_degree, glm::mat3_cast(random_rotation(5)));
  const Rotation none(max_degree, quat(1, 0, 0, 0));
  for (int l = 0; l <= max_degree; ++l) {
    for (int a = -l; a <= l; ++a) {
      for (int b = -l; b <= l; ++b) {
        double dot = 0;
        for (int k = -l; k <= l; ++k) dot += turned.element(l, a, k) * turned.element(l, b, k);
        ASSERT_NEAR(dot, a == b ? 1 : 0, 1e-12);
        ASSERT_NEAR(none.element(l, a, b), a == b ? 1 : 0, 1e-14);
      }
    }
  }
}

TEST(Rotation, AllowsMirroring) {
  glm::dmat3 mirror(1);
  mirror[0][0] = -1;  // x ↦ −x
  const RadianceSh sh = random_sh(max_degree, 9);
  const RadianceSh mirrored = Rotation(max_degree, mirror).apply(sh);
  Pcg32 random(1);
  for (int i = 0; i < 20; ++i) {
    const vec3 d = vec3(test::random_direction(random));
    // Single-precision evaluation of 121 terms of size ~1.
    EXPECT_LT(largest_difference(eval(mirrored, d), eval(sh, vec3(-d.x, d.y, d.z))), 1e-4f);
  }
}

TEST(Rotation, ThereAndBackGivesTheSameFunction) {
  const RadianceSh sh = random_sh(max_degree, 4);
  const quat q = glm::angleAxis(1.1f, glm::normalize(vec3(1, 2, 3)));
  EXPECT_LT(largest_difference(rotate(rotate(sh, q), glm::conjugate(q)), sh),
            2e-6f);  // rounded to float twice
  EXPECT_TRUE(rotate(RadianceSh(), q).empty());
}

}  // namespace
}  // namespace ssphh::sh
