#include <array>
#include <cmath>

#include "builder.h"
#include "scenes.h"

namespace ssphh::scene {
namespace {

constexpr float period = 2;  // seconds: both fires
constexpr int keys = 16;

/// A sum of waves of that period, in −1..1.
float flicker(float turn, float phase) {
  const float t = 2 * pi * turn;
  return 0.5f * std::sin(3 * t + phase) + 0.3f * std::sin(7 * t + 2.1f * phase) +
         0.2f * std::sin(11 * t + 0.7f * phase);
}

/// Tongues of fire above a torch: balls that stretch and sway.
void add_flames(Builder& b, int torch) {
  struct Tongue {
    float radius, height;
    vec3 radiance;
  };
  const std::array<Tongue, 3> tongues{
      {{0.05f, 0.06f, {240, 110, 24}}, {0.036f, 0.13f, {300, 150, 36}}, {0.02f, 0.18f, {260, 90, 14}}}};
  Animation burn;
  burn.name = "burn";
  for (std::size_t i = 0; i < tongues.size(); ++i) {
    const Tongue& tongue = tongues[i];
    const std::string name = "flame " + std::to_string(i + 1);
    const int node = b.node(name, at({0, tongue.height, 0}), torch);
    b.add_at(node, name, make_sphere(tongue.radius, 24, 12), b.matte(name, vec3(0), tongue.radiance));
    b.scene().instances.back().light_group = "torch";
    AnimationChannel place{.node = node, .path = AnimationPath::translation, .times = {}, .values = {}};
    AnimationChannel size{.node = node, .path = AnimationPath::scale, .times = {}, .values = {}};
    for (int k = 0; k <= keys; ++k) {
      const float turn = static_cast<float>(k % keys) / keys, phase = 1.7f * static_cast<float>(i);
      const float sway = 0.25f * tongue.height;
      place.times.push_back(period * static_cast<float>(k) / keys);
      place.values.emplace_back(sway * flicker(turn, phase),
                                tongue.height * (1 + 0.2f * flicker(turn, phase + 1)),
                                sway * flicker(turn, phase + 2), 0);
      size.times.push_back(place.times.back());
      size.values.emplace_back(1 + 0.25f * flicker(turn, phase + 3), 1.3f + 0.4f * flicker(turn, phase + 4),
                               1 + 0.25f * flicker(turn, phase + 5), 0);
    }
    burn.channels.push_back(std::move(place));
    burn.channels.push_back(std::move(size));
  }
  b.scene().animations.push_back(std::move(burn));
}

/// I(ω) of an open fire: more upward and sideways than down, leaning now here, now there.
Emission fire() {
  Emission emission{{}, keys / period, 0, true};
  for (int k = 0; k < keys; ++k) {
    const float turn = static_cast<float>(k) / keys;
    sh::IntensitySh frame(2);
    const float level = 1 + 0.35f * flicker(turn, 0.4f);
    const vec3 color(1, 0.45f + 0.05f * flicker(turn, 2), 0.12f + 0.03f * flicker(turn, 3));
    const vec3 lean(0.35f * flicker(turn, 1), 0.5f, 0.35f * flicker(turn, 2.5f));
    frame[0] = level * color / 0.28209479f;
    frame[1] = level * lean.y * color / 0.48860251f;
    frame[2] = level * lean.z * color / 0.48860251f;
    frame[3] = level * lean.x * color / 0.48860251f;
    frame[6] = -0.15f * level * color;
    emission.frames.push_back(std::move(frame));
  }
  return emission;
}

}  // namespace

Scene make_torch() {
  Builder b("torch");
  const int stone = b.matte("stone", {0.5f, 0.46f, 0.4f}), floor = b.matte("floor", {0.42f, 0.36f, 0.3f});
  const int iron = b.glossy("iron", vec3(0.08f), 0.5f), wood = b.matte("wood", {0.35f, 0.22f, 0.12f});
  const int white = b.matte("plaster", vec3(0.75f)), blue = b.matte("cloth", {0.2f, 0.3f, 0.6f});
  b.add("vault", flipped(make_box({-3, 0, -2.5f}, {3, 3, 2.5f})), stone);
  b.add("slabs", make_quad({-2.9f, 0.01f, 2.4f}, {5.8f, 0, 0}, {0, 0, -4.8f}), floor);
  b.add("pillar", make_column(0.2f, 3), white, at({0.3f, 0, -0.6f}));
  b.add("chest", make_box({-0.4f, 0.01f, -0.3f}, {0.4f, 0.5f, 0.3f}), wood,
        at({-0.5f, 0, 1.5f}, 20, {0, 1, 0}));
  b.add("banner", make_box({-0.5f, 0.8f, -2.48f}, {0.5f, 2.4f, -2.45f}), blue, at({-1.6f, 0, 0}));
  b.add("stand", make_cylinder(0.02f, 1.1f), iron, at({-1.7f, 0.01f, 0.2f}));

  const int torch = b.node("torch", at({-1.7f, 1.5f, 0.2f}));
  b.add_at(torch, "handle", transformed(make_cylinder(0.025f, 0.36f), at({0, -0.38f, 0}).matrix()), wood);
  b.add_at(torch, "cup", transformed(make_cylinder(0.05f, 0.03f), at({0, -0.03f, 0}).matrix()), iron);
  add_flames(b, torch);
  b.sphl("fire", {1.9f, 0.5f, 1}, 0.2f, fire(), 3);

  b.camera("main", {2.6f, 1.6f, 2.1f}, {-1.2f, 1.1f, -0.8f}, 55);
  b.sphl("west", {-2.3f, 1.6f, 1.5f});
  b.sphl("middle", {-0.4f, 1.7f, 0.2f});
  b.sphl("east", {2, 1.8f, -1.3f});
  return b.finish();
}

}  // namespace ssphh::scene
