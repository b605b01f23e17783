// Virtual lights merged into fewer ones of the same power.

#include <cmath>
#include <numeric>

#include <gtest/gtest.h>

#include <ssphh/core/random.h>
#include <ssphh/core/sphere.h>
#include <ssphh/methods/vpl/virtual_lights.h>

#include "transfer.h"

namespace ssphh::methods::vpl {
namespace {

/// On the six walls of a room of edge 2 around the origin, shining inward; one in ten is ten times as bright.
std::vector<Vpl> lights_on_walls(int count) {
  Pcg32 random(5);
  std::vector<Vpl> lights;
  for (int i = 0; i < count; ++i) {
    const int axis = i % 3;
    const float sign = i % 2 == 0 ? 1.0f : -1.0f;
    vec3 place = 2.0f * random.uniform3() - 1.0f, normal(0);
    place[axis] = sign, normal[axis] = -sign;
    lights.push_back({place, normal, (i % 10 == 0 ? 10.0f : 1.0f) * (0.5f + random.uniform3()), 0.1f});
  }
  return lights;
}

glm::dvec3 power_of(const std::vector<Vpl>& lights) {
  return std::accumulate(lights.begin(), lights.end(), glm::dvec3(0),
                         [](const glm::dvec3& sum, const Vpl& l) { return sum + glm::dvec3(l.power); });
}

double irradiance(const Receiver& at, const std::vector<Vpl>& lights) {
  double sum = 0;
  for (const Vpl& light : lights)
    sum += static_cast<double>(unbounded_transfer(at, light) * luminance(light.power) / pi);
  return sum;
}

TEST(MergeLights, KeepsPowerAndPlaces) {
  const std::vector<Vpl> lights = lights_on_walls(1000);
  for (const std::size_t most : {1, 2, 7, 100, 999}) {
    const std::vector<Vpl> merged = merge_lights(lights, most);
    ASSERT_EQ(merged.size(), most);
    const glm::dvec3 before = power_of(lights), after = power_of(merged);
    for (int c = 0; c < 3; ++c) EXPECT_NEAR(after[c] / before[c], 1, 1e-5) << most;
    std::size_t from = 0;
    for (const Vpl& light : merged) {
      while (from < lights.size() && lights[from].position != light.position) ++from;
      ASSERT_LT(from, lights.size()) << "in the order of the lights, each at the place of another";
      EXPECT_EQ(light.normal, lights[from].normal);
      EXPECT_EQ(light.radius, lights[from].radius);
      ++from;
    }
  }
}

TEST(MergeLights, LeavesFewAsTheyAreAndTakesAllAtOnePlace) {
  const std::vector<Vpl> lights = lights_on_walls(20);
  for (const std::size_t most : {20, 21, 1000}) {
    const std::vector<Vpl> same = merge_lights(lights, most);
    ASSERT_EQ(same.size(), lights.size());
    for (std::size_t i = 0; i < same.size(); ++i) EXPECT_EQ(same[i].power, lights[i].power);
  }
  EXPECT_TRUE(merge_lights(lights, 0).empty());
  EXPECT_TRUE(merge_lights({}, 3).empty());
  const std::vector<Vpl> one_place(9, lights[0]);
  EXPECT_EQ(merge_lights(one_place, 4).size(), 4u);
}

TEST(MergeLights, ErrLessTheMoreAreLeft) {
  const std::vector<Vpl> lights = lights_on_walls(4096);
  std::vector<double> errors;
  for (const std::size_t most : {16, 256, 2048}) {
    const std::vector<Vpl> merged = merge_lights(lights, most);
    Pcg32 random(9);
    double error = 0;
    constexpr int places = 64;
    for (int i = 0; i < places; ++i) {
      const Receiver at{1.2f * random.uniform3() - 0.6f, sample_uniform_sphere(random.uniform2())};
      const double all = irradiance(at, lights);
      error += std::abs(irradiance(at, merged) - all) / all / places;
    }
    errors.push_back(error);
  }
  // Independent lights err by 1/√n: sixteen times as many, a quarter; leave room for chance.
  EXPECT_LT(errors[1], 0.5 * errors[0]);
  EXPECT_LT(errors[2], 0.5 * errors[1]);
  EXPECT_LT(errors[2], 0.03);
}

}  // namespace
}  // namespace ssphh::methods::vpl
