/// What is asked for when nobody says otherwise, every number once, and what stands in a value before
/// anything is put into it: callers, the tool's help and the pages of docs/ rely on them.

#include <gtest/gtest.h>

#include <ssphh/probes/hier.h>
#include <ssphh/probes/lookup.h>
#include <ssphh/probes/probe_limits.h>

namespace ssphh::probes {
namespace {

TEST(Defaults, OfProbeSets) {
  const ProbeSet set;
  EXPECT_EQ(set.degree, 9);
  EXPECT_EQ(set.generator, (GeneratorInfo{.op = LightOperator::path,
                                          .viz = VizMethod::none,
                                          .gen = GenMode::full,
                                          .max_depth = 3,
                                          .passes = 1,
                                          .spp = 16,
                                          .face_size = 64,
                                          .seed = 0,
                                          .directions = 0,
                                          .surfel_size = 0,
                                          .link_rays = 0,
                                          .scene = "",
                                          .scene_hash = {0, 0},
                                          .time = 0}));
  const LightGroup group;
  EXPECT_EQ(group.scale, vec3(1));
  const Probe probe;
  EXPECT_EQ(probe.position, vec3(0));
  EXPECT_EQ(probe.radius, 0.1f);
  const Edge edge;
  EXPECT_EQ(edge.from, -1);
  EXPECT_EQ(edge.transfer, 0);
  const Hierarchy hierarchy;
  EXPECT_EQ(hierarchy.op, HierOperator::coefficient);
  EXPECT_EQ(hierarchy.neighbors, -1);
  EXPECT_EQ(hierarchy.threshold, 0);
  const HierParams hier;
  EXPECT_EQ(hier, (HierParams{HierOperator::coefficient, -1, 0}));
}

TEST(Defaults, OfLookups) {
  const LookupParams lookup;
  EXPECT_FALSE(lookup.layer.has_value());
  EXPECT_EQ(lookup.light, ProbeLight::reflected);
  EXPECT_EQ(lookup.irradiance_degree, 4);
  EXPECT_TRUE(lookup.dering);
  const WeightParams& weights = lookup.weights;
  EXPECT_FALSE(weights.method.has_value());
  EXPECT_EQ(weights.fallback, WeightMethod::mls);
  EXPECT_EQ(weights.nearest, 8);
  EXPECT_EQ(weights.spacing, 0);
  EXPECT_EQ(weights.normal_offset, 0);
  EXPECT_EQ(max_weights, 16);
  EXPECT_EQ(ProbeWeights().entries.size(), 48u);
  EXPECT_EQ(most_surface_points, 24u);
}

TEST(ProbeLimits, AreThoseOfThePageOfProbeFiles) {
  EXPECT_EQ(limits::probes, 65536u);
  EXPECT_EQ(limits::light_groups, 256u);
  EXPECT_EQ(limits::text, 1024u);
  EXPECT_EQ(limits::depth, 65535);
  EXPECT_EQ(limits::samples, 16777216);
  EXPECT_EQ(limits::face_size, 4096);
  EXPECT_EQ(limits::rays, 16777216);
  EXPECT_EQ(limits::fitted_points, 262144u);
  EXPECT_EQ(limits::fitted_weight, 1e6f);
  EXPECT_EQ(limits::coordinate, 1e9f);
  EXPECT_EQ(limits::coefficient, 1e30f);
  EXPECT_EQ(limits::scale, 1e6f);
  EXPECT_EQ(limits::smallest_radius, 1e-9f);
  EXPECT_EQ(limits::json_bytes, 134217728u);
  EXPECT_EQ(limits::binary_bytes, 4294967296u);
}

}  // namespace
}  // namespace ssphh::probes
