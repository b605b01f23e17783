#version 450 core
// Into one face of a cube map (perspective, depth = near / z) or one parallel map.
#include "material.glsl"

uniform vec3 origin, right, up, forward;  // right and up scaled to the edge of the map
uniform float near_plane;                 // 0: parallel, forward scaled to 1 / range

layout(location = 0) in vec3 position;
#ifdef ALPHA
layout(location = 2) in vec2 uv_0;
layout(location = 4) in vec4 color;
layout(location = 5) in vec2 uv_1;
layout(location = 0) out vec4 uv_out;
layout(location = 1) out vec4 color_out;
layout(location = 2) out vec3 from_light;
#endif

void main() {
  vec3 p = (instance.world * vec4(position, 1)).xyz - origin;
  vec2 plane = vec2(dot(p, right), dot(p, up));
  float z = dot(p, forward);
  gl_Position = near_plane > 0 ? vec4(plane, near_plane, z) : vec4(plane, 1 - z, 1);
#ifdef ALPHA
  uv_out = vec4(uv_0, uv_1);
  color_out = color;
  from_light = p;
#endif
}
