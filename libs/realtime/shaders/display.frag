#version 450 core
// Exposure, tone curve and encoding, as image::to_display.
#include "common.glsl"
layout(binding = UNIT_PICTURE) uniform sampler2D image;
uniform ivec4 corner;
uniform int plain;  // views that are no light: encoding only
layout(location = 0) out vec4 color;

float curve(float x) {
  if (!(x > 0)) return 0;
  if (frame.tone.y != 0) {
    if (x > 1e4) return 1;
    x = x * (2.51 * x + 0.03) / (x * (2.43 * x + 0.59) + 0.14);
  }
  return min(x, 1.0);
}

float encode(float x) {
  if (frame.tone.z > 0) return pow(x, frame.tone.z);
  return x <= 0.0031308 ? 12.92 * x : 1.055 * pow(x, 1 / 2.4) - 0.055;
}

void main() {
  vec3 c = texelFetch(image, ivec2(gl_FragCoord.xy) - corner.xy, 0).rgb;
  if (plain != 0) {
    color = vec4(clamp(c, 0.0, 1.0), 1);
    return;
  }
  c *= frame.tone.x;
  color = vec4(encode(curve(c.x)), encode(curve(c.y)), encode(curve(c.z)), 1);
}
