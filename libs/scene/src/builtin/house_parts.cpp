#include "house_parts.h"

#include <array>
#include <cmath>

namespace ssphh::scene {

void add_wall(Builder& b, const std::string& name, const Wall& wall, int material) {
  const auto piece = [&](float from, float to, float low, float high) {
    if (!(to > from && high > low)) return;
    vec3 least(wall.across, low, wall.across);
    vec3 most(wall.across + wall.thick, high, wall.across + wall.thick);
    least[wall.axis] = from, most[wall.axis] = to;
    b.add(name, make_box(least, most), material);
  };
  float at = wall.begin;
  for (const Opening& o : wall.openings) {
    piece(at, o.from, 0, wall.height);
    piece(o.from, o.to, 0, o.low);
    piece(o.from, o.to, o.high, wall.height);
    if (o.pane >= 0) {
      vec3 corner(wall.across + wall.thick / 2, o.low, wall.across + wall.thick / 2), along(0);
      corner[wall.axis] = o.from, along[wall.axis] = o.to - o.from;
      b.add("pane", make_quad(corner, along, {0, o.high - o.low, 0}), o.pane);
    }
    at = o.to;
  }
  piece(at, wall.end, 0, wall.height);
}

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

void add_shelf(Builder& b, const vec3& corner, const vec3& size, int boards, int material) {
  const float thick = 0.03f;
  const auto part = [&](const char* name, const vec3& least, const vec3& most) {
    b.add(name, make_box(corner + least, corner + most), material);
  };
  part("shelf side", vec3(0), {thick, size.y, size.z});
  part("shelf side", {size.x - thick, 0, 0}, size);
  for (int i = 0; i < boards; ++i) {
    const float y = static_cast<float>(i) / static_cast<float>(boards - 1) * (size.y - thick);
    part("shelf board", {thick, y, 0}, {size.x - thick, y + thick, size.z});
  }
}

void add_stairs(Builder& b, const vec3& corner, int steps, float width, int material) {
  const float rise = 0.17f, run = 0.28f;
  for (int i = 0; i < steps; ++i) {
    const auto step = static_cast<float>(i);
    b.add(
        "stair",
        make_box(corner + vec3(step * run, 0, 0), corner + vec3((step + 1) * run, (step + 1) * rise, width)),
        material);
  }
}

void add_teapot(Builder& b, const vec3& foot, float size, int material) {
  const float s = size;
  const std::array body = {vec2(0, 0),
                           vec2(0.09f, 0) * s,
                           vec2(0.13f, 0.04f) * s,
                           vec2(0.15f, 0.09f) * s,
                           vec2(0.145f, 0.13f) * s,
                           vec2(0.12f, 0.17f) * s,
                           vec2(0.085f, 0.19f) * s,
                           vec2(0.05f, 0.205f) * s,
                           vec2(0, 0.21f) * s};
  b.add("pot", make_lathe(body, 64), material, at(foot));
  b.add("knob", make_sphere(0.018f * s, 32, 16), material, at(foot + vec3(0, 0.225f * s, 0)));
  const auto spout = [&](float t) { return s * vec3(0.12f + 0.13f * t, 0.08f + 0.12f * t * t, 0); };
  b.add("spout", make_tube(spout, false, 0.018f * s, 24, 16), material, at(foot));
  const auto handle = [&](float t) {
    const float a = pi * (t - 0.5f);
    return s * vec3(-0.125f - 0.085f * std::cos(a), 0.11f + 0.05f * std::sin(a), 0);
  };
  b.add("handle", make_tube(handle, false, 0.012f * s, 32, 12), material, at(foot));
}

HousePaint house_paint(Builder& b) {
  HousePaint paint;
  paint.outer = b.matte("wall", {0.75f, 0.73f, 0.7f});
  paint.inner = b.matte("inner wall", {0.7f, 0.7f, 0.72f});
  paint.red = b.matte("red wall", {0.7f, 0.12f, 0.1f});
  paint.roof = b.matte("roof", {0.6f, 0.55f, 0.5f});
  paint.cloth = b.matte("cloth", {0.2f, 0.3f, 0.5f});
  paint.wood = b.matte("wood", {0.45f, 0.3f, 0.18f});
  paint.white = b.matte("white", vec3(0.75f));
  paint.pane = b.pane("pane", {0.96f, 0.98f, 0.97f});
  return paint;
}

void add_house(Builder& b, const HousePaint& paint) {
  const float sill = 0.9f, lintel = 2.2f, door = 2.1f, height = 2.7f, thick = 0.2f;
  const auto wall = [&](const char* name, int axis, float across, float begin, float end,
                        std::vector<Opening> openings, int material) {
    add_wall(b, name, {axis, across, begin, end, height, thick, std::move(openings)}, material);
  };
  const auto window = [&](float from) { return Opening{from, from + 2, sill, lintel, paint.pane}; };
  wall("front", 0, 0, 0, 12.2f, {window(1), window(5), window(9)}, paint.outer);
  wall("rear", 0, 8, 0, 12.2f, {{5.6f, 6.6f, 0, door}}, paint.outer);
  wall("west", 2, 0, thick, 8, {window(1.5f)}, paint.outer);
  wall("east", 2, 12, thick, 8, {window(1.5f)}, paint.outer);
  wall("corridor wall", 0, 5.5f, thick, 12,
       {{1.5f, 2.4f, 0, door}, {5.5f, 6.4f, 0, door}, {9.5f, 10.4f, 0, door}}, paint.inner);
  wall("partition", 2, 4, thick, 5.5f, {}, paint.inner);
  wall("red partition", 2, 8, thick, 5.5f, {}, paint.red);
  b.add("roof", make_box({-0.3f, height, -0.3f}, {12.5f, height + 0.25f, 8.5f}), paint.roof);

  add_sofa(b, {1, 0, 4.3f}, paint.cloth);
  add_table(b, {1.4f, 0, 2.2f}, {1.2f, 0.7f}, 0.45f, paint.wood);
  b.add("vase", make_sphere(0.14f, 32, 16), paint.white, at({1.9f, 0.59f, 2.5f}));
  b.add("bed", make_box({5, 0, 3.4f}, {7, 0.5f, 5.3f}), paint.cloth);
  b.add("cupboard", make_box({4.3f, 0, 0.6f}, {4.85f, 1.8f, 2}), paint.wood);
  add_table(b, {9.1f, 0, 2}, {1.8f, 1}, 0.75f, paint.wood);
  b.add("bowl", make_torus(0.2f, 0.07f, 40, 16), paint.white, at({10, 0.82f, 2.5f}));
  b.add("picture", make_box({11.93f, 1.3f, 3.9f}, {11.99f, 1.9f, 4.8f}), paint.wood);
}

}  // namespace ssphh::scene
