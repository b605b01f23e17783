#include <gtest/gtest.h>

#include <ssphh/core/math.h>
#include <ssphh/core/sphere.h>
#include <ssphh/image/sphere_map.h>
#include <ssphh/scene/query.h>
#include <ssphh/scene/studio.h>

namespace ssphh::scene {
namespace {

TEST(Studio, IsBrighterAboveAndSoftEverywhere) {
  constexpr int n = 4096;
  double above = 0, below = 0;
  float least = 1e9f, most = 0;
  for (int i = 0; i < n; ++i) {
    const vec3 d = spherical_fibonacci(i, n);
    const float light = studio_radiance(d);
    (d.y > 0 ? above : below) += static_cast<double>(light);
    least = std::min(least, light), most = std::max(most, light);
  }
  EXPECT_GT(above, 1.5 * below);
  EXPECT_GT(least, 0.2f) << "no side of a thing is black";
  EXPECT_LT(most, 20 * least);
  EXPECT_GT(most, 4 * least) << "a plain white one shows no shape";
  EXPECT_NEAR((above + below) / n, 0.7, 0.2);
}

TEST(Studio, IsANeutralEnvironmentThatIsTheOnlyGroup) {
  Scene scene;
  add_studio(scene);
  EXPECT_EQ(light_groups(scene), std::vector<std::string>{"studio"});
  EXPECT_TRUE(validate(scene).empty());
  const image::Image& picture = scene.environment->equirect;
  for (int i = 0; i < 64; ++i) {
    const vec3 d = spherical_fibonacci(i, 64), light = image::sample_equirect(picture, d);
    EXPECT_EQ(light, vec3(light.x));
    EXPECT_NEAR(light.x, studio_radiance(d), 0.01f);
  }
}

TEST(Studio, TakesThePlaceOfAnotherEnvironment) {
  Scene scene, other;
  scene.environment.emplace().color = vec3(7);
  add_studio(scene), add_studio(other);
  EXPECT_EQ(scene_hash(scene), scene_hash(other));
}

TEST(Studio, HasItsSoftLightsWhereTheyAreDescribed) {
  for (const vec3& lamp : {vec3(1, 1.6f, 1.2f), vec3(-2, 1, 0.5f)}) {
    const Frame around = Frame::around(glm::normalize(lamp));
    for (int i = 0; i < 8; ++i) {
      const float turn = 2 * pi * static_cast<float>(i) / 8;
      const vec3 beside = around.to_world({0.3f * std::cos(turn), 0.3f * std::sin(turn), 0.954f});
      EXPECT_LT(studio_radiance(beside), studio_radiance(glm::normalize(lamp))) << i;
    }
  }
}

}  // namespace
}  // namespace ssphh::scene
