#pragma once
/// What stands at one point of the picture, and what lights it: for the panel that follows the mouse.

#include <optional>
#include <string>
#include <vector>

#include <ssphh/probes/lookup.h>
#include <ssphh/rays/posed_world.h>
#include <ssphh/scene/query.h>

#include "edits.h"
#include "view_camera.h"

namespace ssphh::viewer {

struct InspectedSurface {
  vec3 position{0};
  vec3 normal{0};       ///< unit, for shading, toward the eye
  vec3 face_normal{0};  ///< of the triangle
  float distance = 0;   ///< from the ray's origin [m]
  vec3 albedo{0};       ///< of the diffuse part, textures included
  std::string object, material;
};

/// The nearest surface on a ray with a unit direction, its material as edited; none: there is nothing.
std::optional<InspectedSurface> inspect_surface(const scene::Scene& scene, const Edits& edits, float time,
                                                const rays::RayQuery& ray);

/// A probe or a record of surfaces that lights a point.
struct LightShare {
  std::string name;
  float weight = 0;  ///< in E(x, n) = Σ w_j E_j(n); may be negative
};

struct InspectedLight {
  vec3 irradiance{0};              ///< indirect, as looked up [W/m²]
  bool by_records = false;         ///< else by probes
  std::vector<LightShare> shares;  ///< the largest first, by magnitude
};

/// How a lookup that blends (not `light`) lights the point, by records where `params` and the set have them
/// near, else by probes. `sees` tells whether nothing blocks the way between two points.
InspectedLight inspect_light(const probes::ProbeSet& set, const probes::LookupParams& params,
                             const rays::SurfacePoint& at, const probes::SeesProbe& sees);

/// What the pixel inspector shows.
struct Inspection {
  vec2 point{0};  ///< of the picture, (0, 0) its lower left and (1, 1) its upper right corner
  std::optional<InspectedSurface> surface;
  std::optional<vec3> radiance, truth;  ///< of the picture's pixel; none: not drawn yet, not traced
  InspectedLight light;
};

/// When an inspection holds: for the same point, view and pose of the same scene with the same edits, as long
/// as no other picture was drawn.
struct InspectedAt {
  vec2 point{0};
  View view;
  float time = 0;
  std::uint64_t edits = 0;
  int pictures = 0;
  const void* scene = nullptr;
  friend bool operator==(const InspectedAt&, const InspectedAt&) = default;
};

}  // namespace ssphh::viewer
