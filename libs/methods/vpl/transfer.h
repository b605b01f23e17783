#pragma once
/// How much of a virtual light's power arrives at a point that sees it.

#include "photons.h"

namespace ssphh::methods::vpl {

/// A lit point.
struct Receiver {
  vec3 position{0};
  vec3 normal{0};
  /// Of a glossy lobe (n + 1)/2π cosⁿ around `axis`, which takes the place of the cosine; below 0: diffuse.
  float exponent = -1;
  vec3 axis{0};
};

/// Irradiance [W/m²] (of a lobe: radiance it reflects, W sr⁻¹ m⁻²) per π watts of the light [1/m²]. Of a
/// spherical light: its power spread over the disc that the sphere shows, the mean over directions to it
/// (Hašan, Křivánek, Walter & Bala, Virtual Spherical Lights, SIGGRAPH Asia 2009, eq. 4), by quadrature.
float transfer(const Receiver& at, const Vpl& light, const VplParams& params);

/// The same without a bound, whatever the parameters say.
float unbounded_transfer(const Receiver& at, const Vpl& light);

/// Lights close together.
struct VplCluster {
  scene::Bounds bounds;
  vec3 axis{0, 0, 1};      ///< of the cone that holds their normals
  float spread = 0;        ///< its half-angle [rad]
  float least_radius = 0;  ///< of spherical ones [m]
  float most_radius = 0;
  vec3 power{0};  ///< of all [W]
};

/// At most what transfer() is for any light of the cluster. Diffuse receivers only.
float transfer_bound(const Receiver& at, const VplCluster& cluster, const VplParams& params);

}  // namespace ssphh::methods::vpl
