/// Ambient occlusion: the share of the hemisphere's cosine lobe that near surfaces close, where that is
/// known.

#include <algorithm>
#include <random>

#include <gmock/gmock.h>

#include "gl_context.h"
#include "pictures.h"
#include "stage.h"

namespace ssphh::test {
namespace {

using realtime::FrameSettings;
using realtime::Renderer;

constexpr int columns = 48, rows = 32;
constexpr float width = 2.4f, step_height = 0.3f;

/// A floor seen from straight above, and to the right of x = 0 a step up.
scene::Scene step_up() {
  scene::Scene s;
  s.materials = {matte(vec3(0.5f))};
  add_mesh(s, scene::make_quad({-9, 0, 9}, {18, 0, 0}, {0, 0, -18}), 0);
  add_mesh(s, scene::make_quad({0, step_height, 9}, {9, 0, 0}, {0, 0, -18}), 0);
  scene::Node& eye = s.nodes.emplace_back();
  eye.local.translation = {0, 3, 0};
  eye.local.rotation = glm::quatLookAt(vec3(0, -1, 0), vec3(0, 0, -1));
  s.cameras.emplace_back().node = static_cast<int>(s.nodes.size()) - 1;
  s.cameras[0].orthographic = true, s.cameras[0].yheight = width * rows / columns;
  scene::validate(s);
  return s;
}

class Occlusion : public WithGl {
 protected:
  /// Mean over each column of how open the surface is.
  static std::vector<double> open(Renderer& renderer, const scene::Scene& scene, float radius) {
    const auto draw = [&](bool occlusion) {
      FrameSettings settings;
      settings.view = realtime::View::indirect;
      settings.ambient_occlusion = occlusion, settings.occlusion_radius = radius;
      renderer.draw(scene::camera_pose(scene, ""), settings, {.width = columns, .height = rows});
      return renderer.read_back();
    };
    const image::Image bare = draw(false), closed = draw(true);
    std::vector<double> found;
    for (int x = 0; x < columns; ++x) {
      double sum = 0;
      for (int y = 0; y < rows; ++y) {
        const float share = closed.rgb(x, y).y / bare.rgb(x, y).y;
        EXPECT_NEAR(16 * share, std::round(16 * share), 0.02f) << "one of sixteen samples is in sight or not";
        sum += static_cast<double>(share) / rows;
      }
      found.push_back(sum);
    }
    return found;
  }
  /// Of the floor at x: samples in the cosine lobe, as far away as a tenth of the radius to all of it; those
  /// that come out behind a surface by a hundredth of the radius or more, and less than the radius, are
  /// closed.
  static double expected(float x, float radius) {
    constexpr int side = 48;
    int closed = 0;
    for (int i = 0; i < side * side * 40; ++i) {
      const float u = (static_cast<float>(i % side) + 0.5f) / side,
                  phi = 2 * pi * (static_cast<float>(i / side % side) + 0.5f) / side;
      const float reach = radius * (0.1f + 0.9f * (static_cast<float>(i / (side * side)) + 0.5f) / 40);
      const float across = reach * std::sqrt(u) * std::cos(phi),
                  up = reach * std::sqrt(1 - u) + 0.01f * radius;
      const float behind = (x + across > 0 ? step_height : 0) - up;
      closed += behind > 0.01f * radius && behind < radius;
    }
    return 1 - closed / static_cast<double>(side * side * 40);
  }
};

TEST_F(Occlusion, OfAStepIsTheShareOfTheLobeBehindIt) {
  const scene::Scene scene = step_up();
  Renderer renderer(gl(), scene);
  renderer.set_probes(made_up_probes(std::vector{vec3(0, 2, 0)}));
  for (const float radius : {0.5f, 0.9f}) {
    const std::vector<double> found = open(renderer, scene, radius);
    for (int x = 0; x < columns; ++x) {
      SCOPED_TRACE(testing::Message() << "column " << x << ", radius " << radius);
      const float place = (static_cast<float>(x) + 0.5f) / columns * width - 0.5f * width;
      const double mean = found[x];
      if (place > 0 || place < -radius) {
        EXPECT_EQ(mean, 1) << "nothing stands higher";
      } else if (place < -1.5f * width / columns) {
        // 512 samples, of which the sixteen of a pixel are spread; five standard errors as if they were not.
        // Depth is that of a whole pixel: the step's edge lies in the middle of none
        const double truth = expected(place, radius);
        EXPECT_NEAR(mean, truth, 5 * std::sqrt(std::max(truth * (1 - truth), 1e-3) / (16.0 * rows)) + 0.01);
      }
    }
  }
}

TEST_F(Occlusion, IsOffForNoRadiusAndOfAFlatFloor) {
  const scene::Scene scene = step_up();
  Renderer renderer(gl(), scene);
  renderer.set_probes(made_up_probes(std::vector{vec3(0, 2, 0)}));
  for (const double mean : open(renderer, scene, 0)) EXPECT_EQ(mean, 1);
}

}  // namespace
}  // namespace ssphh::test
