/// A kept result may serve only the request that it answers: keys hold every field that decides it.

#include "unit_key.h"

#include <gtest/gtest.h>

#include "job_fields.h"

namespace ssphh::farm {
namespace {

using ssphh::test::expect_a_key_of_every_field;
using ssphh::test::expect_same_fields;
using ssphh::test::Undecisive;

const Undecisive where_a_scene_lies = {
    {"scene/package", "parts are had from there; scene.light names what decides the light"},
    {"scene/manifest_bytes", "the size of the package"},
};

Undecisive besides(Undecisive more) {
  more.insert(where_a_scene_lies.begin(), where_a_scene_lies.end());
  return more;
}

TEST(UnitKey, OfATransportJobHoldsEveryFieldOfIt) {
  expect_a_key_of_every_field(
      test::some_transport_job(), [](const TransportJob& job) { return unit_key(job); }, besides({}));
}

TEST(UnitKey, OfATileHoldsEveryFieldOfItsJob) {
  expect_a_key_of_every_field(
      test::some_tile_job(),
      [](const TileJob& job) {
        return unit_key(job, {1, 2, 3, 4});
      },
      besides({
          {"tiles", "other tiles of the job: the key is one tile's"},
          {"params/tile", "is not used: every tile of the job is rendered"},
          {"params/camera/camera/name", "for people"},
          {"params/camera/camera/node", "the pose is the camera's world matrix"},
          {"params/camera/camera/aspect", "a render's own size wins"},
          {"lighting/value/bytes", "the size of the file whose hash is in the key"},
      }));
}

TEST(UnitKey, OfATileHoldsItsPlaceAndSize) {
  const TileJob job = test::some_tile_job();
  expect_a_key_of_every_field(job.tiles[0], [&](const trace::Tile& tile) { return unit_key(job, tile); });
}

TEST(UnitKey, OfGenHoldsThePathsAndTheProbesOwnPlace) {
  expect_a_key_of_every_field(
      test::some_probe_job(bake::BakeStage::gen), [](const ProbeJob& all) { return unit_key(all, 1); },
      besides({
          {"viz_params", "of VIZ alone"},
          {"probes", "others of the job: the key is one probe's"},
          {"places/size", "GEN looks at the probe's own place alone"},
          {"places/0", "that of another probe"},
          {"places/2", "that of another probe"},
      }));
}

TEST(UnitKey, OfVizHoldsThePathsAllPlacesAndWhichEdges) {
  expect_a_key_of_every_field(
      test::some_probe_job(bake::BakeStage::viz), [](const ProbeJob& all) { return unit_key(all, 1); },
      besides({{"probes", "others of the job: the key is one probe's"}}));
}

// Every probe derives its seed from its index, so that two at the same place differ.
TEST(UnitKey, IsAnotherForEveryProbe) {
  for (const bake::BakeStage stage : {bake::BakeStage::gen, bake::BakeStage::viz}) {
    ProbeJob all = test::some_probe_job(stage);
    all.places.assign(3, all.places[0]);
    EXPECT_NE(unit_key(all, 1), unit_key(all, 2));
  }
}

TEST(UnitKey, AJobHoldsWhatTheSetsGeneratorSays) {
  probes::ProbeSet set;
  set.degree = 6;
  set.generator.max_depth = 5, set.generator.passes = 2, set.generator.spp = 3;
  set.generator.viz_max_depth = 7, set.generator.viz_passes = 4, set.generator.viz_spp = 6;
  set.generator.face_size = 11, set.generator.seed = 0x123456789abcdef0;
  for (const float x : {0.5f, 2.5f}) {
    probes::Probe probe;
    probe.position = {x, x + 0.1f, x + 0.2f}, probe.radius = x + 0.3f;
    set.probes.push_back(probe);
  }
  for (const bake::BakeStage stage : {bake::BakeStage::gen, bake::BakeStage::viz}) {
    ProbeJob wanted;
    wanted.scene = test::some_scene(), wanted.stage = stage;
    wanted.degree = 6, wanted.face_size = 11;
    wanted.path = {5, 2, 3, 0x123456789abcdef0};
    if (stage == bake::BakeStage::viz) wanted.path = {7, 4, 6, 0x123456789abcdef0};
    wanted.viz_params = {true, 3, 0.25f};
    wanted.places = {{{0.5f, 0.6f, 0.7f}, 0.8f}, {{2.5f, 2.6f, 2.7f}, 2.8f}};
    expect_same_fields(job_of_set(set, {true, 3, 0.25f}, stage, test::some_scene()), wanted);
  }
}

TEST(UnitKey, LightingHoldsWhatARenderSaysOfItsProbes) {
  const Blob file{{0x2468ace013579bdf, 0x0f1e2d3c4b5a6978}, std::vector<std::byte>(77)};
  RenderProbes asked;
  auto& [set, lookup] = asked;
  set = nullptr, lookup = {probes::LookupMethod::light, probes::WeightMethod::mls, probes::ProbeLayer::self};
  expect_same_fields(lighting_of(asked, file), ProbeLighting{file.hash, 77, lookup});
}

}  // namespace
}  // namespace ssphh::farm
