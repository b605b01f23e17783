#version 450 core
// Depths of pixels that are spread evenly over the picture.
#include "gbuffer_read.glsl"

uniform ivec4 size;  // of the small picture
layout(location = 0) out float depth;

void main() {
  depth = depth_at(ivec2(gl_FragCoord.xy / vec2(size.xy) * vec2(textureSize(gbuffer1, 0))));
}
