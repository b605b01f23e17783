// A program as an engine would write it, with the file in a buffer of its own choice. The test puts #version in front.
#define SSPHH_BINDING 3
#ifdef VULKAN
#define SSPHH_SET 1
#endif
#include "ssphh_lookup.glsl"

layout(local_size_x = 64) in;
layout(std430, binding = 0) writeonly buffer Results { vec4 results[]; };

void main() {
  vec3 position = vec3(gl_GlobalInvocationID), normal = vec3(0.0, 1.0, 0.0);
  vec3 still = ssphh_irradiance(position, normal), open = ssphh_irradiance_open(position, normal);
  results[gl_GlobalInvocationID.x] = vec4(still + open + ssphh_irradiance_for(position, normal, normal.yxz, true), 1.0);
}
