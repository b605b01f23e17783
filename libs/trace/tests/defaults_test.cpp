/// What is asked for when nobody says otherwise, every number once, and what stands in a value before
/// anything is put into it: callers, the tool's help and the pages of docs/ rely on them.

#include <gtest/gtest.h>

#include <ssphh/trace/render_state.h>
#include <ssphh/trace/thing_emission.h>
#include <ssphh/trace/transport_scene.h>

namespace ssphh::trace {
namespace {

TEST(Defaults, OfWhatIsTraced) {
  const TransportOptions transport;
  EXPECT_EQ(transport.light_samples, 16);
  EXPECT_EQ(transport.environment_samples, 64);
  EXPECT_EQ(transport.surface_tolerance, 5e-5f);
  const ThingEmissionParams thing;
  EXPECT_EQ(thing.degree, 8);
  EXPECT_EQ(thing.image_size, 32);
  EXPECT_EQ(thing.path.max_depth, 8);
  const RenderParams picture{};
  EXPECT_EQ(picture.width, 1280);
  EXPECT_EQ(picture.height, 720);
  EXPECT_EQ(picture.projection, Projection::pinhole);
  EXPECT_FALSE(picture.per_group);
  EXPECT_EQ(picture.tile.x + picture.tile.y + picture.tile.width + picture.tile.height, 0);
}

TEST(Defaults, OfResults) {
  const ThingEmission thing;
  EXPECT_EQ(thing.center, vec3(0));
  EXPECT_EQ(thing.radius, 0);
  EXPECT_EQ(thing.paths, 0u);
  const RenderState state;
  EXPECT_EQ(state.passes_done, 0);
  EXPECT_EQ(state.paths, 0u);
  EXPECT_EQ(state.rays, 0u);
}

}  // namespace
}  // namespace ssphh::trace
