#version 450 core
#ifdef ALPHA
#define BASE_TEXTURE
#include "material.glsl"

layout(location = 0) in vec4 uv;
layout(location = 1) in vec4 color;

void main() {
  float alpha = base_color(uv.xy, uv.zw, color).a;
  if (!covered(alpha, gl_FragCoord.xy, gl_FragCoord.z)) discard;
  if (material.glass.x > 0 && glass_share(uv.xy, uv.zw) >= 0.5) discard;  // lets light pass
}
#else
void main() {}
#endif
