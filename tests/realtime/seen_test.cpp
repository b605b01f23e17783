/// Lamps that are no surfaces and the sky, as the eye sees them, and the views of what a frame is made of.

#include <gmock/gmock.h>

#include "gl_context.h"
#include "picture_bounds.h"
#include "pictures.h"
#include "stage.h"

namespace ssphh::test {
namespace {

using realtime::FrameSettings;
using realtime::Renderer;
using realtime::Sky;
using realtime::View;

constexpr PictureSize seen_size{48, 32};

/// A black wall 2 m before the eye that covers the right half of the picture.
scene::Scene black_wall() {
  scene::Scene s;
  s.materials = {matte(vec3(0))};
  add_mesh(s, scene::make_quad({0, -9, -2}, {9, 0, 0}, {0, 18, 0}), 0);
  s.nodes.emplace_back().local.translation = {0.003f, 0.002f, 0};
  s.cameras.emplace_back().node = 1;
  return s;
}
scene::Light& add_lamp(scene::Scene& s, scene::LightType type, const vec3& at,
                       const vec3& goes = {0, 0, -1}) {
  scene::Node& node = s.nodes.emplace_back();
  node.local.translation = at;
  node.local.rotation = glm::quatLookAt(glm::normalize(goes), vec3(0, 1, 0));
  scene::Light& light = s.lights.emplace_back();
  light.name = "lamp", light.type = type, light.node = static_cast<int>(s.nodes.size()) - 1;
  light.color = {1, 0.6f, 0.3f};
  return light;
}

class Seen : public WithGl {
 protected:
  image::Image draw(scene::Scene scene, const FrameSettings& settings = {}) {
    scene::validate(scene);
    Renderer renderer(gl(), scene,
                      {.light_map_size = 32,
                       .area_map_size = 32,
                       .sun_map_size = 32,
                       .environment_map_size = 32,
                       .environment_samples = 1});
    renderer.draw(scene::camera_pose(scene, ""), settings,
                  {.width = seen_size.width, .height = seen_size.height});
    return renderer.read_back();
  }
  /// `light(ray)` is what is seen along it, up to `share`; pixels whose middle it calls doubtful by a NaN are
  /// left out, at most 5 %.
  template <class Light>
  static void expect_seen(const image::Image& drawn, const scene::Scene& scene, const Light& light,
                          float share = 1e-4f) {
    const std::vector<rays::RayQuery> rays = pixel_rays(scene::camera_pose(scene, ""), seen_size);
    image::Image expected(seen_size.width, seen_size.height, 3);
    std::vector<bool> doubtful;
    for (std::size_t i = 0; i < rays.size(); ++i) {
      const vec3 value = light(rays[i]);
      doubtful.push_back(!is_finite(value));
      expected.set_rgb(static_cast<int>(i) % seen_size.width, static_cast<int>(i) / seen_size.width,
                       doubtful.back() ? vec3(0) : value);
    }
    EXPECT_LT(std::ranges::count(doubtful, true), seen_size.width * seen_size.height / 20);
    PictureBounds bounds = PictureBounds::around(expected, share, 1e-6f);
    bounds.left_out = doubtful;
    EXPECT_TRUE(picture_is(drawn, bounds));
  }
  /// Distance at which a ray meets the wall; none: infinite.
  static float wall_distance(const rays::RayQuery& ray) {
    const float t = (-2 - ray.origin.z) / ray.direction.z;
    const float x = ray.origin.x + t * ray.direction.x;
    return std::abs(x) < 1e-3f ? NAN : t > 0 && x > 0 ? t : INFINITY;
  }
  static constexpr vec3 unsure{NAN};
};

TEST_F(Seen, SphereShinesBeforeWhatStandsBehindIt) {
  for (const bool parallel : {false, true}) {
    for (const vec3& middle : {vec3(0.2f, 0.1f, -1.6f), vec3(0.1f, -0.2f, -2.6f), vec3(0.1f, 0, -2)}) {
      scene::Scene s = black_wall();
      s.cameras[0].orthographic = parallel;
      scene::Light& lamp = add_lamp(s, scene::LightType::sphere, middle);
      lamp.radius = 0.35f, lamp.intensity = 5;
      expect_seen(draw(s, {.sky = Sky::black}), s, [&](const rays::RayQuery& ray) {
        const vec3 c = middle - ray.origin;
        const float along = glm::dot(c, ray.direction), wall = wall_distance(ray);
        const float half2 = 0.35f * 0.35f - glm::dot(c, c) + along * along;
        const float t = along - std::sqrt(std::max(half2, 0.0f));
        if (std::abs(half2) < 1e-3f || std::isnan(wall) || (half2 > 0 && std::abs(t - wall) < 2e-3f))
          return unsure;
        return half2 > 0 && t < wall ? 5.0f * lamp.color : vec3(0);
      });
    }
  }
}

TEST_F(Seen, FlatLampsShineFromTheirFrontBeforeWhatStandsBehindThem) {
  for (const bool parallel : {false, true}) {
    for (const scene::LightType type : {scene::LightType::rectangle, scene::LightType::disc}) {
      for (const vec3& middle : {vec3(0.2f, 0.1f, -1.6f), vec3(0.1f, -0.2f, -2.6f)}) {
        const vec3 goes = glm::normalize(vec3(-0.2f, 0.3f, 1));
        scene::Scene s = black_wall();
        s.cameras[0].orthographic = parallel;
        scene::Light& lamp = add_lamp(s, type, middle, goes);
        lamp.size = {0.9f, 0.5f}, lamp.radius = 0.35f, lamp.intensity = 5;
        const mat3 axes = glm::mat3_cast(s.nodes.back().local.rotation);
        const float node_scale = 7;
        s.nodes.back().local.scale = vec3(node_scale);
        const auto light = [&](const rays::RayQuery& ray) {
          const float t = glm::dot(middle - ray.origin, goes) / glm::dot(ray.direction, goes);
          const vec3 at = (ray.origin + t * ray.direction - middle) * axes;
          const float wall = wall_distance(ray);
          // How far outside; a disc is a polygon whose corners and sides stand 0.3 % from the circle
          const float outside = type == scene::LightType::disc
                                    ? glm::length(at) - 0.35f
                                    : std::max(std::abs(at.x) - 0.45f, std::abs(at.y) - 0.25f);
          if (std::isnan(wall) || std::abs(outside) < 2e-3f || std::abs(t - wall) < 2e-3f) return unsure;
          return outside < 0 && t < wall ? 5.0f * lamp.color : vec3(0);
        };
        expect_seen(draw(s, {.sky = Sky::black}), s, light);
        // From behind there is nothing of it
        s.nodes.back().local.rotation = glm::quatLookAt(-goes, vec3(0, 1, 0));
        EXPECT_THAT(draw(s, {.sky = Sky::black}).pixels, testing::Each(0.0f));
      }
    }
  }
}

TEST_F(Seen, FromWithinASphereItsFarSideIsSeen) {
  scene::Scene s = black_wall();
  scene::Light& lamp = add_lamp(s, scene::LightType::sphere, {0.3f, 0, -0.2f});
  lamp.radius = 3, lamp.intensity = 0.5f;
  expect_seen(draw(s), s, [&](const rays::RayQuery& ray) {
    const vec3 c = vec3(0.3f, 0, -0.2f) - ray.origin;
    const float along = glm::dot(c, ray.direction), wall = wall_distance(ray);
    const float t = along + std::sqrt(9 - glm::dot(c, c) + along * along);
    return std::isnan(wall) || std::abs(t - wall) < 2e-3f ? unsure : t < wall ? 0.5f * lamp.color : vec3(0);
  });
}

TEST_F(Seen, SunIsADiscBehindEverything) {
  for (const float radius : {0.3f}) {
    scene::Scene s = black_wall();
    const vec3 toward = glm::normalize(vec3(-0.1f, 0.15f, -1));
    scene::Light& sun = add_lamp(s, scene::LightType::directional, vec3(0), -toward);
    sun.angular_radius = radius, sun.intensity = 2;
    const vec3 radiance = 2.0f * sun.color / (pi * std::sin(radius) * std::sin(radius));
    expect_seen(draw(s), s, [&](const rays::RayQuery& ray) {
      const float away = std::acos(std::min(glm::dot(ray.direction, toward), 1.0f)),
                  wall = wall_distance(ray);
      if (std::isnan(wall) || std::abs(away - radius) < 1e-3f) return unsure;
      return away < radius && wall == INFINITY ? radiance : vec3(0);
    });
    const image::Image black = draw(s, {.sky = Sky::black});
    EXPECT_THAT(black.pixels, testing::Each(0.0f)) << "it belongs to the sky";
  }
}

TEST_F(Seen, SunWithoutExtentAndLampsWithoutExtentAreNotSeen) {
  scene::Scene s = black_wall();
  add_lamp(s, scene::LightType::directional, vec3(0), {0.1f, 0, 1}).intensity = 9;
  add_lamp(s, scene::LightType::point, {-0.2f, 0, -1}).intensity = 9;
  EXPECT_THAT(draw(s).pixels, testing::Each(0.0f));
}

TEST_F(Seen, SkyOfOneColourIsThatColour) {
  for (const bool parallel : {false, true}) {
    scene::Scene s = black_wall();
    s.cameras[0].orthographic = parallel;
    s.environment.emplace().color = {0.4f, 0.7f, 1.5f};
    const auto sky = [&](const rays::RayQuery& ray) {
      const float wall = wall_distance(ray);
      return std::isnan(wall) ? unsure : wall == INFINITY ? vec3(0.4f, 0.7f, 1.5f) : vec3(0);
    };
    expect_seen(draw(s), s, sky);
    expect_seen(draw(s, {.view = View::direct}), s, sky);
    EXPECT_THAT(draw(s, {.sky = Sky::black}).pixels, testing::Each(0.0f));
    EXPECT_THAT(draw(s, {.direct = false}).pixels, testing::Each(0.0f)) << "it is direct light";
  }
}

/// The stage by one lamp, without noise.
class Views : public WithGl {
 protected:
  image::Image draw(Renderer& renderer, View view) {
    FrameSettings settings;
    settings.view = view;
    renderer.draw(scene::camera_pose(scene_, ""), settings,
                  {.width = seen_size.width, .height = seen_size.height});
    return renderer.read_back();
  }
  scene::Scene scene_ = stage(matte({0.9f, 0.3f, 0.5f}));
};

TEST_F(Views, DepthIsThatAlongTheAxis) {
  for (const bool parallel : {false, true}) {
    scene_.cameras[0].orthographic = parallel, scene_.cameras[0].yheight = 3.5f;
    add_stage_lamp(scene_, {});
    const trace::TransportScene source(scene_);
    const scene::CameraPose pose = scene::camera_pose(scene_, "");
    const PixelPoints points(source, pose, seen_size);
    Renderer renderer(gl(), scene_);
    PictureBounds bounds = PictureBounds::around(points.picture([&](const PixelPoint& p) {
      const float z = glm::dot(p.point.position - vec3(pose.world[3]), -vec3(pose.world[2]));
      return vec3(z / (1 + z));
    }),
                                                 1e-4f, 0);
    const std::vector<bool> corners = points.corners();
    EXPECT_LT(bounds.widen([&](int x, int y) { return corners[y * seen_size.width + x]; }), 0.35);
    EXPECT_TRUE(picture_is(draw(renderer, View::depth), bounds));
  }
}

TEST_F(Views, ShadowIsTheShareOfAllLampsLightThatArrives) {
  // On a floor alone the shadow of a plate; of two lamps, each with its own luminance and distance
  scene::Scene s;
  s.materials = {matte(vec3(0.5f))};
  add_mesh(s, scene::make_quad({-4, 0, 4}, {8, 0, 0}, {0, 0, -8}), 0);
  add_mesh(s, scene::make_quad({-0.5f, 1, 0.5f}, {1, 0, 0}, {0, 0, -1}), 0);
  scene::Node& eye = s.nodes.emplace_back();
  eye.local.translation = {0, 0.9f, 0};
  eye.local.rotation = glm::quatLookAt(vec3(0, -1, 0), vec3(0, 0, -1));
  s.cameras.emplace_back().node = static_cast<int>(s.nodes.size()) - 1;
  s.cameras[0].orthographic = true, s.cameras[0].yheight = 4;
  const std::array<vec3, 2> places = {vec3(-0.6f, 2.2f, 0.1f), vec3(0.9f, 1.9f, -0.4f)};
  for (const vec3& place : places) add_lamp(s, scene::LightType::point, place);
  s.lights[0].color = {1, 0.2f, 0.1f}, s.lights[0].intensity = 7;
  s.lights[1].color = {0.1f, 0.9f, 0.7f}, s.lights[1].intensity = 4;
  scene::validate(s);
  Renderer renderer(gl(), s);
  FrameSettings settings;
  settings.view = View::shadow;
  const PictureSize square{40, 40};
  const scene::CameraPose pose = scene::camera_pose(s, "");
  renderer.draw(pose, settings, {.width = square.width, .height = square.height});
  image::Image expected(square.width, square.height, 3);
  std::vector<bool> doubtful;
  const std::vector<rays::RayQuery> rays = pixel_rays(pose, square);
  for (std::size_t i = 0; i < rays.size(); ++i) {
    const vec3 x(rays[i].origin.x, 0, rays[i].origin.z);
    float arrives = 0, all = 0;
    doubtful.push_back(false);
    for (std::size_t l = 0; l < 2; ++l) {
      const vec3 way = places[l] - x, at = x + way / way.y;  // at the plate's height
      const float off = std::max(std::abs(at.x), std::abs(at.z)) - 0.5f;
      // A texel of 2 m / 1022 at 1 m is less than that on the plate
      if (std::abs(off) < 0.006f) doubtful.back() = true;
      const float e =
          luminance(s.lights[l].color) * s.lights[l].intensity * way.y / std::pow(glm::dot(way, way), 1.5f);
      all += e, arrives += off > 0 ? e : 0;
    }
    expected.set_rgb(static_cast<int>(i) % square.width, static_cast<int>(i) / square.width,
                     vec3(arrives / all));
  }
  EXPECT_LT(std::ranges::count(doubtful, true), 160);
  PictureBounds bounds = PictureBounds::around(expected, 0.002f, 1e-4f);  // sums of halves
  bounds.left_out = doubtful;
  EXPECT_TRUE(picture_is(renderer.read_back(), bounds));
}

TEST_F(Views, ShadowOfNoLightAtAllIsBlack) {
  scene::Light dark;
  dark.intensity = 0;
  add_stage_lamp(scene_, dark);
  Renderer renderer(gl(), scene_);
  EXPECT_THAT(draw(renderer, View::shadow).pixels, testing::Each(0.0f));
}

TEST_F(Views, ChosenProbeHasItsOwnColourAndIsBrighterTheMoreAreInSight) {
  scene::Scene s;
  s.materials = {matte(vec3(0.5f))};
  add_mesh(s, scene::make_quad({-9, -9, 0}, {18, 0, 0}, {0, 18, 0}), 0);
  s.nodes.emplace_back().local.translation = {0, 0, 2};
  s.cameras.emplace_back().node = 1;
  scene::validate(s);
  Renderer renderer(gl(), s);
  const auto colours = [&](const std::vector<vec3>& places) {
    renderer.set_probes(made_up_probes(places));
    FrameSettings settings;
    settings.view = View::chosen_sphl, settings.weights = probes::WeightMethod::distance;
    renderer.draw(scene::camera_pose(s, ""), settings, {.width = 8, .height = 4});
    return renderer.read_back();
  };
  const image::Image one = colours({{-1, 0, 1}}), hidden = colours({{-1, 0, -1}}),
                     two = colours({{-1, 0, 1}, {1, 0, 1}});
  const vec3 first = one.rgb(0, 2);
  for (int x = 0; x < 8; ++x) {
    EXPECT_EQ(one.rgb(x, 1), first) << "there is no other";
    // 0.4 of the colour and 0.6 / 8 for each in sight; 0.15 of it where none is
    for (int c = 0; c < 3; ++c) {
      EXPECT_NEAR(hidden.rgb(x, 1)[c] / first[c], 0.15f / 0.475f, 1e-5f);
      if (x < 4) {
        EXPECT_NEAR(two.rgb(x, 1)[c] / first[c], 0.55f / 0.475f, 1e-5f);
      }
    }
    if (x >= 4) {
      EXPECT_GT(glm::distance(two.rgb(x, 1), 0.55f / 0.475f * first), 0.1f);
    }
  }
  for (int c = 0; c < 3; ++c) {
    EXPECT_GE(first[c] / 0.475f, 0.15f);
    EXPECT_LE(first[c] / 0.475f, 1);
  }
}

}  // namespace
}  // namespace ssphh::test
