#include <ssphh/scene/sun_sky.h>

#include "builder.h"
#include "scenes.h"

namespace ssphh::scene {
namespace {

constexpr float height = 2.7f, thick = 0.2f;

/// Along a wall, from `from` to `to` metres, open between two heights.
struct Opening {
  float from, to, low, high;
};
constexpr float sill = 0.9f, lintel = 2.2f, door = 2.1f;

struct Walls {
  Builder& b;

  /// From `begin` to `end` along x or z (`axis`), `across` the lesser coordinate of its faces, with openings
  /// in ascending order.
  void add(const std::string& name, int axis, float across, float begin, float end,
           const std::vector<Opening>& openings, int material) {
    const auto piece = [&](float from, float to, float low, float high) {
      if (!(to > from && high > low)) return;
      vec3 least(across, low, across), most(across + thick, high, across + thick);
      least[axis] = from, most[axis] = to;
      b.add(name, make_box(least, most), material);
    };
    float at = begin;
    for (const Opening& o : openings) {
      piece(at, o.from, 0, height);
      piece(o.from, o.to, 0, o.low);
      piece(o.from, o.to, o.high, height);
      at = o.to;
    }
    piece(at, end, 0, height);
  }
};

void add_table(Builder& b, const vec3& corner, const vec2& size, float top, int material) {
  const float leg = 0.07f;
  b.add("table top", make_box(corner + vec3(0, top - 0.05f, 0), corner + vec3(size.x, top, size.y)),
        material);
  for (const float x : {0.0f, size.x - leg}) {
    for (const float z : {0.0f, size.y - leg})
      b.add("table leg", make_box(corner + vec3(x, 0, z), corner + vec3(x + leg, top - 0.05f, z + leg)),
            material);
  }
}

void add_sofa(Builder& b, const vec3& corner, int material) {
  b.add("seat", make_box(corner, corner + vec3(2, 0.42f, 0.9f)), material);
  b.add("back", make_box(corner + vec3(0, 0.42f, 0.7f), corner + vec3(2, 0.85f, 0.9f)), material);
  b.add("arm", make_box(corner + vec3(0, 0.42f, 0), corner + vec3(0.2f, 0.6f, 0.7f)), material);
  b.add("arm", make_box(corner + vec3(1.8f, 0.42f, 0), corner + vec3(2, 0.6f, 0.7f)), material);
}

}  // namespace

/// Three furnished rooms and a corridor, 12 m by 8, on a plain of 250 m that is their floor, too: indoors and
/// outdoors at once, a scene whose bounds say nothing of where the light matters.
Scene make_house() {
  Builder b("house");
  const int ground = b.matte("ground", {0.35f, 0.33f, 0.28f});
  const int outer = b.matte("wall", {0.75f, 0.73f, 0.7f});
  const int inner = b.matte("inner wall", {0.7f, 0.7f, 0.72f});
  const int red = b.matte("red wall", {0.7f, 0.12f, 0.1f});
  const int roof = b.matte("roof", {0.6f, 0.55f, 0.5f});
  const int cloth = b.matte("cloth", {0.2f, 0.3f, 0.5f});
  const int wood = b.matte("wood", {0.45f, 0.3f, 0.18f});
  const int white = b.matte("white", vec3(0.75f));

  b.add("ground", make_quad({-125, 0, 125}, {250, 0, 0}, {0, 0, -250}), ground);
  Walls walls{b};
  walls.add("front", 0, 0, 0, 12.2f, {{1, 3, sill, lintel}, {5, 7, sill, lintel}, {9, 11, sill, lintel}},
            outer);
  walls.add("rear", 0, 8, 0, 12.2f, {{5.6f, 6.6f, 0, door}}, outer);
  walls.add("west", 2, 0, thick, 8, {{1.5f, 3.5f, sill, lintel}}, outer);
  walls.add("east", 2, 12, thick, 8, {{1.5f, 3.5f, sill, lintel}}, outer);
  walls.add("corridor wall", 0, 5.5f, thick, 12,
            {{1.5f, 2.4f, 0, door}, {5.5f, 6.4f, 0, door}, {9.5f, 10.4f, 0, door}}, inner);
  walls.add("partition", 2, 4, thick, 5.5f, {}, inner);
  walls.add("red partition", 2, 8, thick, 5.5f, {}, red);
  b.add("roof", make_box({-0.3f, height, -0.3f}, {12.5f, height + 0.25f, 8.5f}), roof);

  add_sofa(b, {1, 0, 4.3f}, cloth);
  add_table(b, {1.4f, 0, 2.2f}, {1.2f, 0.7f}, 0.45f, wood);
  b.add("vase", make_sphere(0.14f, 32, 16), white, at({1.9f, 0.59f, 2.5f}));
  b.add("bed", make_box({5, 0, 3.4f}, {7, 0.5f, 5.3f}), cloth);
  b.add("cupboard", make_box({4.3f, 0, 0.6f}, {4.85f, 1.8f, 2}), wood);
  add_table(b, {9.1f, 0, 2}, {1.8f, 1}, 0.75f, wood);
  b.add("bowl", make_torus(0.2f, 0.07f, 40, 16), white, at({10, 0.82f, 2.5f}));
  b.add("picture", make_box({11.93f, 1.3f, 3.9f}, {11.99f, 1.9f, 4.8f}), wood);
  add_sun_sky(b.scene(), {.elevation = glm::radians(40.0f), .azimuth = glm::radians(-60.0f)});

  b.camera("room-a", {3.6f, 1.6f, 5}, {1, 1.1f, 0.5f}, 55);
  b.camera("room-b", {7.6f, 1.6f, 5.1f}, {5.4f, 1.1f, 0.5f}, 55);
  b.camera("room-c", {8.6f, 1.6f, 5}, {10.8f, 1, 0.8f}, 55);
  b.camera("corridor", {0.8f, 1.6f, 7}, {8, 1.2f, 6.6f}, 50);
  b.camera("outside", {22, 7, -16}, {6, 1, 4}, 40);
  return b.finish();
}

}  // namespace ssphh::scene
