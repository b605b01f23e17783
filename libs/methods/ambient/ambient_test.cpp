/// The constant against the energy balance of a room in which it is the whole answer.

#include <gtest/gtest.h>

#include "tests/even_rooms.h"

namespace ssphh::methods {
namespace {

using test::EvenRooms;
using test::expect_near;

TEST(Ambient, IsAllLightOfAnEvenRoom) {
  const vec3 direct(1, 2, 3);
  const EvenRooms rooms(direct, direct, {{1, 1, 1}});
  for (const vec3& light : test::found(*test::made("ambient", rooms.method_scene()), rooms))
    expect_near(light, rooms.answer(vec3(0)), 1e-3f);
  const auto twice = test::made("ambient", rooms.method_scene(), {"factor=2"});
  for (const vec3& light : test::found(*twice, rooms, vec3(3, 1, 1)))
    expect_near(light, 2.0f * vec3(3, 1, 1) * rooms.answer(vec3(0)), 3e-3f);
}

TEST(Ambient, IsTheMeanOfWhatTheScenesSphlsReach) {
  // Both rooms, as large as each other; then the first alone. Points are drawn: 65536 leave 0.4 %.
  const vec3 first(1), second(3);
  const EvenRooms both(first, second, {{1, 1, 1}, {3.1f, 1, 1}}), one(first, second, {{1, 1, 1}});
  const std::vector<std::string> points{"points=65536"};
  const vec3 mean = 0.5f * (both.answer(vec3(0)) + both.answer(vec3(3, 0, 0)));
  const vec3 found = test::found(*test::made("ambient", both.method_scene(), points), both)[0];
  for (int c = 0; c < 3; ++c) EXPECT_NEAR(found[c], mean[c], 0.02f * mean[c]);
  expect_near(test::found(*test::made("ambient", one.method_scene(), points), one)[0], one.answer(vec3(0)),
              1e-3f);
}

TEST(Ambient, MirrorsAsMuchFromEverywhere) {
  const EvenRooms rooms(vec3(1), vec3(1), {{1, 1, 1}});
  const auto method = test::made("ambient", rooms.method_scene());
  test::found(*method, rooms);
  for (const rays::SurfacePoint& point : EvenRooms::points())
    expect_near(method->light().glossy(point, {0, 0, 1}, 0.3f), rooms.answer(vec3(0)) / pi, 1e-3f);
}

}  // namespace
}  // namespace ssphh::methods
