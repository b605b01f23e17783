#version 450 core
// What glass leaves of the picture behind it. Variant SPREAD: that times the picture, spread by the lobe of the rough sheet
// before it, and as alpha how much of the lobe the picture shows.
#include "gbuffer_read.glsl"

layout(binding = UNIT_LEFT_BY_GLASS) uniform sampler2D left_by_glass;
layout(location = 0) out vec4 color;

#ifdef SPREAD
#include "bsdf.glsl"
layout(binding = UNIT_BEHIND_GLASS) uniform sampler2D behind_glass;
layout(binding = UNIT_BEHIND_GBUFFER1) uniform usampler2D behind_gbuffer1;
// No constant: compilers would unroll the loop, for seconds.
uniform int taps, steps;
// Of a way through the picture: of the sheet's depth, and times the step before.
const float FIRST_STEP = 0.004, STEP_GROWTH = 1.7;

bool shown(vec2 pixel) { return all(greaterThan(pixel, vec2(0))) && all(lessThan(pixel, picture_size())); }
float behind_depth(vec2 pixel) { return uintBitsToFloat(texelFetch(behind_gbuffer1, ivec2(pixel), 0).y); }

// What the picture shows in direction wi from the sheet, which sees `solid_angle` there: what the way first goes behind, not
// by much; else what is farthest. Times what the glass before it leaves, at most what the sheet does. w: 0 where the picture
// does not show it.
vec4 seen_behind(Surface s, vec3 wi, float solid_angle, vec3 by_sheet) {
  float ahead = dot(wi, frame.camera_forward.xyz), way = FIRST_STEP * s.depth, before = 0;
  vec2 pixel = pixel_of(vec4(wi, 0));
  float depth = shown(pixel) ? behind_depth(pixel) : 0;
  bool known = ahead > 0 && shown(pixel) && (depth == 0 || depth > s.depth);
  for (int i = 0; i < steps; ++i) {
    vec2 at = pixel_of(vec4(s.position + way * wi, 1));
    if (!shown(at)) break;
    float there = behind_depth(at), passes = s.depth + way * ahead;
    if (there > s.depth && passes >= there && passes - there <= 1.5 * (way - before) * max(ahead, 0.3)) {
      // As far as the way to that depth
      pixel = pixel_of(vec4(s.position + (there - s.depth) / max(ahead, 0.05) * wi, 1));
      depth = there, known = true;
      break;
    }
    before = way, way *= STEP_GROWTH;
  }
  if (!known) return vec4(0);
  // Pixels that the solid angle covers
  vec2 per_unit = 0.5 * picture_size() / vec2(length(frame.camera_right.xyz), length(frame.camera_up.xyz));
  float nearness = depth == 0 ? 1 : max(depth - s.depth, 0.0) / (orthographic() ? 1 : depth);
  float area = solid_angle * per_unit.x * per_unit.y * nearness * nearness;
  float level = 0.5 * log2(max(area, 1.0));
  vec3 left = min(texelFetch(left_by_glass, ivec2(pixel), 0).rgb, by_sheet);
  return vec4(left * textureLod(behind_glass, pixel / picture_size(), level).rgb, 1);
}

// GGX microfacets of the mirrored eye, by the golden angle; each counts by what masking leaves of it. Other ones for each of
// 4 × 4 samples, so that their edges do not show. w: the share of the lobe that the picture shows.
vec4 spread(Surface s) {
  float alpha = max(s.specular_roughness * s.specular_roughness, MIN_ALPHA), a2 = alpha * alpha;
  mat3 basis = basis_around(s.normal);
  vec3 wo = s.wo * basis;
  vec4 table = albedo_entry(false, wo.z, min(s.specular_roughness, 1.0)), sum = vec4(0);
  float whole = 0;
  vec3 by_sheet = (table.x + table.y) * mix(s.f0, vec3(1), schlick_weight(wo.z));
  for (int i = sample_number(ivec2(gl_FragCoord.xy)); i < 16 * taps; i += 16) {
    float u = (float(i) + 0.5) / float(16 * taps), angle = GOLDEN_ANGLE * float(i);
    float tan2 = a2 * u / (1 - u), c = inversesqrt(1 + tan2);
    vec3 h = vec3(sqrt(tan2) * c * vec2(cos(angle), sin(angle)), c);
    float facing = dot(wo, h);
    vec3 wi = 2 * facing * h - wo;
    if (facing <= 0 || wi.z <= 0) continue;
    float g = 2 * wi.z * wo.z / (wi.z * ggx_root(a2, wo.z) + wo.z * ggx_root(a2, wi.z));
    float t = h.z * h.z * (a2 - 1) + 1, density = a2 * h.z / (PI * t * t) / (4 * facing);
    float weight = g * facing / (wo.z * h.z);
    whole += weight;
    sum += weight * seen_behind(s, basis * wi, 1 / (float(4 * taps) * density), by_sheet);
  }
  return whole > 0 ? sum / whole : vec4(0);
}
#endif

void main() {
  ivec2 at = ivec2(gl_FragCoord.xy);
#ifdef SPREAD
  color = spread(read_surface(at));
#else
  color = vec4(texelFetch(left_by_glass, at, 0).rgb, 1);
#endif
}
