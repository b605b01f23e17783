#version 450 core
// Emission, lamps' light, probes' light and what stands behind: one radiance.
#include "gbuffer_read.glsl"
#include "bsdf.glsl"
#include "shadow.glsl"
#include "lights.glsl"

layout(binding = 8) uniform sampler2D emitted_image;
layout(binding = 9) uniform sampler2D direct_image;
layout(binding = 10) uniform sampler2D irradiance_image;
layout(binding = 11) uniform sampler2D glossy_image;
layout(binding = 13) uniform sampler2D environment_map;
layout(binding = 14) uniform sampler2D occlusion_image;

uniform int show_sky;
layout(location = 0) out vec4 color;

const int VIEW_LIT = 0, VIEW_DIRECT = 1, VIEW_INDIRECT = 2, VIEW_ALBEDO = 3, VIEW_NORMAL = 4, VIEW_DEPTH = 5,
          VIEW_SHADOW = 6, VIEW_SPHL = 7;

vec3 environment_radiance(vec3 d) {
  // The image is turned about +y by the rotation, counter-clockwise seen from above
  float c = frame.environment.x, s = frame.environment.y;
  vec3 e = vec3(c * d.x - s * d.z, d.y, s * d.x + c * d.z);
  vec2 uv = vec2(0.5 + atan(e.z, e.x) / (2 * PI), acos(clamp(e.y, -1, 1)) / PI);
  return textureLod(environment_map, uv, 0).rgb;
}

// Emitters that are no surfaces, seen before `distance` along a ray from o.
vec3 seen_emitters(vec3 o, vec3 d, float distance, bool escaped) {
  vec3 sum = vec3(0);
  for (int i = 0; i < frame.counts.x; ++i) {
    int kind = emitters[i].items.x;
    if (kind == SPHERE) {
      vec3 c = emitters[i].place.xyz - o;
      float r = emitters[i].place.w, along = dot(c, d);
      vec3 miss = c - along * d;
      float half2 = r * r - dot(miss, miss);
      if (half2 < 0) continue;
      float t = dot(c, c) < r * r ? along + sqrt(half2) : along - sqrt(half2);
      if (t >= 0 && t < distance) sum += emitters[i].light.rgb;
    } else if (kind == DIRECTIONAL && escaped && emitters[i].place.w > 0) {
      vec3 off = d - emitters[i].place.xyz;
      float s = sin(emitters[i].place.w);
      if (dot(off, off) <= 2 * (1 - sqrt(1 - s * s))) sum += emitters[i].light.rgb / (PI * s * s);
    } else if (kind == ENVIRONMENT && escaped) {
      sum += emitters[i].light.rgb * environment_radiance(d);
    }
  }
  return sum;
}

vec3 fetch_indirect(sampler2D image, ivec2 at, Surface s) {
  int n = int(frame.extra.y);
  if (n == 1) return texelFetch(image, at, 0).rgb;
  // Between the four samples around, those on the same surface count
  vec2 place = vec2(at) / float(n);
  ivec2 low = ivec2(floor(place)), most = (ivec2(frame.camera_right.w, frame.camera_up.w) - 1) / n;
  vec2 f = place - vec2(low);
  vec4 sum = vec4(0);
  for (int i = 0; i < 4; ++i) {
    ivec2 o = ivec2(i & 1, i >> 1), q = min(low + o, most);
    float stored = texelFetch(gbuffer_depth, q * n, 0).x;
    vec2 b = mix(1 - f, f, vec2(o));
    float weight = b.x * b.y + 1e-4;
    if (stored > 0) {
      vec3 p = position_at(vec2(q * n) + 0.5, view_depth(stored));
      vec3 other = oct_decode(unpackSnorm2x16(texelFetch(gbuffer0, q * n, 0).x));
      float off = abs(dot(p - s.position, s.geometric_normal)) / (0.01 * s.depth);
      float turned = max(dot(other, s.normal), 0);
      turned *= turned;
      turned *= turned;
      weight *= exp(-off) * turned * turned + 1e-4;
    } else {
      weight *= 1e-6;
    }
    sum += weight * vec4(texelFetch(image, q, 0).rgb, 1);
  }
  return sum.rgb / sum.w;
}

vec3 probe_color(int probe, float count) {
  vec3 hue = vec3(hash01(uvec3(probe, 1, 0)), hash01(uvec3(probe, 2, 0)), hash01(uvec3(probe, 3, 0)));
  return (0.15 + 0.85 * hue) * (count > 0 ? 0.4 + 0.6 * min(count / 8, 1) : 0.15);
}

void main() {
  ivec2 at = ivec2(gl_FragCoord.xy);
  Surface s = read_surface(at);
  int view = frame.switches.w;
  vec2 pixel = gl_FragCoord.xy;
  vec3 d = view_direction(pixel), o = view_origin(pixel);
  color = vec4(0, 0, 0, 1);
  bool lamps = frame.switches.x != 0 && (view == VIEW_LIT || view == VIEW_DIRECT);
  if (!s.hit) {
    if (lamps) color.rgb = seen_emitters(o, d, 1e30, show_sky != 0);
    return;
  }
  if (view == VIEW_NORMAL) color.rgb = 0.5 + 0.5 * s.normal;
  if (view == VIEW_DEPTH) color.rgb = vec3(s.depth / (1 + s.depth));
  if (view == VIEW_SHADOW) color.rgb = vec3(texelFetch(direct_image, at, 0).w);
  if (view == VIEW_SPHL) {
    ivec2 q = at / int(frame.extra.y);
    color.rgb = probe_color(int(texelFetch(glossy_image, q, 0).w), texelFetch(irradiance_image, q, 0).w);
  }
  vec3 emitted = texelFetch(emitted_image, at, 0).rgb;
  if (lamps) {
    color.rgb += emitted + seen_emitters(o, d, length(s.position - o), false);
    if (!s.unlit) color.rgb += texelFetch(direct_image, at, 0).rgb;
  }
  bool probes = frame.switches.y != 0 && (view == VIEW_LIT || view == VIEW_INDIRECT) && !s.unlit;
  if (!probes && view != VIEW_ALBEDO) return;

  Bsdf bsdf = bsdf_from(s.diffuse, s.f0, s.diffuse_roughness, s.specular_roughness, dot(s.normal, s.wo));
  if (view == VIEW_ALBEDO) color.rgb = s.unlit ? min(emitted, vec3(1)) : bsdf.albedo + s.diffuse * (1 - bsdf.albedo);
  if (!probes) return;
  float open = frame.extra.x > 0 ? texelFetch(occlusion_image, at, 0).x : 1;
  vec3 e = fetch_indirect(irradiance_image, at, s);
  color.rgb += open * s.diffuse * (1 - bsdf.albedo) / PI * e;
  if (bsdf.specular) color.rgb += open * bsdf.albedo * fetch_indirect(glossy_image, at, s);
}
