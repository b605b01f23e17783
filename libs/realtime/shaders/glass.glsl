// Where light goes that meets glass, as libs/shading/src/glass computes it. Needs material.glsl and bsdf.glsl.

// Reflectance for either polarisation.
vec2 fresnel_reflectance(float cosine, float eta) {
  float before = clamp(cosine, 1e-6, 1.0), sine2 = (1 - before * before) / (eta * eta);
  float beyond = sqrt(max(1 - sine2, 0.0));
  vec2 r = vec2((before - eta * beyond) / (before + eta * beyond), (eta * before - beyond) / (eta * before + beyond));
  return r * r;
}

struct GlassShares {
  vec3 reflected, transmitted;
};

// What a rough lobe keeps of light, going on straight in place of it.
float kept_by_lobe(float cosine, float roughness) {
  if (roughness * roughness <= MIN_ALPHA) return 1;
  vec4 table = albedo_entry(false, cosine, min(roughness, 1.0));
  return table.x + table.y;
}

// Of a body: the part of what it absorbs that belongs to one crossing of its surface, `distance` behind the middle of its box.
// All crossings together make the way through it, in whatever order they are drawn: what the way in has too much before the
// middle the way out lacks beyond it. Crossings that something hides count where that stands: on their way in and out they
// cancel. `most`: powers of e that the picture holds.
vec3 absorbed_at(float distance, bool going_in, bool hidden, float most) {
  float reach = most / max(max_component(material.inside.rgb), 1e-20);
  if (hidden) distance = clamp(distance, -reach, reach);
  return exp(min((going_in ? distance : -distance) * material.inside.rgb, most));
}

// Seen from outside.
GlassShares glass_shares(float cosine, vec3 tint) {
  vec2 r = material.glass.w * fresnel_reflectance(cosine, material.glass.z);
  GlassShares shares;
  if (material.glass.y == 0) {
    shares.reflected = vec3(0.5 * (r.x + r.y));
    shares.transmitted = (1 - shares.reflected) * tint;
    return shares;
  }
  vec3 through_s = (1 - r.x) * (1 - r.x) * tint / max(1 - r.x * r.x * tint * tint, vec3(1e-12));
  vec3 through_p = (1 - r.y) * (1 - r.y) * tint / max(1 - r.y * r.y * tint * tint, vec3(1e-12));
  shares.transmitted = 0.5 * (through_s + through_p);
  shares.reflected = 0.5 * (r.x + r.y + tint * (r.x * through_s + r.y * through_p));
  return shares;
}
