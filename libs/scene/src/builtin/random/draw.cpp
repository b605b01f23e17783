#include "draw.h"

#include <cmath>

#include <fmt/format.h>

#include <ssphh/scene/sun_sky.h>

namespace ssphh::scene {
namespace {

std::uint8_t srgb8(float linear) {
  const float encoded = linear <= 0.0031308f ? 12.92f * linear : 1.055f * std::pow(linear, 1 / 2.4f) - 0.055f;
  return static_cast<std::uint8_t>(std::lround(255 * glm::clamp(encoded, 0.0f, 1.0f)));
}

Texture checker(const vec3& even, const vec3& odd) {
  Texture texture;
  texture.name = "checker";
  texture.width = texture.height = 64;
  for (int y = 0; y < 64; ++y) {
    for (int x = 0; x < 64; ++x) {
      const vec3& color = (x / 32 + y / 32) % 2 == 0 ? even : odd;
      for (int c = 0; c < 3; ++c) texture.rgba.push_back(srgb8(color[c]));
      texture.rgba.push_back(255);
    }
  }
  return texture;
}

/// Radiance that differs by direction and colour: bright above, a warm side, a bluish one.
image::Image sky_picture(Draw& draw) {
  const int width = 64, height = 32;
  image::Image picture(width, height, 3);
  const float warm = draw.between(0, 2 * pi), level = draw.scaled(0.5f, 20);
  for (int y = 0; y < height; ++y) {
    for (int x = 0; x < width; ++x) {
      const float up = std::cos(pi * (static_cast<float>(y) + 0.5f) / static_cast<float>(height));
      const float side = std::cos(2 * pi * static_cast<float>(x) / static_cast<float>(width) - warm);
      const vec3 color = up > 0 ? vec3(0.6f + 0.3f * side, 0.7f, 1 - 0.3f * side) * (0.4f + 0.6f * up)
                                : vec3(0.25f, 0.22f, 0.2f);
      for (int c = 0; c < 3; ++c) picture.at(x, y)[c] = level * color[c];
    }
  }
  return picture;
}

}  // namespace

float Draw::scaled(float least, float most) {
  return least * std::pow(most / least, random_.uniform());
}

vec3 Draw::within(const vec3& least, const vec3& most) {
  const float z = between(least.z, most.z), y = between(least.y, most.y), x = between(least.x, most.x);
  return {x, y, z};
}

vec3 Draw::albedo() {
  const float level = between(0.15f, 0.8f);
  switch (pick(3)) {
    case 0:
      return vec3(level);
    case 1:
      return glm::clamp(level * (vec3(0.9f) + 0.2f * random_.uniform3()), 0.03f, 0.85f);
    default: {
      vec3 color(0.05f);
      color[pick(3)] = level;
      color[pick(3)] = between(0.05f, level);
      return color;
    }
  }
}

vec3 Draw::lamp_color() {
  const float warmth = random_.uniform();
  return {1, 1 - 0.35f * warmth, 1 - 0.7f * warmth};
}

int RandomScene::checkered(float repeats) {
  const vec3 odd = draw.albedo();
  return textured(draw.albedo(), odd, repeats);
}

int RandomScene::textured(const vec3& even, const vec3& odd, float repeats) {
  const int material = b.matte("checker", vec3(1));
  b.scene().textures.push_back(checker(even, odd));
  TextureUse& use = b.scene().materials.back().base_color_texture;
  use.texture = static_cast<int>(b.scene().textures.size()) - 1;
  use.scale = vec2(repeats);
  return material;
}

int RandomScene::material() {
  switch (draw.pick(8)) {
    case 0: {
      const float roughness = draw.between(0.2f, 0.8f);
      return b.glossy("glossy", draw.albedo(), roughness);
    }
    case 1: {
      const float roughness = draw.between(0.2f, 0.6f);
      return b.metal("metal", vec3(0.6f) + 0.35f * draw.albedo(), roughness);
    }
    case 2: {
      const vec3 even = draw.albedo();
      const float repeats = draw.scaled(1, 8);
      return textured(even, draw.albedo(), repeats);
    }
    default:
      return matte();
  }
}

int RandomScene::material_or_glass() {
  const int chosen = material();
  if (!glass.chance(0.25f)) return chosen;
  const vec3 color = glass.chance(0.5f) ? vec3(1) : glass.albedo();
  b.scene().materials[chosen] = solid_glass("glass", color, glass.scaled(0.05f, 1));
  return chosen;
}

int RandomScene::pane() {
  if (!glass.chance(0.5f)) return -1;
  return b.pane("pane", glass.chance(0.8f) ? vec3(0.97f) : vec3(0.3f) + 0.6f * glass.albedo());
}

void add_daylight(RandomScene& s, Daylight daylight) {
  s.daylight = daylight;
  Draw& draw = s.draw;
  const auto set = [&](image::Image picture, const vec3& color) {
    Environment environment;
    environment.name = "sky";
    environment.equirect = std::move(picture);
    environment.color = color;
    s.b.scene().environment = std::move(environment);
  };
  switch (daylight) {
    case Daylight::none:
      return;
    case Daylight::sun_and_sky:
      add_sun_sky(s.b.scene(), {.elevation = glm::radians(draw.between(8, 80)),
                                .azimuth = draw.between(0, 2 * pi),
                                .turbidity = draw.between(2, 9),
                                .width = 128});
      return;
    case Daylight::sky:
      set({}, draw.scaled(0.3f, 10) * vec3(0.8f, 0.9f, 1));
      return;
    case Daylight::picture:
      set(sky_picture(draw), vec3(1));
      return;
  }
}

void add_lamp(RandomScene& s, const vec3& least, const vec3& most, float area) {
  Draw& draw = s.draw;
  const std::string name = fmt::format("lamp {}", ++s.lamps);
  const vec3 place = draw.within(least, most);
  const vec3 color = draw.lamp_color();
  const float power = area * draw.scaled(3, 30);  // radiant watts: 3 to 30 W/m²
  switch (draw.pick(5)) {
    case 0:
      s.b.point_light(name, place, color, power / (4 * pi));
      return;
    case 1: {
      const float aside_z = draw.between(-0.5f, 0.5f), aside_x = draw.between(-0.5f, 0.5f);
      const vec3 target(place.x + aside_x, 0, place.z + aside_z);
      const float outer = draw.between(25, 75);
      const float solid_angle = 2 * pi * (1 - std::cos(glm::radians(outer)));
      s.b.spot_light(name, place, target, color, power / solid_angle, draw.between(0, outer - 2), outer);
      return;
    }
    case 2: {
      const float radius = draw.between(0.03f, 0.12f);
      s.b.sphere_light(name, place, radius, color, power / (4 * pi * pi * radius * radius));
      return;
    }
    case 3: {
      const float radius = draw.between(0.05f, 0.15f);
      const vec3 radiance = color * power / (4 * pi * pi * radius * radius);
      s.b.add(name, make_sphere(radius, 24, 12), s.b.matte(name, vec3(0), radiance), at(place));
      s.b.scene().instances.back().light_group = name;
      return;
    }
    default: {
      const float wide = draw.between(0.1f, 0.4f), deep = draw.between(0.1f, 0.6f);
      const vec3 radiance = color * power / (4 * wide * deep * pi);
      s.b.add_emitter(name, name, make_quad(place - vec3(wide, 0, deep), {2 * wide, 0, 0}, {0, 0, 2 * deep}),
                      radiance);
    }
  }
}

}  // namespace ssphh::scene
