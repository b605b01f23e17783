/// Products and convolutions of functions: the identities that any right product or convolution obeys.

#include <ssphh/sh/operators.h>
#include <ssphh/sh/rotate.h>
#include <ssphh/sh/triple_product.h>
#include <ssphh/sh/zonal.h>

#include "property.h"
#include "sh_generators.h"

namespace ssphh::test {
namespace {

using sh::RadianceSh;
using sh::TripleProductTensor;
using sh::ZonalSh;

constexpr double root_4pi = 3.5449077018110321;

/// Two small functions of fixed degrees, and their whole product.
const TripleProductTensor& whole_product() {
  static const TripleProductTensor tensor(3, 4, 7);
  return tensor;
}

/// Products have up to 16 · 25 terms, of which about 9 per coefficient are not 0; |Γ| < 1.
double product_rounding(const RadianceSh& f, const RadianceSh& g) {
  return 30 * rounding * size_of(f) * size_of(g);
}

ZonalSh kernel_of(std::uint64_t seed) {
  Pcg32 random(seed);
  ZonalSh kernel(sh::max_degree + 1);
  for (double& z : kernel) z = 2.0 * static_cast<double>(random.uniform()) - 1;
  return kernel;
}

TEST(TripleProductProperty, FactorsCommute) {
  const TripleProductTensor swapped(4, 3, 7);
  EXPECT_TRUE(for_all(functions(3, 3), functions(4, 4))
                  .cases(25)
                  .holds([&](const RadianceSh& f, const RadianceSh& g) {
                    return at_most(apart(whole_product().product(f, g), swapped.product(g, f)),
                                   product_rounding(f, g));
                  }));
}

TEST(TripleProductProperty, IsLinearInEachFactor) {
  EXPECT_TRUE(for_all(functions(3, 3), functions(3, 3), functions(4, 4), vectors3(-2, 2))
                  .cases(25)
                  .holds([](RadianceSh a, const RadianceSh& b, const RadianceSh& g, const vec3& factor) {
                    RadianceSh separate = whole_product().product(a, g);
                    separate *= factor;
                    separate += whole_product().product(b, g);
                    a *= factor;
                    a += b;
                    return at_most(apart(whole_product().product(a, g), separate),
                                   2 * product_rounding(a, g) + product_rounding(b, g));
                  }));
}

TEST(TripleProductProperty, TheMeanOfAProductIsTheScalarProduct) {
  EXPECT_TRUE(
      for_all(functions(3, 3), functions(4, 4)).cases(25).holds([](const RadianceSh& f, const RadianceSh& g) {
        glm::dvec3 scalar(0);
        for (int k = 0; k < sh::coefficient_count(3); ++k) scalar += glm::dvec3(f[k]) * glm::dvec3(g[k]);
        const glm::dvec3 integral = root_4pi * glm::dvec3(whole_product().product(f, g)[0]);
        const glm::dvec3 off = glm::abs(integral - scalar);
        return at_most(std::max({off.x, off.y, off.z}), root_4pi * product_rounding(f, g));
      }));
}

TEST(TripleProductProperty, TurnsWithItsFactors) {
  EXPECT_TRUE(for_all(functions(3, 3), functions(4, 4), directions(), angles())
                  .cases(25)
                  .holds([](const RadianceSh& f, const RadianceSh& g, const vec3& axis, float angle) {
                    const sh::Rotation rotation(7, turn(axis, angle));
                    return at_most(apart(whole_product().product(rotation.apply(f), rotation.apply(g)),
                                         rotation.apply(whole_product().product(f, g))),
                                   3 * product_rounding(f, g));
                  }));
}

TEST(ConvolutionProperty, TurnsWithTheFunction) {
  EXPECT_TRUE(for_all(functions(), seeds(), directions(), angles())
                  .cases(30)
                  .holds([](const RadianceSh& f, std::uint64_t seed, const vec3& axis, float angle) {
                    const sh::Rotation rotation(f.degree(), turn(axis, angle));
                    const ZonalSh kernel = kernel_of(seed);
                    // The factor of band 0, √4π, is the largest.
                    return at_most(
                        apart(convolve(rotation.apply(f), kernel), rotation.apply(convolve(f, kernel))),
                        4 * rounding * root_4pi * size_of(f));
                  }));
}

TEST(ConvolutionProperty, KernelsCommuteAndTheNarrowestOneChangesNothing) {
  ZonalSh peak;
  for (int l = 0; l <= sh::max_degree; ++l) peak.push_back(std::sqrt((2 * l + 1) / (4 * pi_d)));
  EXPECT_TRUE(for_all(functions(), seeds(), seeds())
                  .cases(30)
                  .holds([&](const RadianceSh& f, std::uint64_t first, std::uint64_t second) {
                    if (convolve(f, peak) != f) return at_most(apart(convolve(f, peak), f), 0);
                    const ZonalSh a = kernel_of(first), b = kernel_of(second);
                    return at_most(apart(convolve(convolve(f, a), b), convolve(convolve(f, b), a)),
                                   8 * rounding * 4 * pi_d * size_of(f));
                  }));
}

TEST(OperatorProperty, EachIsLinearInTheSource) {
  EXPECT_TRUE(
      for_all(functions(3, 3), functions(3, 3), functions(3, 3), vectors3(-2, 2), seeds())
          .cases(25)
          .holds([](const RadianceSh& response, const RadianceSh& a, const RadianceSh& b, const vec3& factor,
                    std::uint64_t seed) {
            Pcg32 random(seed);
            sh::TransferMatrix matrix(3, 3);
            for (vec3& value : matrix.values) value = random.uniform3();
            RadianceSh mixed = a;
            mixed *= factor;
            mixed += b;
            double worst = 0;
            const auto compare = [&](const auto& operate) {
              RadianceSh whole(3), first(3), second(3);
              operate(whole, mixed), operate(first, a), operate(second, b);
              first *= factor;
              first += second;
              worst = std::max(worst, apart(whole, first));
            };
            compare([&](RadianceSh& sum, const RadianceSh& s) { add_coefficient_product(sum, response, s); });
            compare([&](RadianceSh& sum, const RadianceSh& s) { add_raw_product(sum, response, s); });
            compare([&](RadianceSh& sum, const RadianceSh& s) { add_mean_product(sum, response, s); });
            compare([&](RadianceSh& sum, const RadianceSh& s) { add_matrix_product(sum, matrix, s); });
            // 16 products of numbers up to 2 · 3.
            return at_most(worst, 16 * 6 * 3 * rounding);
          }));
}

}  // namespace
}  // namespace ssphh::test
