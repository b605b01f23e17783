#include <ssphh/image/sphere_map.h>

#include "builder.h"
#include "scenes.h"

namespace ssphh::scene {
namespace {

/// Nowhere negative, and a sum of spherical harmonics up to degree 2, so that transfer vectors of that degree
/// lose nothing of it. Warm to +x, bluish above, another colour in each quarter of the horizon.
vec3 sky(const vec3& d) {
  return vec3(0.9f, 0.8f, 0.9f) + d.x * vec3(0.6f, 0.3f, -0.1f) + d.y * vec3(0.05f, 0.2f, 0.5f) +
         d.z * vec3(-0.15f, 0.15f, 0.1f) + d.x * d.z * vec3(0.2f, -0.1f, 0.2f);
}

}  // namespace

/// A court of 4 m, open above, whose environment alone lights it: what turns with the environment shows.
/// Walls in three colours bleed on white bodies; the fourth side is low, for the camera.
Scene make_court() {
  Builder b("court");
  const int white = b.matte("white", vec3(0.75f));
  const int red = b.matte("red", {0.7f, 0.12f, 0.08f});
  const int green = b.matte("green", {0.15f, 0.5f, 0.12f});
  const int blue = b.matte("blue", {0.15f, 0.25f, 0.65f});
  const int stone = b.matte("stone", {0.55f, 0.5f, 0.45f});

  b.add("floor", make_quad({-2, 0, 2}, {4, 0, 0}, {0, 0, -4}), stone);
  b.add("left wall", make_box({-2.2f, 0, -2.2f}, {-2, 2, 2}), red);
  b.add("right wall", make_box({2, 0, -2.2f}, {2.2f, 2, 2}), green);
  b.add("back wall", make_box({-2, 0, -2.2f}, {2, 2, -2}), blue);
  b.add("sill", make_box({-2, 0, 1.8f}, {2, 0.3f, 2}), white);
  b.add("block", make_box({-0.35f, 0, -0.35f}, {0.35f, 0.9f, 0.35f}), white,
        at({-0.9f, 0, -0.7f}, 25, {0, 1, 0}));
  b.add("knot", make_torus_knot(2, 3, 0.4f, 0.17f, 0.11f, 160, 14), white,
        at({0.8f, 0.62f, -0.2f}, 70, {1, 0, 0}));
  b.add("ball", make_sphere(0.3f, 32, 16), white, at({-0.35f, 0.3f, 0.75f}));

  Environment environment;
  constexpr int width = 128, height = 64;
  environment.equirect = image::Image(width, height);
  for (int y = 0; y < height; ++y) {
    for (int x = 0; x < width; ++x) {
      const vec3 d = image::equirect_direction((static_cast<float>(x) + 0.5f) / width,
                                               (static_cast<float>(y) + 0.5f) / height);
      environment.equirect.set_rgb(x, y, sky(d));
    }
  }
  b.scene().environment = std::move(environment);

  b.camera("front", {0.2f, 2.6f, 4.6f}, {0, 0.55f, -0.3f}, 42);
  b.sphl("middle", {0, 1.3f, 0.2f});
  b.sphl("left", {-1.6f, 0.7f, 0.4f});
  b.sphl("right", {1.6f, 0.8f, 0.9f});
  b.sphl("back", {0, 0.9f, -1.6f});
  b.sphl("front", {0.5f, 0.5f, 1.3f});
  b.sphl("above", {0.2f, 2.3f, -0.5f});
  return b.finish();
}

}  // namespace ssphh::scene
