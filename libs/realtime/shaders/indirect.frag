#version 450 core
// Light from SPHLs: irradiance (rgb) and radiance of the glossy lobe; libs/gi says what the lookups are.
#include "gbuffer_read.glsl"
#include "bsdf.glsl"
#include "shadow.glsl"
#include "probe_data.glsl"
#include "sh.glsl"
#include "probe_lookup.glsl"

layout(location = 0) out vec4 irradiance_out;  // w: probes that count
layout(location = 1) out vec4 glossy_out;      // w: the one that counts most

vec3 irradiance_of(int probe, float basis[25]) {
  int stored = (frame.degrees.x + 1) * (frame.degrees.x + 1);
  int base = probe * 3 * stored;
  vec3 sum = vec3(0);
  for (int k = 0; k < min(stored, 25); ++k) {
    int at = base + 3 * k;
    sum += basis[k] * vec3(probe_irradiance[at], probe_irradiance[at + 1], probe_irradiance[at + 2]);
  }
  return max(sum, vec3(0));
}

float glossy_band(int l, float roughness) {
  return textureLod(glossy_bands, vec2((float(l) + 0.5) / 11.0, (roughness * 128 + 0.5) / 129.0), 0).x;
}

// Bands beyond which the lobe leaves less than 1/500.
int glossy_degree(float roughness) {
  int degree = min(frame.degrees.y, frame.degrees.z);
  while (degree > 0 && glossy_band(degree, roughness) < 0.002) --degree;
  return degree;
}

vec3 radiance_of(int probe, vec3 d, float roughness, int degree) {
  int base = probe * 3 * (frame.degrees.y + 1) * (frame.degrees.y + 1);
  vec3 sum = vec3(0);
  FOR_EACH_HARMONIC(degree, d, {
    int at = base + 3 * k;
    float factor = roughness < 0 ? y : y * glossy_band(l, roughness);
    sum += factor * vec3(probe_radiance[at], probe_radiance[at + 1], probe_radiance[at + 2]);
  })
  return max(sum, vec3(0));
}

void main() {
  ivec2 at = ivec2(gl_FragCoord.xy) * int(frame.extra.y);
  Surface s = read_surface(at);
  irradiance_out = glossy_out = vec4(0);
  if (!s.hit || s.unlit) return;
  vec3 mirror = reflect(-s.wo, s.normal);
  bool glossy = max_component(s.f0) > 0;
  float roughness = min(abs(s.specular_roughness), 1);
  int degree = glossy ? glossy_degree(roughness) : 0;
  float basis[25];
  sh_basis4(s.normal, basis);

  if (frame.switches.z == LIGHT) {
    // The nearest visible one above the horizon as a lamp, I = L / (N . w); else the nearest around the point
    Near near = nearest_probes(s.position);
    int chosen = -1;
    for (int i = 0; i < MAX_NEAR && chosen < 0; ++i) {
      int probe = near.probe[i];
      if (probe < 0) break;
      vec3 d = probe_places[probe].xyz - s.position;
      if (dot(d, d) > 0 && dot(d, s.normal) > 0 && sees_probe(probe, s.position, s.normal, s.geometric_normal, dot(d, d)))
        chosen = probe;
    }
    bool lights = chosen >= 0;
    if (!lights) chosen = near.probe[0];
    vec3 w = normalize(probe_places[chosen].xyz - s.position);
    vec3 e = lights ? radiance_of(chosen, w, -1, min(frame.degrees.y, frame.degrees.z)) / max(dot(s.normal, w), 0.05)
                    : irradiance_of(chosen, basis);
    irradiance_out = vec4(e, lights ? 1 : 0);
    glossy_out = vec4(glossy ? radiance_of(chosen, mirror, roughness, degree) : vec3(0), float(chosen));
    return;
  }

  Blend b = blend_probes(s.position, s.normal, s.geometric_normal);
  vec3 e = vec3(0), l = vec3(0);
  float most = -1;
  int chosen = 0;
  for (int i = 0; i < b.count; ++i) {
    e += b.weight[i] * irradiance_of(b.probe[i], basis);
    if (b.weight[i] > most) most = b.weight[i], chosen = b.probe[i];
    if (glossy) l += b.weight[i] * radiance_of(b.probe[i], mirror, roughness, degree);
  }
  irradiance_out = vec4(e, b.visible ? float(b.count) : 0);
  glossy_out = vec4(l, float(chosen));
}
