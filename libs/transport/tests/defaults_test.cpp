/// What is asked for when nobody says otherwise, every number once, and what stands in a value before
/// anything is put into it: callers, the tool's help and the pages of docs/ rely on them.

#include <gtest/gtest.h>

#include <ssphh/transport/bounce.h>
#include <ssphh/transport/gbuffer.h>
#include <ssphh/transport/relight_session.h>

#include "network_data.h"
#include "sphl_emission.h"

namespace ssphh::transport {
namespace {

TEST(Defaults, OfTransport) {
  const RelightParams relight;
  EXPECT_EQ(relight.poses, 0);
  EXPECT_EQ(relight.kept_pose_bytes, std::size_t{64} << 20);
  EXPECT_EQ(relight.degree, 4);
  EXPECT_EQ(relight.changed, 1e-3f);
  EXPECT_TRUE(relight.warm_start);
  EXPECT_EQ(relight.op, probes::LightOperator::surfel);
  EXPECT_EQ(scene::ProbePlace().radius, 0.1f);
  EXPECT_TRUE(SolveReport().converged);
  EXPECT_TRUE(BounceReport().converged);
  EXPECT_EQ(RelightReport().total_ms(), 0);
  EXPECT_EQ(RelightReport().pose_rays + RelightReport().direct_rays + RelightReport().hits_changed, 0u);
}

TEST(ProbePlaces, TakeNamePositionAndRadius) {
  const std::vector<scene::ProbePlace> places =
      scene::places_of(std::vector<probes::Probe>{{"a", vec3(1, 2, 3), 0.25f, {}, {}, {}, {}}});
  ASSERT_EQ(places.size(), 1u);
  EXPECT_EQ(places[0].name, "a");
  EXPECT_EQ(places[0].position, vec3(1, 2, 3));
  EXPECT_EQ(places[0].radius, 0.25f);
}

TEST(RelightReport, TotalIsOfAllFourStages) {
  RelightReport report;
  report.pose_ms = 1, report.direct_ms = 20, report.solve_ms = 300, report.project_ms = 4000;
  EXPECT_EQ(report.total_ms(), 4321);
}

TEST(TransportValues, OfTransport) {
  EXPECT_EQ(EmissionEntry(), (EmissionEntry{vec3(0), -1}));
  EXPECT_EQ(no_surfel, -1);
  EXPECT_EQ(no_patch, -1);
  const Sight sight;
  EXPECT_EQ(sight.patch, no_patch);
  EXPECT_EQ(sight.albedo, vec3(0));
  EXPECT_EQ(sight.emission, vec3(0));
  EXPECT_EQ(sight.group, -1);
  EXPECT_EQ(PoseReport().rays_near_parts, 0u);
  EXPECT_EQ(PoseReport().hits_changed, 0u);
  EXPECT_EQ(ClusterPoint().albedo, vec3(0));
  EXPECT_EQ(Surfel().albedo, vec3(0));
  EXPECT_EQ(Surfel().part, 0);
  const MovingRay ray;
  EXPECT_EQ(ray.normal, vec3(0));
  EXPECT_EQ(ray.patch, no_patch);
  EXPECT_EQ(ray.albedo, 0u);
  EXPECT_EQ(ray.owner, 0u);
  EXPECT_EQ(ray.sample, 0u);
  EXPECT_EQ(ray.emission, 0u);
  const Resolved resolved;
  EXPECT_EQ(resolved.patch, no_patch);
  EXPECT_EQ(resolved.albedo, 0u);
  EXPECT_EQ(resolved.emission, 0u);
  EXPECT_EQ(resolved.distance, 0);
  const PlacedPart part{};
  EXPECT_EQ(part.to_world, mat4(1));
  EXPECT_EQ(part.to_part, mat4(1));
  EXPECT_EQ(PreparedPose().time, 0);
  const SphlEmitter emitter;
  EXPECT_EQ(emitter.position, vec3(0));
  EXPECT_EQ(emitter.radius, 0.1f);
  const BounceReport bounce;
  EXPECT_EQ(bounce.iterations, 0);
  EXPECT_EQ(bounce.contraction, 0);
  EXPECT_EQ(bounce.edges, 0u);
  EXPECT_EQ(SolveReport().iterations, 0);
  EXPECT_EQ(SolveReport().residual, 0);
}

}  // namespace
}  // namespace ssphh::transport
