/// Light that flat sheets of glass mirror: closed forms and path tracing.

#include <gtest/gtest.h>

#include <ssphh/core/random.h>
#include <ssphh/core/sphere.h>
#include <ssphh/rays/posed_world.h>
#include <ssphh/scene/primitives.h>
#include <ssphh/shading/glass.h>
#include <ssphh/trace/path_tracer.h>
#include <ssphh/trace/transport_scene.h>

namespace ssphh::trace {
namespace {

constexpr vec3 tint(0.9f, 0.6f, 0.3f);

/// A tinted pane in the plane x = 0 of 2 × 2 m, and a lamp of radius 0.05 m at (1, 1, 0), or a sky.
scene::Scene pane_scene(bool lamp, bool sky) {
  scene::Scene s;
  scene::Material glass;
  glass.transmission = 1, glass.base_color = tint, glass.specular_roughness = 0;
  s.materials.push_back(glass);
  s.meshes.push_back(scene::make_quad(vec3(0, 0, -1), vec3(0, 0, 2), vec3(0, 2, 0)));
  s.meshes[0].material = 0;
  s.nodes.resize(2);
  s.nodes[1].local.translation = vec3(1, 1, 0);
  scene::Instance pane;
  pane.mesh = 0, pane.node = 0;
  s.instances.push_back(pane);
  if (lamp) {
    scene::Light light;
    light.type = scene::LightType::sphere, light.radius = 0.05f;
    light.name = "lamp", light.node = 1, light.color = vec3(1, 2, 3), light.intensity = 4;
    s.lights.push_back(light);
  }
  if (sky) s.environment.emplace().color = vec3(1, 2, 3);
  return s;
}

std::unique_ptr<rays::DirectLight> light_of(const TransportScene& source) {
  const std::vector<mat4> poses(1, mat4(1));
  return source.direct_light(source.lights(0), poses);
}

const rays::SurfacePoint floor_point{vec3(1.5f, 0, 0.2f), vec3(0, 1, 0)};

vec3 reflectance(float cosine) {
  return shading::sheet_reflectance({.share = 1, .tint = tint}, cosine);
}

TEST(MirroredLight, AFloorGetsTheLampsImageTimesTheSheetsReflectance) {
  const scene::Scene s = pane_scene(true, false);
  const TransportScene source(s);
  const auto light = light_of(source);
  ASSERT_TRUE(light->mirrors());
  vec3 found;
  light->mirrored(0, {&floor_point, 1}, {&found, 1});
  // The lamp's light straight to the point's mirror image, times what the sheet mirrors at that angle
  const rays::SurfacePoint image{floor_point.position * vec3(-1, 1, 1), floor_point.normal};
  const scene::Scene open = [&] {
    scene::Scene without = s;
    without.instances.clear();
    return without;
  }();
  const TransportScene open_source(open);
  vec3 straight;
  light_of(open_source)->irradiance(0, {&image, 1}, {&straight, 1});
  const vec3 way = glm::normalize(vec3(1, 1, 0) - image.position);
  const vec3 expected = straight * reflectance(way.x);
  for (int c = 0; c < 3; ++c) EXPECT_NEAR(found[c] / expected[c], 1, 1e-2f) << c;  // over the lamp's extent

  const rays::IrradianceByNormal turned = light->mirrored_by_normal(0, floor_point, 256);
  const vec3 toward = way * vec3(-1, 1, 1);
  for (int c = 0; c < 3; ++c) {
    EXPECT_NEAR(turned[3][c] / expected[c], 1, 1e-2f) << c;
    // A surface that turns toward the pane gets more, as the cosine says
    EXPECT_NEAR(turned[0][c] / (expected[c] * toward.x / toward.y), 1, 2e-2f) << c;
  }
  vec3 facing(0);
  for (const rays::ArrivingLight& part : light->mirrored_arriving(0, floor_point.position, 256)) {
    EXPECT_GT(glm::dot(part.toward, toward), 0.99f);
    facing += part.irradiance;
  }
  for (int c = 0; c < 3; ++c) EXPECT_NEAR(facing[c] * toward.y / expected[c], 1, 1e-2f) << c;
}

TEST(MirroredLight, NothingIsMirroredBesideThePaneOrFromBehindIt) {
  const scene::Scene s = pane_scene(true, false);
  const TransportScene source(s);
  const auto light = light_of(source);
  const rays::SurfacePoint behind{vec3(-1.5f, 0, 0), vec3(0, 1, 0)}, beside{vec3(1.5f, 0, 9), vec3(0, 1, 0)};
  for (const rays::SurfacePoint& point : {behind, beside}) {
    vec3 found(1);
    light->mirrored(0, {&point, 1}, {&found, 1});
    EXPECT_EQ(found, vec3(0));
    EXPECT_TRUE(light->mirrored_arriving(0, point.position, 64).empty());
  }
}

TEST(MirroredLight, LampsWithoutExtentAreNotMirroredAsTheyAreToPaths) {
  scene::Scene s = pane_scene(true, false);
  s.lights[0].type = scene::LightType::point, s.lights[0].radius = 0;
  const TransportScene source(s);
  vec3 found(1);
  light_of(source)->mirrored(0, {&floor_point, 1}, {&found, 1});
  EXPECT_EQ(found, vec3(0));
  const auto traced = PathTracer(s).surface_irradiance({&floor_point, 1}, {.max_depth = 4, .spp = 4096}, {});
  EXPECT_EQ(traced[0].indirect, vec3(0));
}

// All that is indirect at these points is mirrored. Five standard errors of the paths, and 2 % of ours.
TEST(MirroredLight, SkyAndLampAreMirroredAsPathsFindThem) {
  for (const bool sky : {false, true}) {
    scene::Scene s = pane_scene(!sky, sky);
    if (!sky) s.lights[0].radius = 0.4f;
    const TransportScene source(s, {.light_samples = 1024, .environment_samples = 1 << 14});
    const auto light = light_of(source);
    const std::vector<rays::SurfacePoint> points{floor_point,
                                                 {vec3(0.4f, 0.7f, 0), vec3(0, 0, 1)},
                                                 {vec3(-0.5f, 1, 0.1f), glm::normalize(vec3(2, 1, 0))}};
    std::vector<vec3> found(points.size());
    light->mirrored(0, points, found);
    const auto traced = PathTracer(s).surface_irradiance(points, {.max_depth = 2, .spp = 1 << 18}, {});
    for (std::size_t i = 0; i < points.size(); ++i) {
      for (int c = 0; c < 3; ++c) {
        const float noise = std::sqrt(traced[i].indirect_variance[c]);
        EXPECT_NEAR(found[i][c], traced[i].indirect[c], 5 * noise + 0.02f * traced[i].indirect[c])
            << sky << ' ' << i << ' ' << c;
      }
      const rays::IrradianceByNormal kept = light->mirrored_by_normal(0, points[i], 1 << 14);
      for (int c = 0; c < 3; ++c)
        EXPECT_NEAR(kept[3][c], found[i][c], 0.02f * found[i][c]) << sky << ' ' << i;
    }
  }
}

TEST(MirroredLight, RaysFollowThePaneByItsReflectanceWhateverTheirCompany) {
  const scene::Scene s = pane_scene(false, true);
  const TransportScene source(s);
  std::vector<rays::RayQuery> rays;
  for (int i = 0; i < 2000; ++i) rays.push_back({vec3(0.7f, 1, 0), spherical_fibonacci(i, 2000)});
  std::vector<rays::RayHit> hits(rays.size());
  source.intersect(0, rays, hits);
  const std::vector<rays::MirroredRay> all = source.mirrored(0, rays, hits);
  ASSERT_GT(all.size(), 100u);
  for (const rays::MirroredRay& m : all) {
    const vec3 d = rays[m.of].direction, expected = reflectance(-d.x);
    EXPECT_LT(glm::distance(m.ray.direction, d * vec3(-1, 1, 1)), 1e-5f);
    EXPECT_NEAR(m.ray.origin.x, 0, 1e-4f);
    for (int c = 0; c < 3; ++c) EXPECT_NEAR(m.share[c], expected[c], 1e-4f);
    const auto alone = source.mirrored(0, {&rays[m.of], 1}, {&hits[m.of], 1});
    ASSERT_EQ(alone.size(), 1u);
    EXPECT_EQ(alone[0].ray.direction, m.ray.direction);
    EXPECT_EQ(alone[0].share, m.share);
  }
}

// Of several panes one is chosen: in the mean over rays each mirrors what reaches it.
TEST(MirroredLight, OneOfSeveralPanesIsChosenAsLightDoes) {
  scene::Scene s = pane_scene(false, true);
  s.nodes.emplace_back().local.translation = vec3(-1, 0, 0);
  s.instances.push_back(s.instances[0]);
  s.instances[1].node = 2;
  const TransportScene source(s);
  std::vector<rays::RayQuery> rays;
  for (int i = 0; i < 40000; ++i)
    rays.push_back({vec3(1, 0.5f + 1e-5f * static_cast<float>(i), 0), vec3(-1, 0, 0)});
  std::vector<rays::RayHit> hits(rays.size());
  source.intersect(0, rays, hits);
  vec3 near(0), far(0);
  for (const rays::MirroredRay& m : source.mirrored(0, rays, hits))
    (m.ray.origin.x > -0.5f ? near : far) += m.share / static_cast<float>(rays.size());
  const vec3 r = reflectance(1);
  const vec3 t = shading::straight_transmittance({.share = 1, .tint = tint}, 1);
  for (int c = 0; c < 3; ++c) {
    EXPECT_NEAR(near[c] / r[c], 1, 0.04f) << c;  // 40,000 rays of which half choose otherwise: 0.5 %, times 8
    EXPECT_NEAR(far[c] / (t[c] * r[c]), 1, 0.04f) << c;
  }
}

TEST(MirroredLight, APanePartsWhatItLetsSeeEachOther) {
  const scene::Scene s = pane_scene(true, false);
  const PathTracer tracer(s);
  const TransportScene source(s);
  const rays::PosedWorld world(source, 0);
  const vec3 a(0.5f, 1, 0), b(-0.5f, 1, 0), c(0.5f, 0.5f, 0);
  EXPECT_TRUE(tracer.visible(a, b) && tracer.joined(a, c) && world.joined(a, c));
  EXPECT_FALSE(tracer.joined(a, b) || world.joined(a, b));
}

TEST(MirroredLight, WhatIsJoinedIsWhatNearestHitsSay) {
  scene::Scene s = pane_scene(true, false);
  s.animations.emplace_back().channels.push_back(
      {.node = 0, .path = scene::AnimationPath::translation, .times = {0}, .values = {vec4(0)}});
  s.meshes.push_back(scene::make_box({-0.4f, 0, -0.4f}, {-0.2f, 1, 0.4f}));
  s.instances.push_back({1, -1, -1, ""});
  const TransportScene source(s);
  ASSERT_EQ(source.part_count(), 2);
  Pcg32 random(6);
  int joined[2] = {};
  for (int i = 0; i < 400; ++i) {
    const vec3 from = 2.0f * random.uniform3() - vec3(1, 0, 1), to = 2.0f * random.uniform3() - vec3(1, 0, 1);
    for (int part = 0; part < 2; ++part) {
      const rays::RayQuery way{from, to - from, 1};
      joined[part] += source.joined(part, way);
      EXPECT_EQ(source.joined(part, way), source.rays::TransportSource::joined(part, way)) << i;
    }
  }
  for (const int count : joined) EXPECT_TRUE(count > 100 && count < 380) << count;
}

}  // namespace
}  // namespace ssphh::trace
