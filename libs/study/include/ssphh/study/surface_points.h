#pragma once
/// Points spread evenly over the surfaces of a posed scene that somebody can get to see: where lookups are
/// compared with the truth.

#include <cstdint>
#include <optional>
#include <span>
#include <vector>

#include <ssphh/core/control.h>
#include <ssphh/rays/transport_source.h>
#include <ssphh/scene/query.h>

namespace ssphh::study {

/// Whether a place lies in a box, its sides included.
inline bool within(const scene::Bounds& box, const vec3& p) {
  return glm::all(glm::lessThanEqual(box.min, p)) && glm::all(glm::lessThanEqual(p, box.max));
}

struct SurfacePointParams {
  int count = 1024;        ///< points wanted, over 0
  std::uint64_t seed = 0;  ///< the same seed gives the same points
  float clearance = 0;     ///< only points with so much free space before them, along the normal [m]
  std::optional<scene::Bounds> box = {};  ///< all points within [m]; none: anywhere
};

/// Points uniform by area over both sides of all surfaces that can be reached: that see one of `origins`
/// (cameras, probes), or of which some ray, scattered diffusely, meets a place that does. What is shut off
/// (the inside of walls and bodies, the outside of a closed room) has no points. Uniform, because isotropic
/// random lines meet every patch in proportion to its area whatever its orientation (Santaló, Integral
/// Geometry and Geometric Probability, 1976, ch. 12). As long as the scene's bounds stay, the points on what
/// never moves are the same at every time at which they can be reached. Throws Error without origins or
/// surfaces, for a box that is none or that the scene does not reach, and when too few points can be reached.
std::vector<rays::SurfacePoint> reachable_points(const rays::TransportSource& source,
                                                 std::span<const vec3> origins, float time,
                                                 const SurfacePointParams& params = {},
                                                 const Control& control = {});

/// What a camera sees at random places of its picture: what a viewer judges. `aspect` is the picture's width
/// over its height. Fewer points, or none, where most of the picture shows no surface. Throws Error for a
/// count under 1.
std::vector<rays::SurfacePoint> points_in_view(const rays::TransportSource& source,
                                               const scene::CameraPose& camera, float aspect, float time,
                                               int count, std::uint64_t seed = 0);

/// 1 for points that see one of the 16 places nearest to them that are before their surface, 0 for those that
/// see none.
std::vector<std::uint8_t> sees_any(const rays::TransportSource& source,
                                   std::span<const rays::SurfacePoint> points, std::span<const vec3> places,
                                   float time);

/// Points in the open, as something that moves may come there: on a cosine-distributed ray from each surface
/// point, 5 to 95 % of the way to what it meets, the normal uniform over the sphere. None for rays that
/// escape. With a box, in which the surface points must lie, the way ends where it leaves the box. The same
/// seed gives the same points.
std::vector<rays::SurfacePoint> points_in_the_open(const rays::TransportSource& source,
                                                   std::span<const rays::SurfacePoint> surfaces, float time,
                                                   std::uint64_t seed,
                                                   const std::optional<scene::Bounds>& box = {});

}  // namespace ssphh::study
