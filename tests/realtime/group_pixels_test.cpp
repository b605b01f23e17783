/// Light of lamps with an extent, of several groups and of the sky, pixel by pixel and in colour.

#include <gmock/gmock.h>

#include <ssphh/image/sphere_map.h>

#include "change_lighting.h"
#include "gl_context.h"
#include "picture_bounds.h"
#include "pictures.h"
#include "stage.h"

namespace ssphh::test {
namespace {

constexpr PictureSize group_size{80, 48};
constexpr float group_rounding = 0.004f;  // as of lamps without an extent

/// Irradiance of one group at the middle of every pixel, as transport has it, and without shadows.
struct GroupLight {
  GroupLight(const scene::Scene& scene, int group, const PixelPoints& points)
      : lit(points.pixels.size()), open(lit) {
    scene::Scene empty = scene;
    std::erase_if(empty.instances, [&](const scene::Instance& i) {
      return !scene.materials[scene::instance_material(scene, i)].emissive();
    });
    std::vector<rays::SurfacePoint> places;
    for (const PixelPoint& p : points.pixels) places.push_back({p.point.position, stage_normal(p.point)});
    const auto fill = [&](const scene::Scene& lamps, std::vector<vec3>& out) {
      const trace::TransportScene source(lamps, {.light_samples = 256});
      const std::vector<mat4> poses(static_cast<std::size_t>(source.part_count()), mat4(1));
      source.direct_light(source.lights(0), poses)->irradiance(group, places, out);
    };
    fill(scene, lit), fill(empty, open);
    for (std::size_t i = 0; i < lit.size(); ++i) {
      if (points.pixels[i].hit.escaped()) lit[i] = open[i] = vec3(0);
    }
  }
  double share(std::size_t i) const {
    const float whole = max_component(open[i]);
    return whole > 0 ? static_cast<double>(max_component(lit[i]) / whole) : 0;
  }
  std::vector<vec3> lit, open;
};

class GroupPixels : public WithGl {
 protected:
  /// Flat surfaces alone: where a lamp with an extent sinks below the horizon of smooth normals, facets have
  /// another.
  static scene::Scene flat_stage() {
    scene::Scene s = stage(matte(vec3(1)));
    s.instances.pop_back();
    return s;
  }
  /// `steps`: what a half shadow may err by, as a share of the light without it. `partly`: at most so many
  /// pixels have half shadows or edges.
  void expect_truth(const scene::Scene& scene, const std::vector<vec3>& scales, float steps, double partly) {
    const trace::TransportScene source(scene);
    const scene::CameraPose pose = scene::camera_pose(scene, "");
    const PixelPoints points(source, pose, group_size);
    std::vector<GroupLight> groups;
    for (std::size_t g = 0; g < scales.size(); ++g) groups.emplace_back(scene, static_cast<int>(g), points);
    const auto sum = [&](std::vector<vec3> GroupLight::*of) {
      return points.picture([&](const PixelPoint& p) {
        const auto i = points.index(p);
        vec3 e(0);
        for (std::size_t g = 0; g < groups.size(); ++g) e += scales[g] * (groups[g].*of)[i];
        return p.hit.albedo / pi * e;
      });
    };
    const image::Image lit = sum(&GroupLight::lit), open = sum(&GroupLight::open);
    PictureBounds bounds =
        PictureBounds::around(lit, group_rounding, 2e-3f * static_cast<float>(mean_luminance(lit)));
    std::vector<bool> edge = points.corners();  // and shadows of a texel's width before walls
    for (const GroupLight& group : groups) {
      const std::vector<bool> found = points.edges(
          [&](std::size_t a, std::size_t b) { return std::abs(group.share(a) - group.share(b)) > 0.003; });
      for (std::size_t i = 0; i < edge.size(); ++i) edge[i] = edge[i] || found[i];
    }
    const auto at_edge = [&](int x, int y) { return edge[y * group_size.width + x]; };
    for (int y = 0; y < group_size.height; ++y) {
      for (int x = 0; x < group_size.width; ++x) {
        if (!at_edge(x, y)) continue;
        bounds.low.set_rgb(x, y, bounds.low.rgb(x, y) - steps * open.rgb(x, y));
        bounds.high.set_rgb(x, y, bounds.high.rgb(x, y) + steps * open.rgb(x, y));
      }
    }
    EXPECT_LT(bounds.widen(at_edge), partly);

    realtime::Renderer renderer(gl(), scene);
    change_lighting(renderer, [&](auto& state) { std::ranges::copy(scales, state.group_scales.begin()); });
    realtime::FrameSettings settings;
    settings.view = realtime::View::direct;
    renderer.draw(pose, settings, {.width = group_size.width, .height = group_size.height});
    EXPECT_TRUE(picture_is(renderer.read_back(), bounds));
  }
  static scene::Light lamp(scene::LightType type, const vec3& color, float intensity, const char* group) {
    scene::Light light;
    light.type = type, light.color = color, light.intensity = intensity, light.name = light.group = group;
    return light;
  }
};

TEST_F(GroupPixels, ASpheresLightIsThatOfTransport) {
  scene::Scene s = flat_stage();
  scene::Light ball = lamp(scene::LightType::sphere, {1, 0.7f, 0.3f}, 40, "ball");
  ball.radius = 0.3f;
  add_stage_lamp(s, ball);
  // Half shadows have steps of one of eight points, which do not stand in a row: two may come at once
  expect_truth(s, {vec3(1)}, 2.0f / 8, 0.3);
}

TEST_F(GroupPixels, APanelsLightIsThatOfTransport) {
  scene::Scene s = flat_stage();
  s.materials.push_back(matte(vec3(0)));
  s.materials.back().emission = {14, 9, 5};
  add_mesh(s, scene::make_quad({-0.5f, 3, -0.3f}, {1, 0, 0}, {0, 0, 0.8f}), 4);
  scene::validate(s);
  expect_truth(s, {vec3(1)}, 2.0f / 16, 0.35);
}

TEST_F(GroupPixels, AWideSunsLightIsThatOfTransport) {
  scene::Scene s = stage(matte({0.9f, 0.3f, 0.5f}));
  scene::Light sun = lamp(scene::LightType::directional, {1, 0.8f, 0.6f}, 3, "sun");
  sun.angular_radius = 0.03f;
  add_stage_lamp(s, sun);
  // 0.01 of a straight edge (soft_shadow_test.cpp); corners, and heights that differ within a filter, more
  expect_truth(s, {vec3(1)}, 0.08f, 0.25);
}

TEST_F(GroupPixels, EveryGroupIsScaledAloneAndInColour) {
  scene::Scene s = stage(matte({0.9f, 0.3f, 0.5f}));
  add_stage_lamp(s, lamp(scene::LightType::point, {1, 0.3f, 0.2f}, 12, "one"));
  add_stage_lamp(s, lamp(scene::LightType::point, {0.2f, 1, 0.4f}, 9, "two"));
  s.nodes[s.lights[1].node].local.translation = {-1.9f, 2, 1.5f};
  add_stage_lamp(s, lamp(scene::LightType::directional, {0.3f, 0.5f, 1}, 2, "three"));
  expect_truth(s, {{0.5f, 2, 1}, {3, 0.25f, 1.5f}, {1, 0.7f, 0.1f}}, 0, 0.3);
}

TEST_F(GroupPixels, AMatteBallUnderASkyHasTheIntegralOverItsTexels) {
  scene::Scene s;
  s.materials = {matte({0.8f, 0.5f, 0.3f})};
  add_mesh(s, scene::make_sphere(1, 96, 48), 0);
  s.nodes.emplace_back().local.translation = {0, 0, 3.4f};
  s.cameras.emplace_back().node = 1;
  s.environment.emplace().equirect = image::Image(64, 32, 3);
  s.environment->rotation = 0.6f, s.environment->color = {0.5f, 1, 2};
  // Bands up to 2, which the sky's nine, sixteen or more coefficients hold; three colours from three sides
  for (int y = 0; y < 32; ++y) {
    for (int x = 0; x < 64; ++x) {
      const vec3 d =
          image::equirect_direction((static_cast<float>(x) + 0.5f) / 64, (static_cast<float>(y) + 0.5f) / 32);
      s.environment->equirect.set_rgb(x, y, {1 + d.x, 1 + d.y * d.z, 1 - 0.5f * d.y + 0.5f * d.x * d.z});
    }
  }
  scene::validate(s);
  const trace::TransportScene source(s);
  const scene::CameraPose pose = scene::camera_pose(s, "");
  const PixelPoints points(source, pose, {48, 48});
  // The sky turned by 0.6 counter-clockwise about +y
  const mat3 turn(glm::angleAxis(0.6f, vec3(0, 1, 0)));
  const auto sky = [&](const vec3& world) {
    const vec3 d = glm::transpose(turn) * world;
    return vec3(0.5f, 1, 2) * vec3(1 + d.x, 1 + d.y * d.z, 1 - 0.5f * d.y + 0.5f * d.x * d.z);
  };
  const image::Image expected = points.picture([&](const PixelPoint& p) {
    const vec3 n = glm::normalize(p.point.position);
    vec3 e(0);
    constexpr int count = 1000;
    for (int i = 0; i < count; ++i) {
      const vec3 w = spherical_fibonacci(i, count);
      e += sky(w) * (std::max(glm::dot(n, w), 0.0f) * 4 * pi / count);
    }
    return p.hit.albedo / pi * e;
  });
  realtime::Renderer renderer(gl(), s);
  realtime::FrameSettings settings;
  settings.sky = realtime::Sky::black;
  settings.view = realtime::View::direct;
  renderer.draw(pose, settings, {.width = 48, .height = 48});
  // At the rim facets stand in some of the 32 directions' way
  PictureBounds bounds = PictureBounds::around(expected, 0.01f, 0.002f);
  const double rim = bounds.widen([&](int x, int y) {
    const PixelPoint& p = points.at(x, y);
    return !p.hit.escaped() && glm::dot(glm::normalize(p.point.position), p.wo) < 0.3f;
  });
  EXPECT_LT(rim, 0.15);
  EXPECT_TRUE(picture_is(renderer.read_back(), bounds));

  // Beside the ball the sky itself; texels are 0.1 rad wide: h² / 8 of the curvature of bands 1 and 2, 0.5 %
  settings.sky = realtime::Sky::environment;
  renderer.draw(pose, settings, {.width = 48, .height = 48});
  for (int y = 0; y < 48; ++y) {
    for (int x = 0; x < 48; ++x) {
      if (!points.at(x, y).hit.escaped()) continue;
      const vec3 d = sky(-points.at(x, y).wo);
      bounds.low.set_rgb(x, y, 0.99f * d), bounds.high.set_rgb(x, y, 1.01f * d);
    }
  }
  EXPECT_TRUE(picture_is(renderer.read_back(), bounds));
}

}  // namespace
}  // namespace ssphh::test
