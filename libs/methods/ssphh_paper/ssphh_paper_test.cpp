/// SPHLs as lights where their light is known: I = L / (N·L), which makes the irradiance π L at any angle.

#include <cmath>

#include <gtest/gtest.h>

#include "tests/even_rooms.h"

namespace ssphh::methods {
namespace {

using test::EvenRooms;
using test::expect_near;

const std::vector<vec3> one_in_each{{1.2f, 1.2f, 0.9f}, {3.1f, 0.8f, 1.2f}};
const std::vector<std::string> coarse{"degree=2", "face=8", "viz_spp=4", "layer=self"};

TEST(SsphhPaper, LightsEachPointByTheNearestSphlThatItSees) {
  const EvenRooms rooms(vec3(1), vec3(3, 2, 1), one_in_each);
  const std::vector<vec3> light =
      test::found(*test::made("ssphh-paper", rooms.method_scene(), coarse), rooms);
  const std::vector<rays::SurfacePoint> points = EvenRooms::points();
  for (std::size_t i = 0; i < points.size(); ++i)
    expect_near(light[i], rooms.answer(points[i].position), 1e-3f * max_component(light[i]));
}

// GEN is the groups' light at full strength: what dims them afterwards traces nothing.
TEST(SsphhPaper, DimsGroupsWithoutTracing) {
  const EvenRooms rooms(vec3(1), vec3(3, 2, 1), one_in_each);
  const auto method = test::made("ssphh-paper", rooms.method_scene(), coarse);
  const std::vector<vec3> before = test::found(*method, rooms);
  EXPECT_EQ(rooms.traced, 1);
  const std::vector<vec3> dimmed = test::found(*method, rooms, vec3(0.25f, 0.5f, 2));
  EXPECT_EQ(rooms.traced, 1);
  for (std::size_t i = 0; i < before.size(); ++i)
    expect_near(dimmed[i], vec3(0.25f, 0.5f, 2) * before[i], 1e-5f * max_component(before[i]));
}

// A neighbour of radius r at distance d fills the share (1 − √(1 − r²/d²)) / 2 of the directions, and sends
// the mean of its light from there.
TEST(SsphhPaper, AddsWhatANeighbourSends) {
  const EvenRooms rooms(vec3(1), vec3(3), {{0.6f, 1, 1}, {1.4f, 1, 1}, {3.1f, 1, 1}});
  const auto of_layer = [&](const char* layer) {
    const auto method =
        test::made("ssphh-paper", rooms.method_scene(),
                   {"degree=0", "face=32", "viz_spp=16", "viz_source=radiance", "operator=mean", layer});
    const std::vector<vec3> light = test::found(*method, rooms);
    EXPECT_EQ(method->numbers()[1].second, 2)
        << "edges: from one of the pair to the other, none through the wall";
    return light;
  };
  const std::vector<vec3> self = of_layer("layer=self"), neighbor = of_layer("layer=neighbor"),
                          sum = of_layer("layer=sum");
  const float share = 0.5f * (1 - std::sqrt(1 - 0.1f * 0.1f / (0.8f * 0.8f)));
  for (std::size_t i = 0; i < sum.size(); ++i) {
    const bool alone = EvenRooms::in_second(EvenRooms::points()[i].position);
    const vec3 expected = alone ? vec3(0) : share * self[i];
    expect_near(neighbor[i], expected, 0.05f * max_component(expected));
    expect_near(sum[i], self[i] + neighbor[i], 1e-5f * max_component(self[i]));
  }
}

}  // namespace
}  // namespace ssphh::methods
