#pragma once
/// The specular lobe alone: what looked-up pictures ask rays for where they find it better than probes.

#include <optional>

#include <ssphh/core/math.h>
#include <ssphh/shading/bsdf.h>
#include <ssphh/shading/surface.h>

namespace ssphh::trace {

/// What the surface reflects without its diffuse lobe.
shading::BsdfParams specular_lobe(const shading::Surface& surface);

/// Perceptual, in 0..1, whichever the lobe's model.
float roughness_of(const shading::Surface& surface);

/// The share of what a lobe reflects that rays find better than probes: all of narrow ones, for probes blur
/// what is near, and nothing of wide ones, which rays leave noisy.
float followed_share(const shading::Surface& surface);

/// The specular lobe seen from one direction; all directions in the world.
class MirrorLobe {
 public:
  MirrorLobe(const shading::Surface& surface, const vec3& wo);

  /// How many rays of it to follow on average: as many as the lobe's share of what is reflected is worth,
  /// at most `most_rays`.
  static constexpr int most_rays = 4;
  float rays() const { return rays_; }
  /// As BsdfFrom::sample. Empty also where the direction lies below the surface itself.
  std::optional<shading::BsdfSample> sample(float u_lobe, const vec2& u) const;
  /// f cos θ and the density of sample().
  shading::BsdfValue eval(const vec3& wi) const;

 private:
  bool above(const vec3& wi) const { return glm::dot(wi, geometric_normal_) > 0; }

  Frame frame_;
  vec3 geometric_normal_;
  shading::BsdfFrom lobe_;
  float rays_;
};

/// Share of f(wo, wi) that is its specular lobe's; of an opaque surface, directions in its shading frame.
vec3 specular_share(const shading::Surface& surface, const vec3& wo, const vec3& wi);

}  // namespace ssphh::trace
