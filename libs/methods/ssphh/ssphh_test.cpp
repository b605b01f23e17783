/// Light of either of two rooms, whatever stands in for the probes: a wall of 10 cm is between them.

#include <gtest/gtest.h>

#include "tests/even_rooms.h"

namespace ssphh::methods {
namespace {

using test::EvenRooms;
using test::expect_near;

class Ssphh : public testing::TestWithParam<const char*> {};

TEST_P(Ssphh, KeepsTheLightOfEitherRoomThere) {
  const EvenRooms rooms(vec3(1), vec3(3, 2, 1),
                        {{1.6f, 0.6f, 0.7f}, {0.6f, 1.3f, 1.4f}, {2.4f, 1.2f, 0.8f}, {3.6f, 0.7f, 1.3f}});
  const auto method =
      test::made("ssphh", rooms.method_scene(),
                 {"places=scene", std::string("weights=") + GetParam(), "surfel_size=0.4", "records=512"});
  const std::vector<rays::SurfacePoint> points = EvenRooms::points();
  // Fitted weights need not sum to 1: here they miss it by up to 5 %.
  const float tolerance = std::string(GetParam()) == "fitted" ? 0.07f : 0.01f;
  for (const vec3& scale : {vec3(1), vec3(2, 0.5f, 1), vec3(0)}) {
    const std::vector<vec3> light = test::found(*method, rooms, scale);
    for (std::size_t i = 0; i < points.size(); ++i) {
      SCOPED_TRACE(i);
      const vec3 expected = scale * rooms.answer(points[i].position);
      expect_near(light[i], expected, tolerance * max_component(expected));
    }
  }
}

INSTANTIATE_TEST_SUITE_P(Weights, Ssphh,
                         testing::Values("distance", "trilinear", "mls", "fitted", "surface", "gather"),
                         [](const auto& weights) { return std::string(weights.param); });

}  // namespace
}  // namespace ssphh::methods
