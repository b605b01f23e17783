/// Light of lamps without an extent: the drawn picture is path tracing at depth 1.

#include <map>

#include <gmock/gmock.h>

#include <ssphh/scene/primitives.h>

#include "gl_context.h"
#include "pictures.h"

namespace ssphh {
namespace {

using test::PictureSize;

/// Share of the pixels whose drawn value lies outside of what the traced picture holds within one pixel, 1 %
/// and a thousandth of its mean allowed for rounding of normals and colours in the G-buffer. Edges of shadows
/// may move by that pixel: a shadow map's texel is less (2 · 6 m / 1024 against 5 m / 128).
double share_outside(const image::Image& drawn, const image::Image& traced) {
  const auto floor = static_cast<float>(1e-3 * test::mean_luminance(traced));
  int outside = 0;
  for (int y = 0; y < traced.height; ++y) {
    for (int x = 0; x < traced.width; ++x) {
      vec3 low(1e9f), high(-1e9f);
      for (int dy = -1; dy <= 1; ++dy) {
        for (int dx = -1; dx <= 1; ++dx) {
          const vec3 v =
              traced.rgb(glm::clamp(x + dx, 0, traced.width - 1), glm::clamp(y + dy, 0, traced.height - 1));
          low = glm::min(low, v), high = glm::max(high, v);
        }
      }
      const vec3 v = drawn.rgb(x, y);
      const bool in = glm::all(glm::lessThanEqual(0.99f * low - floor, v)) &&
                      glm::all(glm::lessThanEqual(v, 1.01f * high + floor));
      outside += !in;
    }
  }
  return static_cast<double>(outside) / (traced.width * traced.height);
}

class DirectLight : public test::WithGl {
 protected:
  /// A floor and a wall, a box and a ball; the ball has a material of its own.
  static scene::Scene stage(const scene::Material& ball) {
    scene::Scene s;
    scene::Material matte;
    matte.specular = 0;
    matte.base_color = {0.7f, 0.6f, 0.5f};
    s.materials = {matte, ball};
    const auto add = [&](scene::Mesh mesh, int material, const vec3& at) {
      mesh.material = material;
      scene::Node node;
      node.local.translation = at;
      s.nodes.push_back(node);
      s.meshes.push_back(std::move(mesh));
      scene::Instance instance;
      instance.mesh = instance.node = static_cast<int>(s.meshes.size()) - 1;
      s.instances.push_back(instance);
    };
    add(scene::make_quad({-3, 0, 3}, {6, 0, 0}, {0, 0, -6}), 0, vec3(0));
    add(scene::make_quad({-3, 0, -2}, {6, 0, 0}, {0, 4, 0}), 0, vec3(0));
    add(scene::make_box({-0.5f, 0, -0.5f}, {0.5f, 1, 0.5f}), 0, {-1, 0, -0.5f});
    add(scene::make_sphere(0.6f), 1, {0.8f, 0.6f, 0.2f});
    scene::Node eye;
    eye.local.translation = {0, 1.5f, 5};
    eye.local.rotation = glm::angleAxis(-0.15f, vec3(1, 0, 0));
    s.nodes.push_back(eye);
    scene::Camera camera;
    camera.name = "eye";
    camera.node = static_cast<int>(s.nodes.size()) - 1;
    s.cameras.push_back(camera);
    return s;
  }
  static scene::Scene with_light(scene::Scene s, scene::Light light) {
    scene::Node node;
    node.local.translation = {1.5f, 2.8f, 2};
    // Down and to the left, away from the viewer
    node.local.rotation = glm::quatLookAt(glm::normalize(vec3(-0.5f, -0.8f, -0.7f)), vec3(0, 1, 0));
    s.nodes.push_back(node);
    light.node = static_cast<int>(s.nodes.size()) - 1;
    light.name = "lamp";
    s.lights.push_back(light);
    scene::validate(s);
    return s;
  }
  void expect_equal(const scene::Scene& s) {
    const PictureSize size;
    const trace::PathTracer tracer(s);
    const image::Image truth = test::traced(s, nullptr, size, 32, 1, tracer);
    realtime::Renderer renderer(gl(), s);
    const image::Image picture = test::drawn(renderer, s, size);
    EXPECT_GT(test::mean_luminance(truth), 0);
    EXPECT_NEAR(test::mean_luminance(picture) / test::mean_luminance(truth), 1, 0.01);
    EXPECT_LT(share_outside(picture, truth), 0.005);
  }
  static scene::Light lamp(scene::LightType type, float intensity) {
    scene::Light light;
    light.type = type;
    light.color = {1, 0.8f, 0.5f};
    light.intensity = intensity;
    return light;
  }
  static scene::Material plain() {
    scene::Material m;
    m.specular = 0;
    return m;
  }
};

TEST_F(DirectLight, OfAPointLightIsThatOfPathTracing) {
  expect_equal(with_light(stage(plain()), lamp(scene::LightType::point, 20)));
}

TEST_F(DirectLight, OfASpotWithARangeIsThatOfPathTracing) {
  scene::Light spot = lamp(scene::LightType::spot, 20);
  spot.inner_cone = 0.3f, spot.outer_cone = 0.7f, spot.range = 9;
  expect_equal(with_light(stage(plain()), spot));
}

TEST_F(DirectLight, OfTheSunIsThatOfPathTracing) {
  expect_equal(with_light(stage(plain()), lamp(scene::LightType::directional, 3)));
}

TEST_F(DirectLight, SeenByAnOrthographicCameraIsThatOfPathTracing) {
  scene::Scene s = with_light(stage(plain()), lamp(scene::LightType::point, 20));
  s.cameras[0].orthographic = true;
  s.cameras[0].yheight = 3.5f;
  expect_equal(s);
}

TEST_F(DirectLight, IsReflectedByEveryModelAsOnTheCpu) {
  scene::Material glossy, phong, metal, rough, disney;
  glossy.specular_roughness = 0.4f;
  phong.specular_roughness = -0.5f;
  metal.metallic = 1, metal.specular_roughness = 0.35f, metal.base_color = {0.9f, 0.6f, 0.4f};
  rough.specular = 0, rough.diffuse_roughness = -0.7f;
  disney.diffuse_roughness = 0.6f, disney.specular_roughness = 0.7f;
  for (const scene::Material& m : {glossy, phong, metal, rough, disney}) {
    SCOPED_TRACE(testing::Message() << "roughness " << m.diffuse_roughness << ", " << m.specular_roughness);
    expect_equal(with_light(stage(m), lamp(scene::LightType::point, 20)));
  }
}

/// A ball in the open under a sky that grows dark downwards and has a window in it.
scene::Scene ball_under_sky() {
  scene::Scene s;
  s.materials.resize(1);
  s.meshes.push_back(scene::make_sphere(1, 96, 48));
  s.meshes[0].material = 0;
  scene::Instance ball;
  ball.mesh = 0;
  s.instances.push_back(ball);
  scene::Node eye;
  eye.local.translation = {0, 0, 3.4f};
  s.nodes.push_back(eye);
  s.cameras.emplace_back().node = 0;
  s.environment.emplace().equirect = image::Image(128, 64, 3);
  s.environment->rotation = 0.6f;
  for (int y = 0; y < 64; ++y) {
    for (int x = 0; x < 128; ++x) {
      const bool window = x > 78 && x < 100 && y > 14 && y < 30;
      const float up = 1 - static_cast<float>(y) / 64;
      s.environment->equirect.set_rgb(x, y, window ? vec3(6, 5, 3) : vec3(0.2f, 0.5f, 1) * up);
    }
  }
  scene::validate(s);
  return s;
}

/// Mean absolute difference of 8 x 8 blocks over the mean.
double block_difference(const image::Image& a, const image::Image& b) {
  std::map<std::pair<int, int>, double> blocks;
  double sum = 0;
  for (int y = 0; y < a.height; ++y) {
    for (int x = 0; x < a.width; ++x) {
      const auto la = static_cast<double>(luminance(a.rgb(x, y))),
                 lb = static_cast<double>(luminance(b.rgb(x, y)));
      blocks[{x / 8, y / 8}] += la - lb;
      sum += la;
    }
  }
  double off = 0;
  for (const auto& [place, difference] : blocks) off += std::abs(difference);
  return off / sum;
}

TEST_F(DirectLight, ABallMirrorsTheEnvironmentByItsRoughnessAsTraced) {
  // What the split sum leaves: lobes are round about one direction, those of rough surfaces are not. Seen to
  // be 0.9, 2.1, 5.3 %; 7.2 % of a Blinn-Phong lobe, which has less of a tail than the tiles' GGX
  struct Case {
    float roughness;
    double most;
  };
  scene::Scene s = ball_under_sky();
  realtime::Renderer renderer(gl(), s);
  for (const Case& c : {Case{0.12f, 0.015}, {0.35f, 0.03}, {0.7f, 0.07}, {-0.4f, 0.09}}) {
    SCOPED_TRACE(testing::Message() << "roughness " << c.roughness);
    scene::Material& metal = s.materials[0];
    metal.metallic = 1, metal.specular_roughness = c.roughness, metal.base_color = {0.9f, 0.7f, 0.5f};
    renderer.set_material(0, metal);
    const PictureSize size{96, 96};
    const trace::PathTracer tracer(s);
    const image::Image truth = test::traced(s, nullptr, size, 32, 1, tracer);
    const image::Image picture = test::drawn(renderer, s, size);
    EXPECT_LT(block_difference(truth, picture), c.most);
    EXPECT_NEAR(test::mean_luminance(picture) / test::mean_luminance(truth), 1, 0.03);
  }
}

TEST_F(DirectLight, ShadowsOfAMaskedLeafHaveItsHoles) {
  scene::Scene s = with_light(stage(plain()), lamp(scene::LightType::point, 20));
  // Stripes, covered and not, on a leaf above the floor
  scene::Texture stripes{
      .name = "stripes", .width = 4, .height = 1, .rgba = std::vector<std::uint8_t>(16, 255)};
  stripes.rgba[7] = stripes.rgba[15] = 0;
  s.textures.push_back(stripes);
  scene::Material m = plain();
  m.alpha_mode = scene::AlphaMode::mask;
  m.base_color_texture.texture = 0;
  m.base_color_texture.nearest = true;
  s.materials.push_back(m);
  scene::Mesh leaf = scene::make_quad({-0.2f, 1.6f, 1.6f}, {1.6f, 0, 0}, {0, 0, -1});
  leaf.uvs[0] = {{0, 0}, {1, 0}, {1, 1}, {0, 1}};
  leaf.material = 2;
  s.meshes.push_back(leaf);
  scene::Instance instance;
  instance.mesh = static_cast<int>(s.meshes.size()) - 1;
  s.instances.push_back(instance);
  scene::validate(s);
  expect_equal(s);
}

}  // namespace
}  // namespace ssphh
