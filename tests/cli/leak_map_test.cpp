// The picture of leaks: rays through the pixels' centres, the share of the mean at each dark one, and its
// colours.

#include "results/leak_map.h"

#include <cmath>
#include <functional>

#include <gtest/gtest.h>

#include <ssphh/core/file.h>
#include <ssphh/image/io.h>
#include <ssphh/metrics/heat_map.h>
#include <ssphh/scene/lambertian.h>
#include <ssphh/scene/primitives.h>
#include <ssphh/trace/path_tracer.h>
#include <ssphh/trace/transport_scene.h>

#include "temp_dir.h"

namespace ssphh::app {
namespace {

/// Everywhere as much as x + 2 y says, and black elsewhere.
class Slope final : public rays::IndirectLight {
 public:
  vec3 irradiance(const rays::SurfacePoint& at) const override {
    return vec3(std::max(0.0f, at.position.x + 2 * at.position.y));
  }
  vec3 glossy(const rays::SurfacePoint&, const vec3&, float) const override { return vec3(0); }
};

/// A tilted quad of albedo 0.6, five to seven metres before a camera at (0, 0, 5), in a scene without light.
class LeakPicture : public testing::Test {
 protected:
  static scene::Scene make_scene() {
    scene::Scene scene;
    scene.nodes.emplace_back();
    scene.materials.emplace_back().base_color = vec3(0.6f);
    scene.meshes = {scene::make_quad({-1, -0.5f, 0.5f}, {3, 0, -1}, {0, 2, -1})};
    scene.instances = {{0, 0, 0, ""}};
    return scene::lambertian(std::move(scene));
  }
  LeakPicture() {
    pose_.world = mat4(1);
    pose_.world[3] = vec4(0, 0, 5, 1);
    params_.path = {.max_depth = 2, .passes = 1, .spp = 2, .seed = 0};
    params_.mean = 4;
  }
  LeakMap map() const {
    return leak_map(trace::TransportScene(scene_), 0, pose_, width, height, trace::PathTracer(scene_),
                    Slope(), params_, {});
  }
  /// Each pixel against the ray through its centre; true where the quad is hit.
  void expect_pixels(const LeakMap& map,
                     const std::function<void(float u, float v, vec3& eye, vec3& d)>& ray) {
    // Barycentrics of the quad: p = corner + s a + t b
    const vec3 corner(-1, -0.5f, 0.5f), a(3, 0, -1), b(0, 2, -1), normal = glm::normalize(glm::cross(a, b));
    std::size_t hit = 0;
    for (int y = 0; y < height; ++y) {
      for (int x = 0; x < width; ++x) {
        vec3 eye(0), d(0);
        ray((static_cast<float>(x) + 0.5f) / width * 2 - 1, 1 - (static_cast<float>(y) + 0.5f) / height * 2,
            eye, d);
        const float distance = glm::dot(corner - eye, normal) / glm::dot(d, normal);
        const vec3 p = eye + distance * d;
        const float s = (p.x - corner.x) / 3, t = (p.y - corner.y) / 2;
        const bool inside = s > 0 && s < 1 && t > 0 && t < 1;
        hit += inside ? 1 : 0;
        const float grey = inside ? 0.5f * 0.6f * std::abs(glm::dot(normal, d)) : 0;
        const float leaked = inside ? std::max(0.0f, p.x + 2 * p.y) / 4 : 0;
        EXPECT_NEAR(map.grey.at(x, y)[0], grey, 1e-5f) << x << ", " << y;
        EXPECT_NEAR(map.leaked.at(x, y)[0], leaked, 1e-5f) << x << ", " << y;
      }
    }
    EXPECT_GT(hit, 15u);
    EXPECT_LT(hit, static_cast<std::size_t>(width * height));
    EXPECT_EQ(map.dark, hit) << "in a scene without light each place is dark";
  }

  static constexpr int width = 10, height = 7;
  const scene::Scene scene_ = make_scene();
  scene::CameraPose pose_;
  study::LeakParams params_;
};

TEST_F(LeakPicture, LooksThroughThePixelsCentres) {
  pose_.camera.yfov = 0.6f;
  expect_pixels(map(), [](float u, float v, vec3& eye, vec3& d) {
    const float half = std::tan(0.3f);
    eye = vec3(0, 0, 5);
    d = glm::normalize(vec3(u * half * width / height, v * half, -1));
  });
}

TEST_F(LeakPicture, OfAnOrthographicCameraHasParallelRays) {
  pose_.camera.orthographic = true;
  pose_.camera.yheight = 3;
  pose_.world[0] *= 2.0f;  // a node's scale is not the camera's
  expect_pixels(map(), [](float u, float v, vec3& eye, vec3& d) {
    eye = vec3(u * 1.5f * width / height, v * 1.5f, 5);
    d = vec3(0, 0, -1);
  });
}

TEST_F(LeakPicture, OfNothingIsBlack) {
  pose_.world[2] *= -1.0f;  // looks away
  const LeakMap nothing = map();
  EXPECT_EQ(nothing.dark, 0u);
  EXPECT_EQ(nothing.grey.pixels, std::vector<float>(70, 0));
  EXPECT_EQ(nothing.leaked.pixels, std::vector<float>(70, 0));
}

TEST(LeakColours, HideTheSceneOnlyWhereAHundredthOfTheScaleLeaks) {
  const test::TempDir dir;
  LeakMap map{image::Image(5, 1, 1), image::Image(5, 1, 1), 4};
  map.grey.pixels = {0.25f, 0.5f, 0.75f, 1, 0.125f};
  map.leaked.pixels = {0, 0.0049f, 0.0051f, 0.5f, 0.5f};
  const float scale = write_leak_map(dir / "a.png", map);
  EXPECT_EQ(scale, metrics::automatic_scale(map.leaked));
  ASSERT_EQ(scale, 0.5f);
  const image::Rgba8 grey = metrics::heat_map(map.grey, metrics::ColorRamp::grey, 1),
                     hot = metrics::heat_map(map.leaked, metrics::ColorRamp::inferno, scale);
  image::Rgba8 wanted = grey;
  std::copy(hot.rgba.begin() + 8, hot.rgba.end(), wanted.rgba.begin() + 8);
  image::write_image(dir / "wanted.exr", map.leaked);
  EXPECT_EQ(read_file(dir / "a.png"), image::encode_png(wanted));
  EXPECT_EQ(write_leak_map(dir / "a.exr", map), 0) << "numbers have no scale";
  EXPECT_EQ(read_file(dir / "a.exr"), read_file(dir / "wanted.exr"));
}

}  // namespace
}  // namespace ssphh::app
