#version 450 core
// How open a point is to its near surroundings, from depth alone: a look, not a measurement, and off where
// pictures are compared. Samples of the hemisphere's cosine lobe within a radius; what lies in front of one, not too far,
// closes it.
#include "gbuffer_read.glsl"

layout(location = 0) out float open;
const int SAMPLES = 16;

void main() {
  ivec2 at = ivec2(gl_FragCoord.xy);
  Surface s = read_surface(at);
  mat3 basis = basis_around(s.normal);
  float turn = 2 * PI * hash01(uvec3(at, 7));
  float radius = frame.extra.x, closed = 0;
  vec3 right = frame.camera_right.xyz / dot(frame.camera_right.xyz, frame.camera_right.xyz);
  vec3 up = frame.camera_up.xyz / dot(frame.camera_up.xyz, frame.camera_up.xyz);
  vec2 size = vec2(frame.camera_right.w, frame.camera_up.w);
  for (int i = 0; i < SAMPLES; ++i) {
    float u = (float(i) + 0.5) / float(SAMPLES), phi = turn + 2.39996323 * float(i);
    vec3 d = basis * vec3(sqrt(u) * vec2(cos(phi), sin(phi)), sqrt(1 - u));
    float reach = radius * (0.1 + 0.9 * fract(float(i) * 0.618034));
    vec3 p = s.position + 0.01 * radius * s.normal + reach * d - frame.camera_position.xyz;
    float z = dot(p, frame.camera_forward.xyz);
    if (z <= 0) continue;
    vec2 plane = vec2(dot(p, right), dot(p, up)) / (orthographic() ? 1 : z) + frame.shift.xy;
    ivec2 q = ivec2((0.5 + 0.5 * plane) * size);
    if (any(lessThan(q, ivec2(0))) || any(greaterThanEqual(q, ivec2(size)))) continue;
    float depth = depth_at(q);
    float before = z - depth;
    if (depth > 0 && before > 0.01 * radius && before < radius) closed += 1;
  }
  open = 1 - closed / float(SAMPLES);
}
