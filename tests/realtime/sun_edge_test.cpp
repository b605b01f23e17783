/// Edges of a sun's shadows in a wide view: as straight as what throws them.

#include <algorithm>
#include <cmath>
#include <limits>

#include <gmock/gmock.h>

#include "gl_context.h"
#include "pictures.h"
#include "stage.h"

namespace ssphh::test {
namespace {

constexpr PictureSize wide{320, 180};
constexpr float eye_height = 1.6f, distance_m = 12,
                half_view = 0.45f;  // tangent of half the picture's height
constexpr float wall_height = 3, overhang = 0.6f;
const vec3 toward_sun(0.5f, 0.6f, 0.62f);

class SunEdge : public WithGl {
 protected:
  /// A house on a plain, its wall seen from straight before it, and a sun from the upper right.
  static scene::Scene house(float sun_radius) {
    scene::Scene s;
    s.materials = {matte(vec3(0.5f))};
    add_mesh(s, scene::make_quad({-500, 0, 500}, {1000, 0, 0}, {0, 0, -1000}), 0);
    add_mesh(s, scene::make_box({-8, 0, -10}, {8, wall_height, 0}), 0);
    add_mesh(s, scene::make_box({-9, wall_height, -10}, {9, wall_height + 0.2f, overhang}), 0);
    scene::Node& eye = s.nodes.emplace_back();
    eye.local.translation = {0.01f, eye_height, distance_m};
    scene::Camera& camera = s.cameras.emplace_back();
    camera.node = static_cast<int>(s.nodes.size()) - 1;
    camera.yfov = 2 * std::atan(half_view);
    scene::Node& sky = s.nodes.emplace_back();
    sky.local.rotation = glm::quatLookAt(-glm::normalize(toward_sun), vec3(0, 1, 0));
    scene::Light& sun = s.lights.emplace_back();
    sun.type = scene::LightType::directional;
    sun.node = static_cast<int>(s.nodes.size()) - 1;
    sun.angular_radius = sun_radius;
    scene::validate(s);
    return s;
  }
  /// Rows from the picture's upper edge to this height on the wall.
  static float row_of(float height) {
    return 0.5f * wide.height * (1 - (height - eye_height) / (distance_m * half_view));
  }
};

TEST_F(SunEdge, UnderTheEavesOfAHouseOnAPlainIsStraightToAPixel) {
  // Of the four fine maps those around what the picture shows up to a depth leave teeth of 0.9 pixels here,
  // those around all that it might show up to there 1.6.
  for (const float radius : {0.0f, 0.0046f}) {
    const scene::Scene scene = house(radius);
    realtime::Renderer renderer(gl(), scene, {.sun_map_size = 300});
    realtime::FrameSettings settings;
    settings.view = realtime::View::direct;
    renderer.draw(scene::camera_pose(scene, ""), settings, {.width = wide.width, .height = wide.height});
    const image::Image picture = renderer.read_back();
    const float edge = row_of(wall_height - overhang * toward_sun.y / toward_sun.z);
    const int first = static_cast<int>(row_of(wall_height)) + 2, last = static_cast<int>(edge) + 12;
    const float lit = picture.rgb(wide.width / 2, last).x;
    ASSERT_GT(lit, 0);
    float least = std::numeric_limits<float>::max(), most = 0;
    for (int x = 60; x < 260; ++x) {
      float dark = 0;
      for (int y = first; y < last; ++y) dark += 1 - picture.rgb(x, y).x / lit;
      least = std::min(least, dark), most = std::max(most, dark);
    }
    EXPECT_NEAR(static_cast<float>(first) + 0.5f * (least + most), edge, 0.5f)
        << "of a sun with a radius of " << radius;
    EXPECT_LT(most - least, 1.1f) << "of a sun with a radius of " << radius;
  }
}

}  // namespace
}  // namespace ssphh::test
