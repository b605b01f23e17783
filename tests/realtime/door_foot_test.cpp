/// Light of records at the foot of a door so thin that it divides parts of the cells that list them.

#include <algorithm>

#include <gtest/gtest.h>

#include "gl_context.h"
#include "pictures.h"
#include "stage.h"

namespace ssphh::test {
namespace {

constexpr PictureSize size{96, 96};

using DoorFoot = WithGl;

TEST_F(DoorFoot, HasTheLightOfTheViewersSide) {
  // Two halves of a floor, bright and dark, a door of a centimetre between them. A part with floor of both
  // has no record that all of it sees; probes, which would answer then, are black.
  scene::Scene scene;
  scene.materials = {matte(vec3(0.5f))};
  add_mesh(scene, scene::make_quad({-2, 0, 2}, {2, 0, 0}, {0, 0, -4}), 0);
  add_mesh(scene, scene::make_quad({0, 0, 2}, {2, 0, 0}, {0, 0, -4}), 0);
  add_mesh(scene, scene::make_box({-0.005f, 0, -2}, {0.005f, 1, 2}), 0);
  scene::Node& eye = scene.nodes.emplace_back();
  eye.local.translation = {-0.4f, 0.5f, 0};
  eye.local.rotation = glm::quatLookAt(glm::normalize(vec3(0.4f, -0.5f, 0)), vec3(0, 1, 0));
  scene.cameras.emplace_back().node = static_cast<int>(scene.nodes.size()) - 1;
  scene::validate(scene);
  std::vector<rays::SurfacePoint> points;
  std::vector<probes::RecordLight> light;
  for (int i = 0; i < 256; ++i) {
    const vec3 place(0.25f * static_cast<float>(i % 16) - 1.875f, 0,
                     0.25f * static_cast<float>(i / 16) - 1.875f);
    points.push_back({place, {0, 1, 0}});
    light.emplace_back(0.0f);
    light.back()[3] = vec3(place.x < 0 ? 1 : 0);
  }
  const auto sees = [](const vec3& a, const vec3& b) {
    const auto side = [](float x) { return x <= -0.005f ? -1 : x >= 0.005f ? 1 : 0; };
    return side(a.x) == side(b.x) && side(a.x) != 0;
  };
  realtime::Renderer renderer(gl(), scene);
  renderer.set_probes(made_up_probes(std::vector{vec3(-1, 0.5f, 0)}));
  const sh::RadianceSh black(4);
  const int probe = 0;
  renderer.update_probes({&probe, 1}, {&black, 1});
  renderer.set_records(probes::prepare_surfaces(scene, 0, points, sees));
  renderer.set_record_light(light);
  realtime::FrameSettings settings;
  settings.weights = probes::WeightMethod::surface;
  settings.view = realtime::View::indirect;
  settings.indirect_scale = 1;
  renderer.draw(scene::camera_pose(scene, ""), settings, {.width = size.width, .height = size.height});
  const image::Image picture = renderer.read_back();
  // From the lower edge up the floor before the door, to half of the picture
  float least = 1e9f, most = 0;
  for (int y = size.height / 2 + 1; y < size.height; ++y) {
    for (int x = 0; x < size.width; ++x)
      least = std::min(least, picture.rgb(x, y).x), most = std::max(most, picture.rgb(x, y).x);
  }
  EXPECT_GT(most, 0.1f);
  EXPECT_GT(least, 0.97f * most);
}

}  // namespace
}  // namespace ssphh::test
