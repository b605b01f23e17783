#pragma once
/// Everything a user may change in a scene, as a value beside the scene: what undo keeps and saving applies.

#include <map>
#include <optional>
#include <string>
#include <vector>

#include <ssphh/scene/query.h>
#include <ssphh/scene/sun_sky.h>
#include <ssphh/scene/with_lighting.h>

namespace ssphh::viewer {

struct LightEdit {
  std::optional<mat4> world;  ///< none: where the scene's own animation puts it
  vec3 color{1};
  float intensity = 1;  ///< units as scene::Light
  bool on = true;

  friend bool operator==(const LightEdit&, const LightEdit&) = default;
};

struct SphlEdit {
  int source = -1;               ///< index of the scene's SPHL; −1: a new one
  std::optional<vec3> position;  ///< world [m]; none: at the source's node
  std::string name;
  float radius = 0.1f;
  bool enabled = true;

  friend bool operator==(const SphlEdit&, const SphlEdit&) = default;
};

struct Edits {
  std::vector<LightEdit> lights;           ///< one per light of the scene
  std::map<std::string, vec3> groups;      ///< factors on light groups; a group that is left out has 1
  float environment_rotation = 0;          ///< about +y beyond the scene's own [rad]
  std::optional<scene::SunSky> sky;        ///< in place of the scene's computed one; none: that one
  std::vector<scene::Material> materials;  ///< one per material of the scene
  std::vector<SphlEdit> sphls;
};

/// No change at all.
Edits edits_of(const scene::Scene& scene);

/// Whether the values that the viewer edits are the same: colours, roughnesses, metalness, specular, IOR,
/// emission.
bool same_surface(const scene::Material& a, const scene::Material& b);

/// What lights the scene at `time` with the edits: what renderers and relighting take.
scene::LightingState edited_lighting(const scene::Scene& scene, const Edits& edits, float time);

/// The scene with all edits done. A light that moved stands still at its place, on a node of its own, as does
/// an SPHL; what was not edited stays as it is, to the bit.
scene::Scene edited_scene(scene::Scene scene, const Edits& edits, float time);

/// With its lights, groups and materials alone as they are in the scene: what decides the surfaces' light
/// transport, but no lamp.
scene::Scene with_materials(scene::Scene scene, const Edits& edits);

/// Whether both lists ask for probes at the same places; names and radii do not count.
bool same_places(const std::vector<SphlEdit>& a, const std::vector<SphlEdit>& b);

/// World position of an SPHL at `time`.
vec3 sphl_position(const scene::Scene& scene, const std::vector<mat4>& world, const SphlEdit& sphl);

/// Index in `after` of the SPHL that is before[index]; −1: it is not there. In lists of one length each keeps
/// its place; else it is known by its source and name.
int same_sphl(const std::vector<SphlEdit>& before, int index, const std::vector<SphlEdit>& after);

/// A name that no other SPHL has: "SPHL 7".
std::string new_sphl_name(const Edits& edits);

/// Position of a light's world matrix, and the unit direction in which it shines (−z).
vec3 light_position(const mat4& world);
vec3 light_direction(const mat4& world);
/// The same matrix at another place, or turned toward a direction (any length but 0).
mat4 with_position(const mat4& world, const vec3& position);
mat4 with_direction(const mat4& world, const vec3& direction);

}  // namespace ssphh::viewer
