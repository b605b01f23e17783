#include <algorithm>

#include <gtest/gtest.h>

#include <ssphh/core/random.h>
#include <ssphh/study/converged_truth.h>
#include <ssphh/study/lookup_error.h>

#include "dark_space.h"

namespace ssphh::study {
namespace {

/// Paths that bring 1, 2 and 3 W/m² of the channels on the mean, each with this relative deviation.
class NoisySource final : public test::DarkSpace {
 public:
  explicit NoisySource(double of_a_path, float scale = 1, std::size_t lit = ~std::size_t{0})
      : of_a_path_(of_a_path), scale_(scale), lit_(lit) {}
  mutable std::vector<rays::PathParams> asked;

  std::vector<rays::IrradianceEstimate> surface_irradiance(std::span<const rays::SurfacePoint> points,
                                                           const rays::PathParams& path,
                                                           const Control&) const override {
    asked.push_back(path);
    const double deviation = of_a_path_ / std::sqrt(path.passes * path.spp);
    std::vector<rays::IrradianceEstimate> estimates;
    for (std::size_t i = 0; i < points.size(); ++i) {
      Pcg32 random(path.seed, i);
      float normal = -6;  // of deviation 1, near enough
      for (int k = 0; k < 12; ++k) normal += random.uniform();
      const vec3 mean = (i < lit_ ? scale_ : 0) * vec3(1, 2, 3), by = static_cast<float>(deviation) * mean;
      estimates.push_back({2.0f * mean, mean + normal * by, by * by, by * vec3(by.y, by.z, by.x)});
    }
    return estimates;
  }

 private:
  double of_a_path_;
  float scale_;
  std::size_t lit_;  ///< points, the first ones; nothing arrives at the others
};

std::vector<rays::SurfacePoint> points(std::size_t count) {
  return std::vector<rays::SurfacePoint>(count, {vec3(0), {0, 0, 1}});
}

TEST(ConvergedTruth, DoublesItsPathsUntilTheNoiseIsSmall) {
  // √(2/π) 3.2 / √n ≤ 0.05 · (1 + ε): 2607 paths or a few less, for relative_floor lies under the fraction.
  const NoisySource source(3.2);
  const rays::PathParams path{7, 1, 16, 5};
  const ConvergedTruth truth = converged_truth(source, points(400), path, 0.05);
  EXPECT_EQ(truth.spp, 4096);
  const std::vector<int> rounds{16, 16, 32, 64, 128, 256, 512, 1024, 2048};
  ASSERT_EQ(source.asked.size(), rounds.size());
  std::vector<std::uint64_t> seeds;
  for (std::size_t i = 0; i < rounds.size(); ++i) {
    EXPECT_EQ(source.asked[i].spp * source.asked[i].passes, rounds[i]);
    EXPECT_EQ(source.asked[i].max_depth, 7);
    seeds.push_back(source.asked[i].seed);
  }
  std::ranges::sort(seeds);
  EXPECT_EQ(std::ranges::adjacent_find(seeds), seeds.end()) << "two rounds of the same paths";
}

TEST(ConvergedTruth, IsTheMeanOfAllPathsWithTheVarianceOfIt) {
  const NoisySource source(3.2);
  const ConvergedTruth truth = converged_truth(source, points(400), {7, 1, 16, 5}, 0.05);
  const double deviation = 3.2 / std::sqrt(4096.0);
  double square = 0;
  for (const rays::IrradianceEstimate& e : truth.estimates) {
    EXPECT_EQ(e.direct, vec3(2, 4, 6));
    for (int c = 0; c < 3; ++c) {
      const double mean = 1 + c, z = (static_cast<double>(e.indirect[c]) - mean) / (deviation * mean);
      EXPECT_NEAR(static_cast<double>(e.indirect_variance[c]), std::pow(deviation * mean, 2), 1e-6);
      EXPECT_NEAR(static_cast<double>(e.indirect_covariance[c]),
                  deviation * deviation * mean * (1 + (c + 1) % 3), 1e-6);
      if (c == 0) square += z * z;
    }
  }
  // χ² of 400: within 4.5 of its deviations, a false alarm in 10⁵.
  EXPECT_NEAR(square, 400, 4.5 * std::sqrt(800.0));
}

TEST(ConvergedTruth, OfOnePointAmongDarkOnesIsAsExactAsThatPointAsks) {
  // 3.2 / √n ≤ 0.05 / 3: 36,864 paths. Its mean with 399 that are dark is under 0.05 from the first.
  EXPECT_EQ(converged_truth(NoisySource(3.2, 1, 1), points(400), {7, 1, 16, 5}, 0.05).spp, 1 << 15)
      << "16.8 million in all";
  EXPECT_EQ(converged_truth(NoisySource(1.6, 1, 1), points(400), {7, 1, 16, 5}, 0.05).spp, 1 << 14)
      << "9216 or a few less";
}

TEST(ConvergedTruth, StopsAtItsLimitsAndWhereNoNoiseIsAskedFor) {
  const NoisySource source(1);
  EXPECT_EQ(converged_truth(source, points(3), {7, 2, 16, 5}, 0).spp, 32);
  ASSERT_EQ(source.asked.size(), 1u);
  EXPECT_EQ(source.asked[0].passes, 2);
  EXPECT_EQ(converged_truth(source, points(3), {7, 2, 16, 5}, 1e-4).spp, most_truth_spp);
  EXPECT_EQ(converged_truth(source, points(1 << 13), {7, 1, 16, 5}, 1e-4).spp, 1 << 11)
      << "paths of all points together";
  EXPECT_EQ(converged_truth(source, points(3), {7, 1, 3 * most_truth_spp, 5}, 1e-4).spp, 3 * most_truth_spp)
      << "what is asked for is traced";
}

TEST(ConvergedTruth, TakesWhatIsDarkOrWithoutNoiseAsItIs) {
  EXPECT_EQ(converged_truth(NoisySource(3.2, 0), points(3), {7, 1, 16, 5}, 0.01).spp, 16);
  EXPECT_EQ(converged_truth(NoisySource(0), points(3), {7, 1, 16, 5}, 0.01).spp, 16);
}

}  // namespace
}  // namespace ssphh::study
