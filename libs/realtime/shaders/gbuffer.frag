#version 450 core
#include "common.glsl"
#include "material.glsl"
#ifdef GLASS
#include "bsdf.glsl"
#include "glass.glsl"
#endif

layout(location = 0) in vec3 from_camera;
layout(location = 1) in vec3 world_normal;
layout(location = 2) in vec4 uv;
layout(location = 3) in vec4 world_tangent;
layout(location = 4) in vec4 color;

layout(location = 0) out uvec4 gbuffer0;
layout(location = 1) out uvec2 gbuffer1;
layout(location = 2) out vec4 color_out;

uniform int emission_shown;  // 1: all; 2: of unlit surfaces, whose colour it is
#ifdef GLASS
#include "glass_layers.glsl"
#endif

vec3 normalize_or(vec3 v, vec3 fallback) {
  float l2 = dot(v, v);
  return l2 > 0 ? v * inversesqrt(l2) : fallback;
}

#ifdef NORMAL_TEXTURE
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
#endif

void main() {
  int flags = int(instance.emission_scale.w);
  bool mirrored = (flags & 1) != 0;
  vec4 base = base_color(uv.xy, uv.zw, color);
  if (!covered(base.a, gl_FragCoord.xy, gl_FragCoord.z)) discard;

  vec3 wo = frame.camera_position.w != 0 ? -frame.camera_forward.xyz : -normalize(from_camera);
  // An instance that mirrors turns triangles around
  bool from_front = gl_FrontFacing != mirrored;
  vec3 toward_viewer = normalize_or(cross(dFdx(from_camera), dFdy(from_camera)), wo);
  if (dot(toward_viewer, wo) < 0) toward_viewer = -toward_viewer;
  vec3 front = from_front ? toward_viewer : -toward_viewer;

  vec3 n = normalize_or(world_normal, front);
  if (dot(n, front) < 0) n = -n;
#ifdef NORMAL_TEXTURE
  {
    vec2 place = texture_place(material.normal_use, uv.xy, uv.zw);
    vec4 tangent = world_tangent == vec4(0) ? tangent_of_triangle(place, front) : world_tangent;
    vec3 t = normalize_or(tangent.xyz - n * dot(n, tangent.xyz), vec3(0));
    if (t != vec3(0)) {
      float mirror = mirrored && world_tangent != vec4(0) ? -1 : 1;
      vec3 b = (tangent.w < 0 ? -1 : 1) * mirror * cross(n, t);
      vec3 mapped = 2 * texture(normal_texture, place).xyz - 1;
      mapped.xy *= material.rough.w;
      n = normalize_or(mapped.x * t + mapped.y * b + mapped.z * n, n);
    }
  }
#endif
  if (!from_front) n = -n;
  // A normal that faces away is turned just so far that it sees the viewer
  float c = dot(n, wo);
  if (c < 1e-3) n = normalize_or(n + (2e-3 - c) * wo, toward_viewer);

  float metallic = material.emission.w;
  vec2 roughness = material.rough.xy;
#ifdef ROUGH_TEXTURE
  {
    vec4 texel = texture(rough_texture, texture_place(material.rough_use, uv.xy, uv.zw));
    metallic *= texel.b;
    roughness.y *= texel.g;
  }
#endif
  bool unlit = material.alpha.z != 0;
  vec3 emission = vec3(0);
  if (unlit) {
    emission = base.rgb;
  } else if (from_front || material.alpha.w != 0) {
    emission = material.emission.rgb;
#ifdef EMISSION_TEXTURE
    emission *= texture(emission_texture, texture_place(material.emission_use, uv.xy, uv.zw)).rgb;
#endif
  }
  emission *= instance.emission_scale.rgb;

  vec3 diffuse = unlit ? vec3(0) : base.rgb * (1 - metallic);
  vec3 f0 = unlit ? vec3(0) : mix(vec3(material.rough.z), base.rgb, metallic);
  bool from_behind = false;
#ifdef GLASS
  {
    float share = glass_share(uv.xy, uv.zw);
    if ((share < 0.5) != (glass_layer == GLASS_OPAQUE)) discard;
    float depth = dot(from_camera, frame.camera_forward.xyz);
    if (glass_layer == GLASS_EXITS) {
      if (from_front) discard;
      gbuffer0 = uvec4(floatBitsToUint(depth), packSnorm2x16(oct_encode(n)), uint(instance.middle.w), 0);
      gbuffer1 = uvec2(0), color_out = vec4(0);
      return;
    }
#ifdef BENT
    {
      uvec4 leaves = texelFetch(exits, ivec2(gl_FragCoord.xy), 0);
      if (!from_front || leaves.z != uint(instance.middle.w) || depth > uintBitsToFloat(leaves.x)) discard;
      gbuffer0 = uvec4(0), gbuffer1 = uvec2(0);
      color_out = vec4(share * kept_by_lobe(dot(n, wo), abs(roughness.y)) * light_through_body(n, wo, base.rgb), 1);
      return;
    }
#endif
    float cosine = clamp(dot(n, wo), 0.0, 1.0);
    GlassShares shares = glass_shares(cosine, base.rgb);
    if (glass_layer == GLASS_THROUGH) {
      gbuffer0 = uvec4(0), gbuffer1 = uvec2(0);
      color_out = vec4(left_by_crossing(share * kept_by_lobe(cosine, abs(roughness.y)) * shares.transmitted, from_front), 1);
      return;
    }
    diffuse *= 1 - share;
    from_behind = glass_layer == GLASS_FROSTED;
    if (from_behind) {
      if (material.glass.y == 0 || roughness.y * roughness.y <= MIN_ALPHA) discard;
      diffuse = vec3(0), roughness.y = abs(roughness.y);
      n = -n, toward_viewer = -toward_viewer;
    }
    if (from_behind || glass_layer == GLASS_REFLECTING) {
      // The F0 with which Schlick's term is that of the glass at this angle.
      float s = schlick_weight(cosine);
      vec3 seen = from_behind ? share * shares.transmitted : mix(f0 * (1 - s) + s, shares.reflected, share);
      f0 = clamp((seen - s) / max(1 - s, 1e-3), 0.0, 1.0);
    }
  }
#endif
  gbuffer0 = uvec4(packSnorm2x16(oct_encode(n)), packSnorm2x16(oct_encode(toward_viewer)),
                   pack_color(diffuse, (flags & 2) != 0 ? 1u : 0u), pack_color(f0, (from_front ? 0u : 1u) | (from_behind ? 2u : 0u)));
  gbuffer1 = uvec2(packSnorm2x16(roughness), floatBitsToUint(dot(from_camera, frame.camera_forward.xyz)));
  color_out = vec4(!from_behind && (emission_shown == 1 || (emission_shown == 2 && unlit)) ? emission : vec3(0), 1);
}
