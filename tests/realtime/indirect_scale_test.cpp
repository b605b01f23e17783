/// Indirect light looked up at some pixels only: what stands between them is interpolated where that hardly
/// differs.

#include <gmock/gmock.h>

#include <ssphh/scene/builtin.h>
#include <ssphh/scene/primitives.h>

#include "gl_context.h"
#include "pictures.h"

namespace ssphh {
namespace {

using realtime::FrameSettings;
using realtime::Renderer;
using realtime::Target;

class IndirectScale : public test::WithGl {
 protected:
  static image::Image draw(Renderer& renderer, const scene::Scene& scene, FrameSettings settings,
                           const Target& target) {
    settings.view = realtime::View::indirect;
    renderer.draw(scene::camera_pose(scene, ""), settings, target);
    return renderer.read_back();
  }
};

struct ScaleDifference {
  double mean = 0;   ///< of absolute differences, by the mean of the first picture
  double other = 0;  ///< share of the pixels that are not the same
  double off = 0;    ///< share of those that differ by more than allowed
};

/// `allowed` of the brighter, and what no display shows.
ScaleDifference difference(const image::Image& a, const image::Image& b, float allowed) {
  ScaleDifference found;
  double sum = 0;
  for (int y = 0; y < a.height; ++y) {
    for (int x = 0; x < a.width; ++x) {
      const vec3 p = a.rgb(x, y), q = b.rgb(x, y);
      const float apart = max_component(glm::abs(p - q)), most = max_component(glm::max(p, q));
      found.other += apart > 1e-5f * most;
      found.off += apart > allowed * most + 2.0f / 4096;
      found.mean += static_cast<double>(luminance(glm::abs(p - q)));
      sum += static_cast<double>(luminance(p));
    }
  }
  const double pixels = static_cast<double>(a.width) * a.height;
  return {found.mean / sum, found.other / pixels, found.off / pixels};
}

constexpr float half_float = 1.0f / 1024;  // what images of them round, twice

/// A pixel between others that agree up to a share lies within it of the exact one, but for what is smaller
/// than a cell.
TEST_F(IndirectScale, PixelsBetweenThoseLookedUpDifferByNoMoreThanTheTolerance) {
  const scene::Scene scene = scene::make_builtin("two-rooms");
  const Target target{.width = 64, .height = 36};
  Renderer renderer(gl(), scene);
  renderer.set_probes(test::made_up_probes(scene));
  for (const bool occlusion : {false, true}) {
    FrameSettings settings;
    settings.ambient_occlusion = occlusion;
    const image::Image exact = draw(renderer, scene, settings, target);
    for (const int scale : {2, 3, 5}) {
      for (const float tolerance : {0.0f, 0.05f, 1.0f}) {
        SCOPED_TRACE(testing::Message() << scale << ", " << tolerance << ", occlusion " << occlusion);
        settings.indirect_scale = scale;
        settings.indirect_tolerance = tolerance;
        const ScaleDifference found =
            difference(exact, draw(renderer, scene, settings, target), tolerance + half_float);
        EXPECT_EQ(found.off, 0);
        // Halves err by a quarter of 2^-10 in the mean; with any tolerance interpolation was seen to by 0.021
        EXPECT_LT(found.mean, 0.00025 + 0.022 * static_cast<double>(tolerance));
        EXPECT_GT(found.other, tolerance > 0 ? 0.05 : 0) << "nothing is interpolated";
      }
    }
  }
}

/// Posts thinner than a cell stand before a wall that is lit otherwise.
TEST_F(IndirectScale, WhatStandsBeforeAWallKeepsItsOwnLight) {
  scene::Scene scene;
  scene.materials.resize(1);
  scene.materials[0].specular = 0;
  const auto add = [&](const scene::Mesh& mesh) {
    scene.meshes.push_back(mesh);
    scene::Instance instance;
    instance.mesh = static_cast<int>(scene.meshes.size()) - 1;
    instance.node = 0;
    scene.instances.push_back(instance);
  };
  scene.nodes.resize(2);
  add(scene::make_quad({-4, -3, 0}, {8, 0, 0}, {0, 6, 0}));
  for (int i = 0; i < 12; ++i)
    add(scene::make_quad({-2 + 0.31f * static_cast<float>(i), -3, 1}, {0.06f, 0, 0}, {0, 6, 0}));
  scene.nodes[1].local.translation = {0, 0, 4};
  scene::Camera camera;
  camera.node = 1;
  scene.cameras.push_back(camera);
  scene::validate(scene);
  // Dim between wall and posts, bright before the posts
  probes::ProbeSet probes = test::made_up_probes({{0, 0, 0.5f}, {0, 0, 2}});
  for (probes::GroupLight& light : probes.probes[1].groups) light.reflected *= vec3(20);
  probes::merge_groups(probes);
  Renderer renderer(gl(), scene);
  renderer.set_probes(probes);
  FrameSettings settings;
  settings.weights = probes::WeightMethod::distance;
  settings.indirect_tolerance = 1;  // light agrees everywhere: places must tell
  const Target target{.width = 192, .height = 108};
  const image::Image exact = draw(renderer, scene, settings, target);
  settings.indirect_scale = 4;
  const image::Image some = draw(renderer, scene, settings, target);
  EXPECT_GT(difference(exact, some, 0).other, 0.3) << "nothing is interpolated";
  // The wall's light has edges, the posts' shadows, which this tolerance blurs
  settings.view = realtime::View::depth;
  renderer.draw(scene::camera_pose(scene, ""), settings, target);
  const image::Image depth = renderer.read_back();
  int posts = 0;
  for (int y = 0; y < exact.height; ++y) {
    for (int x = 0; x < exact.width; ++x) {
      if (depth.rgb(x, y).x > 0.77f) continue;  // 3 m: 0.75, 4 m: 0.8
      ++posts;
      EXPECT_NEAR(luminance(some.rgb(x, y)) / luminance(exact.rgb(x, y)), 1, 0.05) << x << ", " << y;
    }
  }
  EXPECT_GT(posts, 1000);
}

/// More than a row of groups: 1024 of 64.
TEST_F(IndirectScale, ManyPixelsThatDifferAreAllLookedUp) {
  const scene::Scene scene = scene::make_builtin("two-rooms");
  Renderer renderer(gl(), scene);
  renderer.set_probes(test::made_up_probes(scene));
  FrameSettings settings;
  settings.weights = probes::WeightMethod::distance;
  const Target target{.width = 480, .height = 320};
  const image::Image exact = draw(renderer, scene, settings, target);
  settings.indirect_scale = 2;
  settings.indirect_tolerance = 0;
  EXPECT_LT(difference(exact, draw(renderer, scene, settings, target), half_float).off, 0.002);
}

}  // namespace
}  // namespace ssphh
