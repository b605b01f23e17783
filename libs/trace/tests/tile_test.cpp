#include <gtest/gtest.h>

#include <ssphh/scene/builtin.h>
#include <ssphh/scene/query.h>
#include <ssphh/trace/path_tracer.h>

namespace ssphh::trace {
namespace {

RenderParams params_of(const scene::Scene& scene) {
  RenderParams params;
  params.width = 37, params.height = 21;
  params.camera = scene::camera_pose(scene, "", 0);
  params.path = {3, 3, 2, 7};
  params.per_group = true;
  return params;
}

TEST(RenderTile, TilesOfAnySizeGiveTheBitsOfTheWholePicture) {
  const scene::Scene scene = scene::make_builtin("gallery1");
  const PathTracer tracer(scene);
  RenderParams params = params_of(scene);
  RenderState whole;
  tracer.render(params, whole);

  RenderState pasted = empty_state(params, tracer.light_groups().size());
  for (int y = 0; y < params.height; y += 10) {
    for (int x = 0; x < params.width; x += 16) {
      params.tile = {x, y, std::min(16, params.width - x), std::min(10, params.height - y)};
      RenderState part;
      tracer.render(params, part);
      paste(pasted, part, params.tile);
    }
  }
  EXPECT_EQ(pasted.color.pixels, whole.color.pixels);
  EXPECT_EQ(pasted.direct.pixels, whole.direct.pixels);
  EXPECT_EQ(pasted.indirect.pixels, whole.indirect.pixels);
  EXPECT_EQ(pasted.albedo.pixels, whole.albedo.pixels);
  EXPECT_EQ(pasted.normal.pixels, whole.normal.pixels);
  EXPECT_EQ(pasted.depth.pixels, whole.depth.pixels);
  EXPECT_EQ(pasted.coverage.pixels, whole.coverage.pixels);
  ASSERT_EQ(pasted.groups.size(), whole.groups.size());
  for (std::size_t g = 0; g < whole.groups.size(); ++g)
    EXPECT_EQ(pasted.groups[g].pixels, whole.groups[g].pixels);
  EXPECT_EQ(pasted.paths, whole.paths);
  EXPECT_EQ(pasted.rays, whole.rays);
}

TEST(RenderTile, TileOutsideThePictureIsRefused) {
  const scene::Scene scene = scene::make_builtin("cornell");
  const PathTracer tracer(scene);
  RenderParams params = params_of(scene);
  params.tile = {30, 0, 8, 8};
  RenderState state;
  EXPECT_THROW(tracer.render(params, state), Error);
}

}  // namespace
}  // namespace ssphh::trace
