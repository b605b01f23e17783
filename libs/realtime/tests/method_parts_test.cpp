/// What method lights take of OpenGL's memory, and where things stand in it; without OpenGL.

#include <gmock/gmock.h>

#include "virtual_light_maps.h"
#include "volume_layout.h"

namespace ssphh::realtime {
namespace {

constexpr std::size_t mib = std::size_t{1} << 20;

TEST(VirtualMapPlan, TakesTheLargestMapsThatFitAndThenFewerLights) {
  int cut = 0;
  for (const std::size_t bytes : {mib / 2, mib, 24 * mib, 64 * mib, 128 * mib, 128 * mib + 5, 1024 * mib}) {
    for (const std::size_t lights :
         {0u, 1u, 2u, 20u, 41u, 170u, 171u, 682u, 683u, 838u, 1365u, 5461u, 5462u, 40000u, 4000000u}) {
      const VirtualMapPlan plan = plan_virtual_maps(lights, bytes);
      EXPECT_LE(MapAtlas::bytes_of(plan.size, 6 * plan.lights), bytes) << lights;
      EXPECT_LE(plan.lights, static_cast<int>(lights));
      if (plan.lights == static_cast<int>(lights)) {
        if (plan.size < 256 && lights < 100000) {
          EXPECT_GT(MapAtlas::bytes_of(2 * plan.size, 6 * plan.lights), bytes) << lights;
        }
      } else {
        ++cut;
        EXPECT_EQ(plan.size, 32);
        EXPECT_GT(MapAtlas::bytes_of(32, 6 * (plan.lights + 1)), bytes) << lights;
      }
    }
  }
  EXPECT_GT(cut, 10);
  EXPECT_EQ(plan_virtual_maps(838, 128 * mib).size, 64);
  EXPECT_EQ(plan_virtual_maps(100000, 128 * mib).lights, 5461);
  EXPECT_EQ(plan_virtual_maps(3, 1000).lights, 0);
}

TEST(VolumeLayout, LevelsWithTheirBordersStandApartWithinThePart) {
  const std::vector<vec3> extents = {{1, 1, 1}, {8.2f, 3, 4}, {1, 20, 0.1f}, {0.1f, 0.1f, 5}, {30, 12, 19}};
  for (const vec3& extent : extents) {
    for (const int resolution : {8, 32, 128, 512}) {
      const methods::vct::VoxelGrid grid = methods::vct::make_grid({vec3(-1), vec3(-1) + extent}, resolution);
      const VolumeLayout layout(grid);
      ASSERT_EQ(static_cast<int>(layout.cells.size()), grid.levels());
      std::size_t needed = 0;
      for (std::size_t a = 0; a < layout.cells.size(); ++a) {
        const ivec3 low = layout.first[a] - 1, high = layout.first[a] + layout.cells[a] + 1;
        EXPECT_TRUE(glm::all(glm::greaterThanEqual(low, ivec3(0))));
        EXPECT_TRUE(glm::all(glm::lessThanEqual(high, layout.part)));
        needed += static_cast<std::size_t>(layout.cells[a].x) * static_cast<std::size_t>(layout.cells[a].y) *
                  static_cast<std::size_t>(layout.cells[a].z) * 6 * 8;
        for (std::size_t b = 0; b < a; ++b) {
          const ivec3 low_b = layout.first[b] - 1, high_b = layout.first[b] + layout.cells[b] + 1;
          EXPECT_TRUE(glm::any(glm::greaterThanEqual(low, high_b)) ||
                      glm::any(glm::greaterThanEqual(low_b, high)))
              << a << " and " << b;
        }
      }
      EXPECT_GE(layout.bytes(), needed);
    }
  }
}

}  // namespace
}  // namespace ssphh::realtime
