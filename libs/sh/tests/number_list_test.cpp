/// Numbers on which no closed form has a say but which results follow: how finely a table is divided, how far
/// a search goes, which random points are drawn.

#include "number_list.h"

#include <gtest/gtest.h>

#include <ssphh/sh/project.h>
#include <ssphh/sh/triple_product.h>
#include <ssphh/sh/window.h>
#include <ssphh/sh/zonal.h>

#include "known_vectors.h"
#include "random_sh.h"

namespace ssphh::sh {
namespace {

using test::NumberList;

TEST(NumberList, OfLobesAndWindowsIsWhatItWas) {
  NumberList list;
  for (const float roughness : {0.003f, 0.013f, 0.1f, 0.317f, 0.62f, 0.995f})
    list.add(fmt::format("glossy {:g}:", roughness), glossy_band_scales(roughness));
  list.add("glossy lookup:", eval_glossy(test::random_sh(7, 3), glm::normalize(vec3(1, -2, 0.5f)), 0.41f));
  for (int degree = 1; degree <= max_degree; degree += 3) {
    const RadianceSh f = test::random_sh(degree, static_cast<std::uint64_t>(degree));
    list.add(fmt::format("minimum {}:", degree), minimum(f));
    for (const NonNegative goal : {NonNegative::irradiance, NonNegative::radiance}) {
      RadianceSh lifted = f;
      lifted[0] = glm::abs(lifted[0]) + 0.7f;
      const AutoWindow window = choose_window(lifted, goal);
      list.add(" window:", 1 / window.width, window.reached);
    }
  }
  for (const NonNegative goal : {NonNegative::irradiance, NonNegative::radiance})
    list.add("grace:", 1 / choose_window(test::grace_cathedral(), goal).width);
  list.expect("libs/sh/tests/expected/lobes.txt");
}

TEST(NumberList, OfPointsAndCountsIsWhatItWas) {
  NumberList list;
  const SphereQuadrature points = stratified_sphere_samples(3, 5);
  for (std::size_t i = 0; i < points.directions.size(); ++i)
    list.add("stratified:", points.directions[i], points.weights[i]);
  for (const int size : {1, 2, 7, 16, 17, 64})
    for (const int degree : {0, 3, 10})
      list.add(fmt::format("size {} degree {}:", size, degree),
               CubeProjector(degree, size).executed_fma_count());
  for (const auto& [i, j, k] : {std::array{1, 1, 2}, {4, 5, 9}, {3, 2, 1}, {0, 4, 4}, {10, 2, 8}})
    list.add(fmt::format("products {} {} {}:", i, j, k), TripleProductTensor(i, j, k).entries().size());
  list.expect("libs/sh/tests/expected/points.txt");
}

/// Sums are kept in single precision for so many blocks only: long ones lose no more than short ones.
TEST(NumberList, AMillionSamplesKeepTheirSum) {
  const std::size_t count = 1 << 20;
  const std::vector<vec3> directions(count, vec3(0, 0, 1)), radiance(count, vec3(1, 3, 0.1f));
  const std::vector<float> weights(count, 0.1f);
  const RadianceSh sum = project(1, directions, weights, radiance);
  // A rounding of each of 512 additions to a lane at most, which mostly cancel: half of that was seen.
  const double expected = 0.28209479177387814 * count * static_cast<double>(0.1f);
  EXPECT_NEAR(static_cast<double>(sum[0].x) / expected, 1, 3e-5);
}

}  // namespace
}  // namespace ssphh::sh
