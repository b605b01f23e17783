#pragma once
/// Direct light on the patches, per light group, kept as long as nothing changes it.

#include <span>
#include <vector>

#include "patches.h"

namespace ssphh::methods::vct {

class PatchLight {
 public:
  /// Dark, for so many patches.
  void reset(std::size_t patches, std::size_t groups);

  /// Asks for the group's irradiance on all patches, or, where `moved` is given, on those that one of these
  /// boxes may shadow. Returns the number of points asked for.
  std::size_t update(int group, const PatchSet& set, const rays::DirectLight& light,
                     const std::vector<scene::Bounds>* moved = nullptr);

  /// Irradiance [W/m²] on each patch: Σ_g scale_g E_g.
  void sum(std::span<const vec3> group_scales, std::vector<vec3>& out) const;

  std::size_t bytes() const;

 private:
  std::vector<std::vector<vec3>> groups_;  ///< [group][patch]
};

}  // namespace ssphh::methods::vct
