#include "common.glsl"

layout(binding = UNIT_GBUFFER0) uniform usampler2D gbuffer0;
layout(binding = UNIT_GBUFFER1) uniform usampler2D gbuffer1;

struct Surface {
  vec3 position, normal, geometric_normal, wo;
  vec3 diffuse, f0;
  float diffuse_roughness, specular_roughness;
  float depth;  // along the view axis
  bool moves;   // on a body that an animation moves
  // A rough sheet from behind: its lobe is that of what it reflects toward the eye's mirror image
  bool from_behind;
};

// Direction to the viewer's world through a pixel; for an orthographic camera its offset on the image plane.
vec3 pixel_ray(vec2 pixel) {
  vec2 plane = 2 * pixel / vec2(frame.camera_right.w, frame.camera_up.w) - 1 - frame.shift.xy;
  return plane.x * frame.camera_right.xyz + plane.y * frame.camera_up.xyz;
}
bool orthographic() { return frame.camera_position.w != 0; }
vec3 view_direction(vec2 pixel) {
  return orthographic() ? frame.camera_forward.xyz : normalize(pixel_ray(pixel) + frame.camera_forward.xyz);
}
vec3 view_origin(vec2 pixel) {
  return frame.camera_position.xyz + (orthographic() ? pixel_ray(pixel) : vec3(0));
}

// Along the view axis; 0 where nothing stands.
float depth_at(ivec2 at) { return uintBitsToFloat(texelFetch(gbuffer1, at, 0).y); }
// Linear on the picture of a plane; 0 where nothing stands.
float linear_depth(ivec2 at) {
  float depth = depth_at(at);
  return orthographic() ? depth : depth > 0 ? 1 / depth : 0;
}
vec3 position_at(vec2 pixel, float depth) {
  vec3 plane = pixel_ray(pixel);
  return frame.camera_position.xyz + (orthographic() ? plane : plane * depth) + depth * frame.camera_forward.xyz;
}

// Where nothing stands the results mean nothing.
vec3 geometric_normal_at(ivec2 at) { return oct_decode(unpackSnorm2x16(texelFetch(gbuffer0, at, 0).y)); }
// What is left of a lobe around the mirrored way: a slope of a normal map mirrors its own ground, which is none.
float above_ground(Surface s, float roughness) {
  float width = max(2 * roughness * roughness, 0.01);
  return smoothstep(-width, 0, dot(reflect(-s.wo, s.normal), s.geometric_normal));
}
Surface read_surface(ivec2 at) {
  Surface s;
  vec2 pixel = vec2(at) + 0.5;
  uvec2 g1 = texelFetch(gbuffer1, at, 0).xy;
  uvec4 g0 = texelFetch(gbuffer0, at, 0);
  s.depth = uintBitsToFloat(g1.y);
  s.position = position_at(pixel, s.depth);
  s.wo = -view_direction(pixel);
  s.normal = oct_decode(unpackSnorm2x16(g0.x));
  s.geometric_normal = oct_decode(unpackSnorm2x16(g0.y));
  s.diffuse = unpack_color(g0.z);
  s.moves = g0.z >> 30 != 0u;
  s.f0 = unpack_color(g0.w);
  s.from_behind = g0.w >> 31 != 0u;
  if (s.from_behind) s.wo -= 2 * dot(s.wo, s.normal) * s.normal;
  vec2 roughness = unpackSnorm2x16(g1.x);
  s.diffuse_roughness = roughness.x;
  s.specular_roughness = roughness.y;
  return s;
}
