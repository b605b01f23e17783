#version 450 core
#ifdef ALPHA
#include "material.glsl"

layout(location = 0) in vec4 uv;
layout(location = 1) in vec4 color;
layout(location = 2) flat in uint material;

void main() {
  Material m = materials[material];
  float alpha = base_color(m, uv.xy, uv.zw, color).a;
  if (!covered(m, alpha, gl_FragCoord.xy, gl_FragCoord.z)) discard;
}
#else
void main() {}
#endif
