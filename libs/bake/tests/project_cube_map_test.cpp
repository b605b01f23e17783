#include "project_cube_map.h"

#include <gtest/gtest.h>

#include "error_message.h"

namespace ssphh::bake {
namespace {

TEST(ProjectCubeMap, RefusesFacesOfOtherChannels) {
  image::CubeMap cube(4);
  const sh::CubeProjector projector(1, 4);
  EXPECT_EQ(project_cube_map(projector, cube), sh::RadianceSh(1));
  cube.faces[3] = image::Image(4, 4, 1);
  EXPECT_EQ(test::message_of([&] { project_cube_map(projector, cube); }),
            "cube map: its faces differ in channels");
}

}  // namespace
}  // namespace ssphh::bake
