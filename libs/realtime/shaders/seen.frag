#version 450 core
// Emitters that are no surfaces, as the eye sees them: ENVIRONMENT and DISC behind everything, SPHERE before it.
#include "gbuffer_read.glsl"
#include "lights.glsl"

#ifdef ENVIRONMENT
layout(binding = UNIT_ENVIRONMENT) uniform sampler2D environment_map;
#endif
layout(location = 0) out vec4 color;

void main() {
  vec2 pixel = gl_FragCoord.xy;
  vec3 d = view_direction(pixel), o = view_origin(pixel);
  color = vec4(0);
#if defined(ENVIRONMENT)
  vec3 e = to_environment(d);
  vec2 uv = vec2(0.5 + atan(e.z, e.x) / (2 * PI), atan(length(e.xz), e.y) / PI);
  color.rgb = emitter.light.rgb * textureLod(environment_map, uv, 0).rgb;
#elif defined(DISC)
  vec3 off = d - emitter.place.xyz;
  float s = sin(emitter.place.w);
  if (s > 0 && dot(off, off) <= 2 * (1 - sqrt(1 - s * s))) color.rgb = emitter.light.rgb / (PI * s * s);
#else
  vec3 c = emitter.place.xyz - o;
  float r = emitter.place.w, along = dot(c, d);
  vec3 miss = c - along * d;
  float half2 = r * r - dot(miss, miss);
  float depth = depth_at(ivec2(pixel));
  float distance = depth > 0 ? length(position_at(pixel, depth) - o) : 1e30;
  float t = dot(c, c) < r * r ? along + sqrt(half2) : along - sqrt(half2);
  if (half2 >= 0 && t >= 0 && t < distance) color.rgb = emitter.light.rgb;
#endif
}
