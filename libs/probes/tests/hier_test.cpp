#include <algorithm>

#include <gmock/gmock.h>

#include <ssphh/probes/hier.h>
#include <ssphh/sh/reconstruct.h>
#include <ssphh/sh/rotate.h>

#include "random_set.h"
#include "root_4pi.h"

namespace ssphh::probes {
namespace {

using test::random_set;
using testing::ElementsAre;
using testing::HasSubstr;

using test::root_4pi_d;

/// Textbook HIER in double precision over a dense table: sort all, take the first N′ above the threshold.
std::vector<glm::dvec3> dense_reference(const ProbeSet& set, const HierParams& params, std::size_t i) {
  const std::size_t n = set.probes.size();
  std::vector<const Edge*> dense(n, nullptr);
  for (const Edge& edge : set.probes[i].edges) dense[edge.from] = &edge;
  std::vector<std::size_t> ranked;
  for (std::size_t j = 0; j < n; ++j) {
    if (j != i && dense[j] && dense[j]->transfer > params.threshold) ranked.push_back(j);
  }
  std::stable_sort(ranked.begin(), ranked.end(),
                   [&](std::size_t a, std::size_t b) { return dense[a]->transfer > dense[b]->transfer; });
  if (params.neighbors >= 0)
    ranked.resize(std::min(ranked.size(), static_cast<std::size_t>(params.neighbors)));
  const auto count = static_cast<std::size_t>(sh::coefficient_count(set.degree));
  std::vector<glm::dvec3> sum(set.probes[i].self.values.begin(), set.probes[i].self.values.end());
  for (const std::size_t j : ranked) {
    const auto& s = set.probes[j].self.values;
    for (std::size_t k = 0; k < count; ++k) {
      const glm::dvec3 h(dense[j]->h.values[k]);
      if (params.op == HierOperator::coefficient) sum[k] += h * glm::dvec3(s[k]) / root_4pi_d;
      if (params.op == HierOperator::raw) sum[k] += h * glm::dvec3(s[k]);
      if (params.op == HierOperator::mean) sum[k] += h * glm::dvec3(s[0]) / root_4pi_d;
      if (params.op == HierOperator::matrix) {
        for (std::size_t m = 0; m < count; ++m) {
          sum[k] += glm::dvec3(dense[j]->matrix.values[k * count + m]) * glm::dvec3(s[m]);
        }
      }
    }
  }
  return sum;
}

void expect_near(const sh::RadianceSh& actual, const std::vector<glm::dvec3>& expected, double tolerance) {
  ASSERT_EQ(actual.values.size(), expected.size());
  for (std::size_t k = 0; k < expected.size(); ++k) {
    for (int c = 0; c < 3; ++c) EXPECT_NEAR(actual.values[k][c], expected[k][c], tolerance) << "k = " << k;
  }
}

sh::RadianceSh constant_sh(int degree, const vec3& value) {
  sh::RadianceSh f(degree);
  f[0] = value * static_cast<float>(root_4pi_d);
  return f;
}

/// Probe 0 with one neighbour.
ProbeSet pair_set(const sh::RadianceSh& h, const sh::RadianceSh& source) {
  ProbeSet set;
  set.degree = h.degree();
  set.light_groups.push_back({"lamp", vec3(1)});
  for (int i = 0; i < 2; ++i) {
    Probe& probe = set.probes.emplace_back();
    probe.groups.push_back({{}, i == 0 ? sh::RadianceSh(set.degree) : source});
  }
  Edge edge;
  edge.from = 1;
  edge.transfer = 0.5f;
  edge.h = h;
  set.probes[0].edges.push_back(edge);
  merge_groups(set);
  return set;
}

TEST(Hier, EveryOperatorAndSelectionEqualsTheDenseReference) {
  ProbeSet set = random_set(7, 7, 4, 2, true);
  set.probes[3].edges[1].transfer = set.probes[3].edges[4].transfer;  // a tie
  for (const HierOperator op :
       {HierOperator::coefficient, HierOperator::mean, HierOperator::matrix, HierOperator::raw}) {
    for (const int neighbors : {-1, 0, 1, 3, 100}) {
      for (const float threshold : {0.0f, 0.4f, 1.0f}) {
        const HierParams params{op, neighbors, threshold};
        hier(set, params);
        for (std::size_t i = 0; i < set.probes.size(); ++i) {
          // Sums of up to 6·25 products of size about 0.1: rounding stays below 1e-5.
          expect_near(set.hierarchy->sum[i], dense_reference(set, params, i), 1e-5);
        }
      }
    }
  }
}

TEST(Hier, CountsTheEdgesItUsed) {
  ProbeSet set = random_set(7, 7, 1);
  EXPECT_EQ(hier(set, {}), 42u);
  EXPECT_EQ(hier(set, {HierOperator::mean, 2, 0}), 14u);
  EXPECT_EQ(hier(set, {HierOperator::mean, 0, 0}), 0u);
  EXPECT_EQ(set.hierarchy->sum[3], set.probes[3].self);
}

TEST(Hier, StrongestNeighboursComeFirstAndTiesByIndex) {
  Probe probe;
  for (const float p : {0.2f, 0.5f, 0.2f, 0.0f, 0.9f}) {
    Edge edge;
    edge.from = static_cast<int>(probe.edges.size()) + 1;
    edge.transfer = p;
    probe.edges.push_back(edge);
  }
  EXPECT_THAT(select_neighbors(probe, {}), ElementsAre(4, 1, 0, 2));
  EXPECT_THAT(select_neighbors(probe, {HierOperator::mean, 3, 0}), ElementsAre(4, 1, 0));
  EXPECT_THAT(select_neighbors(probe, {HierOperator::mean, -1, 0.2f}), ElementsAre(4, 1));
}

TEST(Hier, CoefficientAndMeanMultiplyTwoConstantFunctionsRight) {
  // A response of constant radiance 0.25 to unit emission, times an emission of 3: 0.75 everywhere.
  ProbeSet set = pair_set(constant_sh(3, vec3(0.25f)), constant_sh(3, vec3(3, 2, 0)));
  for (const HierOperator op : {HierOperator::coefficient, HierOperator::mean}) {
    hier(set, {op, -1, 0});
    const vec3 seen = sh::eval(set.hierarchy->neighbor[0], glm::normalize(vec3(1, 2, 3)));
    // Float rounding of one product and one evaluation.
    EXPECT_NEAR(seen.x, 0.75f, 1e-6f);
    EXPECT_NEAR(seen.y, 0.5f, 1e-6f);
    EXPECT_EQ(seen.z, 0.0f);
  }
}

TEST(Hier, MeanHasRankOneItGivesTheResponseTimesANumber) {
  Pcg32 rng(3);
  const sh::RadianceSh h = test::random_sh(rng, 5);
  for (int trial = 0; trial < 3; ++trial) {
    const sh::RadianceSh s = test::random_sh(rng, 5);
    ProbeSet set = pair_set(h, s);
    hier(set, {HierOperator::mean, -1, 0});
    const vec3 factor = s[0] / static_cast<float>(root_4pi_d);
    for (int k = 0; k < sh::coefficient_count(5); ++k) {
      for (int c = 0; c < 3; ++c) EXPECT_NEAR(set.hierarchy->neighbor[0][k][c], factor[c] * h[k][c], 1e-6f);
    }
  }
}

/// Largest difference between HIER of rotated inputs and the rotated HIER, relative to the latter.
double rotation_defect(HierOperator op) {
  Pcg32 rng(11);
  const sh::RadianceSh h = test::random_sh(rng, 4), s = test::random_sh(rng, 4);
  const quat turn = glm::angleAxis(pi / 4, vec3(0, 1, 0));
  ProbeSet still = pair_set(h, s), turned = pair_set(sh::rotate(h, turn), sh::rotate(s, turn));
  hier(still, {op, -1, 0});
  hier(turned, {op, -1, 0});
  const sh::RadianceSh expected = sh::rotate(still.hierarchy->neighbor[0], turn);
  double difference = 0, size = 0;
  for (std::size_t k = 0; k < expected.values.size(); ++k) {
    difference = std::max(difference,
                          double(glm::length(turned.hierarchy->neighbor[0].values[k] - expected.values[k])));
    size = std::max(size, double(glm::length(expected.values[k])));
  }
  return difference / size;
}

TEST(Hier, MeanCommutesWithRotation) {
  EXPECT_LT(rotation_defect(HierOperator::mean), 1e-5);  // rounding of two rotations in float
}

TEST(Hier, CoefficientDoesNotCommuteWithRotation) {
  // The paper's operator depends on the axes: turning the scene by 45° changes its answer by its own size.
  EXPECT_GT(rotation_defect(HierOperator::coefficient), 0.2);
}

TEST(Hier, CoefficientTurnsTwoLobesTowardMinusZIntoOneTowardPlusZ) {
  sh::RadianceSh lobe(1);
  lobe[sh::coefficient_index(1, 0)] = vec3(-1);
  ProbeSet set = pair_set(lobe, lobe);
  hier(set, {});
  EXPECT_GT(set.hierarchy->neighbor[0][sh::coefficient_index(1, 0)].x, 0);
}

TEST(Hier, MatrixWithoutMatricesAndBadParametersAreErrors) {
  ProbeSet set = random_set(1, 3, 1);
  try {
    hier(set, {HierOperator::matrix, -1, 0});
    FAIL() << "no error";
  } catch (const Error& e) {
    EXPECT_THAT(e.what(), HasSubstr("--viz-transfer"));
  }
  EXPECT_THROW(hier(set, {HierOperator::mean, -2, 0}), Error);
  EXPECT_THROW(hier(set, {HierOperator::mean, -1, -0.5f}), Error);
  EXPECT_THROW(hier(set, {HierOperator::mean, -1, std::numeric_limits<float>::infinity()}), Error);
  EXPECT_THROW(hier(set, {HierOperator::mean, -1, std::numeric_limits<float>::quiet_NaN()}), Error);
}

TEST(Hier, ManyProbesOnManyThreadsEqualTheDenseReference) {
  ProbeSet set = random_set(5, 70, 1, 1);
  const HierParams params{HierOperator::coefficient, 8, 0.1f};
  hier(set, params);
  for (const std::size_t i : {0u, 31u, 32u, 69u}) {
    expect_near(set.hierarchy->sum[i], dense_reference(set, params, i), 1e-5);
  }
}

TEST(Hier, ContractionOfTwoProbesIsTheGeometricMeanOfTheirResponses) {
  // A = (0 a; b 0) has the eigenvalues +-sqrt(ab).
  ProbeSet set = random_set(3, 2, 1);
  set.probes[0].edges[0].h = sh::RadianceSh(1);
  set.probes[0].edges[0].h[0] = vec3(0.1f, 0.3f, 0.2f) * static_cast<float>(root_4pi_d);
  set.probes[1].edges[0].h = sh::RadianceSh(1);
  set.probes[1].edges[0].h[0] = vec3(0.3f, 0.2f, 0.1f) * static_cast<float>(root_4pi_d);
  const auto bounds = hier_contraction(set, {HierOperator::mean});
  ASSERT_TRUE(bounds);
  EXPECT_LE(bounds->lower, 0.3 + 1e-6);
  EXPECT_NEAR(bounds->upper, 0.3, 1e-6);
  // Without one of the edges nothing comes back, however often.
  set.probes[1].edges.clear();
  EXPECT_EQ(hier_contraction(set, {HierOperator::mean})->lower, 0);
  EXPECT_FALSE(hier_contraction(set, {HierOperator::coefficient}));
  EXPECT_FALSE(hier_contraction(set, {HierOperator::matrix}));
}

TEST(Relight, ScalingAGroupIsASumOverGroups) {
  ProbeSet set = random_set(2, 3, 2, 2);
  hier(set, {});
  relight(set, "lamp 1", {2, 0, 1});
  EXPECT_FALSE(set.hierarchy.has_value()) << "a hierarchy of the old light must not survive";
  const auto& groups = set.probes[1].groups;
  for (int k = 0; k < 9; ++k) {
    const vec3 expected = set.light_groups[0].scale * groups[0].reflected[k] +
                          vec3(2, 0, 1) * (groups[1].reflected[k] + groups[1].emitted[k]);
    for (int c = 0; c < 3; ++c) EXPECT_NEAR(set.probes[1].self[k][c], expected[c], 1e-6f);
  }
}

TEST(Relight, OfAProbeWithMoreGroupsThanTheSetLeavesItAsItWas) {
  ProbeSet set = random_set(2, 3, 2, 2);
  hier(set, {});
  const vec3 before = set.light_groups[0].scale;
  set.probes[1].groups.emplace_back();
  EXPECT_THROW(relight(set, "lamp 0", before + 1.0f), Error);
  EXPECT_EQ(set.light_groups[0].scale, before);
  EXPECT_TRUE(set.hierarchy.has_value());
}

TEST(Relight, UnknownGroupListsTheKnownOnes) {
  ProbeSet set = random_set(2, 1, 0, 2);
  try {
    relight(set, "lampe", vec3(1));
    FAIL() << "no error";
  } catch (const Error& e) {
    EXPECT_THAT(e.what(), HasSubstr("\"lamp 0\", \"lamp 1\""));
  }
  EXPECT_THROW(relight(set, "lamp 0", {-1, 0, 0}), Error);
  EXPECT_THROW(relight(set, "lamp 0", vec3(std::numeric_limits<float>::infinity())), Error);
}

}  // namespace
}  // namespace ssphh::probes
