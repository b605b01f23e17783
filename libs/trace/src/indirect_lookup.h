#pragma once
/// Indirect light from probes, reflected at the first hit.

#include <optional>

#include <ssphh/rays/radiance_source.h>
#include <ssphh/shading/surface.h>

namespace ssphh::trace {

/// Radiance toward wo: with e the directional albedo of the specular lobe, ρ_d (1 − e)/π · E(x, n) plus e
/// times the probes' radiance around the mirror direction (split sum: Karis, Real Shading in Unreal Engine 4,
/// 2013). Exact under constant light, as the layered BSDF reflects it. `ray_origin` is the
/// point raised above the surface: lookups trace rays. `moves`: the surface is of a body that moves.
/// `followed`: the share of what the specular lobe reflects that comes another way, and is left out.
vec3 reflected_indirect(const rays::IndirectLight& indirect, const shading::Surface& surface,
                        const vec3& ray_origin, const vec3& wo, bool moves, float followed = 0);

/// The share of what a lobe reflects that rays find better than probes: all of narrow ones, for probes blur
/// what is near, and nothing of wide ones, which rays leave noisy.
float followed_share(const shading::Surface& surface);

/// A direction of the specular lobe alone, in the world, and f cos θ over its density and the chance that
/// there is one: dim lobes are followed seldom. `u_end` in [0, 1) decides.
struct MirrorRay {
  vec3 direction, weight;
};
std::optional<MirrorRay> sample_mirror(const shading::Surface& surface, const vec3& wo, float u_lobe,
                                       const vec2& u, float u_end);

}  // namespace ssphh::trace
