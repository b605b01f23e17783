/// What a tetrahedron of probes gives, which knows no walls: their light by barycentric coordinates.

#include <gtest/gtest.h>

#include "tests/even_rooms.h"

namespace ssphh::methods {
namespace {

using test::expect_near;

TEST(IrradianceVolume, BlendsTheCornersOfATetrahedronThroughAWall) {
  const std::vector<vec3> probes{
      {0.3f, 0.4f, 0.3f}, {0.6f, 1.7f, 1.2f}, {3.8f, 0.3f, 1.1f}, {3.1f, 0.9f, 1.8f}};
  const test::EvenRooms rooms(vec3(1), vec3(3), probes);
  const auto method = test::made("irradiance-volume", rooms.method_scene(), {"places=scene"});
  const scene::LightingState state = rays::lighting_at(rooms, 0);
  method->update(state, {});
  const mat3 edges(probes[1] - probes[0], probes[2] - probes[0], probes[3] - probes[0]);
  for (const vec3& share : {vec3(0.2f, 0.3f, 0.1f), vec3(0.6f, 0.1f, 0.2f), vec3(0.05f, 0.1f, 0.8f)}) {
    const vec3 place = probes[0] + edges * share;
    const float of_second = share.y + share.z;
    const vec3 expected = glm::mix(rooms.answer(probes[0]), rooms.answer(probes[3]), of_second);
    for (const vec3& normal : {vec3(0, 1, 0), vec3(-1, 0, 0)})
      expect_near(method->light().irradiance({place, normal}), expected, 0.01f * expected.b);
  }
}

TEST(IrradianceVolume, OfOneRoomIsThatRoomsLightEverywhere) {
  const test::EvenRooms rooms(vec3(1, 2, 3), vec3(0), {{1, 1, 1}});
  const auto method = test::made("irradiance-volume", rooms.method_scene(),
                                 {"places=grid", "probes=8", "interpolation=trilinear"});
  for (const vec3& scale : {vec3(1), vec3(0.5f, 2, 4)}) {
    const std::vector<vec3> light = test::found(*method, rooms, scale);
    for (std::size_t i = 0; i < light.size() / 2; ++i)
      expect_near(light[i], scale * rooms.answer(vec3(0)),
                  0.01f * max_component(scale * rooms.answer(vec3(0))));
  }
}

}  // namespace
}  // namespace ssphh::methods
