/// What is asked for when nobody says otherwise, every number once, and what stands in a value before
/// anything is put into it: callers, the tool's help and the pages of docs/ rely on them.

#include <fmt/format.h>
#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <ssphh/methods/method_list.h>

#include "ddgi/blend.h"
#include "ddgi/rays.h"
#include "probe_volume/probe_grid.h"
#include "prt/sky_transfer.h"
#include "vct/inject.h"
#include "vpl/light_tree.h"

namespace ssphh::methods {
namespace {

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
  const vpl::PhotonParams photons;
  EXPECT_EQ(photons.photons, 512);
  EXPECT_EQ(photons.depth, 25);
  EXPECT_EQ(photons.seed, 0u);
  const ddgi::DdgiBlend blend;
  EXPECT_EQ(blend.hysteresis, 0.97f);
  EXPECT_EQ(blend.change, 0);
  EXPECT_EQ(blend.gamma, 1);
  const ddgi::DdgiField field{ddgi::ProbeGrid{}};
  EXPECT_EQ(field.bias, 0.3f);
  EXPECT_TRUE(field.visibility);
  const probe_volume::ProbeGridParams grid;
  EXPECT_EQ(grid.spacing, 0);
  EXPECT_EQ(grid.places, 200);
  EXPECT_EQ(grid.most, 4096);
}

/// "name value least..most", whole numbers with an i, with the words of a choice.
std::string summary(const MethodParameter& p) {
  std::string text =
      fmt::format("{} {:g}{} {:g}..{:g}", p.name, p.value, p.whole ? "i" : "", p.least, p.most);
  for (const std::string& word : p.choices) text += " " + word;
  return text;
}

std::vector<std::string> declared_by(const std::string& method) {
  std::vector<std::string> found;
  for (const MethodParameter& p : find_method(method).parameters) found.push_back(summary(p));
  return found;
}

using testing::ElementsAre;
using testing::UnorderedElementsAre;

TEST(MethodDefaults, OfWhatPlacesProbes) {
  EXPECT_THAT(declared_by("ssphh"),
              ElementsAre("places 0i 0..1 auto scene", "spacing 0 0..10000", "probes 0i 0..4096",
                          "degree 4i 0..10", "weights 4i 0..5 distance trilinear mls fitted surface gather",
                          "records 16384i 1..65536", "fit_poses 3i 1..64", "fit_points 0i 0..262144",
                          "surfel_size 0 0..1000", "directions 384i 16..65536", "warm_start 1i 0..1"));
  EXPECT_THAT(declared_by("irradiance-volume"),
              ElementsAre("places 0i 0..2 auto scene grid", "spacing 0 0..10000", "probes 0i 0..4096",
                          "interpolation 0i 0..1 tetrahedra trilinear", "surfel_size 0 0..1000",
                          "directions 384i 16..65536", "degree 4i 2..10"));
  EXPECT_THAT(declared_by("prt"),
              ElementsAre("places 0i 0..2 auto scene grid", "spacing 0 0..10000", "probes 0i 0..4096",
                          "interpolation 0i 0..1 tetrahedra trilinear", "surfel_size 0 0..1000",
                          "directions 384i 16..65536", "degree 4i 0..10", "interreflect 3i 0..64",
                          "self_shadow 0.25 0..1e+06", "environment 0i 0..1 transfer probes",
                          "rays 256i 16..65536", "edge 0 0..10000", "vertices 262144i 3..6.71089e+07"));
  EXPECT_THAT(
      declared_by("ddgi"),
      ElementsAre("spacing 0 0..10000", "probes 512i 1..262144", "rays 128i 8..4096",
                  "hysteresis 0.97 0..0.999", "warmup 64i 1..65536", "change 0.5 0..10", "bias 0.3 0..4",
                  "gamma 1 1..8", "visibility 1i 0..1", "relocate 1i 0..1", "seed 0i 0..1e+09"));
}

// Those of the paper: SPHLs of 64x64x6 texels and degree 10, maximum ray depth 3, one pass.
TEST(MethodDefaults, OfThePapersWay) {
  EXPECT_THAT(
      declared_by("ssphh-paper"),
      ElementsAre("places 0i 0..1 scene auto", "probes 6i 1..4096", "degree 10i 0..10", "face 64i 1..4096",
                  "gen 0i 0..1 full local", "depth 3i 0..65535", "passes 1i 1..1.67772e+07",
                  "spp 16i 1..1.67772e+07", "viz_source 0i 0..1 intensity radiance",
                  "viz_paths 1i 0..1 all diffuse", "viz_depth 3i 0..65535", "viz_passes 1i 1..1.67772e+07",
                  "viz_spp 16i 1..1.67772e+07", "operator 0i 0..3 coefficient mean matrix raw",
                  "neighbors -1i -1..65536", "threshold 0 0..1e+30", "layer 2i 0..2 self neighbor sum",
                  "lookup 0i 0..1 light irradiance"));
}

TEST(MethodDefaults, OfWhatPlacesNone) {
  EXPECT_THAT(declared_by("direct"), ElementsAre());
  EXPECT_THAT(declared_by("ambient"), ElementsAre("points 4096i 16..4.1943e+06", "factor 1 0..1000"));
  EXPECT_THAT(declared_by("vpl"),
              ElementsAre("photons 512i 1..1.04858e+06", "depth 25i 2..1000", "kind 0i 0..1 point sphere",
                          "clamp 0.05 0..10", "radius 1 0.01..100", "cluster_error 0 0..1",
                          "check_points 256i 0..65536", "seed 0i 0..1e+09"));
  EXPECT_THAT(declared_by("vct"),
              ElementsAre("resolution 4i 0..6 8 16 32 64 128 256 512", "storage 0i 0..1 sparse dense",
                          "bounces 6i 1..32", "cones 16i 3..4096", "bounce_cones 10i 3..4096",
                          "offset 1 0..16", "step 0.5 0.05..1", "opacity 1 1..8", "samples 4i 1..16"));
}

TEST(MethodDefaults, OpenGlCanDrawWhatGivesItsLightAsData) {
  std::vector<std::string> drawn;
  for (const MethodEntry& entry : all_methods())
    if (entry.has_light_data) drawn.emplace_back(entry.name);
  EXPECT_THAT(drawn, UnorderedElementsAre("ssphh", "vct", "vpl"));
}

TEST(MethodValues, OfTransfer) {
  const prt::TransferParams params;
  EXPECT_EQ(params.degree, 4);
  EXPECT_EQ(params.bounces, 0);
  EXPECT_EQ(prt::TransferVectors().degree, 0);
  EXPECT_EQ(prt::PlaceTransfer().degree, 0);
  EXPECT_EQ(prt::VertexRays().count, 0);
  const prt::TransferMeshParams mesh;
  EXPECT_EQ(mesh.edge, 0);
  EXPECT_EQ(mesh.most, 1048576);
  EXPECT_FALSE(mesh.both_sides);
  EXPECT_EQ(prt::MeshPlace().triangle, -1);
  EXPECT_EQ(prt::MeshPlace().weight, vec3(0));
}

TEST(MethodValues, OfVoxels) {
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

TEST(MethodValues, OfVirtualLightsAndProbeGrids) {
  const vpl::LightNode node;
  EXPECT_EQ(node.light, 0);
  EXPECT_EQ(node.left, -1);
  EXPECT_EQ(node.right, -1);
  const vpl::VplCluster& cluster = node.cluster;
  EXPECT_EQ(cluster.axis, vec3(0, 0, 1));
  EXPECT_EQ(cluster.spread, 0);
  EXPECT_EQ(cluster.least_radius, 0);
  EXPECT_EQ(cluster.most_radius, 0);
  EXPECT_EQ(cluster.power, vec3(0));
  EXPECT_EQ(vpl::CutLight().irradiance, vec3(0));
  EXPECT_EQ(vpl::CutLight().lights, 0);
  const vpl::Receiver receiver;
  EXPECT_EQ(receiver.position, vec3(0));
  EXPECT_EQ(receiver.normal, vec3(0));
  EXPECT_EQ(receiver.exponent, -1);
  EXPECT_EQ(receiver.axis, vec3(0));
  EXPECT_EQ(vpl::Vpl().position, vec3(0));
  EXPECT_EQ(vpl::Vpl().normal, vec3(0));
  EXPECT_EQ(vpl::Vpl().power, vec3(0));
  const ddgi::ProbeGrid grid;
  EXPECT_EQ(grid.first, vec3(0));
  EXPECT_EQ(grid.spacing, vec3(1));
  EXPECT_EQ(grid.count, glm::ivec3(1));
  EXPECT_EQ(ddgi::ProbeRay().radiance, vec3(0));
  EXPECT_EQ(ddgi::ProbeRay().distance, 0);
}

TEST(MethodValues, OfMethods) {
  EXPECT_EQ(MethodMemory().lookup, 0u);
  EXPECT_EQ(MethodMemory().update, 0u);
  EXPECT_FALSE(MethodEntry().has_light_data);
  EXPECT_FALSE(MethodParameter().whole);
}

}  // namespace
}  // namespace ssphh::methods
