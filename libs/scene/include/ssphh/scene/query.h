#pragma once
/// Pure functions over a Scene, which is as check_indices() wants it; world_matrices() looks at what it
/// needs.

#include <cstdint>
#include <limits>
#include <string>
#include <vector>

#include <ssphh/core/hash.h>
#include <ssphh/scene/probe_place.h>
#include <ssphh/scene/scene.h>

namespace ssphh::scene {

/// World matrix of every node with all animations at `time` seconds (clamped to each channel's keys).
std::vector<mat4> world_matrices(const Scene& scene, float time = 0);

/// World matrix of one node, without allocation: only what it hangs on is posed.
mat4 world_matrix(const Scene& scene, int node, float time = 0);

/// Time of the last key of any animation, or when the last emission that changes has ended or begins again
/// [s]; 0 where nothing changes.
float animation_duration(const Scene& scene);

/// Sets `movable` of every node that is animated or stands below an animated one, and clears it on all
/// others.
void mark_movable(Scene& scene);

struct Bounds {
  vec3 min{std::numeric_limits<float>::infinity()}, max{-std::numeric_limits<float>::infinity()};
  bool empty() const { return !(min.x <= max.x); }
  vec3 center() const { return 0.5f * (min + max); }
  /// Radius of the sphere around the box.
  float radius() const { return empty() ? 0 : 0.5f * glm::length(max - min); }
  void add(const vec3& p) { min = glm::min(min, p), max = glm::max(max, p); }
};

/// The box around all instances' vertices, in world space.
Bounds world_bounds(const Scene& scene, const std::vector<mat4>& world);

/// Triangles counted once per instance.
std::uint64_t triangle_count(const Scene& scene);

/// Material index that an instance shades with; −1: the default Material{}.
int instance_material(const Scene& scene, const Instance& instance);

/// Whether a light group is switched off (Scene::dark_groups).
bool is_dark(const Scene& scene, const std::string& group);

/// Whether an instance belongs to a light group: its material is emissive, or its group is dark.
bool is_emitter(const Scene& scene, const Instance& instance);

/// Names of all light groups, in order of first use (lights, emitters among the instances, environment). At
/// most 256; further groups are merged into a last one named "other".
std::vector<std::string> light_groups(const Scene& scene);

/// Index into `groups` of one emitter's group.
int light_group_index(const std::vector<std::string>& groups, const std::string& name);
std::string light_group(const Light& light);
std::string light_group(const Environment& environment);
std::string light_group(const Scene& scene, const Instance& instance);

/// Camera by name, or the first when `name` is empty. Throws Error that lists the names there are. A scene
/// without cameras gets one that looks at its bounds from the front.
Camera find_camera(const Scene& scene, const std::string& name);

struct CameraPose {
  mat4 world;  ///< camera to world
  Camera camera;
};
/// Of the camera of that name, as find_camera, or of one that `name` places (placed_camera.h).
CameraPose camera_pose(const Scene& scene, const std::string& name, float time = 0);

/// The places of the enabled SPHLs.
std::vector<ProbePlace> sphl_places(const Scene& scene, float time = 0);

/// Content hash of everything that can change a picture.
Hash128 scene_hash(const Scene& scene);
/// Hash of everything that decides the light in the scene: as scene_hash, but cameras, SPHLs and nodes on
/// which nothing else stands do not count.
Hash128 light_hash(const Scene& scene);

/// Throws Error naming the object for an index out of range or an array of wrong length: what nobody could
/// use. Called by all that reads whole scenes (tracers, renderers, writers).
void check_indices(const Scene& scene);

/// Throws Error naming the object for an index out of range, a NaN or infinite number, or an array of wrong
/// length. Repaired are: degenerate triangles (removed), normals and tangents that are not unit vectors,
/// rotations, material values out of their range, objects at node −1 (they get a root node), a matrix on an
/// animated node (decomposed). Also sets `movable`. Returns a line for each kind of repair.
std::vector<std::string> validate(Scene& scene);

}  // namespace ssphh::scene
