#pragma once
/// The lights of a set that rays can meet, which points and directions are not.

#include <vector>

#include <ssphh/shading/lights.h>

#include "rays.h"

namespace ssphh::trace {

class FoundByRays {
 public:
  explicit FoundByRays(const shading::LightSet& lights);

  bool any() const { return everywhere_ || !boxes_.empty(); }
  /// Whether the ray might meet one if nothing stood in its way; false is sure.
  bool on(const Ray& ray) const;

 private:
  bool everywhere_ = false;           ///< at infinity, or too many to ask each
  std::vector<scene::Bounds> boxes_;  ///< of the others, in world space
};

}  // namespace ssphh::trace
