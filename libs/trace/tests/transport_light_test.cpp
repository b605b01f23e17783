/// Direct light of a TransportScene against closed forms and the path tracer.

#include <cmath>

#include <glm/gtc/matrix_transform.hpp>
#include <gtest/gtest.h>

#include <ssphh/core/parallel.h>
#include <ssphh/core/random.h>
#include <ssphh/core/sphere.h>
#include <ssphh/scene/builtin.h>
#include <ssphh/trace/transport_scene.h>

#include "hand_made.h"
#include "robot.h"

namespace ssphh::test {
namespace {

using rays::SurfacePoint;

std::unique_ptr<rays::DirectLight> light_at(const trace::TransportScene& source, float time = 0) {
  std::vector<mat4> poses;
  for (int p = 0; p < source.part_count(); ++p) poses.push_back(source.part_pose(p, time));
  return source.direct_light(source.lights(time), poses);
}

vec3 irradiance(const rays::DirectLight& light, const SurfacePoint& point, int group = 0) {
  vec3 out;
  light.irradiance(group, {&point, 1}, {&out, 1});
  return out;
}

double at_origin(const scene::Scene& scene, const trace::TransportOptions& options = {}) {
  const trace::TransportScene source(scene, options);
  return static_cast<double>(irradiance(*light_at(source), {}).x);
}

scene::Scene grey_floor() {
  scene::Scene scene;
  add_floor(scene, lambertian(vec3(0.5f)));
  return scene;
}

TEST(TransportLight, PointLightGivesCosineOverSquaredDistance) {
  scene::Scene scene = grey_floor();
  add_light(scene, scene::LightType::point, 7, vec3(3, 4, 0)).color = vec3(1, 0.5f, 0.25f);
  const trace::TransportScene source(scene);
  const vec3 e = irradiance(*light_at(source), {});
  // 7 / 25 · 4/5, to float rounding
  EXPECT_NEAR(e.x, 0.224, 1e-7);
  EXPECT_NEAR(e.y, 0.112, 1e-7);
  EXPECT_NEAR(e.z, 0.056, 1e-7);
  EXPECT_EQ(irradiance(*light_at(source), {vec3(0), vec3(0, -1, 0)}), vec3(0)) << "from behind";
}

TEST(TransportLight, StateOfALightWinsOverTheScene) {
  scene::Scene scene = grey_floor();
  add_light(scene, scene::LightType::point, 7, vec3(3, 4, 0));
  const trace::TransportScene source(scene);
  std::vector<scene::LightState> lights = source.lights(0);
  lights[0].world[3] = vec4(0, 2, 0, 1);
  lights[0].intensity = 3, lights[0].color = vec3(1, 2, 3);
  const std::vector<mat4> poses(1, mat4(1));
  const vec3 e = irradiance(*source.direct_light(lights, poses), {});
  EXPECT_NEAR(e.x, 0.75, 1e-6);
  EXPECT_NEAR(e.z, 2.25, 1e-6);
  lights[0].intensity = 0;
  EXPECT_EQ(irradiance(*source.direct_light(lights, poses), {}), vec3(0));
}

TEST(TransportLight, SpotAndDirectionalLight) {
  scene::Scene scene = grey_floor();
  scene::Light& spot = add_light(scene, scene::LightType::spot, 5, vec3(0, 2, 0), vec3(0.5f, -2, 0));
  spot.inner_cone = 0.5f, spot.outer_cone = 0.6f;
  EXPECT_NEAR(at_origin(scene), 5.0 / 4, 1e-6) << "within the inner cone";
  scene.lights.clear();
  add_light(scene, scene::LightType::directional, 2, vec3(0), vec3(3, -4, 0));
  EXPECT_NEAR(at_origin(scene), 2 * 0.8, 1e-6);
}

TEST(TransportLight, SphereLightGivesPiLTimesSquaredSineTimesCosine) {
  scene::Scene scene = grey_floor();
  add_light(scene, scene::LightType::sphere, 7, vec3(3, 4, 0)).radius = 0.5f;
  const double exact = pi_d * 7 * (0.25 / 25) * 0.8;
  EXPECT_NEAR(at_origin(scene), exact, 1e-5 * exact) << "no noise unhidden";
}

TEST(TransportLight, SphereLightOnTheHorizonGivesTheIntegralOverItsUpperHalf) {
  // Nusselt: the half cap above the horizon projects onto the unit disc as the segment beyond the chord at
  // cos α, of area α − sin α cos α.
  scene::Scene scene = grey_floor();
  add_light(scene, scene::LightType::sphere, 7, vec3(3, 0, 0)).radius = 1;
  const double alpha = std::asin(1.0 / 3), exact = 7 * (alpha - std::sin(alpha) * std::cos(alpha));
  trace::TransportOptions options;
  options.light_samples = 4096;
  EXPECT_NEAR(at_origin(scene, options), exact, 5e-3 * exact);
}

/// Irradiance at the origin, facing up, of a polygon of radiance 1 above the horizon (Lambert).
double lambert(std::span<const vec3> corners) {
  double sum = 0;
  for (std::size_t i = 0; i < corners.size(); ++i) {
    const glm::dvec3 a = glm::normalize(glm::dvec3(corners[i]));
    const glm::dvec3 b = glm::normalize(glm::dvec3(corners[(i + 1) % corners.size()]));
    const glm::dvec3 n = glm::cross(a, b);
    sum += std::acos(glm::clamp(glm::dot(a, b), -1.0, 1.0)) * n.y / glm::length(n);
  }
  return std::abs(sum) / 2;
}

TEST(TransportLight, AreaLightGivesItsFormFactor) {
  scene::Scene scene = grey_floor();
  const vec3 corner(-0.3f, 1.5f, -0.5f), u(1, 0, 0), v(0, 0, 1);
  add_object(scene, scene::make_quad(corner, u, v), lambertian(vec3(0), vec3(4)), "panel");
  const vec3 corners[4] = {corner, corner + u, corner + u + v, corner + v};
  const double exact = 4 * lambert(corners);
  EXPECT_NEAR(at_origin(scene), exact, 0.02 * exact);
  trace::TransportOptions options;
  options.light_samples = 4096;
  EXPECT_NEAR(at_origin(scene, options), exact, 2e-4 * exact);
}

TEST(TransportLight, ARectangleLampGivesItsFormFactorUnhiddenAndTheVisibleShareOfItElse) {
  scene::Scene scene = grey_floor();
  add_light(scene, scene::LightType::rectangle, 4, vec3(0.2f, 1.5f, 0)).size = {1, 0.5f};
  // The lamp's axes are those that looking() gives for straight down: x along x, y along −z.
  const vec3 corners[4] = {
      {-0.3f, 1.5f, 0.25f}, {0.7f, 1.5f, 0.25f}, {0.7f, 1.5f, -0.25f}, {-0.3f, 1.5f, -0.25f}};
  const double exact = 4 * lambert(corners);
  EXPECT_NEAR(at_origin(scene), exact, 1e-5 * exact) << "no noise unhidden";
  // Half way, a sheet over x < 0.1 leaves what is seen at x > 0.2.
  add_object(scene, scene::make_quad({-2, 0.75f, 2}, {2.1f, 0, 0}, {0, 0, -4}), lambertian(vec3(0)), "sheet");
  const vec3 left[4] = {{0.2f, 1.5f, 0.25f}, {0.7f, 1.5f, 0.25f}, {0.7f, 1.5f, -0.25f}, {0.2f, 1.5f, -0.25f}};
  trace::TransportOptions options;
  options.light_samples = 4096;
  EXPECT_NEAR(at_origin(scene, options), 4 * lambert(left), 0.01 * exact);
}

TEST(TransportLight, ConstantSkyGivesPi) {
  scene::Scene scene = grey_floor();
  add_constant_sky(scene, vec3(1, 2, 3));
  const trace::TransportScene source(scene);
  const vec3 e = irradiance(*light_at(source), {});
  for (int c = 0; c < 3; ++c) EXPECT_NEAR(e[c], pi * (c + 1), 1e-5f * (c + 1)) << "no noise unhidden";
}

TEST(TransportLight, SkyImageGivesTheCosineIntegralOfItsTexels) {
  // Radiance 1 at azimuths with x > 0: half of the irradiance of a full sky.
  scene::Scene scene = grey_floor();
  scene::Environment sky;
  sky.equirect = image::Image(64, 32);
  for (int y = 0; y < 32; ++y) {
    for (int x = 16; x < 48; ++x) sky.equirect.set_rgb(x, y, vec3(1));
  }
  scene.environment = sky;
  trace::TransportOptions options;
  options.environment_samples = 8192;
  EXPECT_NEAR(at_origin(scene, options), pi_d / 2, 2e-3);
  Samples means;
  const trace::TransportScene source(scene);
  for (int i = 0; i < 200; ++i)
    means.add(static_cast<double>(irradiance(*light_at(source), {vec3(0.01f * float(i), 0, 0)}).x));
  EXPECT_TRUE(mean_is(means, pi_d / 2, {}, 1e-4));
}

TEST(TransportLight, MovingPartCastsItsShadowWhereItIs) {
  scene::Scene scene = grey_floor();
  const int node = add_node(scene, "lid", vec3(0, 1, 0));
  add_object(scene, scene::make_box(vec3(-0.5f, 0, -0.5f), vec3(0.5f, 0.1f, 0.5f)), lambertian(vec3(0.5f)),
             "", node);
  add_light(scene, scene::LightType::point, 1, vec3(0, 3, 0));
  scene::Animation animation;
  animation.channels.push_back({node,
                                scene::AnimationPath::translation,
                                scene::Interpolation::linear,
                                {0, 1},
                                {{0, 1, 0, 0}, {2, 1, 0, 0}}});
  scene.animations.push_back(animation);
  const trace::TransportScene source(scene);
  const std::vector<SurfacePoint> points{{vec3(0, 0, 0)}, {vec3(3, 0, 0)}};
  for (const auto& [time, lit] : {std::pair{0.0f, 1}, {1.0f, 0}, {0.5f, -1}}) {
    std::vector<vec3> out(2);
    light_at(source, time)->irradiance(0, points, out);
    EXPECT_EQ(out[0].x > 0, lit != 1) << time;
    EXPECT_EQ(out[1].x > 0, lit != 0) << time;
  }
}

TEST(TransportLight, EmittedSeesSpheresAndTheSky) {
  scene::Scene scene = grey_floor();
  add_light(scene, scene::LightType::sphere, 7, vec3(0, 4, 0)).radius = 0.5f;
  add_constant_sky(scene, vec3(2));
  const trace::TransportScene source(scene);
  const auto light = light_at(source);
  const int globe = 0, sky = 1;
  const rays::RayQuery up{vec3(0), vec3(0, 2, 0)};
  const float escaped = std::numeric_limits<float>::infinity();
  EXPECT_EQ(light->emitted(globe, up, escaped), vec3(7));
  EXPECT_EQ(light->emitted(globe, up, 1.8f), vec3(7)) << "3.6 m away, the sphere begins at 3.5 m";
  EXPECT_EQ(light->emitted(globe, up, 1.7f), vec3(0));
  EXPECT_EQ(light->emitted(sky, up, escaped), vec3(2));
  EXPECT_EQ(light->emitted(sky, up, 100), vec3(0));
}

TEST(TransportLight, AnswersDependNeitherOnTheBatchNorOnThreads) {
  const scene::Scene scene = scene::make_builtin("cornell");
  const trace::TransportScene source(scene);
  const auto light = light_at(source);
  Pcg32 random(3);
  std::vector<SurfacePoint> points;
  for (int i = 0; i < 1500; ++i)
    points.push_back({random.uniform3() * 2.0f - 1.0f, sample_uniform_sphere(random.uniform2())});
  std::vector<vec3> all(points.size());
  light->irradiance(0, points, all);
  for (std::size_t i = 0; i < points.size(); i += 37) EXPECT_EQ(all[i], irradiance(*light, points[i]));
}

/// Points on the surfaces that random rays from `eye` meet.
std::vector<SurfacePoint> seen_points(const trace::TransportScene& source, const std::vector<mat4>& poses,
                                      const vec3& eye, int count) {
  Pcg32 random(21);
  std::vector<SurfacePoint> points;
  while (static_cast<int>(points.size()) < count) {
    const vec3 direction = sample_uniform_sphere(random.uniform2());
    float nearest = std::numeric_limits<float>::infinity();
    SurfacePoint point;
    for (int p = 0; p < source.part_count(); ++p) {
      const mat4& pose = poses[p];
      const mat4 from_world = glm::inverse(pose);
      const rays::RayQuery ray{vec3(from_world * vec4(eye, 1)), mat3(from_world) * direction};
      rays::RayHit hit;
      source.intersect(p, {&ray, 1}, {&hit, 1});
      if (!(hit.distance < nearest)) continue;
      nearest = hit.distance;
      point = {eye + nearest * direction, glm::normalize(glm::transpose(mat3(from_world)) * hit.normal)};
    }
    if (nearest < 100) points.push_back(point);
  }
  return points;
}

TEST(TransportLight, TwoRoomsAreLitAsThePathTracerSaysWhereverTheDoorIs) {
  const scene::Scene scene = scene::make_builtin("two-rooms");
  const trace::TransportScene source(scene);
  double behind[3];
  int index = 0;
  for (const float time : {0.0f, 0.5f, 1.0f}) {
    const trace::PathTracer tracer(scene, time);
    std::vector<mat4> poses;
    for (int p = 0; p < source.part_count(); ++p) poses.push_back(source.part_pose(p, time));
    for (const float side : {-1.0f, 1.0f}) {
      const auto points = seen_points(source, poses, vec3(2.5f * side, 1.4f, 0.1f), 2000);
      std::vector<vec3> e(points.size());
      light_at(source, time)->irradiance(0, points, e);
      const auto truth = tracer.surface_irradiance(points, {1, 1, 1, 0}, {});
      int differ = 0;
      double sum = 0;
      for (std::size_t i = 0; i < points.size(); ++i) {
        // One lamp that is a point: both are exact, but for rays that graze an edge.
        differ += std::abs(e[i].x - truth[i].direct.x) > 1e-5f * truth[i].direct.x;
        sum += static_cast<double>(e[i].x);
      }
      EXPECT_LE(differ, 4) << "of 2000 at time " << time;
      if (side > 0) behind[index++] = sum;
      EXPECT_TRUE(side > 0 || sum > 10);
    }
  }
  EXPECT_EQ(behind[0], 0) << "the door is shut";
  EXPECT_GT(behind[2], behind[1]);
}

/// All groups together against the path tracer, with parts posed at `time`.
void lights_as_the_path_tracer(const scene::Scene& scene, const vec3& eye, float time) {
  const trace::TransportScene source(scene);
  std::vector<mat4> poses;
  for (int p = 0; p < source.part_count(); ++p) poses.push_back(source.part_pose(p, time));
  const auto points = seen_points(source, poses, eye, 400);
  std::vector<vec3> one(points.size()), sum(points.size(), vec3(0));
  for (int g = 0; g < static_cast<int>(source.light_groups().size()); ++g) {
    light_at(source, time)->irradiance(g, points, one);
    for (std::size_t i = 0; i < points.size(); ++i) sum[i] += one[i];
  }
  const auto truth = trace::PathTracer(scene, time).surface_irradiance(points, {1, 1, 1024, 5}, {});
  Samples difference, light;
  for (std::size_t i = 0; i < points.size(); ++i) {
    difference.add(static_cast<double>(sum[i].x - truth[i].direct.x));
    light.add(static_cast<double>(truth[i].direct.x));
  }
  EXPECT_GT(light.mean(), 0.01);
  EXPECT_TRUE(mean_is(difference, 0, {1e-3, 4}, 1e-5)) << time;
  EXPECT_LT(std::sqrt(difference.variance()), 0.1 * light.mean()) << time;
}

TEST(TransportLight, MovingLampLightsFromWhereItIs) {
  // A panel that turns and sinks, with a box below it.
  scene::Scene scene;
  add_room(scene, lambertian(vec3(0.5f)));
  add_object(scene, scene::make_box(vec3(-0.5f, -1, -0.5f), vec3(0, -0.2f, 0)), lambertian(vec3(0.6f)),
             "box");
  const int node = add_node(scene, "panel", vec3(0, 0.9f, 0));
  add_object(scene, scene::make_quad(vec3(-0.2f, 0, -0.3f), vec3(0.4f, 0, 0), vec3(0, 0, 0.6f)),
             lambertian(vec3(0), vec3(5, 4, 3)), "", node);
  // And one of many triangles that stays.
  add_object(scene, scene::make_sphere(0.1f, 12, 6), lambertian(vec3(0), vec3(3)), "ball",
             add_node(scene, "ball", vec3(0.6f, 0.3f, 0.5f)));
  const quat turned = glm::angleAxis(0.7f, glm::normalize(vec3(1, 0, 1)));
  scene::Animation animation;
  animation.channels.push_back({node,
                                scene::AnimationPath::translation,
                                scene::Interpolation::linear,
                                {0, 1},
                                {{0, 0.9f, 0, 0}, {0.3f, 0.4f, 0, 0}}});
  animation.channels.push_back({node,
                                scene::AnimationPath::rotation,
                                scene::Interpolation::linear,
                                {0, 1},
                                {{0, 0, 0, 1}, {turned.x, turned.y, turned.z, turned.w}}});
  scene.animations.push_back(animation);
  for (const float time : {0.0f, 1.0f}) lights_as_the_path_tracer(scene, vec3(0.5f, -0.3f, -0.6f), time);
}

TEST(TransportLight, LampOnASkewedArmLightsFromWhereItIs) {
  for (const float time : {0.0f, 0.7f}) lights_as_the_path_tracer(robot(), vec3(0.7f, 0.1f, -0.6f), time);
}

TEST(TransportLight, PointsALittleBelowTheirSurfaceAreLitAllTheSame) {
  // Relative errors of 1e-5, as of means and of compressed positions.
  const scene::Scene scene = scene::make_builtin("two-rooms");
  const trace::TransportScene source(scene);
  const std::vector<mat4> poses{mat4(1), source.part_pose(1, 1)};
  const auto points = seen_points(source, poses, vec3(-2.5f, 1.4f, 0.1f), 2000);
  auto moved = points;
  const scene::Bounds bounds = source.part_bounds(0);
  Pcg32 random(2);
  for (SurfacePoint& p : moved)
    p.position += 1e-5f * (bounds.max - bounds.min) * (2.0f * random.uniform3() - 1.0f);
  std::vector<vec3> exact(points.size()), rounded(points.size());
  const auto light = source.direct_light(source.lights(1), poses);
  light->irradiance(0, points, exact);
  light->irradiance(0, moved, rounded);
  int differ = 0;
  for (std::size_t i = 0; i < points.size(); ++i)
    differ += std::abs(exact[i].x - rounded[i].x) > 1e-3f * exact[i].x + 1e-6f;
  EXPECT_LE(differ, 4) << "at the edges of shadows";
}

/// False may only be said where a box changes nothing.
TEST(TransportLight, MayShadowIsNeverWrong) {
  Pcg32 random(11);
  int changed = 0, denied = 0;
  for (int trial = 0; trial < 120; ++trial) {
    scene::Scene scene = grey_floor();
    const auto place = [&] {
      return vec3(4, 3, 4) * (random.uniform3() - vec3(0.5f, 0, 0.5f)) + vec3(0, 0.2f, 0);
    };
    switch (trial % 6) {
      case 0:
        add_light(scene, scene::LightType::point, 5, place());
        break;
      case 1:
        add_light(scene, scene::LightType::spot, 5, place(), vec3(0.3f, -1, 0));
        break;
      case 2:
        add_light(scene, scene::LightType::directional, 5, vec3(0), vec3(0.7f, -1, 0.2f));
        break;
      case 3:
        add_light(scene, scene::LightType::directional, 5, vec3(0), vec3(0.7f, -1, 0.2f)).angular_radius =
            0.1f;
        break;
      case 4:
        add_light(scene, scene::LightType::sphere, 5, place()).radius = 0.3f;
        break;
      default:
        add_object(scene, scene::make_quad(place(), vec3(0.6f, 0, 0), vec3(0, 0, 0.6f)),
                   lambertian(vec3(0), vec3(4)));
    }
    const vec3 low = place(), high = low + 0.1f + 0.9f * random.uniform3();
    const scene::Bounds box{low, high};
    scene::Scene with = scene;
    add_object(with, scene::make_box(low, high), lambertian(vec3(0.5f)));
    const trace::TransportScene before(scene), after(with);
    const auto light = light_at(before), shadowed = light_at(after);
    for (int i = 0; i < 200; ++i) {
      const vec2 p = 6.0f * random.uniform2() - 3.0f;
      SurfacePoint point{vec3(p.x, 0, p.y)};
      if (i % 4 == 0) point.normal = sample_uniform_sphere(random.uniform2());
      const bool differs = irradiance(*light, point) != irradiance(*shadowed, point);
      const bool may = light->may_shadow(0, point, box);
      changed += differs, denied += !may;
      EXPECT_TRUE(may || !differs) << "trial " << trial;
    }
  }
  EXPECT_GT(changed, 300);
  EXPECT_GT(denied, 12000);
}

}  // namespace
}  // namespace ssphh::test
