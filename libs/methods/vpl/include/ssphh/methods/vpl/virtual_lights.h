#pragma once
/// Virtual lights of instant radiosity as plain data (libs/methods/vpl/README.md).

#include <cstddef>
#include <span>
#include <vector>

#include <ssphh/core/enum_names.h>
#include <ssphh/core/math.h>

namespace ssphh::methods::vpl {

/// A diffuse emitter at a point: radiant intensity power/π · cos θ around the normal [W/sr].
struct Vpl {
  vec3 position{0};  ///< a little above its surface
  vec3 normal{0};    ///< unit
  vec3 power{0};     ///< flux that leaves the surface again [W]
  float radius = 0;  ///< over which a spherical light spreads it [m]
};

enum class VplKind { point, sphere };
constexpr auto enum_table(VplKind) {
  using enum VplKind;
  return std::to_array<EnumName<VplKind>>({{point, "point"}, {sphere, "sphere"}});
}

struct VplParams {
  VplKind kind = VplKind::point;
  /// No point light counts for more than one straight ahead at this distance [m]; 0: unbounded.
  float least_distance = 0;
};

/// Exponent of the sharpest lobe cosⁿ that asks virtual lights: sharper ones would show the single lights.
inline constexpr float sharpest_lobe = 100;
/// Of point lights those do not count of which a lobe leaves less than this share.
inline constexpr float least_of_lobe = 1e-3f;

/// A spherical light is asked in so many directions, in rings …
inline constexpr int sphere_rings = 4, sphere_spokes = 8;
/// … unless the square of its distance is so many times that of its radius: from afar it is a point.
inline constexpr float sphere_far2 = 64;

/// At most `most` lights of the same power in all: clusters of neighbours that face about the same way, each
/// at the place of one of its lights, which is chosen with probability ∝ power (Walter et al., Lightcuts,
/// SIGGRAPH 2005). Split is what has the largest product of power and extent, so that bright and wide
/// clusters keep more lights. The same at every call; `lights` as they are where there are no more.
std::vector<Vpl> merge_lights(std::span<const Vpl> lights, std::size_t most);

}  // namespace ssphh::methods::vpl
