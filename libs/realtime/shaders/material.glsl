#include "hash.glsl"

struct TextureUse {
  vec4 matrix;  // rows of the 2 x 2 part
  vec4 offset;  // xy; z: texture coordinate set
};
// What is drawn now: blocks of their own, so that all of a draw's pixels load the same.
layout(std140, binding = BINDING_MATERIAL_BLOCK) uniform MaterialBlock {
  vec4 base;      // rgb, alpha
  vec4 emission;  // rgb, metallic
  vec4 rough;     // diffuse, specular (both bipolar), F0 of the dielectric, normal scale
  vec4 alpha;     // cutoff, mode (0 opaque, 1 mask, 2 blend), unlit, double sided
  vec4 glass;     // transmission, 1 for a thin sheet, index of refraction, weight of what is reflected
  vec4 inside;    // rgb: what a solid body absorbs [1/m]
  TextureUse base_use, rough_use, emission_use, normal_use, transmission_use;
} material;
layout(std140, binding = BINDING_INSTANCE_BLOCK) uniform InstanceBlock {
  mat4 world;
  mat3x4 normal;        // inverse transpose, columns
  vec4 emission_scale;  // of its light group; w: 1 if it mirrors, and 2 if an animation moves it
  vec4 middle;          // of its box in the world; w: its number, from 1
} instance;

layout(binding = UNIT_BASE_TEXTURE) uniform sampler2D base_texture;
layout(binding = UNIT_ROUGH_TEXTURE) uniform sampler2D rough_texture;
layout(binding = UNIT_EMISSION_TEXTURE) uniform sampler2D emission_texture;
layout(binding = UNIT_NORMAL_TEXTURE) uniform sampler2D normal_texture;
layout(binding = UNIT_TRANSMISSION_TEXTURE) uniform sampler2D transmission_texture;

vec2 texture_place(TextureUse use, vec2 uv0, vec2 uv1) {
  vec2 uv = use.offset.z != 0 ? uv1 : uv0;
  return vec2(dot(use.matrix.xy, uv), dot(use.matrix.zw, uv)) + use.offset.xy;
}

vec4 base_color(vec2 uv0, vec2 uv1, vec4 color) {
  vec4 base = material.base * color;
#ifdef BASE_TEXTURE
  base *= texture(base_texture, texture_place(material.base_use, uv0, uv1));
#endif
  return base;
}

// Share of the surface that is glass.
float glass_share(vec2 uv0, vec2 uv1) {
  float metallic = material.emission.w * texture(rough_texture, texture_place(material.rough_use, uv0, uv1)).b;
  float texel = texture(transmission_texture, texture_place(material.transmission_use, uv0, uv1)).r;
  return material.glass.x * texel * (1 - metallic);
}

// Partial coverage is met by chance, a hash of the place: the mean over samples is right.
bool covered(float alpha, vec2 pixel, float depth) {
  if (material.alpha.y == 0) return true;
  if (material.alpha.y == 1) return alpha >= material.alpha.x;
  return alpha > hash01(uvec3(uvec2(pixel), floatBitsToUint(depth)));
}
