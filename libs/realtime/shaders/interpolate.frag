#version 450 core
// Indirect light between the pixels at which it was looked up, where mark.frag allows. Variant FULL_BSDF.
#include "gbuffer_read.glsl"
#include "indirect_out.glsl"

layout(binding = UNIT_IRRADIANCE) uniform sampler2D irradiance_image;
layout(binding = UNIT_GLOSSY) uniform sampler2D glossy_image;

void main() {
  ivec2 at = lit_pixel();
  vec2 place = (vec2(at) / frame.extra.y + 0.5) / vec2(textureSize(irradiance_image, 0));
  vec3 glossy = vec3(0);
#ifdef FULL_BSDF
  glossy = textureLod(glossy_image, place, 0).rgb;
#endif
  put_light(at, read_surface(at), textureLod(irradiance_image, place, 0).rgb, glossy);
}
