#version 450 core
// What surfaces reflect of one emitter's light. Variants: the kind of emitter (POINT, SPHL, LOBE, SUN, DISC, SPHERE,
// MESH, ENVIRONMENT); FULL_BSDF, else surfaces are Lambertian; SHADOW_VIEW gives the light's share that arrives; MIRRORED
// what the specular lobe reflects of an environment alone.
#include "gbuffer_read.glsl"
#ifdef FULL_BSDF
#include "bsdf.glsl"
#endif
#include "shadow.glsl"
#include "lights.glsl"
#if defined(SPHL) || defined(ENVIRONMENT)
#include "probe_data.glsl"
#endif
#if defined(SPHL) || defined(LOBE)
#include "harmonics.glsl"
#endif
#ifdef ENVIRONMENT
#include "sh.glsl"
#ifdef FULL_BSDF
#include "sky_share.glsl"
#endif
#endif
#ifdef DISC
#include "disc.glsl"
#endif
#if defined(SUN) || defined(DISC)
#include "contact.glsl"
// What a map tells for sure stands so many texels away.
const float CONTACT_TEXELS = 4;
float sun_contact(Surface s, vec3 wi, SunMap map) {
  return contact_visibility(s, wi, CONTACT_TEXELS * 2 / (float(emitter.count.z - 2) * map.right.w));
}
#endif

layout(location = 0) out vec4 color;

#ifdef FULL_BSDF
Bsdf bsdf;
mat3 basis;
vec3 wo;
void prepare(Surface s) {
  basis = basis_around(s.normal);
  wo = s.wo * basis;
  bsdf = bsdf_from(s.diffuse, s.f0, s.diffuse_roughness, s.specular_roughness, wo.z);
}
// Radiance toward the viewer for an irradiance of 1 that arrives from wi.
vec3 reflected(Surface s, vec3 wi) {
  vec3 local = wi * basis;
  return local.z > 0 ? eval_bsdf(bsdf, wo, local) / local.z : vec3(0);
}
#else
void prepare(Surface s) {}
vec3 reflected(Surface s, vec3 wi) { return s.diffuse / PI; }
#endif

void store(vec3 sum, float possible, float lit) {
#ifdef SHADOW_VIEW
  color = vec4(lit, possible, 0, 0);
#else
  color = vec4(sum, 0);
#endif
}

#if defined(POINT) || defined(SPHL) || defined(LOBE)
void main() {
  Surface s = read_surface(ivec2(gl_FragCoord.xy));
  prepare(s);
  vec3 d = emitter.place.xyz - s.position;
  float d2 = max(dot(d, d), 1e-12);
  vec3 wi = d * inversesqrt(d2);
  float cosine = dot(s.geometric_normal, wi) > 0 ? max(dot(s.normal, wi), 0.0) : 0;
#ifdef LOBE
  // No point is lit more than from the SPHL's radius
  vec3 e = emitter.light.rgb * (falloff(wi, d2) / max(d2, emitter.place.w * emitter.place.w) * cosine);
  vec3 way = normalize(vec3(dot(emitter.samples[0].place.xyz, wi), dot(emitter.samples[1].place.xyz, wi),
                            dot(emitter.samples[2].place.xyz, wi)));
  vec3 intensity = vec3(0);
  FOR_EACH_HARMONIC(MAX_DEGREE, -way, intensity += y * emitter.corners[k].rgb)
  e *= max(intensity, vec3(0));
#else
  vec3 e = emitter.light.rgb * (falloff(wi, d2) / d2 * cosine);
#ifdef POINT
  e *= profile_share(-wi);
#endif
#endif
#ifdef SPHL
  vec3 leaving = vec3(0);
  FOR_EACH_HARMONIC(MAX_DEGREE, -wi, leaving += y * emitter.corners[k].rgb)
  e *= max(leaving, vec3(0)) * PI * emitter.place.w * emitter.place.w;
  vec3 passed = vec3(probe_visibility(emitter.items.w, emitter.place.xyz, s.position, s.geometric_normal));
#else
  float v = cube_visibility(light_maps, frame.maps.x, frame.map_tiles.x, frame.map_near.x, emitter.items.y,
                            emitter.place.xyz, s.position, s.geometric_normal);
  vec3 passed = v * lamp_filter(emitter.items.y, emitter.place.xyz, s.position);
#endif
  store(passed * e * reflected(s, wi), luminance(e), luminance(e * passed));
}
#endif

#ifdef SUN
void main() {
  Surface s = read_surface(ivec2(gl_FragCoord.xy));
  prepare(s);
  vec3 wi = emitter.place.xyz;
  float cosine = dot(s.geometric_normal, wi) > 0 ? max(dot(s.normal, wi), 0.0) : 0;
  SunMap map = sun_maps[cascade_of(emitter.items.y, s.position)];
  vec3 passed = parallel_visibility(map, s.position, s.geometric_normal) * parallel_filter(map, s.position);
  if (cosine * max_component(passed) > 0) passed *= sun_contact(s, wi, map);
  vec3 e = emitter.light.rgb * cosine;
  store(passed * e * reflected(s, wi), luminance(e), luminance(e * passed));
}
#endif

#ifdef DISC
// Irradiance of each part of the disc above the horizon, times the share of it that is seen. What is glossy
// reflects the middles of the parts.
void main() {
  Surface s = read_surface(ivec2(gl_FragCoord.xy));
  prepare(s);
  float sine = emitter.more.x, total = 0, lit = 0;
  vec3 sum = vec3(0);
  for (int i = 0; i < emitter.items.z; ++i) {
    vec3 wi = emitter.samples[i].place.xyz;
    float cosine = dot(s.normal, wi);
    float e = emitter.samples[i].place.w * disc_irradiance(cosine, sine);
    total += e;
    if (e <= 0 || dot(s.geometric_normal, wi) <= -sine) continue;
    e *= disc_visibility(i, sine, s.position, s.geometric_normal);
    SunMap map = sun_maps[cascade_of(int(emitter.samples[i].normal.w), s.position)];
    if (e > 0) e *= sun_contact(s, wi, map);
    vec3 passed = parallel_filter(map, s.position);
    lit += e * luminance(passed);
    // Half sunk, its middle is that of what is left above the horizon
    sum += e * passed * reflected(s, normalize(wi + max(0.5 * (sine - cosine), 0.0) * s.normal));
  }
  store(emitter.light.rgb * sum, luminance(emitter.light.rgb) * total, luminance(emitter.light.rgb) * lit);
}
#endif

#if defined(SPHERE) || defined(MESH)
float ball_form(Surface s) {
  vec3 d = emitter.place.xyz - s.position;
  float d2 = dot(d, d), r2 = emitter.place.w * emitter.place.w;
  return d2 > r2 ? sphere_irradiance(dot(s.normal, d) * inversesqrt(d2), r2 / d2) : PI;
}

// Irradiance for radiance 1 without shadows; negative: there is no closed form.
float closed_form(Surface s) {
#ifdef SPHERE
  return ball_form(s);
#else
  if (emitter.count.x == 0) return emitter.place.w > 0 ? ball_form(s) : -1;
  float sum = 0;
  for (int t = 0; t < emitter.count.x; ++t) {
    vec3 p = emitter.corners[3 * t].xyz - s.position, q = emitter.corners[3 * t + 1].xyz - s.position,
         r = emitter.corners[3 * t + 2].xyz - s.position;
    // Seen from the front, corners turn counter-clockwise
    bool front = dot(cross(q - p, r - p), p) < 0;
    float e = triangle_irradiance(s.normal, p, front ? r : q, front ? q : r);
    sum += front || emitter.more.y != 0 ? e : 0;
  }
  return sum;
#endif
}

// The closed form divided among points of the light by what each would give, so that shadows alone are
// approximate.
void main() {
  Surface s = read_surface(ivec2(gl_FragCoord.xy));
  prepare(s);
  float closed = closed_form(s);
  float total = 0, lit = 0;
  vec3 sum = vec3(0);
  for (int i = 0; i < emitter.items.z; ++i) {
    AreaSample q = emitter.samples[i];
    vec3 d = q.place.xyz - s.position;
    float d2 = max(dot(d, d), 1e-12);
    vec3 wi = d * inversesqrt(d2);
    float toward = -dot(q.normal.xyz, wi);
    float emits = q.normal.xyz == vec3(0) ? 1 : emitter.more.y != 0 ? abs(toward) : max(toward, 0.0);
    float area = q.place.w * emitter.more.z;
    // Without a closed form nearness must not let one point blow up
    float weight = area * emits * max(dot(s.normal, wi), 0.0) / max(d2, area / PI);
    total += weight;
    if (dot(s.geometric_normal, wi) <= 0) weight = 0;
    float v = cube_visibility(area_maps, frame.maps.y, frame.map_tiles.y, frame.map_near.y, int(q.normal.w), q.place.xyz,
                              s.position, s.geometric_normal);
    vec3 passed = v * area_filter(int(q.normal.w), q.place.xyz, s.position);
    lit += weight * luminance(passed);
    sum += weight * passed * reflected(s, wi);
  }
  float scale = closed < 0 ? 1 : total > 0 ? closed / total : 0;
  store(emitter.light.rgb * sum * scale, luminance(emitter.light.rgb) * total * scale,
        luminance(emitter.light.rgb) * lit * scale);
}
#endif

#ifdef ENVIRONMENT
#ifdef FULL_BSDF
// Octahedral tiles of what lobes of some roughnesses see (environment_tiles.h).
layout(binding = UNIT_ENVIRONMENT_TILES) uniform sampler2DArray environment_tiles;
uniform ivec4 environment_layout;  // texels of a tile without its border, log2 of tiles in a row
uniform float environment_roughness[ENVIRONMENT_LEVELS];

vec3 environment_tile(int level, vec2 texel) {
  ivec3 place = tile_place(level, environment_layout.y);
  vec2 at = vec2(place.xy * (environment_layout.x + 2)) + texel;
  return textureLod(environment_tiles, vec3(at / vec2(textureSize(environment_tiles, 0).xy), place.z), 0).rgb;
}
vec3 through_lobe(vec3 d, float roughness) {
  int level = 0;
  for (int i = 1; i + 1 < ENVIRONMENT_LEVELS; ++i) level = roughness >= environment_roughness[i] ? i : level;
  float low = environment_roughness[level], high = environment_roughness[level + 1];
  vec2 texel = 1 + (0.5 + 0.5 * oct_encode(to_environment(d))) * float(environment_layout.x);
  return mix(environment_tile(level, texel), environment_tile(level + 1, texel),
             (roughness - low) / (high - low));
}
vec3 diffusely(Surface s, vec3 wi) {
  vec3 local = wi * basis;
  return local.z > 0 ? eval_diffuse(bsdf, wo, local) / local.z : vec3(0);
}
#else
vec3 diffusely(Surface s, vec3 wi) { return reflected(s, wi); }
#endif

// Irradiance by spherical harmonics, divided among directions with shadow maps. What the specular lobe mirrors comes from
// tiles, dimmed by the share of the lobe that SPHLs see to be open; where none is in sight, of wide lobes, and behind rough
// sheets, where the picture tells of most, by the share of the directions around the mirrored one that are free.
void main() {
  Surface s = read_surface(ivec2(gl_FragCoord.xy));
  prepare(s);
  float harmonics[25];
  sh_basis4(s.normal, harmonics);
  vec3 whole = vec3(0);
  for (int k = 0; k < 25; ++k) whole += environment_sh[k].rgb * harmonics[k];
  whole = max(whole, vec3(0)) * emitter.light.rgb;
  vec3 total = vec3(0), sum = vec3(0), lit = vec3(0);
#ifdef FULL_BSDF
  // Rough lobes lean toward the normal (Lagarde & de Rousiers, Moving Frostbite to PBR, SIGGRAPH 2014 course)
  float keep = (1 - bsdf.alpha) * (sqrt(1 - bsdf.alpha) + bsdf.alpha);
  vec3 mirror = normalize(mix(s.normal, reflect(-s.wo, s.normal), keep));
  float narrow = min(1 / max(bsdf.alpha * bsdf.alpha, 1e-3), 8.0), around = 0, free = 0;
#endif
  for (int i = 0; i < emitter.items.z; ++i) {
    AreaSample q = emitter.samples[i];
    vec3 wi = q.place.xyz;
    vec3 weight = q.light.rgb * max(dot(s.normal, wi), 0.0);
    total += weight;
    bool above = dot(s.geometric_normal, wi) > 0;
    if (!above) weight = vec3(0);
    float v = parallel_visibility(sun_maps[int(q.normal.w)], s.position, s.geometric_normal);
    vec3 passed = v * parallel_filter(sun_maps[int(q.normal.w)], s.position);
    lit += weight * passed;
    sum += weight * passed * diffusely(s, wi);
#ifdef FULL_BSDF
    float near = above ? luminance(q.light.rgb) * exp(narrow * (dot(mirror, wi) - 1)) : 0;
    around += near;
    free += near * luminance(passed);
#endif
  }
  vec3 scale = whole / max(total, vec3(1e-20));
#ifdef MIRRORED
  vec3 reflects = vec3(0);
#else
  vec3 reflects = sum * scale;
#endif
#ifdef FULL_BSDF
  // Of directions a wide lobe holds several, and SPHLs' opinions would leave patches in it
  float open = around > 0 ? free / around : 1, by_probes = s.from_behind ? 0 : 1 - smoothstep(0.5, 0.75, bsdf.roughness);
  float told = by_probes > 0 ? sky_share(s, bsdf.alpha) : -1;
  open = told < 0 ? open : mix(open, told, by_probes);
  reflects += bsdf.albedo * above_ground(s, bsdf.roughness) * open * emitter.light.rgb * through_lobe(mirror, bsdf.roughness);
#endif
  store(reflects, luminance(whole), luminance(lit * scale));
}
#endif
