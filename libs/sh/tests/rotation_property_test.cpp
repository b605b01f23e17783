#include <ssphh/sh/irradiance.h>
#include <ssphh/sh/reconstruct.h>
#include <ssphh/sh/rotate.h>

#include "property.h"
#include "sh_generators.h"

namespace ssphh::test {
namespace {

using sh::coefficient_index;
using sh::RadianceSh;
using sh::Rotation;

TEST(RotationProperty, KeepsTheEnergyOfEveryBand) {
  EXPECT_TRUE(for_all(functions(), directions(), angles())
                  .cases(40)
                  .holds([](const RadianceSh& f, const vec3& axis, float angle) {
                    const RadianceSh turned = Rotation(f.degree(), turn(axis, angle)).apply(f);
                    double worst = 0;
                    for (int l = 0; l <= f.degree(); ++l) {
                      glm::dvec3 before(0), after(0);
                      for (int k = coefficient_index(l, -l); k <= coefficient_index(l, l); ++k) {
                        before += glm::dvec3(f[k]) * glm::dvec3(f[k]);
                        after += glm::dvec3(turned[k]) * glm::dvec3(turned[k]);
                      }
                      for (int c = 0; c < 3; ++c)
                        worst = std::max(worst, std::abs(after[c] - before[c]) / (before[c] + 1e-12));
                    }
                    // Each coefficient is rounded once; its square errs twice as much.
                    return at_most(worst, 2.1 * rounding);
                  }));
}

TEST(RotationProperty, OneAfterTheOtherIsTheirProduct) {
  EXPECT_TRUE(for_all(functions(), directions(), angles(), directions(), angles())
                  .cases(30)
                  .holds([](const RadianceSh& f, const vec3& axis, float angle, const vec3& then, float by) {
                    const glm::dmat3 first = turn(axis, angle), second = turn(then, by);
                    const int degree = f.degree();
                    const RadianceSh steps = Rotation(degree, second).apply(Rotation(degree, first).apply(f));
                    // Three roundings, each relative to the whole function.
                    return at_most(apart(steps, Rotation(degree, second * first).apply(f)),
                                   3 * rounding * size_of(f));
                  }));
}

TEST(RotationProperty, TheTransposeUndoesItMirroredOrNot) {
  EXPECT_TRUE(for_all(functions(), directions(), angles(), one_of<double>({1, -1}))
                  .cases(30)
                  .holds([](const RadianceSh& f, const vec3& axis, float angle, double sign) {
                    const glm::dmat3 matrix = sign * turn(axis, angle);
                    const RadianceSh there = Rotation(f.degree(), matrix).apply(f);
                    const RadianceSh back = Rotation(f.degree(), glm::transpose(matrix)).apply(there);
                    return at_most(apart(back, f), 2 * rounding * size_of(f));
                  }));
}

TEST(RotationProperty, CommutesWithLeavingBandsOutToTheBit) {
  EXPECT_TRUE(for_all(functions(), integers(0, sh::max_degree), directions(), angles())
                  .cases(30)
                  .holds([](const RadianceSh& f, int kept, const vec3& axis, float angle) {
                    const int degree = std::min(kept, f.degree());
                    const glm::dmat3 matrix = turn(axis, angle);
                    return truncated(Rotation(f.degree(), matrix).apply(f), degree) ==
                           Rotation(degree, matrix).apply(truncated(f, degree));
                  }));
}

TEST(RotationProperty, CommutesWithTheCosineConvolution) {
  EXPECT_TRUE(for_all(functions(), directions(), angles())
                  .cases(30)
                  .holds([](const RadianceSh& f, const vec3& axis, float angle) {
                    const Rotation rotation(f.degree(), turn(axis, angle));
                    // A_l ≤ π; two roundings each way.
                    return at_most(apart(irradiance_from_radiance(rotation.apply(f)),
                                         rotation.apply(irradiance_from_radiance(f))),
                                   4 * rounding * pi_d * size_of(f));
                  }));
}

TEST(RotationProperty, ALobeTowardDIsTheSameLobeTowardRd) {
  EXPECT_TRUE(for_all(functions(), directions(), angles(), directions())
                  .cases(60)
                  .holds([](const RadianceSh& f, const vec3& axis, float angle, const vec3& d) {
                    const glm::dmat3 matrix = turn(axis, angle);
                    const RadianceSh turned = Rotation(f.degree(), matrix).apply(f);
                    const vec3 there = vec3(glm::normalize(matrix * glm::dvec3(d)));
                    // Directions rounded to 6e-8, slopes up to 10 per radian and band: 121 terms of about 1.
                    return at_most(static_cast<double>(largest_difference(eval(turned, there), eval(f, d))),
                                   1e-5 * (1 + size_of(f)));
                  }));
}

}  // namespace
}  // namespace ssphh::test
