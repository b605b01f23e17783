/// What is asked for when nobody says otherwise, every number once, and what stands in a value before
/// anything is put into it: callers, the tool's help and the pages of docs/ rely on them.

#include <gtest/gtest.h>

#include <ssphh/scene_io/emission_file.h>
#include <ssphh/scene_io/load.h>
#include <ssphh/scene_io/renderer_export.h>

namespace ssphh::scene_io {
namespace {

TEST(Defaults, OfFiles) {
  const LoadOptions load;
  EXPECT_EQ(load.time, 0);
  EXPECT_EQ(load.environment_intensity, 1);
  EXPECT_EQ(load.environment_rotation, 0);
  EXPECT_FALSE(load.keep_dark_light);
  EXPECT_FALSE(load.sun_sky);
  EXPECT_EQ(EmissionFile().radius, 0.1f);
  const ExportSettings renderer{};
  EXPECT_EQ(renderer.time, 0);
  EXPECT_EQ(renderer.width, 1280);
  EXPECT_EQ(renderer.height, 720);
  EXPECT_EQ(renderer.max_depth, 25);
  EXPECT_EQ(renderer.spp, 64);
  EXPECT_FALSE(renderer.cube_at);
  EXPECT_TRUE(renderer.shows_emitters);
}

}  // namespace
}  // namespace ssphh::scene_io
