#include <cmath>

#include "builder.h"
#include "scenes.h"

namespace ssphh::scene {
namespace {

constexpr float tank_radius = 0.18f, water_level = 0.18f;  // metres

/// Height of the surface above its rest: waves in three directions that end at the rim.
float wave(float x, float z) {
  const float free = 1 - (x * x + z * z) / (tank_radius * tank_radius);
  const float waves = std::sin(21 * x + 4 * z) + 0.8f * std::sin(-9 * x + 17 * z + 1) +
                      0.6f * std::sin(-12 * x - 19 * z + 2.3f);
  return 0.006f * free * waves;
}

/// A round body of water. Only its waves show that it turns about its axis.
Mesh make_water() {
  constexpr int rings = 24;
  std::vector<vec2> profile{{0, 0}, {tank_radius, 0}};
  for (int i = rings; i >= 0; --i)
    profile.emplace_back(tank_radius * static_cast<float>(i) / rings, water_level);
  Mesh mesh = make_lathe(profile, 72);
  for (std::size_t i = 0; i < mesh.positions.size(); ++i) {
    vec3& p = mesh.positions[i];
    if (mesh.normals[i].y < 0.5f) continue;
    constexpr float step = 1e-3f;
    mesh.normals[i] = glm::normalize(vec3(wave(p.x - step, p.z) - wave(p.x + step, p.z), 2 * step,
                                          wave(p.x, p.z - step) - wave(p.x, p.z + step)));
    p.y += wave(p.x, p.z);
  }
  return mesh;
}

/// Once around y in `period` seconds.
AnimationChannel around(int node, float period, float sign) {
  AnimationChannel turn{.node = node, .path = AnimationPath::rotation, .times = {}, .values = {}};
  for (int quarter = 0; quarter <= 4; ++quarter) {
    const float half = sign * pi / 4 * static_cast<float>(quarter);
    turn.times.push_back(period / 4 * static_cast<float>(quarter));
    turn.values.emplace_back(0, std::sin(half), 0, std::cos(half));
  }
  return turn;
}

}  // namespace

Scene make_fishtank() {
  Builder b("fishtank");
  const int plaster = b.matte("plaster", vec3(0.7f)), wood = b.matte("wood", {0.4f, 0.26f, 0.15f});
  const int sand = b.matte("sand", {0.7f, 0.62f, 0.45f}), orange = b.matte("fish", {0.85f, 0.3f, 0.04f});
  b.add("room", flipped(make_box({-2, 0, -2}, {2, 2.6f, 2})), plaster);
  b.add("boards", make_quad({-1.99f, 0.005f, 1.99f}, {3.98f, 0, 0}, {0, 0, -3.98f}), wood);
  b.add("picture", make_box({0.2f, 1.2f, -1.995f}, {1.2f, 1.9f, -1.97f}), b.matte("red", {0.6f, 0.1f, 0.1f}));
  b.add("stand", make_box({-0.45f, 0.005f, -0.45f}, {0.45f, 0.7f, 0.45f}), wood, at({-0.5f, 0, -0.4f}));

  const int tank = b.node("tank", at({-0.5f, 0.71f, -0.4f}));
  b.stand_on(tank);
  b.add("sand", make_cylinder(0.17f, 0.018f), sand, at({0, 0.005f, 0}));
  b.add_emitter("lamp", "lamp", transformed(make_cylinder(0.09f, 0.022f), at({0, 0.01f, 0}).matrix()),
                {180, 167, 132});
  const int fish = b.node("fish", at(vec3(0)), tank);
  Transform body = at({0.11f, 0.108f, 0});
  body.scale = {0.018f, 0.025f, 0.05f};
  b.add_at(fish, "fish", transformed(make_sphere(1, 32, 16), body.matrix()), orange);
  b.add_at(fish, "tail", make_box({0.108f, 0.09f, 0.045f}, {0.112f, 0.126f, 0.08f}), orange);
  const int water = b.node("water", at(vec3(0)), tank);
  b.add_at(water, "water", make_water(), b.body("water", {0.7f, 0.92f, 0.97f}, 0.5f, 1.33f));
  b.stand_on(-1);
  b.scene().animations.push_back({"waves", {around(water, 4, 1), around(fish, 4, -1)}});

  b.camera("main", {1.7f, 1.4f, 1.8f}, {-0.5f, 1.25f, -0.6f}, 65);
  b.camera("tank", {0.5f, 1.3f, 0.7f}, {-0.5f, 0.9f, -0.4f}, 40);
  b.sphl("west", {-1.5f, 1.7f, 1});
  b.sphl("middle", {0.6f, 1.2f, 0.4f});
  b.sphl("tank", {-0.5f, 1.9f, -0.4f});
  b.sphl("east", {1.4f, 1.8f, -1.3f});
  return b.finish();
}

}  // namespace ssphh::scene
