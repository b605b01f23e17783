#pragma once
/// Lamps as users make and change them.

#include <string>
#include <vector>

#include <ssphh/scene/scene.h>

namespace ssphh::viewer {

/// A lamp apart from its place, colour and intensity: what renderers and light transport are built for.
struct Lamp {
  std::string name, group;  ///< group empty: the name
  scene::LightType type = scene::LightType::point;
  float radius = 0;  ///< this and what follows as those of scene::Light
  vec2 size{0};
  scene::Emission emission;
  float angular_radius = 0;
  float inner_cone = 0, outer_cone = pi / 4;
  float range = 0;
  scene::LampProfile profile{};

  friend bool operator==(const Lamp&, const Lamp&) = default;
};

Lamp lamp_of(const scene::Light& light);
/// The light that the lamp is, apart from its node.
scene::Light light_of(const Lamp& lamp, const vec3& color, float intensity);

struct LightEdit {
  std::optional<mat4> world;  ///< none: where the scene's own animation puts it
  vec3 color{1};
  float intensity = 1;  ///< units as scene::Light
  bool on = true;
  int source = -1;  ///< index of the scene's lamp; −1: a new one, which has a `world`
  Lamp lamp{};

  friend bool operator==(const LightEdit&, const LightEdit&) = default;
};

/// A number of a lamp in the unit that users see.
struct LampNumber {
  const char *name, *unit, *help;
  float step;  ///< least of a drag [a pixel]; 0: of a length, as suits the scene
  float value, low, high;
};

/// Intensity, and what lamps of its type have beside it.
std::vector<LampNumber> lamp_numbers(const LightEdit& light);
/// Sets one of them by its name. An outer cone takes a wider inner one along. Throws Error, which says what
/// is right, for a number out of bounds and one that the lamp does not have.
void set_lamp_number(LightEdit& light, const std::string& name, float value);

/// A new lamp at a place: white, as bright as suits a picture of `exposure` EV with surfaces some `distance`
/// metres away. Spots and beams shine down, suns slantwise.
LightEdit new_lamp(scene::LightType type, const std::string& name, const vec3& place, float distance,
                   float exposure);

/// Position of a light's world matrix, and the unit direction in which it shines (−z).
vec3 light_position(const mat4& world);
vec3 light_direction(const mat4& world);
/// The same matrix at another place, or turned toward a direction (any length but 0).
mat4 with_position(const mat4& world, const vec3& position);
mat4 with_direction(const mat4& world, const vec3& direction);

/// Whether lamps of the type, and of that profile, shine in a direction, and stand at a place.
bool has_direction(scene::LightType type, const scene::LampProfile& profile = {});
bool has_place(scene::LightType type);

/// Lines in space that show a lamp's shape: the rims of a spot's cones and lines to them, a sphere's outline,
/// how far the light reaches, polar curves of a profile. `length`: of what has none of its own [m].
std::vector<std::vector<vec3>> lamp_lines(const Lamp& lamp, const mat4& world, float length);

}  // namespace ssphh::viewer
