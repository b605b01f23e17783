/// What is asked for when nobody says otherwise, every number once: callers, the tool's help and the pages of
/// docs/ rely on them.

#include <fmt/format.h>
#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <ssphh/gi/bake.h>
#include <ssphh/gi/hier.h>
#include <ssphh/gi/leak.h>
#include <ssphh/gi/lint.h>
#include <ssphh/gi/lookup.h>
#include <ssphh/gi/methods/table.h>
#include <ssphh/gi/place.h>
#include <ssphh/gi/surface_points.h>
#include <ssphh/gi/transport_bake.h>

#include "methods/ddgi/blend.h"
#include "methods/irradiance-volume/probe_grid.h"
#include "methods/vpl/photons.h"
#include "probe_limits.h"

namespace ssphh::gi {
namespace {

TEST(Defaults, OfPathTracedBakes) {
  const BakeParams bake;
  EXPECT_EQ(bake.gen, GenMode::full);
  EXPECT_EQ(bake.face_size, 64);
  EXPECT_FALSE(bake.keep_light);
  EXPECT_TRUE(bake.viz);
  EXPECT_FALSE(bake.viz_params.matrix);
  EXPECT_EQ(bake.viz_params.neighbors, -1);
  EXPECT_EQ(bake.viz_params.threshold, 0);
  const BakeReport report;
  EXPECT_EQ(report.gen_seconds + report.viz_seconds, 0);
  EXPECT_EQ(report.rays + report.resumed, 0u);
  const HierParams hier;
  EXPECT_EQ(hier, (HierParams{HierOperator::coefficient, -1, 0}));
}

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
}

TEST(Defaults, OfPlacement) {
  const PlaceParams params;
  EXPECT_EQ(params.spacing, 0);
  EXPECT_EQ(params.count, 0);
  EXPECT_EQ(params.clearance, 0.04f);
  EXPECT_EQ(params.levels, 1);
  EXPECT_EQ(params.max_probes, 4096);
  const PlacedProbe probe;
  EXPECT_EQ(probe, (PlacedProbe{"", vec3(0), 0.1f, PlaceKind::grid, 0, 0, 0}));
  EXPECT_EQ(PlacedEdge(), (PlacedEdge{0, 0, false}));
  EXPECT_EQ(PlaceCounts(), (PlaceCounts{0, 0, 0, 0, 0, 0, 0, 0, 0}));
  const Placement placement;
  EXPECT_EQ(placement.origin, vec3(0));
  EXPECT_EQ(placement.spacing, 0);
  EXPECT_EQ(placement.clearance, 0);
  EXPECT_EQ(placement.back_limit, 0);
  const ProbeGridParams grid;
  EXPECT_EQ(grid.spacing, 0);
  EXPECT_EQ(grid.places, 200);
  EXPECT_EQ(grid.most, 4096);
}

TEST(PlaceCounts, RemovedAreAllButThoseRelocated) {
  const PlaceCounts counts{.candidates = 1,
                           .relocated = 20,
                           .inside = 300,
                           .too_close = 4000,
                           .open_air = 50000,
                           .redundant = 600000,
                           .swept = 7000000,
                           .unreachable = 80000000,
                           .surplus = 900000000};
  EXPECT_EQ(counts.removed(), 987654300u);
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
  EXPECT_EQ(most_fitted_points, 12u);
  EXPECT_EQ(LightLookup::smallest_cosine, 0.05f);
}

TEST(Defaults, OfWhatMeasures) {
  const LeakParams leak;
  EXPECT_EQ(leak.dark_share, 1e-4f);
  EXPECT_EQ(leak.sigmas, 3);
  EXPECT_EQ(leak.path.max_depth, 25);
  EXPECT_EQ(leak.path.passes, 1);
  EXPECT_EQ(leak.path.spp, 256);
  EXPECT_EQ(leak.path.seed, 0u);
  EXPECT_EQ(leak.mean, 0);
  const LintParams lint;
  EXPECT_EQ(lint.clearance, 0);
  EXPECT_EQ(lint.negative_tolerance, 0.1f);
  EXPECT_EQ(lint.spacing, 0);
  const SurfacePointParams points;
  EXPECT_EQ(points.count, 1024);
  EXPECT_EQ(points.seed, 0u);
  EXPECT_EQ(points.clearance, 0);
}

TEST(Defaults, OfTransport) {
  const TransportBakeParams bake;
  EXPECT_EQ(bake.op, LightOperator::surfel);
  EXPECT_FALSE(bake.viz);
  EXPECT_FALSE(bake.fit);
  EXPECT_EQ(bake.transport, (TransportParams{384, 0, 128, 8}));
  EXPECT_EQ(bake.solve.tolerance, 1e-3f);
  EXPECT_EQ(bake.solve.max_iterations, 300);
  EXPECT_EQ(bake.bounce.weights.method, WeightMethod::trilinear);
  EXPECT_EQ(bake.bounce.irradiance_degree, 2);
  EXPECT_EQ(bake.bounce.applications, 0);
  EXPECT_EQ(bake.bounce.tolerance, 1e-3f);
  EXPECT_EQ(bake.bounce.max_iterations, 200);
  EXPECT_EQ(bake.viz_params.neighbors, 16);
  EXPECT_EQ(bake.viz_params.threshold, 0);
  EXPECT_EQ(bake.viz_params.solve.tolerance, 1e-2f);
  EXPECT_EQ(bake.viz_params.solve.max_iterations, 300);
  EXPECT_EQ(bake.fit_params.probes, 12);
  EXPECT_EQ(bake.fit_params.training_lights, 24);
  EXPECT_EQ(bake.fit_params.own_weight, 3);
  EXPECT_EQ(bake.fit_params.gather_rays, 256);
  EXPECT_EQ(bake.fit_params.ridge, 1e-3f);
  EXPECT_EQ(bake.fit_params.degree, 2);
  const RelightParams relight;
  EXPECT_EQ(relight.poses, 0);
  EXPECT_EQ(relight.degree, 4);
  EXPECT_EQ(relight.changed, 1e-3f);
  EXPECT_TRUE(relight.warm_start);
  EXPECT_EQ(relight.op, LightOperator::surfel);
  EXPECT_EQ(ProbePlace().radius, 0.1f);
  EXPECT_TRUE(SolveReport().converged);
  EXPECT_TRUE(BounceReport().converged);
  EXPECT_EQ(RelightReport().total_ms(), 0);
  EXPECT_EQ(RelightReport().pose_rays + RelightReport().direct_rays + RelightReport().hits_changed, 0u);
}

TEST(RelightReport, TotalIsOfAllFourStages) {
  RelightReport report;
  report.pose_ms = 1, report.direct_ms = 20, report.solve_ms = 300, report.project_ms = 4000;
  EXPECT_EQ(report.total_ms(), 4321);
}

TEST(Defaults, OfMethodsParts) {
  const vct::ConeParams cones;
  EXPECT_EQ(cones.cones, 16);
  EXPECT_EQ(cones.offset, 1);
  EXPECT_EQ(cones.opacity, 1);
  EXPECT_EQ(cones.step, 0.5f);
  const vpl::VplParams lights;
  EXPECT_EQ(lights.kind, vpl::VplKind::point);
  EXPECT_EQ(lights.least_distance, 0);
  EXPECT_EQ(vpl::Vpl().radius, 0);
  EXPECT_EQ(vpl::sharpest_lobe, 100);
  const methods::PhotonParams photons;
  EXPECT_EQ(photons.photons, 512);
  EXPECT_EQ(photons.depth, 25);
  EXPECT_EQ(photons.seed, 0u);
  const methods::DdgiBlend blend;
  EXPECT_EQ(blend.hysteresis, 0.97f);
  EXPECT_EQ(blend.change, 0);
  EXPECT_EQ(blend.gamma, 1);
  const methods::DdgiField field{methods::ProbeGrid{}};
  EXPECT_EQ(field.bias, 0.3f);
  EXPECT_TRUE(field.visibility);
}

/// "name value least..most", whole numbers with an i, with the words of a choice.
std::string summary(const MethodParameter& p) {
  std::string text =
      fmt::format("{} {:g}{} {:g}..{:g}", p.name, p.value, p.whole ? "i" : "", p.least, p.most);
  for (const std::string& word : p.choices) text += " " + word;
  return text;
}

std::vector<std::string> declared(const std::string& method) {
  std::vector<std::string> found;
  for (const MethodParameter& p : find_method(method).parameters) found.push_back(summary(p));
  return found;
}

using testing::ElementsAre;

TEST(MethodDefaults, OfWhatPlacesProbes) {
  EXPECT_THAT(declared("ssphh"),
              ElementsAre("places 0i 0..1 auto scene", "spacing 0 0..10000", "probes 0i 0..4096",
                          "degree 4i 0..10", "weights 3i 0..3 distance trilinear mls fitted",
                          "fit_poses 3i 1..64", "fit_points 0i 0..262144", "surfel_size 0 0..1000",
                          "directions 384i 16..65536", "warm_start 1i 0..1"));
  EXPECT_THAT(declared("irradiance-volume"),
              ElementsAre("places 0i 0..2 auto scene grid", "spacing 0 0..10000", "probes 0i 0..4096",
                          "interpolation 0i 0..1 tetrahedra trilinear", "surfel_size 0 0..1000",
                          "directions 384i 16..65536", "degree 4i 2..10"));
  EXPECT_THAT(declared("prt"),
              ElementsAre("places 0i 0..2 auto scene grid", "spacing 0 0..10000", "probes 0i 0..4096",
                          "interpolation 0i 0..1 tetrahedra trilinear", "surfel_size 0 0..1000",
                          "directions 384i 16..65536", "degree 4i 0..10", "interreflect 3i 0..64",
                          "self_shadow 0.25 0..1e+06", "environment 0i 0..1 transfer probes",
                          "rays 256i 16..65536", "edge 0 0..10000", "vertices 262144i 3..6.71089e+07"));
  EXPECT_THAT(
      declared("ddgi"),
      ElementsAre("spacing 0 0..10000", "probes 512i 1..262144", "rays 128i 8..4096",
                  "hysteresis 0.97 0..0.999", "warmup 64i 1..65536", "change 0.5 0..10", "bias 0.3 0..4",
                  "gamma 1 1..8", "visibility 1i 0..1", "relocate 1i 0..1", "seed 0i 0..1e+09"));
}

TEST(MethodDefaults, OfWhatPlacesNone) {
  EXPECT_THAT(declared("direct"), ElementsAre());
  EXPECT_THAT(declared("ambient"), ElementsAre("points 4096i 16..4.1943e+06", "factor 1 0..1000"));
  EXPECT_THAT(declared("vpl"),
              ElementsAre("photons 512i 1..1.04858e+06", "depth 25i 2..1000", "kind 0i 0..1 point sphere",
                          "clamp 0.05 0..10", "radius 1 0.01..100", "cluster_error 0 0..1",
                          "check_points 256i 0..65536", "seed 0i 0..1e+09"));
  EXPECT_THAT(declared("vct"),
              ElementsAre("resolution 4i 0..6 8 16 32 64 128 256 512", "storage 0i 0..1 sparse dense",
                          "bounces 6i 1..32", "cones 16i 3..4096", "bounce_cones 10i 3..4096",
                          "offset 1 0..16", "step 0.5 0.05..1", "opacity 1 1..8", "samples 4i 1..16"));
}

TEST(MethodDefaults, OpenGlCanDrawWhatGivesItsLightAsData) {
  for (const MethodEntry& entry : method_table())
    EXPECT_EQ(entry.has_light_data, std::string(entry.name) == "vpl" || std::string(entry.name) == "vct")
        << entry.name;
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
}  // namespace ssphh::gi
