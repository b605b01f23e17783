#version 450 core
// An engine's G-buffer as ours: Lambertian surfaces.
#include "common.glsl"

layout(binding = UNIT_TAKEN) uniform sampler2D depth_image;
layout(binding = UNIT_TAKEN + 1) uniform sampler2D position_image;
layout(binding = UNIT_TAKEN + 2) uniform sampler2D normal_image;
layout(binding = UNIT_TAKEN + 3) uniform sampler2D geometric_normal_image;
layout(binding = UNIT_TAKEN + 4) uniform sampler2D albedo_image;
layout(binding = UNIT_TAKEN + 5) uniform sampler2D moving_image;
uniform ivec4 given;   // position, geometric normal, albedo, moving
uniform ivec4 stored;  // clip space has z in 0..w, normals from zero
uniform float empty_depth;
uniform mat4 clip_to_world;

layout(location = 0) out uvec4 gbuffer0;
layout(location = 1) out uvec2 gbuffer1;
layout(location = 2) out vec4 color_out;

vec3 normal_at(sampler2D normals, ivec2 at) {
  vec3 n = texelFetch(normals, at, 0).xyz;
  return stored.y != 0 ? 2 * n - 1 : n;
}
uint pack_normal(vec3 normal) { return packSnorm2x16(oct_encode(normalize(normal))); }

void main() {
  ivec2 at = ivec2(gl_FragCoord.xy);
  vec2 plane = 2 * gl_FragCoord.xy / vec2(frame.camera_right.w, frame.camera_up.w) - 1;
  vec4 place;
  if (given.x != 0) {
    place = texelFetch(position_image, at, 0);
    if (place.w == 0) discard;
  } else {
    float depth = texelFetch(depth_image, at, 0).x;
    if (depth == empty_depth) discard;
    place = clip_to_world * vec4(plane, stored.x != 0 ? depth : 2 * depth - 1, 1);
    place /= place.w;
  }
  vec3 shading = normal_at(normal_image, at);
  vec3 geometric = given.y != 0 ? normal_at(geometric_normal_image, at) : shading;
  vec3 albedo = given.z != 0 ? texelFetch(albedo_image, at, 0).rgb : vec3(1);
  bool moves = given.w != 0 && texelFetch(moving_image, at, 0).x > 0.5;

  // Along the ray through the texel, in lengths of its part along the view axis
  vec2 on = plane - frame.shift.xy;
  vec3 across = on.x * frame.camera_right.xyz + on.y * frame.camera_up.xyz;
  bool orthographic = frame.camera_position.w != 0;
  vec3 ray = frame.camera_forward.xyz + (orthographic ? vec3(0) : across);
  vec3 away = place.xyz - frame.camera_position.xyz - (orthographic ? across : vec3(0));
  float depth = dot(away, ray) / dot(ray, ray);
  if (!(depth > 0) || !(dot(shading, shading) > 0) || !(dot(geometric, geometric) > 0)) discard;
  gbuffer0 = uvec4(pack_normal(shading), pack_normal(geometric), pack_color(albedo, moves ? 1u : 0u), 0u);
  gbuffer1 = uvec2(0u, floatBitsToUint(depth));
  color_out = vec4(0);
}
