#include "lamp.h"

#include <algorithm>
#include <cmath>

#include <fmt/format.h>
#include <fmt/ranges.h>

#include <ssphh/scene/area_lamp.h>

#include "lamp_profile.h"

namespace ssphh::viewer {
namespace {

using enum scene::LightType;

/// Of lamps in a watch and over a valley [m].
constexpr float least_length = 1e-6f, most_length = 1e5f;

/// Of a number, with the name that it has in messages.
float& member(LightEdit& light, const std::string& name) {
  Lamp& lamp = light.lamp;
  if (name == "radius") return lamp.radius;
  if (name == "width") return lamp.size.x;
  if (name == "height") return lamp.size.y;
  if (name == "range") return lamp.range;
  if (name == "inner cone") return lamp.inner_cone;
  if (name == "outer cone") return lamp.outer_cone;
  if (name == "diameter") return lamp.angular_radius;
  return light.intensity;
}

/// What stands in a scene for one that is shown: degrees are radians, a diameter is twice a radius, and the
/// power of a flat lamp is π times its area and radiance.
float factor_of(const Lamp& lamp, const std::string& name) {
  if (name == "power") return 1 / (pi * scene::lamp_area(light_of(lamp, vec3(1), 1)));
  if (name == "inner cone" || name == "outer cone") return pi / 180;
  return name == "diameter" ? pi / 360 : 1;
}

/// A circle about an axis through its middle.
std::vector<vec3> circle(const vec3& middle, const vec3& axis, float radius) {
  constexpr int corners = 48;
  const Frame frame = Frame::around(axis);
  std::vector<vec3> line;
  for (int i = 0; i <= corners; ++i) {
    const float angle = 2 * pi * static_cast<float>(i) / corners;
    line.push_back(middle + radius * (std::cos(angle) * frame.x + std::sin(angle) * frame.y));
  }
  return line;
}

}  // namespace

Lamp lamp_of(const scene::Light& light) {
  return {light.name,       light.group,    light.type,           light.radius,
          light.size,       light.emission, light.angular_radius, light.inner_cone,
          light.outer_cone, light.range,    light.profile};
}

scene::Light light_of(const Lamp& lamp, const vec3& color, float intensity) {
  scene::Light light;
  light.name = lamp.name, light.group = lamp.group, light.type = lamp.type;
  light.color = color, light.intensity = intensity;
  light.radius = lamp.radius, light.size = lamp.size, light.emission = lamp.emission,
  light.angular_radius = lamp.angular_radius;
  light.inner_cone = lamp.inner_cone, light.outer_cone = lamp.outer_cone, light.range = lamp.range;
  light.profile = lamp.profile;
  return light;
}

std::vector<LampNumber> lamp_numbers(const LightEdit& light) {
  const scene::LightType type = light.lamp.type;
  // In the order of the types
  constexpr const char* units[] = {"W/sr", "W/sr", "W/m²", "W/(sr m²)", "times", "W/(sr m²)", "W/(sr m²)"};
  std::vector<LampNumber> numbers = {
      {"intensity", units[static_cast<int>(type)],
       "Point and spot: power per solid angle. Sun: irradiance of a plane that faces it. Sphere, "
       "rectangle and disc: radiance of the surface. SPHL: a factor on its emission.",
       0.001f, 0, 0, 1e6f}};
  if (scene::is_area_lamp(type))
    numbers.push_back({"power", "W",
                       "All light of a white lamp, which sets the intensity: π times area times radiance.",
                       0.001f, 0, 0, 1e7f});
  if (type == rectangle) {
    numbers.push_back({"width", "m",
                       "Along the lamp's x axis. A larger lamp of one intensity gives more light.", 0, 0,
                       least_length, most_length});
    numbers.push_back({"height", "m", "Along the lamp's y axis.", 0, 0, least_length, most_length});
  }
  if (type == sphere || type == sphl || type == disc)
    numbers.push_back({"radius", "m", "Larger lamps have softer shadows.", 0, 0, least_length, most_length});
  if (type == spot) {
    numbers.push_back({"outer cone", "°", "From the axis to where the light ends.", 0.1f, 0, 0.5f, 90});
    numbers.push_back(
        {"inner cone", "°", "From the axis to where the light begins to fade.", 0.1f, 0, 0, 90});
  }
  if (type == point || type == spot)
    numbers.push_back(
        {"range", "m", "Beyond this distance it does not shine; 0: no limit.", 0, 0, 0, most_length});
  if (type == directional)
    numbers.push_back({"diameter", "°", "Of its disc in the sky: the sun's is 0.53°, 0 has sharp shadows.",
                       0.01f, 0, 0, 180});
  LightEdit read = light;
  for (LampNumber& number : numbers) {
    number.value = member(read, number.name) / factor_of(light.lamp, number.name);
    if (number.name == std::string("inner cone")) number.high = light.lamp.outer_cone * 180 / pi;
  }
  return numbers;
}

void set_lamp_number(LightEdit& light, const std::string& name, float value) {
  const std::vector<LampNumber> numbers = lamp_numbers(light);
  const auto number = std::ranges::find_if(numbers, [&](const LampNumber& n) { return n.name == name; });
  if (number == numbers.end()) {
    std::vector<std::string> names;
    for (const LampNumber& n : numbers) names.emplace_back(n.name);
    throw Error(light.lamp.name, fmt::format("a {} lamp has no {}", name_of(light.lamp.type), name),
                fmt::format("it has: {}", fmt::join(names, ", ")));
  }
  // A number that went through degrees is not refused for its last bit.
  if (!(value >= number->low && value <= number->high * (1 + 1e-6f)))
    throw Error(light.lamp.name, fmt::format("{} {:g} {} is not within {:g} to {:g} {}", name, value,
                                             number->unit, number->low, number->high, number->unit));
  member(light, name) = value * factor_of(light.lamp, name);
  Lamp& lamp = light.lamp;
  lamp.inner_cone = std::min(lamp.inner_cone, lamp.outer_cone);
}

LightEdit new_lamp(scene::LightType type, const std::string& name, const vec3& place, float distance,
                   float exposure) {
  LightEdit light;
  light.lamp.name = name;
  light.lamp.type = type;
  // A white wall at the distance is half as bright as the picture's white.
  const float irradiance = 0.5f * pi / std::exp2(exposure);
  light.intensity = irradiance * distance * distance;
  if (type == directional) light.intensity = irradiance, light.lamp.angular_radius = 0.00465f;
  if (type == sphere) {
    light.lamp.radius = 0.05f * distance;
    light.intensity = irradiance / (pi * 0.05f * 0.05f);
  }
  if (type == sphl) {
    light.lamp.radius = 0.05f * distance;
    light.lamp.emission.frames = {scene::lobe_emission(scene::Lobe::beam, {0, 0, -1}, glm::radians(40.0f))};
  }
  if (scene::is_area_lamp(type)) {
    if (type == rectangle) light.lamp.size = distance * vec2(0.3f, 0.15f);
    if (type == disc) light.lamp.radius = 0.1f * distance;
    light.intensity *= 1 / scene::lamp_area(light_of(light.lamp, vec3(1), 1));
  }
  if (type == spot) light.lamp.inner_cone = glm::radians(30.0f), light.lamp.outer_cone = glm::radians(40.0f);
  const vec3 direction = type == directional ? vec3(-0.4f, -1, -0.3f) : vec3(0, -1, 0);
  const mat4 at = with_position(mat4(1), place);
  light.world = has_direction(type) ? with_direction(at, direction) : at;
  return light;
}

vec3 light_position(const mat4& world) {
  return vec3(world[3]);
}

vec3 light_direction(const mat4& world) {
  return -glm::normalize(vec3(world[2]));
}

mat4 with_position(const mat4& world, const vec3& position) {
  mat4 out = world;
  out[3] = vec4(position, 1);
  return out;
}

mat4 with_direction(const mat4& world, const vec3& direction) {
  const Frame frame = Frame::around(-glm::normalize(direction));
  return {vec4(frame.x, 0), vec4(frame.y, 0), vec4(frame.z, 0), world[3]};
}

bool has_direction(scene::LightType type, const scene::LampProfile& profile) {
  if (type == point) return !profile.empty();
  return type == spot || type == directional || type == sphl || scene::is_area_lamp(type);
}

bool has_place(scene::LightType type) {
  return type != directional;
}

std::vector<std::vector<vec3>> lamp_lines(const Lamp& lamp, const mat4& world, float length) {
  const vec3 at = light_position(world), along = light_direction(world);
  std::vector<std::vector<vec3>> lines;
  if (has_direction(lamp.type, lamp.profile)) lines.push_back({at, at + length * along});
  if (lamp.type == spot) {
    for (const float cone : {lamp.outer_cone, lamp.inner_cone}) {
      if (cone <= 0) continue;
      // Of one slant length: a cone of 90° is a disc.
      lines.push_back(circle(at + length * std::cos(cone) * along, along, length * std::sin(cone)));
    }
    for (const std::size_t i : {0u, 12u, 24u, 36u}) lines.push_back({at, lines[1][i]});
  }
  if (scene::is_area_lamp(lamp.type)) {
    const mat4 pose = scene::area_lamp_pose(world);
    const vec3 x = 0.5f * lamp.size.x * vec3(pose[0]), y = 0.5f * lamp.size.y * vec3(pose[1]);
    if (lamp.type == rectangle) lines.push_back({at - x - y, at + x - y, at + x + y, at - x + y, at - x - y});
    if (lamp.type == disc) lines.push_back(circle(at, along, lamp.radius));
  }
  if (!lamp.profile.empty()) {
    const mat3 axes = scene::emission_axes(world);
    for (const float turn : {0.0f, pi / 2}) {
      std::vector<vec3>& line = lines.emplace_back(profile_curve(lamp.profile, turn));
      for (vec3& p : line) p = at + length * (axes * p);
    }
  }
  const auto ball = [&](float radius) {
    for (const vec3& axis : {vec3(1, 0, 0), vec3(0, 1, 0), vec3(0, 0, 1)})
      lines.push_back(circle(at, axis, radius));
  };
  if (lamp.radius > 0 && (lamp.type == sphere || lamp.type == sphl)) ball(lamp.radius);
  if (lamp.range > 0 && (lamp.type == point || lamp.type == spot)) ball(lamp.range);
  return lines;
}

}  // namespace ssphh::viewer
