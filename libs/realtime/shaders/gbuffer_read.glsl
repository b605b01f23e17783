#include "common.glsl"

layout(binding = 0) uniform usampler2D gbuffer0;
layout(binding = 1) uniform usampler2D gbuffer1;
layout(binding = 2) uniform sampler2D gbuffer_depth;

struct Surface {
  bool hit, unlit;
  vec3 position, normal, geometric_normal, wo;
  vec3 diffuse, f0;
  float diffuse_roughness, specular_roughness;
  float depth;  // along the view axis
};

// Direction to the viewer's world through a pixel; for an orthographic camera its offset on the image plane.
vec3 pixel_ray(vec2 pixel) {
  vec2 plane = 2 * pixel / vec2(frame.camera_right.w, frame.camera_up.w) - 1;
  return plane.x * frame.camera_right.xyz + plane.y * frame.camera_up.xyz;
}
bool orthographic() { return frame.camera_position.w != 0; }
vec3 view_direction(vec2 pixel) {
  return orthographic() ? frame.camera_forward.xyz : normalize(pixel_ray(pixel) + frame.camera_forward.xyz);
}
vec3 view_origin(vec2 pixel) {
  return frame.camera_position.xyz + (orthographic() ? pixel_ray(pixel) : vec3(0));
}

float view_depth(float stored) {
  return orthographic() ? (1 - stored) * frame.camera_forward.w : frame.camera_forward.w / stored;
}
vec3 position_at(vec2 pixel, float depth) {
  vec3 plane = pixel_ray(pixel);
  return frame.camera_position.xyz + (orthographic() ? plane : plane * depth) + depth * frame.camera_forward.xyz;
}

Surface read_surface(ivec2 at) {
  Surface s;
  float stored = texelFetch(gbuffer_depth, at, 0).x;
  s.hit = stored > 0;
  if (!s.hit) return s;
  vec2 pixel = vec2(at) + 0.5;
  s.depth = view_depth(stored);
  s.position = position_at(pixel, s.depth);
  s.wo = -view_direction(pixel);
  uvec4 g0 = texelFetch(gbuffer0, at, 0);
  s.normal = oct_decode(unpackSnorm2x16(g0.x));
  s.geometric_normal = oct_decode(unpackSnorm2x16(g0.y));
  s.diffuse = unpack_color(g0.z);
  s.f0 = unpack_color(g0.w);
  s.unlit = (g0.z >> 30) != 0;
  vec2 roughness = unpackSnorm2x16(texelFetch(gbuffer1, at, 0).x);
  s.diffuse_roughness = roughness.x;
  s.specular_roughness = roughness.y;
  return s;
}
