// Reflection as libs/shading/bsdf computes it; the formulas' sources stand there. Local frame, z the normal;
// values are f cos(theta_i).

// A and B of the lobes' directional albedo E = f0 A + f90 B by cosine (x) and roughness (y); z, w their means.
// Layer 0: GGX, 1: Blinn-Phong.
layout(binding = UNIT_ALBEDO_TABLE) uniform sampler2DArray albedo_table;

struct Bsdf {
  vec3 diffuse, f0;
  float diffuse_roughness, roughness, alpha, f90;
  bool phong, specular;
  vec3 albedo;  // of the specular lobe toward the viewer
  vec3 left;    // what the lobe leaves for the diffuse layer, but for its share toward the light
};

vec4 albedo_entry(bool phong, float mu, float roughness) {
  vec2 place = (vec2(mu, roughness) * float(ALBEDO_TABLE_SIZE - 1) + 0.5) / float(ALBEDO_TABLE_SIZE);
  return texture(albedo_table, vec3(place, phong ? 1 : 0));
}

float schlick_weight(float c) {
  float m = 1 - c, m2 = m * m;
  return m2 * m2 * m;
}

float oren_nayar(float sigma, vec3 wo, vec3 wi) {
  float s = wo.x * wi.x + wo.y * wi.y;
  float t = s > 0 ? max(wo.z, wi.z) : 1;
  return wi.z * (1 + sigma * s / t) / (PI + (PI / 2 - 2.0 / 3.0) * sigma);
}

float disney_diffuse(float roughness, vec3 wo, vec3 wi) {
  float k = 0.5 + roughness;
  float grazing = k + (k * k - k) / 21 + 11 * roughness * roughness / 504;
  float normal = 1 + (roughness - 0.5) / 21 + roughness / 84;
  float peak = max(1.0, max(grazing, normal)) + 0.02 * max(0.0, 1 - 12 * abs(roughness - 0.5));
  float rise = roughness * (1 + dot(wo, wi)) - 0.5;
  return wi.z * (1 + rise * schlick_weight(wo.z)) * (1 + rise * schlick_weight(wi.z)) / (PI * peak);
}

float ggx_root(float a2, float c) { return sqrt(a2 + (1 - a2) * c * c); }

float ggx(float alpha, vec3 wo, vec3 wi, vec3 h) {
  float a2 = alpha * alpha;
  float t = dot(h.xy, h.xy) + a2 * h.z * h.z;
  return a2 / (PI * t * t) * 0.5 * wi.z / (wi.z * ggx_root(a2, wo.z) + wo.z * ggx_root(a2, wi.z));
}

float blinn_phong_lambda(float alpha, float c) {
  float a2 = alpha * alpha, a = c / (alpha * sqrt(max(1 - c * c, 1e-12)));
  float beckmann = a >= 1.6 ? 0 : (1 - 1.259 * a + 0.396 * a * a) / (a * (3.535 + 2.181 * a));
  return mix(beckmann, 0.5 * (ggx_root(a2, c) / c - 1), a2 * (0.54 + 0.46 * a2 * a2));
}

float blinn_phong(float alpha, vec3 wo, vec3 wi, vec3 h) {
  float n = 2 / (alpha * alpha) - 2;
  float sin2 = min(dot(h.xy, h.xy), 0.9999999);
  // log(1 - x) loses small x: its series there
  float log_cos2 = sin2 < 1e-3 ? -sin2 * (1 + sin2 * (0.5 + sin2 / 3)) : log(1 - sin2);
  float d = (n + 2) / (2 * PI) * exp(0.5 * n * log_cos2);
  return d / ((1 + blinn_phong_lambda(alpha, wo.z) + blinn_phong_lambda(alpha, wi.z)) * 4 * wo.z);
}

Bsdf bsdf_from(vec3 diffuse, vec3 f0, float diffuse_roughness, float specular_roughness, float cos_o) {
  Bsdf b;
  b.diffuse = diffuse, b.f0 = f0;
  b.diffuse_roughness = diffuse_roughness;
  b.phong = specular_roughness < 0;
  b.roughness = abs(specular_roughness);
  b.alpha = max(b.roughness * b.roughness, MIN_ALPHA);
  b.f90 = min(1.0, F90_PER_F0 * max_component(f0));
  b.specular = max_component(f0) > 0;
  b.albedo = vec3(0);
  b.left = vec3(1);
  if (b.specular) {
    vec4 table = albedo_entry(b.phong, cos_o, b.roughness);
    b.albedo = min(f0 * table.x + b.f90 * table.y, vec3(1));
    b.left = (1 - b.albedo) / max(1 - (f0 * table.z + b.f90 * table.w), vec3(1e-3));
  }
  return b;
}

// The diffuse layer under the lobe.
vec3 eval_diffuse(Bsdf b, vec3 wo, vec3 wi) {
  if (wo.z <= 0 || wi.z <= 0) return vec3(0);  // formulas for directions above the surface, NaN on its plane
  float d = b.diffuse_roughness == 0 ? wi.z / PI
            : b.diffuse_roughness < 0 ? oren_nayar(-b.diffuse_roughness, wo, wi)
                                      : disney_diffuse(b.diffuse_roughness, wo, wi);
  if (!b.specular) return b.diffuse * d;
  vec4 table = albedo_entry(b.phong, wi.z, b.roughness);
  vec3 share = 1 - min(b.f0 * table.x + b.f90 * table.y, vec3(1));
  return b.diffuse * b.left * share * d;
}

vec3 eval_bsdf(Bsdf b, vec3 wo, vec3 wi) {
  vec3 diffuse = eval_diffuse(b, wo, wi);
  if (!b.specular || wo.z <= 0 || wi.z <= 0) return diffuse;
  vec3 h = normalize(wo + wi);
  float s = schlick_weight(dot(wo, h));
  return diffuse + (b.f0 * (1 - s) + b.f90 * s) * (b.phong ? blinn_phong(b.alpha, wo, wi, h) : ggx(b.alpha, wo, wi, h));
}
