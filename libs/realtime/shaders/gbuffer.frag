#version 450 core
#include "common.glsl"
#include "material.glsl"

layout(location = 0) in vec3 from_camera;
layout(location = 1) in vec3 world_normal;
layout(location = 2) in vec4 uv;
layout(location = 3) in vec4 world_tangent;
layout(location = 4) in vec4 color;
layout(location = 5) flat in uint instance;

layout(location = 0) out uvec4 gbuffer0;
layout(location = 1) out uint gbuffer1;
layout(location = 2) out vec4 emitted;

vec3 normalize_or(vec3 v, vec3 fallback) {
  float l2 = dot(v, v);
  return l2 > 0 ? v * inversesqrt(l2) : fallback;
}

// Tangent along +u of the normal map and handedness, from how texture coordinates change on the triangle:
// for meshes without tangents.
vec4 tangent_of_triangle(vec2 place, vec3 front) {
  vec3 e1 = dFdx(from_camera), e2 = dFdy(from_camera);
  vec2 d1 = dFdx(place), d2 = dFdy(place);
  float determinant = d1.x * d2.y - d1.y * d2.x;
  if (determinant == 0) return vec4(0);
  vec3 along_u = (d2.y * e1 - d1.y * e2) / determinant;
  vec3 along_v = (d1.x * e2 - d2.x * e1) / determinant;
  // The map's green points up the image, against v
  return vec4(along_u, dot(cross(front, along_u), -along_v) < 0 ? -1 : 1);
}

void main() {
  Instance i = instances[instance];
  Material m = materials[i.material.x];
  vec4 base = base_color(m, uv.xy, uv.zw, color);
  if (!covered(m, base.a, gl_FragCoord.xy, gl_FragCoord.z)) discard;

  vec3 wo = frame.camera_position.w != 0 ? -frame.camera_forward.xyz : -normalize(from_camera);
  // An instance that mirrors turns triangles around
  bool from_front = gl_FrontFacing != (i.material.y != 0u);
  vec3 toward_viewer = normalize_or(cross(dFdx(from_camera), dFdy(from_camera)), wo);
  if (dot(toward_viewer, wo) < 0) toward_viewer = -toward_viewer;
  vec3 front = from_front ? toward_viewer : -toward_viewer;

  vec3 n = normalize_or(world_normal, front);
  if (dot(n, front) < 0) n = -n;
  if (m.normal_use.offset.w != 0) {
    vec2 place = texture_place(m.normal_use, uv.xy, uv.zw);
    vec4 tangent = world_tangent == vec4(0) ? tangent_of_triangle(place, front) : world_tangent;
    vec3 t = normalize_or(tangent.xyz - n * dot(n, tangent.xyz), vec3(0));
    if (t != vec3(0)) {
      float mirror = i.material.y != 0u && world_tangent != vec4(0) ? -1 : 1;
      vec3 b = (tangent.w < 0 ? -1 : 1) * mirror * cross(n, t);
      vec3 mapped = 2 * texture(normal_texture, place).xyz - 1;
      mapped.xy *= m.rough.w;
      n = normalize_or(mapped.x * t + mapped.y * b + mapped.z * n, n);
    }
  }
  if (!from_front) n = -n;
  // A normal that faces away is turned just so far that it sees the viewer
  float c = dot(n, wo);
  if (c < 1e-3) n = normalize_or(n + (2e-3 - c) * wo, toward_viewer);

  float metallic = m.emission.w;
  vec2 roughness = m.rough.xy;
  if (m.rough_use.offset.w != 0) {
    vec4 texel = texture(rough_texture, texture_place(m.rough_use, uv.xy, uv.zw));
    metallic *= texel.b;
    roughness.y *= texel.g;
  }
  bool unlit = m.alpha.z != 0;
  vec3 emission = vec3(0);
  if (unlit) {
    emission = base.rgb;
  } else if (from_front || m.alpha.w != 0) {
    emission = m.emission.rgb;
    if (m.emission_use.offset.w != 0)
      emission *= texture(emission_texture, texture_place(m.emission_use, uv.xy, uv.zw)).rgb;
  }
  if (i.material.z != 0u) emission *= group_scales[i.material.z - 1u].rgb;

  vec3 diffuse = unlit ? vec3(0) : base.rgb * (1 - metallic);
  vec3 f0 = unlit ? vec3(0) : mix(vec3(m.rough.z), base.rgb, metallic);
  gbuffer0 = uvec4(packSnorm2x16(oct_encode(n)), packSnorm2x16(oct_encode(toward_viewer)),
                   pack_color(diffuse, unlit ? 1u : 0u), pack_color(f0, 0u));
  gbuffer1 = packSnorm2x16(roughness);
  emitted = vec4(emission, 1);
}
