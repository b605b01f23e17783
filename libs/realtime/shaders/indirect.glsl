#version 450 core
// Light from SPHLs, as the lookups of libs/probes find it. Variants: LOOKUP_LIGHT, else irradiance; MLS or TRILINEAR, else
// weights by distance; FITTED with MLS, irradiance from fitted points where there are any; those of indirect_out.glsl;
// CHOSEN_VIEW the probe that counts most.
#include "gbuffer_read.glsl"
#include "indirect_out.glsl"
#include "shadow.glsl"
#include "probe_lookup.glsl"
#ifdef FITTED
#include "fitted_lookup.glsl"
#endif
#if defined(MLS) || defined(TRILINEAR)
#define FIT
#endif

struct Found {
  vec3 irradiance, glossy;
  int chosen, count;
};

// Software renderers run both sides of every branch but leave loops early: what few probes need stands in loops
// over their bits.
int next_bit(inout uint bits) {
  int i = findLSB(bits);
  bits &= bits - 1;
  return i;
}

#ifdef LOOKUP_LIGHT
// The nearest visible one above the horizon as a lamp whose cosine cancels: rho L leaves; else the nearest as if it
// stood here.
Found look_up(Surface s, vec3 mirror, float roughness, bool wanted) {
  int base = candidates_at(s.position);
  uint above = 0;
  vec4 nearest = vec4(0), chosen = vec4(0);
  float least = 1e30, best = 1e30;
  for (int i = 0; i < frame.grid_size.w; ++i) {
    vec4 near = candidate(base + i);
    if (near.w < 0) break;
    vec3 d = near.xyz - s.position;
    float d2 = dot(d, d);
    nearest = d2 < least ? near : nearest;
    least = min(d2, least);
    above |= dot(d, s.normal) > 0 ? 1u << i : 0u;
  }
  while (above != 0) {
    vec4 near = candidate(base + next_bit(above));
    vec3 d = near.xyz - s.position;
    float d2 = dot(d, d);
    bool lights = d2 < best && sees_probe(near.xyz, int(near.w), s.position, s.normal, s.geometric_normal, sqrt(d2));
    best = lights ? d2 : best;
    chosen = lights ? near : chosen;
  }
  Found found;
  found.count = best < 1e30 ? 1 : 0;
  found.chosen = int(found.count > 0 ? chosen.w : nearest.w);
  vec3 w = normalize(chosen.xyz - s.position);
  vec3 as_lamp = PI * radiance_of(found.chosen, radiance_at(w, 0));
  found.irradiance = found.count > 0 ? as_lamp : irradiance_of(found.chosen, irradiance_at(s.normal));
  found.glossy = radiance_of(found.chosen, radiance_at(mirror, roughness));
  return found;
}
#else
float bump_of(float d2) {
  float spacing = frame.tone.w, reach = MLS_REACH * spacing, falloff = max(0.0, 1 - d2 / (reach * reach));
  return falloff * falloff + MLS_LEAST_BUMP;
}

float tent_of(vec3 d) {
  vec3 t = max(1 - abs(d) / frame.tone.w, 0.0);
  return min(t.x, min(t.y, t.z)) > LEAST_TENT ? t.x * t.y * t.z : 0;
}

// Those of the candidates, of squared distances d2_of, that are the MAX_NEAR nearest; `within` of them are no farther
// than far2.
uint nearest_of(float d2_of[MAX_LISTED], int listed, int within, float far2) {
  // Look for a distance with so many inside; there is none where several are equally far
  float low = 0, high = far2, middle = far2 * pow(float(MAX_NEAR) / float(max(within, 1)), 2.0 / 3.0);
  uint inside = 0;
  int found = within;
  for (int step = 0; step < 12 && found != MAX_NEAR && within > MAX_NEAR; ++step) {
    inside = 0;
    for (int i = 0; i < listed; ++i) inside |= d2_of[i] <= middle ? 1u << i : 0u;
    found = bitCount(inside);
    low = found < MAX_NEAR ? middle : low;
    high = found < MAX_NEAR ? high : middle;
    middle = 0.5 * (low + high);
  }
  return inside;
}

// MLS: a linear fit to what the probes in sight within two spacings give, weighted by a bump, and its value at x
// (probes::WeightMethod::mls). TRILINEAR: a tent of one spacing along each axis. Else, or where x sees none of those: inverse
// squared distance times a wrapped cosine over the nearest that x sees; if it sees none, over the nearest, less those
// below the tangent plane. Without `wanted` the result means nothing and costs little.
Found look_up(Surface s, vec3 mirror, float roughness, bool wanted) {
  int base = candidates_at(s.position);
  float spacing = frame.tone.w;
#ifdef MLS
  float reach2 = MLS_REACH * MLS_REACH * spacing * spacing;
  mat4 matrix = mat4(0);
#endif
  uint listed = 0, pending = 0, beyond = 0, seen = 0;
  int within = 0;
  float far2 = 0, d2_of[MAX_LISTED];
  for (int i = 0; i < frame.grid_size.w; ++i) {
    vec4 near = candidate(base + i);
    if (near.w < 0 || !wanted) break;
    vec3 d = near.xyz - s.position;
    float d2 = dot(d, d);
    uint bit = 1u << i;
    d2_of[i] = d2;
    listed |= bit;
    bool above = maybe_above(d, d2, s);
#ifdef FIT
#ifdef MLS
    bool reached = d2 < reach2;
#else
    bool reached = tent_of(d) > 0;
#endif
    beyond |= above && !reached ? bit : 0u;
#else
    const bool reached = true;
#endif
    pending |= above && reached ? bit : 0u;
    within += reached ? 1 : 0;
    far2 = reached ? max(far2, d2) : far2;
  }
  if (within > MAX_NEAR) pending &= nearest_of(d2_of, bitCount(listed), within, far2);
#ifdef FIT
  bool fits = pending != 0;
  if (!fits) pending = beyond;
#else
  const bool fits = false;
#endif
  while (pending != 0) {
    int i = next_bit(pending);
    vec4 near = candidate(base + i);
    vec3 d = near.xyz - s.position;
    float d2 = dot(d, d);
    bool sees = sees_probe(near.xyz, int(near.w), s.position, s.normal, s.geometric_normal, sqrt(d2));
    seen |= sees ? 1u << i : 0u;
#ifdef MLS
    float bump = sees && fits ? bump_of(d2) : 0;
    vec4 p = vec4(1, d / spacing);
    matrix += bump * outerProduct(p, p);
#endif
#ifdef FIT
    // Beyond the fit's reach, once it has found nothing
    bool further = pending == 0 && seen == 0 && fits;
    fits = fits && !further;
    pending = further ? beyond : pending;
#endif
    if (!fits && bitCount(seen) == MAX_BLEND) pending = 0;
  }
#ifdef MLS
  mat4 m = matrix / max(matrix[0].x, 1e-30);
  for (int c = 0; c < 4; ++c) m[c][c] += c == 0 ? (fits ? 0 : 1) : MLS_RIDGE;
  vec4 row = inverse(m)[0];
#endif
  uint used = seen != 0 ? seen : listed & uint((1 << MAX_BLEND) - 1);
  vec2 e_place = irradiance_at(s.normal);
#ifdef FULL_BSDF
  RadiancePlace l_place = radiance_at(mirror, roughness);
#endif
  Found found;
  found.count = bitCount(seen);
  found.irradiance = found.glossy = vec3(0);
  float sum = 0, glossy_sum = 0, most = -1;
  while (used != 0) {
    vec4 near = candidate(base + next_bit(used));
    int probe = int(near.w);
    vec3 d = near.xyz - s.position;
    float d2 = max(dot(d, d), 1e-12);
    float cosine = dot(s.normal, d) * inversesqrt(d2);
    float wrapped = 0.5 + 0.5 * cosine;
    float weight = (wrapped * wrapped + WRAPPED_FLOOR) / d2;
    found.chosen = weight > most ? probe : found.chosen;
    most = max(most, weight);
#ifdef MLS
    weight = fits ? bump_of(d2) * dot(row, vec4(1, d / spacing)) : weight;
#elif defined(TRILINEAR)
    weight = fits ? tent_of(d) : weight;
#endif
    sum += weight;
    glossy_sum += max(weight, 0.0);
    weight *= seen != 0 ? 1 : clamp(HIDDEN_SLOPE * cosine, 0.0, 1.0);
    found.irradiance += weight * irradiance_of(probe, e_place, s.moves);
#ifdef FULL_BSDF
    found.glossy += max(weight, 0.0) * radiance_of(probe, l_place);  // a fit goes astray in narrow lobes
#endif
  }
  found.irradiance = max(found.irradiance / sum, 0.0);
  found.glossy /= max(glossy_sum, 1e-30);
  return found;
}
#endif

void main() {
  ivec2 at = lit_pixel();
  if (at.x < 0) return;
  Surface s = read_surface(at);
  float roughness = abs(s.specular_roughness);
#ifdef FITTED
  vec3 fitted;
  bool is_fitted = fitted_irradiance(s, fitted);
#endif
#if defined(FITTED) && !defined(FULL_BSDF)
  bool wanted = !is_fitted;
#else
  const bool wanted = true;
#endif
  Found found = look_up(s, reflect(-s.wo, s.normal), roughness, wanted);
  found.glossy *= above_ground(s, roughness);
#ifdef FITTED
  found.irradiance = is_fitted ? fitted : found.irradiance;
#endif
#ifdef CHOSEN_VIEW
  vec3 hue = vec3(hash01(uvec3(found.chosen, 1, 0)), hash01(uvec3(found.chosen, 2, 0)), hash01(uvec3(found.chosen, 3, 0)));
  color = vec4((0.15 + 0.85 * hue) * (found.count > 0 ? 0.4 + 0.6 * min(float(found.count) / 8, 1.0) : 0.15), 1);
#else
  put_light(at, s, found.irradiance, found.glossy);
#endif
}
