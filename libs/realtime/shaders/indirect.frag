#version 450 core
// Light from SPHLs, as libs/gi's lookups find it. Variants: LOOKUP_LIGHT, else irradiance; MLS, else weights by
// distance; FULL_BSDF, else
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
// A linear fit to what the probes in sight give, weighted by a bump of two spacings, and its value at x
// (gi::WeightMethod::mls). The fit is linear in the probes' light, so that sums over them do.
struct LinearFit {
  mat4 matrix;
  mat4x3 e, l;
};

void add(inout LinearFit fit, vec3 offset, float bump, vec3 e, vec3 l) {
  vec4 p = vec4(1, offset);
  fit.matrix += bump * outerProduct(p, p);
  fit.e += bump * outerProduct(e, p);
  fit.l += bump * outerProduct(l, p);
}

// Weights at x of the four sums: the value there is their product.
vec4 at_center(LinearFit fit) {
  const float ridge = 0.05;  // keeps the fit flat where the probes do not differ
  vec4 sums = fit.matrix[0];
  mat4 m = fit.matrix / sums.x;
  for (int c = 1; c < 4; ++c) m[c][c] += ridge;
  vec4 row = inverse(m)[0];
  return row / dot(row, sums);
}

// Inverse squared distance times a wrapped cosine over the nearest that x sees; over the nearest if it sees
// none.
Found look_up(Surface s, vec3 mirror, float roughness) {
  int base = candidates_at(s.position);
  vec3 e_seen = vec3(0), e_all = vec3(0), l_seen = vec3(0), l_all = vec3(0);
  float seen = 0, all_weights = 0, most = -1;
  Found found;
  found.count = found.chosen = 0;
#ifdef MLS
  LinearFit fit = LinearFit(mat4(0), mat4x3(0), mat4x3(0));
  float spacing = frame.tone.w, reach2 = 4 * spacing * spacing;
#endif
  for (int i = 0; i < MAX_NEAR; ++i) {
    int probe = probe_grid[base + i];
#ifdef MLS
    if (probe < 0) break;
#else
    if (probe < 0 || found.count == MAX_BLEND) break;
#endif
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
#else
    const vec3 l = vec3(0);
#endif
#ifdef MLS
    float falloff = max(0, 1 - d2 / reach2);
    add(fit, d / spacing, sees && d2 < reach2 ? falloff * falloff + 1e-6 : 0, e, l);
#endif
    found.count += sees ? 1 : 0;
    found.chosen = seen_weight > most ? probe : found.chosen;
    most = max(most, seen_weight);
  }
  found.irradiance = seen > 0 ? e_seen / seen : e_all / all_weights;
  found.glossy = seen > 0 ? l_seen / seen : l_all / all_weights;
#ifdef MLS
  if (fit.matrix[0].x > 0) {
    vec4 center = at_center(fit);
    found.irradiance = max(fit.e * center, 0);
    found.glossy = max(fit.l * center, 0);
  }
#endif
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
