#version 450 core
// Depth alone; GLASS: what glass leaves of the light.
#include "hash.glsl"
#ifdef GLASS
#include "common.glsl"
#endif
#ifdef ALPHA
#define BASE_TEXTURE
#include "material.glsl"
#ifdef GLASS
#include "bsdf.glsl"
#include "glass.glsl"
layout(location = 0) out vec4 left;
uniform vec3 forward;
uniform float near_plane;  // 0: parallel light
#endif

layout(location = 0) in vec4 uv;
layout(location = 1) in vec4 color;
layout(location = 2) in vec3 from_light;
uniform float clear_radius;  // nothing nearer to the light is in its way

void main() {
  if (dot(from_light, from_light) < clear_radius * clear_radius) discard;
  vec4 base = base_color(uv.xy, uv.zw, color);
  if (!covered(base.a, gl_FragCoord.xy, gl_FragCoord.z)) discard;
  float share = material.glass.x > 0 ? glass_share(uv.xy, uv.zw) : 0;
#ifdef GLASS
  if (share < 0.5) discard;
  vec3 across = cross(dFdx(from_light), dFdy(from_light));
  float cosine = abs(dot(normalize(across), normalize(near_plane > 0 ? from_light : forward)));
  float roughness = material.rough.y * texture(rough_texture, texture_place(material.rough_use, uv.xy, uv.zw)).g;
  left = vec4(share * kept_by_lobe(cosine, abs(roughness)) * glass_shares(cosine, base.rgb).transmitted, 1);
#else
  if (share >= 0.5) discard;  // lets light pass
#endif
}
#else
void main() {}
#endif
