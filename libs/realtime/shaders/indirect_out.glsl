// What a pass of indirect light leaves. Variants: TO_IMAGES, irradiance and glossy radiance for apply.frag, at some
// pixels only; FULL_BSDF, radiance that any surface reflects; else that Lambertian ones do.
#ifdef FULL_BSDF
#include "bsdf.glsl"
#endif

#ifdef TO_IMAGES
layout(location = 0) out vec4 irradiance_out;
layout(location = 1) out vec4 glossy_out;
#else
layout(location = 0) out vec4 color;
#endif

ivec2 lit_pixel() {
#ifdef TO_IMAGES
  return ivec2(gl_FragCoord.xy) * int(frame.extra.y);
#else
  return ivec2(gl_FragCoord.xy);
#endif
}

void put_light(Surface s, vec3 irradiance, vec3 glossy) {
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
