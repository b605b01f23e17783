/// Threads look up while another dims lamps and swaps light: each lookup has light of before or after.

#include <atomic>
#include <thread>

#include <gtest/gtest.h>

#include "cooked_room.h"

namespace ssphh::test {
namespace {

TEST(RuntimeThreads, LookupsSeeOneOrTheOtherLight) {
  const OpenedFile day(cook_two_rooms(set_of_two_rooms(OnSurfaces::records, 2, 4), 8)),
      night(cook_two_rooms(set_of_two_rooms(OnSurfaces::records, 2, 77), 8));
  // The lamp alone, all colours at 1 or all at 0
  const float off[] = {0, 0, 0}, on[] = {1, 1, 1};
  for (const OpenedFile* file : {&day, &night}) {
    ssphh_runtime_set_group_scale(file->runtime, 0, on);
    for (std::uint32_t g = 1; g < 3; ++g) ssphh_runtime_set_group_scale(file->runtime, g, off);
  }
  const rays::SurfacePoint at{{-1, 0, 0.3f}, {0, 1, 0}};
  const vec3 by_day = day.irradiance(at), by_night = night.irradiance(at);
  ASSERT_NE(by_day, by_night);

  std::atomic<bool> stop = false;
  std::atomic<int> strange = 0, looked_up = 0;
  std::vector<std::jthread> readers;
  for (int t = 0; t < 3; ++t) {
    readers.emplace_back([&] {
      while (!stop) {
        vec3 e;
        ssphh_runtime_irradiance(day.runtime, 0, &at.position.x, &at.normal.x, &e.x);
        for (glm::length_t c = 0; c < 3; ++c)
          strange += e[c] != 0 && e[c] != by_day[c] && e[c] != by_night[c];
        ++looked_up;
      }
    });
  }
  for (int i = 0; i < 2000 || looked_up < 1000; ++i) {
    const std::vector<std::byte>& light = i % 2 ? day.bytes() : night.bytes();
    EXPECT_EQ(ssphh_runtime_swap_light(day.runtime, light.data(), light.size()), SSPHH_RUNTIME_OK);
    EXPECT_EQ(ssphh_runtime_set_group_scale(day.runtime, 0, i % 3 ? on : off), SSPHH_RUNTIME_OK);
  }
  stop = true;
  readers.clear();
  EXPECT_EQ(strange, 0) << "of " << looked_up;
}

}  // namespace
}  // namespace ssphh::test
