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

// Seen from outside. What goes through a body's surface has half the way through it to go.
GlassShares glass_shares(float cosine, vec3 tint) {
  vec2 r = material.glass.w * fresnel_reflectance(cosine, material.glass.z);
  GlassShares shares;
  if (material.glass.y == 0) {
    shares.reflected = vec3(0.5 * (r.x + r.y));
    shares.transmitted = (1 - shares.reflected) * tint * material.inside.rgb;
    return shares;
  }
  vec3 through_s = (1 - r.x) * (1 - r.x) * tint / max(1 - r.x * r.x * tint * tint, vec3(1e-12));
  vec3 through_p = (1 - r.y) * (1 - r.y) * tint / max(1 - r.y * r.y * tint * tint, vec3(1e-12));
  shares.transmitted = 0.5 * (through_s + through_p);
  shares.reflected = 0.5 * (r.x + r.y + tint * (r.x * through_s + r.y * through_p));
  return shares;
}
