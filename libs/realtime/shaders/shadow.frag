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
uniform vec3 origin, right, up, forward;
uniform float near_plane;  // 0: parallel light
layout(binding = UNIT_LIGHT_MAPS) uniform sampler2DArray opaque_depth;
uniform int layer;  // of it
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
  vec3 crossed = share * kept_by_lobe(cosine, abs(roughness)) * glass_shares(cosine, base.rgb).transmitted;
  // What is behind the nearest surface dims nothing before it
  float nearest = texelFetch(opaque_depth, ivec3(gl_FragCoord.xy, layer), 0).r;
  bool hidden = gl_FragCoord.z < nearest;
  if (hidden) crossed = vec3(1);
  if (material.glass.y == 0) {
    vec3 middle = instance.middle.xyz - origin;
    float behind_middle;
    if (near_plane > 0) {
      float z = dot(from_light, forward), along = length(from_light) / z;
      behind_middle = along * (hidden ? near_plane / nearest : z) - length(middle);
    } else {
      float z = hidden ? 1 - nearest : dot(from_light, forward);
      behind_middle = (z - dot(middle, forward)) / length(forward);
    }
    // Maps and instances that mirror turn triangles around
    bool mirrored = ((int(instance.emission_scale.w) & 1) != 0) != (dot(cross(right, up), forward) > 0);
    crossed *= absorbed_at(behind_middle, gl_FrontFacing != mirrored, hidden, 8);
  }
  left = vec4(crossed, 1);
#else
  if (share >= 0.5) discard;  // lets light pass
#endif
}
#else
void main() {}
#endif
