#version 450 core
// Where pieces of a wall meet at a corner of one alone, pixels slip between them and show the dark inside of a piece. Such a
// pixel goes on what stands at both sides of it, if that is one plane before it.
#include "gbuffer_read.glsl"

layout(rgba32ui, binding = UNIT_GBUFFER0_IMAGE) uniform writeonly uimage2D gbuffer0_image;
layout(rg32ui, binding = UNIT_GBUFFER1_IMAGE) uniform writeonly uimage2D gbuffer1_image;

bool from_front(ivec2 at) { return depth_at(at) > 0 && texelFetch(gbuffer0, at, 0).w >> 30 == 0u; }

void main() {
  ivec2 at = ivec2(gl_FragCoord.xy), end = textureSize(gbuffer0, 0);
  if (texelFetch(gbuffer0, at, 0).w >> 30 == 0u) discard;
  for (int axis = 0; axis < 2; ++axis) {
    ivec2 one = axis == 0 ? ivec2(1, 0) : ivec2(0, 1), a = at - one, b = at + one;
    if (any(lessThan(a, ivec2(0))) || any(greaterThanEqual(b, end)) || !from_front(a) || !from_front(b)) continue;
    vec3 n = geometric_normal_at(a), place = position_at(vec2(a) + 0.5, depth_at(a));
    vec3 across = position_at(vec2(b) + 0.5, depth_at(b)) - place;
    if (dot(n, geometric_normal_at(b)) < 0.999 || abs(dot(n, across)) > 0.02 * length(across)) continue;
    // Where the way through the pixel meets their plane
    vec3 origin = position_at(vec2(at) + 0.5, 0), way = position_at(vec2(at) + 0.5, 1) - origin;
    float depth = dot(n, place - origin) / dot(n, way);
    if (!(depth < depth_at(at))) continue;
    imageStore(gbuffer0_image, at, texelFetch(gbuffer0, a, 0));
    imageStore(gbuffer1_image, at, uvec4(texelFetch(gbuffer1, a, 0).x, floatBitsToUint(depth), 0, 0));
    break;
  }
  discard;
}
