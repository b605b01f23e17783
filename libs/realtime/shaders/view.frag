#version 450 core
// What a frame is made of, in place of the frame.
#include "gbuffer_read.glsl"
#include "bsdf.glsl"

layout(binding = UNIT_SHADOW_IMAGE) uniform sampler2D shadow_image;  // light that arrives, light there would be
layout(location = 0) out vec4 color;

void main() {
  ivec2 at = ivec2(gl_FragCoord.xy);
  Surface s = read_surface(at);
  int view = int(frame.environment.w);
  color = vec4(0, 0, 0, 1);
  if (view == VIEW_ALBEDO) {
    Bsdf bsdf = bsdf_from(s.diffuse, s.f0, s.diffuse_roughness, s.specular_roughness, dot(s.normal, s.wo));
    color.rgb = bsdf.albedo + s.diffuse * (1 - bsdf.albedo);
  }
  if (view == VIEW_NORMAL) color.rgb = 0.5 + 0.5 * s.normal;
  if (view == VIEW_DEPTH) color.rgb = vec3(s.depth / (1 + s.depth));
  if (view == VIEW_SHADOW) {
    vec2 light = texelFetch(shadow_image, at, 0).xy;
    color.rgb = vec3(light.y > 0 ? min(light.x / light.y, 1.0) : 0);  // both sums are rounded
  }
}
