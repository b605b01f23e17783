#version 450 core
// Indirect light of methods that keep none in SPHLs. Variants: CONES (cones.glsl), else virtual lights, a part of
// them in each pass; FULL_BSDF, else surfaces are Lambertian; TO_IMAGES gives irradiance and glossy radiance for
// apply.frag, at some pixels only.
#include "gbuffer_read.glsl"
#ifdef FULL_BSDF
#include "bsdf.glsl"
#endif
#ifdef CONES
#include "cones.glsl"
#else
#include "shadow.glsl"
#include "virtual_lights.glsl"
#endif

#ifdef TO_IMAGES
layout(location = 0) out vec4 irradiance_out;
layout(location = 1) out vec4 glossy_out;
#else
layout(location = 0) out vec4 color;
#endif

void main() {
  ivec2 at = ivec2(gl_FragCoord.xy);
#ifdef TO_IMAGES
  at *= int(frame.extra.y);
#endif
  Surface s = read_surface(at);
  vec3 irradiance, glossy;
  look_up(s, reflect(-s.wo, s.normal), min(abs(s.specular_roughness), 1), irradiance, glossy);
#if defined(TO_IMAGES)
  irradiance_out = vec4(irradiance, 1);
  glossy_out = vec4(glossy, 1);
#elif defined(FULL_BSDF)
  Bsdf bsdf = bsdf_from(s.diffuse, s.f0, s.diffuse_roughness, s.specular_roughness, dot(s.normal, s.wo));
  color = vec4(s.diffuse * (1 - bsdf.albedo) / PI * irradiance + bsdf.albedo * glossy, 0);
#else
  color = vec4(s.diffuse / PI * irradiance, 0);
#endif
}
