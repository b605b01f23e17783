// At which pixel a pass of indirect light looks, and what it leaves there. Variants: TO_IMAGES, irradiance and glossy
// radiance at some pixels only, for interpolate.frag; LISTED, a compute shader for the pixels of listed_pixels.glsl.
// FULL_BSDF: radiance that any surface reflects; else that Lambertian ones do.
#ifdef FULL_BSDF
#include "bsdf.glsl"
#endif

#if defined(TO_IMAGES)
layout(location = 0) out vec4 irradiance_out;
layout(location = 1) out vec4 glossy_out;
#elif defined(LISTED)
#include "listed_pixels.glsl"
layout(local_size_x = LISTED_GROUP) in;
layout(rgba32f, binding = UNIT_COLOR_IMAGE) uniform image2D color_image;
#else
layout(location = 0) out vec4 color;
#endif
layout(binding = UNIT_OCCLUSION) uniform sampler2D occlusion_image;

// Below 0: there is none left.
ivec2 lit_pixel() {
#if defined(TO_IMAGES)
  return ivec2(gl_FragCoord.xy) * int(frame.extra.y);
#elif defined(LISTED)
  uint group = gl_WorkGroupID.y * LISTED_ROW + gl_WorkGroupID.x, i = group * LISTED_GROUP + gl_LocalInvocationID.x;
  return i < listed.count ? ivec2(listed.pixels[i] & 0xffffu, listed.pixels[i] >> 16) : ivec2(-1);
#else
  return ivec2(gl_FragCoord.xy);
#endif
}

#ifdef TO_IMAGES
void put_light(ivec2 at, Surface s, vec3 irradiance, vec3 glossy) {
  irradiance_out = vec4(irradiance, 1);
  glossy_out = vec4(glossy, 1);
}
#else
void put_light(ivec2 at, Surface s, vec3 irradiance, vec3 glossy) {
  float open = frame.extra.x > 0 ? texelFetch(occlusion_image, at, 0).x : 1;
#ifdef FULL_BSDF
  Bsdf bsdf = bsdf_from(s.diffuse, s.f0, s.diffuse_roughness, s.specular_roughness, dot(s.normal, s.wo));
  vec3 radiance = s.diffuse * (1 - bsdf.albedo) / PI * irradiance + bsdf.albedo * glossy;
#else
  vec3 radiance = s.diffuse / PI * irradiance;
#endif
#ifdef LISTED
  imageStore(color_image, at, imageLoad(color_image, at) + vec4(open * radiance, 0));
#else
  color = vec4(open * radiance, 0);
#endif
}
#endif
