#version 450 core
// Of a cell of pixels with indirect light looked up at its corners: whether the four are alike, and the plane that
// they lie on. x: linear depth at the first corner; 0: they are not. y, z: its change per pixel. w: the first corner's
// normal. Variant FULL_BSDF.
#include "gbuffer_read.glsl"

layout(binding = UNIT_IRRADIANCE) uniform sampler2D irradiance_image;
layout(binding = UNIT_GLOSSY) uniform sampler2D glossy_image;
layout(location = 0) out uvec4 cell;

// Up to a share of the brightest, or to what no display shows.
bool alike(vec3 least, vec3 most, float reflected) {
  float apart = max_component(most - least);
  return apart <= frame.extra.z * max_component(most) || apart * reflected * frame.tone.x < 1.0 / 4096;
}

void main() {
  int n = int(frame.extra.y);
  ivec2 low = ivec2(gl_FragCoord.xy), last = (ivec2(frame.camera_right.w, frame.camera_up.w) - 1) / n;
  uint normal = texelFetch(gbuffer0, low * n, 0).x;
  vec3 first = oct_decode(unpackSnorm2x16(normal));
  vec3 least_e = vec3(1e30), most_e = vec3(0), least_l = vec3(1e30), most_l = vec3(0);
  float turned = 1, z[4];
  for (int i = 0; i < 4; ++i) {
    ivec2 q = min(low + ivec2(i & 1, i >> 1), last);
    z[i] = linear_depth(q * n);
    turned = min(turned, dot(first, oct_decode(unpackSnorm2x16(texelFetch(gbuffer0, q * n, 0).x))));
    vec3 e = texelFetch(irradiance_image, q, 0).rgb;
    least_e = min(least_e, e), most_e = max(most_e, e);
#ifdef FULL_BSDF
    vec3 l = texelFetch(glossy_image, q, 0).rgb;
    least_l = min(least_l, l), most_l = max(most_l, l);
#endif
  }
  bool whole = all(lessThan(low, last)) && min(min(z[0], z[1]), min(z[2], z[3])) > 0;
  bool agree = whole && turned > 0.95 && alike(least_e, most_e, 1 / PI);
#ifdef FULL_BSDF
  agree = agree && alike(least_l, most_l, 1);
#endif
  vec3 plane = vec3(z[0], (z[1] - z[0]) / float(n), (z[2] - z[0]) / float(n));
  cell = uvec4(floatBitsToUint(agree ? plane : vec3(0)), normal);
}
