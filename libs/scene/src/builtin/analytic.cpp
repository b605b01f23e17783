#include "builder.h"
#include "scenes.h"

namespace ssphh::scene {

/// White furnace: a convex body of albedo ρ = 0.5 under radiance 1 from everywhere reflects exactly ρ, since
/// none of its points sees another. Flat normals: with interpolated ones the cosine would belong to another
/// plane than the horizon that the body itself makes.
Scene make_furnace() {
  Builder b("furnace");
  Mesh sphere = make_sphere(1, 64, 32);
  sphere.normals.clear();
  b.add("body", std::move(sphere), b.matte("half", vec3(0.5f)));
  b.scene().environment = Environment{};

  b.camera("front", {0, 0, 4}, {0, 0, 0}, 40, 1);
  b.sphl("east", {2, 0, 0});
  b.sphl("west", {-2, 0, 0});
  b.sphl("above", {0, 2, 0});
  b.sphl("below", {0, -2, 0});
  b.sphl("south", {0, 0, 2});
  b.sphl("north", {0, 0, -2});
  return b.finish();
}

/// Every wall emits Le = 1 and reflects ρ = 0.5: radiance Σ ρ^k = Le/(1 − ρ) = 2 everywhere, Σ_{k ≤ d} ρ^k at
/// depth d.
Scene make_glowing_box() {
  Builder b("box");
  b.add("walls", flipped(make_box(vec3(-1), vec3(1))), b.matte("glowing", vec3(0.5f), vec3(1)));

  b.camera("inside", {0.3f, 0.1f, 0.8f}, {-0.2f, 0, -1}, 60, 1);
  b.sphl("center", {0, 0, 0});
  b.sphl("east", {0.6f, 0.3f, 0.2f});
  b.sphl("west", {-0.7f, -0.2f, 0.4f});
  b.sphl("above", {-0.1f, 0.7f, -0.3f});
  b.sphl("corner", {0.8f, -0.8f, -0.8f});
  return b.finish();
}

}  // namespace ssphh::scene
