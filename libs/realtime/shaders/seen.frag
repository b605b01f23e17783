#version 450 core
// Emitters that are no surfaces, as the eye sees them: ENVIRONMENT and DISC behind everything, SPHERE and flat lamps (MESH)
// before it.
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
#elif defined(MESH)
  // The front of a plane, within reach of the lamp's middle
  vec3 n = emitter.samples[0].normal.xyz, c = emitter.place.xyz - o;
  float facing = -dot(d, n), t = -dot(c, n) / facing;
  vec3 at = t * d - c;
  if (facing <= 0 || t < 0 || dot(at, at) > 1.001 * emitter.place.w * emitter.place.w) return;
  float depth = depth_at(ivec2(pixel));
  if (depth > 0 && length(position_at(pixel, depth) - o) <= t) return;
  for (int k = 0; k < emitter.count.x; ++k) {
    vec3 p = emitter.corners[3 * k].xyz - emitter.place.xyz, q = emitter.corners[3 * k + 1].xyz - emitter.place.xyz,
         r = emitter.corners[3 * k + 2].xyz - emitter.place.xyz;
    if (dot(cross(q - p, at - p), n) >= 0 && dot(cross(r - q, at - q), n) >= 0 && dot(cross(p - r, at - r), n) >= 0) {
      color.rgb = emitter.light.rgb;
      return;
    }
  }
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
