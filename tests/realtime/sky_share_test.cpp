/// Metal that mirrors the sky where the sky is, as SPHLs' shadow maps tell it, and nothing of it where things
/// are.

#include <array>

#include <gtest/gtest.h>

#include <ssphh/scene/primitives.h>

#include "gl_context.h"
#include "pictures.h"

namespace ssphh {
namespace {

constexpr test::PictureSize size{64, 64};

struct Pictures {
  image::Image drawn, traced;
};

/// Metal and what stands around it under an even bluish sky; nothing else reflects any light.
struct SkyShare : test::WithGl {
  void SetUp() override {
    WithGl::SetUp();
    scene::Material& metal = scene.materials.emplace_back();
    metal.metallic = 1, metal.specular_roughness = metal.diffuse_roughness = 0.2f,
    metal.base_color = vec3(0.9f, 0.7f, 0.4f);
    scene::Material& black = scene.materials.emplace_back();
    black.base_color = vec3(0), black.specular = 0, black.double_sided = true;
    scene.environment.emplace().color = vec3(0.5f, 0.7f, 1);
  }
  void add(scene::Mesh mesh, int material, const vec3& place = vec3(0)) {
    mesh.material = material;
    scene.meshes.push_back(std::move(mesh));
    scene::Instance& instance = scene.instances.emplace_back();
    instance.mesh = static_cast<int>(scene.meshes.size()) - 1;
    instance.node = static_cast<int>(scene.nodes.size());
    scene.nodes.emplace_back().local.translation = place;
  }
  void look(const vec3& eye, const vec3& target) {
    scene::Camera& camera = scene.cameras.emplace_back();
    camera.node = static_cast<int>(scene.nodes.size());
    camera.yfov = 0.6f;
    scene::Node& node = scene.nodes.emplace_back();
    node.local.translation = eye;
    node.local.rotation = glm::quatLookAt(glm::normalize(target - eye), vec3(0, 1, 0));
  }
  Pictures direct(const std::vector<vec3>& probes) {
    scene::validate(scene);
    realtime::Renderer renderer(gl(), scene, test::small_maps);
    renderer.set_probes(test::made_up_probes(probes));
    realtime::FrameSettings settings;
    settings.view = realtime::View::direct;
    const trace::PathTracer tracer(scene);
    return {test::drawn(renderer, scene, size, settings), test::traced(scene, nullptr, size, 256, 1, tracer)};
  }
  scene::Scene scene;
};

vec3 mean(const image::Image& image, int left, int top, int right, int bottom) {
  vec3 sum(0);
  for (int y = top; y < bottom; ++y) {
    for (int x = left; x < right; ++x) sum += image.rgb(x, y);
  }
  return sum / static_cast<float>((right - left) * (bottom - top));
}

// Maps of what the sky lights are too coarse there to tell a ball from the ground that it stands on.
TEST_F(SkyShare, OfABallOnAWidePlainIsNoneBelowTheHorizon) {
  add(scene::make_quad({-300, 0, 300}, {600, 0, 0}, {0, 0, -600}), 1);
  add(scene::make_sphere(0.5f), 0, {0, 0.6f, 0});
  look({0, 0.6f, 4}, {0, 0.6f, 0});
  const Pictures p = direct({{0, 0.3f, 1.5f}, {-1, 0.4f, 1.2f}, {1, 0.4f, 1.2f}, {0, 1.5f, 1}});
  // Mirrors of level ways stand at half height; roughness blurs some 8 pixels of 26
  const vec3 above = mean(p.drawn, 26, 20, 38, 26), below = mean(p.drawn, 26, 42, 38, 48);
  const vec3 above_truth = mean(p.traced, 26, 20, 38, 26), below_truth = mean(p.traced, 26, 42, 38, 48);
  for (int c = 0; c < 3; ++c) {
    EXPECT_NEAR(above[c] / above_truth[c], 1, 0.05) << c;
    EXPECT_LT(below_truth[c], 0.05f * above_truth[c]) << c;
    EXPECT_LT(below[c], 0.05f * above[c]) << c;
  }
}

// A slope of a normal map, or a shading normal, mirrors the ground that it stands for.
TEST_F(SkyShare, OfANormalThatLeansTooFarIsNone) {
  scene::Mesh plate = scene::make_quad({-1, -1, 0}, {2, 0, 0}, {0, 2, 0});
  for (vec3& normal : plate.normals) normal = glm::normalize(vec3(3, 0, 1));
  add(plate, 0);
  look({0, 0, 4}, {0, 0, 0});
  scene::validate(scene);
  realtime::Renderer renderer(gl(), scene, test::small_maps);
  renderer.set_probes(test::made_up_probes(std::vector<vec3>{{-1, 0, 1}, {1, 0, 1}, {0, 1, 1.5f}}));
  const image::Image drawn = test::drawn(renderer, scene, size);
  const vec3 middle = mean(drawn, 26, 26, 38, 38), beside = mean(drawn, 0, 0, 4, 4);
  for (int c = 0; c < 3; ++c) EXPECT_LT(middle[c], 0.01f * beside[c]) << c;
}

// Within a spacing's share of a wall SPHLs beyond it tell of the other side, and maps of what the sky lights
// are too coarse.
TEST_F(SkyShare, OfATableBesideAWallIsNoneInAClosedRoom) {
  add(scene::make_quad({-300, 0, 300}, {600, 0, 0}, {0, 0, -600}), 1);
  add(scene::make_quad({-2, 2.5f, 2}, {4, 0, 0}, {0, 0, -4}), 1);
  for (const float z : {-2.0f, 2.0f}) add(scene::make_quad({-2, 0, z}, {4, 0, 0}, {0, 2.5f, 0}), 1);
  for (const float x : {-2.0f, 2.0f}) add(scene::make_quad({x, 0, 2}, {0, 0, -4}, {0, 2.5f, 0}), 1);
  add(scene::make_box({-0.8f, 0.7f, -1.99f}, {0.8f, 0.75f, -1}), 0);
  look({0.5f, 1.7f, 1.5f}, {0, 0.7f, -1.6f});
  const Pictures p = direct({{-1, 1.2f, 1},
                             {1, 1.2f, 1},
                             {0, 1.5f, -0.5f},
                             {-1.2f, 1, -1},
                             {-1, 1, -2.6f},
                             {0, 1.2f, -2.5f},
                             {1, 1, -2.6f},
                             {2.6f, 1.4f, 0}});
  for (int y = 0; y < size.height; ++y) {
    for (int x = 0; x < size.width; ++x) {
      EXPECT_LT(p.drawn.rgb(x, y).g, 1e-3f) << x << ' ' << y;
      EXPECT_EQ(p.traced.rgb(x, y), vec3(0));
    }
  }
}

// A window 1 m wide. What 32 directions have of it is off by .99 of all light, five ways about the mirrored
// one by .47.
TEST_F(SkyShare, OfAFloorMirrorsTheWindowWhereItIs) {
  add(scene::make_quad({-2, 0, 2}, {4, 0, 0}, {0, 0, -4}), 0);
  add(scene::make_quad({-2, 3, 2}, {4, 0, 0}, {0, 0, -4}), 1);
  add(scene::make_quad({-2, 0, 2}, {4, 0, 0}, {0, 3, 0}), 1);
  for (const float x : {-2.0f, 2.0f}) add(scene::make_quad({x, 0, 2}, {0, 0, -4}, {0, 3, 0}), 1);
  for (const auto& [left, right, low, high] :
       {std::array{-2.0f, 0.3f, 0.0f, 3.0f}, std::array{1.3f, 2.0f, 0.0f, 3.0f},
        std::array{0.3f, 1.3f, 0.0f, 1.0f}, std::array{0.3f, 1.3f, 2.0f, 3.0f}})
    add(scene::make_quad({left, low, -2}, {right - left, 0, 0}, {0, high - low, 0}), 1);
  look({0, 1.7f, 1.9f}, {0.4f, 0, -0.4f});
  const Pictures p = direct({{-1, 1.2f, 1}, {1, 1.2f, 1}, {0, 1.5f, -0.5f}, {-1, 1, -1}});
  vec3 off(0), all(0);
  for (int y = 0; y < size.height; ++y) {
    for (int x = 0; x < size.width; ++x) {
      off += glm::abs(p.drawn.rgb(x, y) - p.traced.rgb(x, y));
      all += p.traced.rgb(x, y);
    }
  }
  for (int c = 0; c < 3; ++c) EXPECT_LT(off[c] / all[c], 0.25f) << c;
}

}  // namespace
}  // namespace ssphh
