#pragma once
/// Everything a user may change in a scene, as a value beside the scene: what undo keeps and saving applies.

#include <map>
#include <memory>
#include <optional>
#include <string>
#include <vector>

#include <ssphh/scene/query.h>
#include <ssphh/scene/sun_sky.h>
#include <ssphh/scene/with_lighting.h>

#include "lamp.h"
#include "view_camera.h"

namespace ssphh::viewer {

struct SphlEdit {
  int source = -1;               ///< index of the scene's SPHL; −1: a new one
  std::optional<vec3> position;  ///< world [m]; none: at the source's node
  std::string name;
  float radius = 0.1f;
  bool enabled = true;

  friend bool operator==(const SphlEdit&, const SphlEdit&) = default;
};

/// A view with a name.
struct CameraEdit {
  int source = -1;  ///< index of the scene's camera; −1: a new one, which has a view
  std::string name;
  std::optional<View> view;  ///< none: the source's, which may move

  friend bool operator==(const CameraEdit&, const CameraEdit&) = default;
};

/// A picture of the whole sky, equirectangular, in place of the scene's environment.
struct Surroundings {
  std::string file;                           ///< whole path
  std::shared_ptr<const image::Image> image;  ///< radiance, three channels
};
/// Reads one (.hdr, .exr). Throws Error where the file holds none.
Surroundings read_surroundings(const std::string& file);

struct Edits {
  std::vector<LightEdit> lights;             ///< the scene's that are left, and new ones
  std::map<std::string, vec3> groups;        ///< factors on light groups; a group that is left out has 1
  float environment_rotation = 0;            ///< about +y beyond the scene's own [rad]
  std::optional<scene::SunSky> sky;          ///< in place of the scene's computed one; none: that one
  std::optional<Surroundings> surroundings;  ///< in place of what surrounds the scene; `sky` is none then
  std::vector<scene::Material> materials;    ///< one per material of the scene
  std::vector<SphlEdit> sphls;
  std::vector<CameraEdit> cameras;
};

/// No change at all.
Edits edits_of(const scene::Scene& scene);

/// Whether the values that the viewer edits are the same: colours, roughnesses, metalness, specular, IOR,
/// emission.
bool same_surface(const scene::Material& a, const scene::Material& b);

/// The scene with the lamps of the edits, each with its shape but with the place, colour and intensity that
/// it had, and with their surroundings: what renderers and light transport are built for, and indices of
/// lamps count. `opened`: without any edit.
scene::Scene with_lamps(scene::Scene opened, const Edits& edits);
/// Whether the scene's lamps are those of the edits, but for place, colour and intensity, and so are its
/// surroundings; `opened` as before.
bool has_lamps(const scene::Scene& scene, const scene::Scene& opened, const Edits& edits);

/// What lights the scene at `time` with the edits: what renderers and relighting take. `scene` has their
/// lamps.
scene::LightingState edited_lighting(const scene::Scene& scene, const Edits& edits, float time);

/// What light groups at factor 0 would emit: kept, for files, or out of the scene, for renderers.
enum class DarkLight { kept, out };

/// The scene as it was opened with all edits done. A light that moved stands still at its place, on a node of
/// its own, as does an SPHL and a camera; what was not edited stays as it is, to the bit.
scene::Scene edited_scene(scene::Scene opened, const Edits& edits, float time,
                          DarkLight dark = DarkLight::out);

/// With its lights, groups and materials alone as they are in the scene: what decides the surfaces' light
/// transport, but no lamp.
scene::Scene with_materials(scene::Scene scene, const Edits& edits);

/// Whether both lists ask for probes at the same places; names and radii do not count.
bool same_places(const std::vector<SphlEdit>& a, const std::vector<SphlEdit>& b);

/// Whether a bake finds the same light with both: SPHLs, cameras and factors on groups do not count.
bool same_light(const Edits& a, const Edits& b);

/// World position of an SPHL at `time`.
vec3 sphl_position(const scene::Scene& scene, const std::vector<mat4>& world, const SphlEdit& sphl);

/// Index in `after` of the SPHL that is before[index]; −1: it is not there. In lists of one length each keeps
/// its place; else it is known by its source and name.
int same_sphl(const std::vector<SphlEdit>& before, int index, const std::vector<SphlEdit>& after);
/// The same of a lamp.
int same_lamp(const std::vector<LightEdit>& before, int index, const std::vector<LightEdit>& after);

/// A name that no other SPHL has: "SPHL 7".
std::string new_sphl_name(const Edits& edits);

/// A name that no lamp has yet: "spot 2" where there is a "spot", or a "spot 1".
std::string new_lamp_name(const Edits& edits, const std::string& like);

/// Gives a lamp or a camera another name. A lamp stays in its light group. Throws Error for no name, and one
/// that another has.
void rename_lamp(Edits& edits, std::size_t lamp, const std::string& name);
void rename_camera(Edits& edits, std::size_t camera, const std::string& name);
/// A view under a name, as rename_camera() wants it.
void add_camera(Edits& edits, const std::string& name, const View& view);

}  // namespace ssphh::viewer
