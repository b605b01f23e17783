#include "found_by_rays.h"

#include <algorithm>

namespace ssphh::trace {
namespace {

/// More boxes than this cost more than most rays do.
constexpr std::size_t most_boxes = 16;

/// Grown by what rounding may put of a hit beside its triangle.
scene::Bounds grown(const scene::Bounds& box) {
  const float magnitude = std::max(max_abs_component(box.min), max_abs_component(box.max));
  const float margin = 1e-3f * box.radius() + 4 * position_error(magnitude);
  return {box.min - margin, box.max + margin};
}

bool meets(const Ray& ray, const scene::Bounds& box) {
  float near = 0, far = std::numeric_limits<float>::infinity();
  for (glm::length_t c = 0; c < 3; ++c) {
    const float inverse = 1 / ray.direction[c];
    float a = (box.min[c] - ray.origin[c]) * inverse, b = (box.max[c] - ray.origin[c]) * inverse;
    if (a > b) std::swap(a, b);
    // Not a number, 0 · ∞, where the ray lies in a side: then these keep what they have
    near = std::max(near, a);
    far = std::min(far, b);
  }
  return near <= far * (1 + 1e-5f);
}

}  // namespace

FoundByRays::FoundByRays(const shading::LightSet& lights) {
  for (int i = 0; i < lights.emitter_count() && !everywhere_; ++i) {
    const shading::Emitter emitter = lights.emitter(i);
    if (emitter.delta()) continue;
    everywhere_ = emitter.distant() || boxes_.size() == most_boxes;
    if (!everywhere_) boxes_.push_back(grown(emitter.extent));
  }
}

bool FoundByRays::on(const Ray& ray) const {
  return everywhere_ ||
         std::ranges::any_of(boxes_, [&](const scene::Bounds& box) { return meets(ray, box); });
}

}  // namespace ssphh::trace
