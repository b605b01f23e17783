/// What is asked for when nobody says otherwise, every number once, and what stands in a value before
/// anything is put into it: callers, the tool's help and the pages of docs/ rely on them.

#include <gtest/gtest.h>

#include <ssphh/bake/bake.h>
#include <ssphh/bake/transport_bake.h>
#include <ssphh/bake/update.h>

#include "checkpoint.h"

namespace ssphh::bake {
namespace {

TEST(Defaults, OfPathTracedBakes) {
  const BakeParams params;
  EXPECT_EQ(params.gen, probes::GenMode::full);
  EXPECT_EQ(params.face_size, 64);
  EXPECT_FALSE(params.keep_light);
  EXPECT_TRUE(params.viz);
  EXPECT_FALSE(params.viz_params.matrix);
  EXPECT_EQ(params.viz_params.neighbors, -1);
  EXPECT_EQ(params.viz_params.threshold, 0);
  EXPECT_EQ(params.viz_params.source, probes::VizSource::intensity);
  EXPECT_EQ(params.viz_params.paths, rays::PathSet::all);
  EXPECT_FALSE(params.viz_path.has_value());
  const BakeReport report;
  EXPECT_EQ(report.gen_seconds + report.viz_seconds, 0);
  EXPECT_EQ(report.rays + report.resumed, 0u);
}

TEST(Defaults, OfBakesByTransport) {
  const TransportBakeParams params;
  EXPECT_EQ(params.op, probes::LightOperator::surfel);
  EXPECT_FALSE(params.viz);
  EXPECT_FALSE(params.fit);
  EXPECT_EQ(params.transport, (transport::TransportParams{384, 0, 128, 8, 32, 100000}));
  EXPECT_EQ(params.solve.tolerance, 1e-3f);
  EXPECT_EQ(params.solve.max_iterations, 2000);
  EXPECT_TRUE(params.solve.settle);
  EXPECT_EQ(params.bounce.weights.method, probes::WeightMethod::trilinear);
  EXPECT_EQ(params.bounce.irradiance_degree, 2);
  EXPECT_EQ(params.bounce.applications, 0);
  EXPECT_EQ(params.bounce.tolerance, 1e-3f);
  EXPECT_EQ(params.bounce.max_iterations, 200);
  EXPECT_EQ(params.viz_params.neighbors, 16);
  EXPECT_EQ(params.viz_params.threshold, 0);
  EXPECT_EQ(params.viz_params.source, probes::VizSource::intensity);
  EXPECT_EQ(params.viz_params.solve.tolerance, 3e-2f);
  EXPECT_EQ(params.viz_params.solve.max_iterations, 300);
  EXPECT_EQ(params.fit_params.probes, 12);
  EXPECT_EQ(params.fit_params.training_lights, 24);
  EXPECT_EQ(params.fit_params.own_weight, 3);
  EXPECT_EQ(params.fit_params.gather_rays, 256);
  EXPECT_EQ(params.fit_params.ridge, 1e-3f);
  EXPECT_EQ(params.fit_params.degree, 2);
}

TEST(BakeValues, OfBakes) {
  EXPECT_EQ(ProbeStage(), (ProbeStage{BakeStage::gen, 0}));
  const ProbeStageResult stage;
  EXPECT_EQ(stage.seconds, 0);
  EXPECT_EQ(stage.rays, 0u);
  const CheckpointRecord record;
  EXPECT_EQ(record.stage, BakeStage::gen);
  EXPECT_EQ(record.probe, 0u);
  EXPECT_EQ(record.seconds, 0);
  EXPECT_EQ(record.rays, 0u);
  const UpdatePlan plan;
  EXPECT_EQ(plan.noise, 0) << "where nothing is compared";
  EXPECT_EQ(plan.tolerance, 0);
  EXPECT_EQ(plan.seconds, 0);
  const TransportBakeReport report;
  EXPECT_EQ(report.surfels, 0u);
  EXPECT_EQ(report.links, 0u);
  EXPECT_EQ(report.iterations, 0);
  EXPECT_EQ(report.contraction, 0);
  EXPECT_EQ(report.lost, 0);
  EXPECT_EQ(report.seconds, 0);
  EXPECT_EQ(report.viz_seconds, 0);
  EXPECT_EQ(report.fit_seconds, 0);
  EXPECT_EQ(report.rays, 0u);
}

TEST(BakeValues, StagesAreThoseOfCheckpoints) {
  EXPECT_EQ(names_of<BakeStage>(), (std::vector<std::string>{"gen", "viz"}));
  EXPECT_EQ(parse_enum<BakeStage>("viz"), BakeStage::viz);
  EXPECT_EQ(parse_enum<BakeStage>("Gen"), std::nullopt);
}

}  // namespace
}  // namespace ssphh::bake
