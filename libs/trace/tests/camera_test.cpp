#include "camera.h"

#include <ssphh/core/sphere.h>
#include <ssphh/image/sphere_map.h>

#include "hand_made.h"

namespace ssphh::test {
namespace {

trace::RenderParams params_of(trace::Projection projection, int width, int height) {
  trace::RenderParams params;
  params.projection = projection;
  params.width = width, params.height = height;
  params.camera.world = look_at(vec3(1, 2, 3), vec3(1, 2, 0));
  params.camera.camera.yfov = pi / 2;
  return params;
}

void expect_near(const vec3& a, const vec3& b) {
  EXPECT_LT(glm::distance(a, b), 1e-6f) << a.x << " " << a.y << " " << a.z;
}

TEST(Camera, PinholeSpansItsVerticalFieldOfView) {
  const trace::CameraRays camera(params_of(trace::Projection::pinhole, 200, 100));
  expect_near(camera.ray(100, 50).direction, vec3(0, 0, -1));
  expect_near(camera.ray(100, 0).direction, glm::normalize(vec3(0, 1, -1)));
  expect_near(camera.ray(200, 50).direction, glm::normalize(vec3(2, 0, -1)));
  expect_near(camera.ray(0, 100).direction, glm::normalize(vec3(-2, -1, -1)));
  expect_near(camera.ray(0, 100).origin, vec3(1, 2, 3));
  // Depth is along the axis.
  EXPECT_NEAR(camera.depth(camera.ray(100, 0), std::sqrt(2.0f)), 1, 1e-6f);
}

TEST(Camera, ScaleOfTheNodeIsIgnored) {
  trace::RenderParams params = params_of(trace::Projection::pinhole, 200, 100);
  const trace::Ray plain = trace::CameraRays(params).ray(30, 70);
  params.camera.world = params.camera.world * glm::mat4(mat3(3.0f));
  expect_near(trace::CameraRays(params).ray(30, 70).direction, plain.direction);
}

TEST(Camera, OrthographicRaysAreParallel) {
  trace::RenderParams params = params_of(trace::Projection::orthographic, 200, 100);
  params.camera.camera.yheight = 4;
  const trace::CameraRays camera(params);
  expect_near(camera.ray(0, 0).direction, vec3(0, 0, -1));
  expect_near(camera.ray(0, 0).origin, vec3(1 - 4, 2 + 2, 3));
  expect_near(camera.ray(200, 100).origin, vec3(1 + 4, 2 - 2, 3));
}

TEST(Camera, EquirectLooksWhereTheImageConventionSays) {
  const trace::CameraRays camera(params_of(trace::Projection::equirect, 64, 32));
  expect_near(camera.ray(32, 16).direction, vec3(1, 0, 0));
  expect_near(camera.ray(48, 16).direction, vec3(0, 0, 1));
  expect_near(camera.ray(20, 10).direction, image::equirect_direction(20.0f / 64, 10.0f / 32));
}

TEST(Camera, CubeStripHasTheFacesInOrder) {
  const trace::CameraRays camera(params_of(trace::Projection::cube_strip, 48, 8));
  for (int face = 0; face < 6; ++face) {
    expect_near(camera.ray(static_cast<float>(8 * face) + 1.5f, 6.5f).direction,
                texel_direction(face, 1, 6, 8));
  }
}

TEST(Camera, CubeStripOfARenderMatchesTheProbesCube) {
  // Emission by face: what a probe at the same place sees.
  scene::Scene scene;
  add_room(scene, lambertian(vec3(0), vec3(1, 2, 3)));
  add_object(scene, scene::make_box(vec3(-0.9f, -0.9f, 0.5f), vec3(0.2f, 0.7f, 0.9f)), lambertian(vec3(0)),
             "box");
  trace::RenderParams params = params_of(trace::Projection::cube_strip, 6 * 16, 16);
  params.camera.world = mat4(1);
  params.path = {0, 1, 64, 1};
  const trace::RenderState state = render(scene, params);
  const rays::GroupRadiance probe =
      trace::PathTracer(scene).incident_radiance({vec3(0), 16, params.path}, {}).at(0);
  for (int face = 0; face < 6; ++face) {
    for (int y = 0; y < 16; ++y) {
      for (int x = 0; x < 16; ++x) {
        const float a = state.color.rgb(16 * face + x, y).y;
        const float b = probe.emitted.faces[face].rgb(x, y).y;
        // Texels at the box's edge have noise; a turned face would differ by 2 in dozens of texels.
        EXPECT_NEAR(a, b, 0.35f);
      }
    }
  }
}

}  // namespace
}  // namespace ssphh::test
