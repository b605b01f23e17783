/// No light where every other method finds some.

#include <gtest/gtest.h>

#include "tests/even_rooms.h"

namespace ssphh::methods {
namespace {

TEST(Direct, AddsNothingToLitRooms) {
  const test::EvenRooms rooms(vec3(1), vec3(2), {{1, 1, 1}, {3.1f, 1, 1}});
  const auto method = test::made("direct", rooms.method_scene());
  for (const vec3& light : test::found(*method, rooms)) EXPECT_EQ(light, vec3(0));
  EXPECT_EQ(method->light().glossy({}, {0, 1, 0}, 0), vec3(0));
  EXPECT_EQ(method->memory().lookup + method->memory().update, 0u);
  EXPECT_EQ(rooms.rays_traced(), 0u);
}

}  // namespace
}  // namespace ssphh::methods
