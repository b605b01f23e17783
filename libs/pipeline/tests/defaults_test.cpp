/// What is asked for when nobody says otherwise, every number once, and what stands in a value before
/// anything is put into it: callers, the tool's help and the pages of docs/ rely on them.

#include <gtest/gtest.h>

#include <ssphh/pipeline/bake_scene.h>
#include <ssphh/pipeline/lamp_lattice.h>
#include <ssphh/pipeline/method_figures.h>
#include <ssphh/pipeline/places.h>
#include <ssphh/pipeline/render_scene.h>
#include <ssphh/pipeline/scene_options.h>

namespace ssphh::pipeline {
namespace {

TEST(Defaults, OfScenes) {
  const SceneOptions scene;
  EXPECT_EQ(scene.environment_intensity, 1);
  EXPECT_EQ(scene.environment_rotation, 0);
  EXPECT_FALSE(scene.lambert);
  EXPECT_FALSE(scene.keep_dark_light);
  EXPECT_EQ(scene.time, 0);
  const SkyOptions sky;
  EXPECT_FALSE(sky.model);
  EXPECT_FALSE(sky.preetham);
  EXPECT_EQ(sky.elevation, 45);
  EXPECT_EQ(sky.azimuth, 120);
  EXPECT_EQ(sky.turbidity, 3);
  EXPECT_FALSE(sky.utc_offset);
  EXPECT_EQ(sky.north, 0);
}

TEST(Defaults, OfBakes) {
  const PlaceOptions places;
  EXPECT_EQ(places.probes, "");
  EXPECT_EQ(places.clearance, 0.04f);
  EXPECT_EQ(places.levels, 1);
  EXPECT_EQ(places.max_probes, 65536);
  EXPECT_EQ(PlaceResult().seconds, 0);
  const BakeSettings bake;
  EXPECT_EQ(bake.degree, 9);
  EXPECT_EQ(bake.seed, 0u);
  EXPECT_EQ(bake.usual_records, transport::usual_records);
  EXPECT_EQ(bake.max_memory, 0);
  EXPECT_EQ(bake.threshold, 0);
  EXPECT_EQ(bake.viz_source, probes::VizSource::intensity);
  const LampLatticeParams lattice;
  EXPECT_EQ(lattice.spacing, 1);
  EXPECT_EQ(lattice.reach, 2);
  EXPECT_EQ(lattice.radius, 0);
  const LampLattice found;
  EXPECT_EQ(found.origin, vec3(0));
  EXPECT_EQ(found.box, 0);
  EXPECT_EQ(found.boxes, glm::ivec3(0));
  EXPECT_EQ(LampShare().place, -1);
  EXPECT_EQ(LampShare().weight, 0);
}

TEST(Defaults, OfPictures) {
  EXPECT_EQ(LightFinder{}.method, "path");
  EXPECT_EQ(MethodFigures().bake_seconds, 0);
  EXPECT_EQ(MethodFigures().update_seconds, 0);
}

}  // namespace
}  // namespace ssphh::pipeline
