#pragma once
/// What a thing sends out, seen from far away into each direction: the profile of an SPHL that shines in its
/// place.

#include <string>
#include <vector>

#include <ssphh/core/control.h>
#include <ssphh/rays/radiance_source.h>
#include <ssphh/scene/scene.h>

namespace ssphh::trace {

struct ThingEmissionParams {
  int degree = 8;
  int image_size = 32;  ///< pixels along a side of the picture that is taken from each direction
  rays::PathParams path{.max_depth = 8};
};

struct ThingEmission {
  sh::IntensitySh intensity;  ///< [W/sr], ω in the node's axes
  vec3 center{0};             ///< of the light that leaves it, in the node's space
  float radius = 0;           ///< metres, of the sphere around the center that holds all of it
  std::uint64_t paths = 0;
};

/// By parallel views of the thing at and below `node` at `time`, alone in the dark (scene::thing_alone), from
/// the directions of a quadrature that is exact for more than twice the degree; lamps without extent by their
/// own intensity, where they are not hidden. Throws Error for a thing that sends out nothing or has no size,
/// and for a degree or size out of range; Cancelled when asked to stop.
ThingEmission thing_emission(const scene::Scene& scene, int node, float time,
                             const ThingEmissionParams& params, const Control& control = {});

/// Names of the SPHLs that shine and stand inside of a body: most of what they see are back faces.
std::vector<std::string> buried_lamps(const scene::Scene& scene, const rays::RadianceSource& source,
                                      float time);

}  // namespace ssphh::trace
