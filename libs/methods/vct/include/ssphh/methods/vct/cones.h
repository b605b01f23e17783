#pragma once
/// Cones that divide a hemisphere or a lobe among themselves.

#include <vector>

#include <ssphh/core/math.h>

namespace ssphh::methods::vct {

struct Cone {
  vec3 direction{0, 0, 1};  ///< unit, about z
  float weight = 1;
  float tangent = 0;  ///< of the half angle
};

/// Divides the hemisphere about z into `count` cells that hold the same share of the cosine lobe: rings of
/// cells as square as can be (Beckers & Beckers, A General Rule for Disk and Hemisphere Partition into
/// Equal-Area Cells, 2012, on the disk of (x, y)). A cone has the mean direction of its cell under the
/// cosine, the cell's solid angle, and the weight ∫ cos θ dω = π/count.
std::vector<Cone> hemisphere_cones(int count);

/// A cap within an angle of this cosine, 30°, or a smaller one is one cone …
inline constexpr double one_cone_cosine = 0.8660254037844386;
/// … and a wider one so many: one in the middle and a ring around it.
inline constexpr int cap_cone_count = 7;

/// Divides the cap within the angle whose cosine is `cosine` into cells of the same solid angle, weights 1/n.
std::vector<Cone> cap_cones(float cosine);

/// Cosine of the cap over which uniform radiance has the mean cosine of a glossy lobe of this perceptual
/// roughness (sh::glossy_band_scale): ⟨cos θ⟩ = (1 + cosine)/2.
float lobe_cosine(float roughness);

}  // namespace ssphh::methods::vct
