#version 450 core
#include "common.glsl"
#include "material.glsl"

layout(location = 0) in vec3 position;
layout(location = 1) in vec3 normal;
layout(location = 2) in vec2 uv_0;
layout(location = 3) in vec4 tangent;
layout(location = 4) in vec4 color;
layout(location = 5) in vec2 uv_1;

layout(location = 0) out vec3 from_camera;
layout(location = 1) out vec3 world_normal;
layout(location = 2) out vec4 uv_out;
layout(location = 3) out vec4 world_tangent;
layout(location = 4) out vec4 color_out;

void main() {
  vec3 world = (instance.world * vec4(position, 1)).xyz;
  from_camera = world - frame.camera_position.xyz;
  world_normal = mat3(instance.normal) * normal;
  world_tangent = vec4(mat3(instance.world) * tangent.xyz, tangent.w);
  uv_out = vec4(uv_0, uv_1);
  color_out = color;

  vec3 right = frame.camera_right.xyz / dot(frame.camera_right.xyz, frame.camera_right.xyz);
  vec3 up = frame.camera_up.xyz / dot(frame.camera_up.xyz, frame.camera_up.xyz);
  float z = dot(from_camera, frame.camera_forward.xyz);
  vec2 plane = vec2(dot(from_camera, right), dot(from_camera, up));
  plane += frame.shift.xy * (frame.camera_position.w != 0 ? 1 : z);
  gl_Position = frame.camera_position.w != 0 ? vec4(plane, 1 - z / frame.camera_forward.w, 1)
                                             : vec4(plane, frame.camera_forward.w, z);
}
