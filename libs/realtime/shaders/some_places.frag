#version 450 core
// Where stands what pixels show that are spread evenly over the picture; w: its depth.
#include "gbuffer_read.glsl"

uniform ivec4 size;  // of the small picture
layout(location = 0) out vec4 place;

void main() {
  ivec2 at = ivec2(gl_FragCoord.xy / vec2(size.xy) * vec2(textureSize(gbuffer1, 0)));
  float depth = depth_at(at);
  place = vec4(position_at(vec2(at) + 0.5, depth), depth);
}
