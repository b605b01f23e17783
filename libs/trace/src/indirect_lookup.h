#pragma once
/// Indirect light from probes, reflected at the first hit.

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

}  // namespace ssphh::trace
