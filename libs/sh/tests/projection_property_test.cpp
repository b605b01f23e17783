#include <ssphh/sh/project.h>
#include <ssphh/sh/reconstruct.h>

#include "property.h"
#include "sh_generators.h"

namespace ssphh::test {
namespace {

using sh::RadianceSh;

/// A cube map of independent noise in every texel.
struct NoiseCube {
  NoiseCube(int size, std::uint64_t seed) {
    Pcg32 random(seed);
    for (std::vector<float>& face : texels) {
      face.resize(static_cast<std::size_t>(3 * size * size));
      for (float& value : face) value = random.uniform();
    }
  }
  sh::CubeFaces faces() const { return {texels[0], texels[1], texels[2], texels[3], texels[4], texels[5]}; }

  std::vector<float> texels[6];
};

TEST(ProjectionProperty, OfAMixedCubeMapIsTheMixedProjections) {
  EXPECT_TRUE(for_all(integers(0, sh::max_degree), integers(1, 17), seeds(), seeds(), floats(-3, 3))
                  .cases(30)
                  .holds([](int degree, int size, std::uint64_t first, std::uint64_t second, float factor) {
                    const NoiseCube a(size, first), b(size, second);
                    NoiseCube mixed = a;
                    for (std::size_t f = 0; f < 6; ++f) {
                      for (std::size_t i = 0; i < a.texels[f].size(); ++i)
                        mixed.texels[f][i] += factor * b.texels[f][i];
                    }
                    RadianceSh separate = sh::project_cube(degree, size, b.faces());
                    separate *= vec3(factor);
                    separate += sh::project_cube(degree, size, a.faces());
                    // ∫|Y_k| ≤ √4π of texels up to 4, summed in single-precision lanes.
                    return at_most(apart(sh::project_cube(degree, size, mixed.faces()), separate),
                                   16 * rounding * 4 * 3.545);
                  }));
}

TEST(ProjectionProperty, LowDegreesArePrefixesOfHighOnesForEverySize) {
  EXPECT_TRUE(for_all(integers(0, sh::max_degree), integers(1, 17), seeds())
                  .cases(30)
                  .holds([](int degree, int size, std::uint64_t seed) {
                    const NoiseCube cube(size, seed);
                    return sh::project_cube(degree, size, cube.faces()) ==
                           truncated(sh::project_cube(sh::max_degree, size, cube.faces()), degree);
                  }));
}

TEST(ProjectionProperty, SamplesMaySwapPlacesAndSplitInTwo) {
  EXPECT_TRUE(for_all(integers(1, 40), integers(0, sh::max_degree), seeds())
                  .cases(30)
                  .holds([](int count, int degree, std::uint64_t seed) {
                    Pcg32 random(seed);
                    std::vector<vec3> directions, radiance;
                    std::vector<double> weights;
                    for (int i = 0; i < count; ++i) {
                      directions.push_back(vec3(random_direction(random)));
                      radiance.push_back(random.uniform3());
                      weights.push_back(static_cast<double>(random.uniform()));
                    }
                    const RadianceSh whole = sh::project(degree, directions, weights, radiance);
                    std::vector<vec3> other_directions(directions.rbegin(), directions.rend()),
                        other_radiance(radiance.rbegin(), radiance.rend());
                    std::vector<double> other_weights(weights.rbegin(), weights.rend());
                    other_directions.push_back(directions.front());
                    other_radiance.push_back(radiance.front());
                    other_weights.back() *= 0.25;
                    other_weights.push_back(3 * other_weights.back());
                    // |Y| ≤ √(21/4π) < 1.3 in band 10: sums of `count` terms below that, in float.
                    return at_most(
                        apart(sh::project(degree, other_directions, other_weights, other_radiance), whole),
                        count * 1.3 * 2 * rounding);
                  }));
}

TEST(ProjectionProperty, QuadratureFindsEveryFunctionAgain) {
  EXPECT_TRUE(
      for_all(functions(), integers(0, sh::max_degree)).cases(24).holds([](const RadianceSh& f, int degree) {
        const RadianceSh found = project(degree, sh::sphere_quadrature(f.degree() + degree),
                                         [&](const vec3& d) { return eval(f, d); });
        const int common = std::min(degree, f.degree());
        RadianceSh expected(degree);
        std::copy_n(f.values.begin(), sh::coefficient_count(common), expected.values.begin());
        // Single-precision evaluation of up to 121 terms of size ~1.
        return at_most(apart(found, expected), 2e-6 * (1 + size_of(f)));
      }));
}

}  // namespace
}  // namespace ssphh::test
