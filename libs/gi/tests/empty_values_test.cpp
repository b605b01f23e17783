/// What stands in a value before anything is put into it: "none", darkness, nothing counted. Whoever fills
/// only some of the members relies on the others.

#include <cmath>

#include <gtest/gtest.h>

#include <ssphh/gi/bake.h>
#include <ssphh/gi/leak.h>
#include <ssphh/gi/lint.h>
#include <ssphh/gi/lookup_error.h>
#include <ssphh/gi/methods/table.h>
#include <ssphh/gi/transport/bounce.h>
#include <ssphh/gi/transport/gbuffer.h>
#include <ssphh/gi/transport_bake.h>

#include "checkpoint.h"
#include "methods/ddgi/rays.h"
#include "methods/prt/sky_transfer.h"
#include "methods/vct/inject.h"
#include "methods/vpl/light_tree.h"
#include "place/draft.h"
#include "transport/network_data.h"
#include "transport/sphl_emission.h"
#include "triangle_tree.h"

namespace ssphh::gi {
namespace {

TEST(EmptyValues, OfBakes) {
  EXPECT_EQ(ProbeStage(), (ProbeStage{BakeStage::gen, 0}));
  const ProbeStageResult stage;
  EXPECT_EQ(stage.seconds, 0);
  EXPECT_EQ(stage.rays, 0u);
  const CheckpointRecord record;
  EXPECT_EQ(record.stage, BakeStage::gen);
  EXPECT_EQ(record.probe, 0u);
  EXPECT_EQ(record.seconds, 0);
  EXPECT_EQ(record.rays, 0u);
  const TransportBakeReport transport;
  EXPECT_EQ(transport.surfels, 0u);
  EXPECT_EQ(transport.links, 0u);
  EXPECT_EQ(transport.iterations, 0);
  EXPECT_EQ(transport.contraction, 0);
  EXPECT_EQ(transport.lost, 0);
  EXPECT_EQ(transport.seconds, 0);
  EXPECT_EQ(transport.viz_seconds, 0);
  EXPECT_EQ(transport.fit_seconds, 0);
  EXPECT_EQ(transport.rays, 0u);
}

TEST(EmptyValues, OfMeasurements) {
  const LeakReport leak;
  EXPECT_EQ(leak.ratio, 0);
  EXPECT_EQ(leak.dark, 0u);
  EXPECT_EQ(leak.mean_truth, 0);
  EXPECT_EQ(leak.mean_looked_up, 0);
  EXPECT_EQ(leak.truth_noise, 0);
  const TruthAtPoints truth;
  EXPECT_EQ(truth.dark, 0u);
  EXPECT_EQ(truth.mean, 0);
  EXPECT_EQ(truth.noise, 0);
  const LookupError error;
  EXPECT_EQ(error.points, 0u);
  for (const double value : {error.mean_truth, error.ratio, error.mean_relative, error.median_relative,
                             error.p95_relative, error.noise, error.mean_error, error.relmse})
    EXPECT_EQ(value, 0);
  EXPECT_EQ(relative_floor, 0.01);
  const LintProblem problem;
  EXPECT_EQ(problem.kind, ProbeProblem::inside);
  EXPECT_EQ(problem.probe, -1);
  EXPECT_EQ(problem.position, vec3(0));
  EXPECT_EQ(scene::LightingState(), (scene::LightingState{0, {}, {}, 0, {}}));
  EXPECT_EQ(MethodMemory().lookup, 0u);
  EXPECT_EQ(MethodMemory().update, 0u);
  EXPECT_FALSE(MethodEntry().has_light_data);
  EXPECT_FALSE(MethodParameter().whole);
}

TEST(EmptyValues, OfPlaces) {
  const Draft draft;
  EXPECT_EQ(draft.position, vec3(0));
  EXPECT_EQ(draft.kind, PlaceKind::grid);
  EXPECT_EQ(draft.spacing, 1);
  EXPECT_EQ(draft.reach, 1);
  EXPECT_EQ(draft.radius, 0);
  const Site site;
  EXPECT_TRUE(std::isinf(site.nearest) && std::isinf(site.harmonic) && std::isinf(site.nearest_back));
  EXPECT_EQ(site.back, 0);
  EXPECT_EQ(site.escaped, 0);
  EXPECT_FALSE(site.emitter);
  EXPECT_EQ(site.nearest_hit, vec3(0));
  EXPECT_EQ(site.nearest_normal, vec3(0));
  EXPECT_EQ(site.nearest_back_hit, vec3(0));
  EXPECT_EQ(SiteRules().clearance, 0.04f);
  EXPECT_EQ(SiteRules().back_limit, 0.25f);
  const Lattice lattice;
  EXPECT_EQ(lattice.origin, vec3(0));
  EXPECT_EQ(lattice.spacing, 1);
  EXPECT_EQ(lattice.size, glm::ivec3(0));
}

TEST(EmptyValues, OfTransport) {
  EXPECT_EQ(EmissionEntry(), (EmissionEntry{vec3(0), -1}));
  EXPECT_EQ(no_surfel, -1);
  const Sight sight;
  EXPECT_EQ(sight.surfel, no_surfel);
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
  EXPECT_EQ(ray.surfel, no_surfel);
  EXPECT_EQ(ray.albedo, 0u);
  EXPECT_EQ(ray.owner, 0u);
  EXPECT_EQ(ray.sample, 0u);
  EXPECT_EQ(ray.emission, 0u);
  const Resolved resolved;
  EXPECT_EQ(resolved.surfel, no_surfel);
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
  EXPECT_EQ(Contraction().lower, 0);
  EXPECT_EQ(Contraction().upper, 0);
}

TEST(EmptyValues, OfTransfer) {
  const TransferParams params;
  EXPECT_EQ(params.degree, 4);
  EXPECT_EQ(params.bounces, 0);
  EXPECT_EQ(TransferVectors().degree, 0);
  EXPECT_EQ(PlaceTransfer().degree, 0);
  EXPECT_EQ(VertexRays().count, 0);
  const TransferMeshParams mesh;
  EXPECT_EQ(mesh.edge, 0);
  EXPECT_EQ(mesh.most, 1048576);
  EXPECT_FALSE(mesh.both_sides);
  EXPECT_EQ(MeshPlace().triangle, -1);
  EXPECT_EQ(MeshPlace().weight, vec3(0));
  EXPECT_EQ(OnTriangle().weight, vec3(1, 0, 0));
  EXPECT_EQ(TriangleTree::Found().triangle, -1);
}

TEST(EmptyValues, OfVoxels) {
  EXPECT_EQ(vct::Cell(), (vct::Cell{0, 0, 0}));
  const vct::VoxelGrid grid;
  EXPECT_EQ(grid.origin, vec3(0));
  EXPECT_EQ(grid.voxel, 1);
  EXPECT_EQ(grid.resolution, 4);
  EXPECT_EQ(grid.size, (vct::Cell{4, 4, 4}));
  const vct::VoxelPatches range;
  for (const std::uint32_t at : {range.still_begin, range.still_end, range.moving_begin, range.moving_end})
    EXPECT_EQ(at, 0u);
  EXPECT_EQ(range.voxel, 0u);
  const vct::Patch patch;
  EXPECT_EQ(patch.voxel, 0u);
  EXPECT_EQ(patch.position, vec3(0));
  EXPECT_EQ(patch.normal, vec3(0));
  EXPECT_EQ(patch.albedo, vec3(0));
  EXPECT_EQ(patch.first_sample, 0u);
  EXPECT_EQ(patch.samples, 0u);
  EXPECT_EQ(vct::PatchParams().samples, 4);
  EXPECT_FALSE(vct::PatchParams().moving);
  const vct::Fragment fragment;
  EXPECT_EQ(fragment.voxel, 0u);
  EXPECT_EQ(fragment.area, vec3(0));
  EXPECT_EQ(fragment.centroid, vec3(0));
  EXPECT_FALSE(fragment.cutout);
  const vct::Cone cone;
  EXPECT_EQ(cone.direction, vec3(0, 0, 1));
  EXPECT_EQ(cone.weight, 1);
  EXPECT_EQ(cone.tangent, 0);
  EXPECT_EQ(vct::BrickView().row, 0);
  EXPECT_EQ(vct::BrickView().layer, 0);
}

TEST(EmptyValues, OfVirtualLightsAndProbeGrids) {
  const methods::LightNode node;
  EXPECT_EQ(node.light, 0);
  EXPECT_EQ(node.left, -1);
  EXPECT_EQ(node.right, -1);
  const methods::VplCluster& cluster = node.cluster;
  EXPECT_EQ(cluster.axis, vec3(0, 0, 1));
  EXPECT_EQ(cluster.spread, 0);
  EXPECT_EQ(cluster.least_radius, 0);
  EXPECT_EQ(cluster.most_radius, 0);
  EXPECT_EQ(cluster.power, vec3(0));
  EXPECT_EQ(methods::CutLight().irradiance, vec3(0));
  EXPECT_EQ(methods::CutLight().lights, 0);
  const methods::Receiver receiver;
  EXPECT_EQ(receiver.position, vec3(0));
  EXPECT_EQ(receiver.normal, vec3(0));
  EXPECT_EQ(receiver.exponent, -1);
  EXPECT_EQ(receiver.axis, vec3(0));
  EXPECT_EQ(vpl::Vpl().position, vec3(0));
  EXPECT_EQ(vpl::Vpl().normal, vec3(0));
  EXPECT_EQ(vpl::Vpl().power, vec3(0));
  const methods::ProbeGrid grid;
  EXPECT_EQ(grid.first, vec3(0));
  EXPECT_EQ(grid.spacing, vec3(1));
  EXPECT_EQ(grid.count, glm::ivec3(1));
  EXPECT_EQ(methods::ProbeRay().radiance, vec3(0));
  EXPECT_EQ(methods::ProbeRay().distance, 0);
}

}  // namespace
}  // namespace ssphh::gi
