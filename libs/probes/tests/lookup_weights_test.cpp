/// Lookup weights against interpolation written down otherwise, and their promises everywhere.

#include <algorithm>
#include <cmath>
#include <map>

#include <gtest/gtest.h>

#include <ssphh/core/error.h>
#include <ssphh/core/random.h>
#include <ssphh/core/sphere.h>
#include <ssphh/probes/lookup_weights.h>

#include "open_space.h"

namespace ssphh::probes {
namespace {

constexpr WeightMethod all_methods[] = {WeightMethod::distance, WeightMethod::trilinear, WeightMethod::mls};

std::unique_ptr<LookupWeights> weights(const std::vector<vec3>& positions, WeightMethod method,
                                       const SeesProbe& sees = everything) {
  WeightParams params;
  params.method = method;
  return make_weights(positions, sees, params);
}

/// n³ probes, `spacing` apart.
std::vector<vec3> grid(int n, float spacing) {
  std::vector<vec3> positions;
  for (int i = 0; i < n * n * n; ++i) positions.push_back(spacing * vec3(i % n, i / n % n, i / n / n));
  return positions;
}

std::map<int, double> by_probe(const ProbeWeights& weights) {
  std::map<int, double> result;
  for (int i = 0; i < weights.count; ++i) {
    const ProbeWeight& entry = weights.entries[i];
    EXPECT_TRUE(result.emplace(entry.probe, double(entry.weight)).second) << "probe twice";
  }
  return result;
}

TEST(LookupWeights, OneSetOfThemServesEverySight) {
  const std::vector<vec3> positions = grid(3, 1);
  const rays::SurfacePoint at{vec3(0.9f, 1.2f, 0.8f), vec3(0, 1, 0)};
  for (const WeightMethod method : all_methods) {
    WeightParams params;
    params.method = method;
    const std::unique_ptr<VisibleWeights> weights_of_any = make_visible_weights(positions, params);
    for (const float wall : {0.5f, 1.5f}) {
      const SeesProbe sees = [wall](const vec3&, const vec3& probe) { return probe.x < wall; };
      EXPECT_EQ(weights_of_any->at(at, sees), weights(positions, method, sees)->at(at)) << wall;
    }
    EXPECT_EQ(weights_of_any->bytes(), weights(positions, method)->bytes());
  }
}

TEST(LookupWeights, ByProbesAloneStandInForThoseThatNeedMore) {
  const std::vector<vec3> positions = grid(3, 1);
  const rays::SurfacePoint at{vec3(0.9f, 1.2f, 0.8f), vec3(0, 1, 0)};
  for (const WeightMethod method : {WeightMethod::fitted, WeightMethod::surface}) {
    WeightParams params;
    params.method = method;
    params.fallback = WeightMethod::trilinear;
    EXPECT_EQ(make_visible_weights(positions, params)->at(at, everything),
              weights(positions, WeightMethod::trilinear)->at(at));
    params.fallback = method;
    EXPECT_EQ(make_visible_weights(positions, params)->at(at, everything),
              weights(positions, WeightMethod::mls)->at(at));
  }
}

TEST(LookupWeights, TrilinearIsTrilinearInterpolationOnAGrid) {
  constexpr float spacing = 0.7f;
  const std::vector<vec3> positions = grid(5, spacing);
  const auto lookup = weights(positions, WeightMethod::trilinear);
  Pcg32 random(3);
  std::vector<vec3> places;
  for (int i = 0; i < 400; ++i) places.push_back(4 * spacing * random.uniform3());
  // Near corners and edges of cells, where most neighbours are about as near as the far corners.
  for (const float e : {0.02f, 0.05f, 0.1f, 0.2f}) {
    places.push_back(spacing * (vec3(2) + e));
    places.push_back(spacing * (vec3(2) - e));
    places.push_back(spacing * vec3(2 + e, 2 - e, 2.5f));
    places.push_back(spacing * vec3(2 + e, 1.5f, 1.5f));
  }
  for (const vec3& x : places) {
    std::map<int, double> expected;
    const glm::dvec3 u = glm::dvec3(x) / double(spacing);
    for (int corner = 0; corner < 8; ++corner) {
      double w = 1;
      int index = 0, stride = 1;
      for (glm::length_t axis = 0; axis < 3; ++axis) {
        const double low = std::min(std::floor(u[axis]), 3.0), f = u[axis] - low;
        const bool high = corner >> axis & 1;
        w *= high ? f : 1 - f;
        index += stride * (static_cast<int>(low) + high);
        stride *= 5;
      }
      expected[index] = w;
    }
    std::map<int, double> actual = by_probe(lookup->at({x, up}));
    // A tent below 1e-4 is left out, and the rest scaled up by as little; float rounding is far less.
    for (const auto& [probe, w] : expected) EXPECT_NEAR(actual[probe], w, 1.5e-4) << probe;
    for (const auto& [probe, w] : actual) EXPECT_TRUE(expected.contains(probe)) << probe;
  }
}

/// Value at x of the weighted linear fit with the ridge of 5 % on its slopes, in doubles: weights Bᵀ-free, by
/// solving the normal equations for each probe's indicator function.
std::vector<double> mls_reference(const std::vector<vec3>& positions, const vec3& x, double spacing) {
  std::vector<std::pair<double, std::size_t>> near;
  for (std::size_t i = 0; i < positions.size(); ++i) {
    const glm::dvec3 d = glm::dvec3(positions[i]) - glm::dvec3(x);
    near.emplace_back(glm::dot(d, d), i);
  }
  std::sort(near.begin(), near.end());
  near.resize(std::min<std::size_t>(near.size(), max_weights));
  const double radius2 = 4 * spacing * spacing;
  glm::dmat4 a(0);
  double total = 0;
  std::vector<std::pair<double, glm::dvec4>> rows;
  for (const auto& [d2, i] : near) {
    if (d2 > radius2) break;
    const double t = 1 - d2 / radius2, w = t * t + 1e-6;
    const glm::dvec4 row(1, (glm::dvec3(positions[i]) - glm::dvec3(x)) / spacing);
    rows.emplace_back(w, row);
    total += w;
    a += w * glm::outerProduct(row, row);
  }
  for (glm::length_t c = 1; c < 4; ++c) a[c][c] += 0.05 * total;
  std::vector<double> result(positions.size(), 0);
  double sum = 0;
  for (std::size_t k = 0; k < rows.size(); ++k) {
    result[near[k].second] = (glm::inverse(a) * (rows[k].first * rows[k].second))[0];
    sum += result[near[k].second];
  }
  for (double& w : result) w /= sum;
  return result;
}

TEST(LookupWeights, MlsIsTheValueOfAWeightedLinearFit) {
  Pcg32 random(4);
  std::vector<vec3> scattered;
  for (int i = 0; i < 60; ++i) scattered.push_back(3.0f * random.uniform3());
  for (const std::vector<vec3>& positions : {grid(4, 0.7f), scattered}) {
    const double spacing = double(median_spacing(positions));
    const auto lookup = weights(positions, WeightMethod::mls);
    for (int i = 0; i < 100; ++i) {
      const vec3 x = 0.3f + 1.5f * random.uniform3();
      const std::vector<double> expected = mls_reference(positions, x, spacing);
      const std::map<int, double> actual = by_probe(lookup->at({x, up}));
      // Equal distances may be ordered otherwise in doubles; such probes lie at the end of the list.
      double constant = 0;
      for (const auto& [probe, w] : actual) {
        EXPECT_NEAR(w, expected[probe], 1e-4) << i << " " << probe;
        constant += w;
      }
      EXPECT_NEAR(constant, 1, 1e-5);
    }
  }
}

TEST(LookupWeights, MlsKeepsALinearFieldWhereProbesSurroundThePoint) {
  // In the middle of a cell the probes lie symmetrically: exact. Elsewhere the ridge of 5 % gives up some of
  // the slope over the distance from x to the probes' centre of weight: under 4 % of a spacing's change.
  constexpr float spacing = 0.7f;
  const std::vector<vec3> positions = grid(6, spacing);
  const auto lookup = weights(positions, WeightMethod::mls);
  const vec3 slope(0.3f, -0.8f, 0.5f);
  const auto error_at = [&](const vec3& x) {
    double value = 0;
    for (const auto& [probe, w] : by_probe(lookup->at({x, up})))
      value += w * double(2 + glm::dot(slope, positions[probe]));
    return std::abs(value - double(2 + glm::dot(slope, x)));
  };
  Pcg32 random(5);
  for (int i = 0; i < 200; ++i) {
    const vec3 x = spacing * (1.5f + 2.0f * random.uniform3());
    EXPECT_LT(error_at(x), 0.04 * double(spacing * glm::length(slope))) << i;
  }
}

TEST(LookupWeights, AConstantStaysConstantAndNothingIsNaN) {
  Pcg32 random(6);
  std::vector<vec3> scattered, plane, line, twins{vec3(0), vec3(0), vec3(0)};
  for (int i = 0; i < 40; ++i) {
    scattered.push_back(3.0f * random.uniform3());
    plane.push_back({3 * random.uniform(), 1, 3 * random.uniform()});
    line.push_back({3 * random.uniform(), 1, 2});
  }
  const SeesProbe nothing = [](const vec3&, const vec3&) { return false; };
  const SeesProbe half = [](const vec3&, const vec3& p) { return p.x < 1.2f; };
  for (const auto& positions : {scattered, plane, line, twins, grid(3, 0.5f), std::vector<vec3>{vec3(1)}}) {
    for (const WeightMethod method : all_methods) {
      for (const SeesProbe& sees : {everything, nothing, half}) {
        bool seen = false;
        const auto lookup = weights(positions, method, [&](const vec3& from, const vec3& probe) {
          return sees(from, probe) && (seen = true);
        });
        std::vector<vec3> places(positions.begin(), positions.end());
        for (int i = 0; i < 50; ++i) places.push_back(6.0f * random.uniform3() - 1.5f);
        for (const float far : {1e3f, 1e6f, -1e8f}) places.push_back(vec3(far, 1, -far));
        for (const vec3& x : places) {
          seen = false;
          const ProbeWeights at = lookup->at({x, sample_uniform_sphere(random.uniform2())});
          ASSERT_GT(at.count, 0) << name_of(method);
          double sum = 0;
          for (const auto& [probe, w] : by_probe(at)) {
            ASSERT_TRUE(std::isfinite(w)) << name_of(method);
            EXPECT_TRUE(w >= 0 || method == WeightMethod::mls);
            sum += w;
          }
          EXPECT_LE(sum, 1 + 1e-5);
          if (!seen) continue;  // less hidden ones behind the surface
          EXPECT_NEAR(sum, 1, 1e-5) << name_of(method) << " with " << positions.size() << " probes";
        }
      }
    }
  }
}

TEST(LookupWeights, HiddenProbesGetNoWeight) {
  // A wall at x = 1: a point sees the probes on its own side.
  const SeesProbe walled = [](const vec3& from, const vec3& probe) { return (from.x < 1) == (probe.x < 1); };
  const std::vector<vec3> positions = grid(5, 0.6f);
  Pcg32 random(7);
  for (const WeightMethod method : all_methods) {
    const auto lookup = weights(positions, method, walled);
    for (int i = 0; i < 300; ++i) {
      const vec3 x = 2.4f * random.uniform3();
      // Up as the normal: sight starts at the same x.
      for (const auto& [probe, w] : by_probe(lookup->at({x, up})))
        EXPECT_EQ(positions[probe].x < 1, x.x < 1) << name_of(method);
    }
  }
}

TEST(LookupWeights, ASingleProbeCountsEverywhere) {
  for (const WeightMethod method : all_methods) {
    const auto lookup = weights({vec3(1, 2, 3)}, method);
    for (const vec3& x : {vec3(1, 2, 3), vec3(0), vec3(1e4f)}) {
      const ProbeWeights at = lookup->at({x, up});
      ASSERT_EQ(at.count, 1);
      EXPECT_EQ(at.entries[0].probe, 0);
      EXPECT_EQ(at.entries[0].weight, 1);
    }
  }
  EXPECT_THROW(weights({}, WeightMethod::mls), Error);
}

TEST(LookupWeights, MedianSpacingOfGridsAndOddSets) {
  EXPECT_NEAR(median_spacing(grid(4, 0.7f)), 0.7f, 1e-6f);
  EXPECT_TRUE(std::isinf(median_spacing(std::vector<vec3>{vec3(1)})));
  EXPECT_TRUE(std::isinf(median_spacing(std::vector<vec3>{vec3(1), vec3(1)}))) << "one place has no spacing";
  // Nearest neighbours 1, 1, 2, 4, 4: the middle one.
  const std::vector<vec3> line{vec3(0), vec3(1, 0, 0), vec3(3, 0, 0), vec3(7, 0, 0), vec3(-4, 0, 0)};
  EXPECT_EQ(median_spacing(line), 2);
}

}  // namespace
}  // namespace ssphh::probes
