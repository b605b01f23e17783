#version 450 core
// Light from SPHLs, as libs/gi's lookups find it. Variants: LOOKUP_LIGHT, else irradiance; FULL_BSDF, else
// surfaces are Lambertian; TO_IMAGES gives irradiance and glossy radiance for apply.frag, at some pixels only;
// CHOSEN_VIEW the probe that counts most.
#include "gbuffer_read.glsl"
#ifdef FULL_BSDF
#include "bsdf.glsl"
#endif
#include "shadow.glsl"
#include "probe_lookup.glsl"

#ifdef TO_IMAGES
layout(location = 0) out vec4 irradiance_out;
layout(location = 1) out vec4 glossy_out;
#else
layout(location = 0) out vec4 color;
#endif

struct Found {
  vec3 irradiance, glossy;
  int chosen, count;
};

#ifdef LOOKUP_LIGHT
// The nearest visible one above the horizon as a lamp, I = L / (N . w); else the nearest as if it stood here.
Found look_up(Surface s, vec3 mirror, float roughness) {
  int base = candidates_at(s.position);
  int chosen = -1, nearest = 0;
  float best = 1e30, least = 1e30;
  for (int i = 0; i < MAX_NEAR; ++i) {
    int probe = probe_grid[base + i];
    if (probe < 0) break;
    vec3 place = probe_places[probe].xyz, d = place - s.position;
    float d2 = dot(d, d);
    bool nearer = d2 < least;
    least = nearer ? d2 : least;
    nearest = nearer ? probe : nearest;
    bool lights = d2 > 0 && d2 < best && dot(d, s.normal) > 0;
    lights = lights && sees_probe(place, probe, s.position, s.normal, s.geometric_normal, sqrt(d2));
    best = lights ? d2 : best;
    chosen = lights ? probe : chosen;
  }
  Found found;
  found.count = chosen >= 0 ? 1 : 0;
  found.chosen = chosen >= 0 ? chosen : nearest;
  vec3 w = normalize(probe_places[found.chosen].xyz - s.position);
  vec3 as_lamp = radiance_of(found.chosen, w, 0) / max(dot(s.normal, w), 0.05);
  found.irradiance = chosen >= 0 ? as_lamp : irradiance_of(found.chosen, s.normal);
  found.glossy = radiance_of(found.chosen, mirror, roughness);
  return found;
}
#else
// Inverse squared distance times a wrapped cosine over the nearest that x sees; over the nearest if it sees
// none.
Found look_up(Surface s, vec3 mirror, float roughness) {
  int base = candidates_at(s.position);
  vec3 e_seen = vec3(0), e_all = vec3(0), l_seen = vec3(0), l_all = vec3(0);
  float seen = 0, all_weights = 0, most = -1;
  Found found;
  found.count = found.chosen = 0;
  for (int i = 0; i < MAX_NEAR; ++i) {
    int probe = probe_grid[base + i];
    if (probe < 0 || found.count == MAX_BLEND) break;
    vec3 place = probe_places[probe].xyz, d = place - s.position;
    float d2 = max(dot(d, d), 1e-12), distance = sqrt(d2);
    float wrapped = 0.5 + 0.5 * dot(s.normal, d) / distance;
    float weight = (wrapped * wrapped + 0.05) / d2;
    bool sees = sees_probe(place, probe, s.position, s.normal, s.geometric_normal, distance);
    float near_weight = i < MAX_BLEND ? weight : 0, seen_weight = sees ? weight : 0;
    vec3 e = irradiance_of(probe, s.normal);
    e_seen += seen_weight * e;
    e_all += near_weight * e;
    seen += seen_weight;
    all_weights += near_weight;
#ifdef FULL_BSDF
    vec3 l = radiance_of(probe, mirror, roughness);
    l_seen += seen_weight * l;
    l_all += near_weight * l;
#endif
    found.count += sees ? 1 : 0;
    found.chosen = seen_weight > most ? probe : found.chosen;
    most = max(most, seen_weight);
  }
  found.irradiance = seen > 0 ? e_seen / seen : e_all / all_weights;
  found.glossy = seen > 0 ? l_seen / seen : l_all / all_weights;
  return found;
}
#endif

void main() {
  ivec2 at = ivec2(gl_FragCoord.xy);
#ifdef TO_IMAGES
  at *= int(frame.extra.y);
#endif
  Surface s = read_surface(at);
  float roughness = min(abs(s.specular_roughness), 1);
  Found found = look_up(s, reflect(-s.wo, s.normal), roughness);
#if defined(CHOSEN_VIEW)
  vec3 hue = vec3(hash01(uvec3(found.chosen, 1, 0)), hash01(uvec3(found.chosen, 2, 0)), hash01(uvec3(found.chosen, 3, 0)));
  color = vec4((0.15 + 0.85 * hue) * (found.count > 0 ? 0.4 + 0.6 * min(float(found.count) / 8, 1) : 0.15), 1);
#elif defined(TO_IMAGES)
  irradiance_out = vec4(found.irradiance, 1);
  glossy_out = vec4(found.glossy, 1);
#elif defined(FULL_BSDF)
  Bsdf bsdf = bsdf_from(s.diffuse, s.f0, s.diffuse_roughness, s.specular_roughness, dot(s.normal, s.wo));
  color = vec4(s.diffuse * (1 - bsdf.albedo) / PI * found.irradiance + bsdf.albedo * found.glossy, 0);
#else
  color = vec4(s.diffuse / PI * found.irradiance, 0);
#endif
}
