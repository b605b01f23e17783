// An engine that keeps the file in a texture.
layout(binding = 2) uniform highp usampler2D rows;
uvec4 texel(int i) { return texelFetch(rows, ivec2(i & 2047, i >> 11), 0); }
#define SSPHH_TEXEL(i) texel(i)
#include "ssphh_lookup.glsl"

layout(local_size_x = 64) in;
layout(std430, binding = 0) writeonly buffer Results { vec4 results[]; };

void main() { results[gl_GlobalInvocationID.x] = vec4(ssphh_irradiance(vec3(gl_GlobalInvocationID), vec3(0.0, 1.0, 0.0)), 1.0); }
