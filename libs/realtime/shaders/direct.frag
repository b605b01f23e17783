#version 450 core
// Light of lamps: emission is there already; this adds what surfaces reflect of it.
#include "gbuffer_read.glsl"
#include "bsdf.glsl"
#include "shadow.glsl"
#include "lights.glsl"
#include "sh.glsl"
#include "probe_data.glsl"

layout(location = 0) out vec4 color;

struct Arriving {
  vec3 sum;              // reflected toward the viewer
  float lit, possible;   // for the view of shadows
};

// Adds irradiance e (on a plane that faces wi, times its cosine) that arrives from wi.
vec3 reflect_from(Bsdf bsdf, mat3 basis, vec3 wo, vec3 wi) {
  vec3 local = wi * basis;
  return local.z > 0 ? eval_bsdf(bsdf, wo, local) / local.z : vec3(0);
}

float lamp_visibility(int map, vec3 light, Surface s) {
  return cube_visibility(light_maps, frame.maps.x, frame.map_tiles.x, frame.map_near.x, map, light, s.position,
                         s.geometric_normal);
}

void add(inout Arriving a, vec3 reflected, float e, float visibility) {
  a.sum += reflected * visibility;
  a.possible += e;
  a.lit += e * visibility;
}

void point_light(Emitter e, Surface s, Bsdf bsdf, mat3 basis, vec3 wo, inout Arriving a) {
  vec3 d = e.place.xyz - s.position;
  float d2 = dot(d, d);
  if (d2 <= 1e-12) return;
  vec3 wi = d * inversesqrt(d2);
  float cosine = dot(s.normal, wi);
  if (cosine <= 0 || dot(s.geometric_normal, wi) <= 0) return;
  vec3 intensity = e.light.rgb;
  if (e.items.x == SPHL) intensity *= max(emission_toward(e.count.y, -wi), vec3(0)) * PI * e.place.w * e.place.w;
  vec3 irradiance = intensity * (falloff(e, wi, d2) / d2) * cosine;
  if (max_component(irradiance) <= 0) return;
  float v = e.items.x == SPHL ? probe_visibility(e.count.y, s.position, s.geometric_normal)
                              : lamp_visibility(e.items.y, e.place.xyz, s);
  add(a, irradiance * reflect_from(bsdf, basis, wo, wi), luminance(irradiance), v);
}

void directional_light(Emitter e, Surface s, Bsdf bsdf, mat3 basis, vec3 wo, inout Arriving a) {
  vec3 wi = e.place.xyz;
  float cosine = dot(s.normal, wi);
  if (cosine <= 0 || dot(s.geometric_normal, wi) <= 0) return;
  // The finest cascade that holds the point
  int map = e.items.y;
  for (; map < e.items.y + e.items.z - 1; ++map) {
    vec3 d = s.position - sun_maps[map].origin.xyz;
    vec2 plane = vec2(dot(d, sun_maps[map].right.xyz) * sun_maps[map].right.w,
                      dot(d, sun_maps[map].up.xyz) * sun_maps[map].up.w);
    if (all(lessThan(abs(plane), vec2(0.98)))) break;
  }
  float v = parallel_visibility(sun_maps[map], s.position, s.geometric_normal);
  vec3 irradiance = e.light.rgb * cosine;
  add(a, irradiance * reflect_from(bsdf, basis, wo, wi), luminance(irradiance), v);
}

// A light with an extent: its irradiance without shadows in closed form, divided among its samples by what
// each would give, so that shadows alone are approximate.
void area_light(Emitter e, Surface s, Bsdf bsdf, mat3 basis, vec3 wo, inout Arriving a) {
  float closed = -1;
  if (e.items.x == SPHERE) {
    vec3 d = e.place.xyz - s.position;
    float d2 = dot(d, d), r2 = e.place.w * e.place.w;
    closed = d2 > r2 ? sphere_irradiance(dot(s.normal, d) * inversesqrt(d2), r2 / d2) : PI;
  } else if (e.count.x > 0) {
    closed = 0;
    for (int t = 0; t < e.count.x; ++t) {
      int at = e.items.w + 3 * t;
      vec3 p = emitter_corners[at].xyz - s.position, q = emitter_corners[at + 1].xyz - s.position,
           r = emitter_corners[at + 2].xyz - s.position;
      // Seen from the front, corners turn counter-clockwise
      float side = dot(cross(q - p, r - p), p);
      if (side >= 0 && e.more.y == 0) continue;
      closed += side < 0 ? triangle_irradiance(s.normal, p, r, q) : triangle_irradiance(s.normal, p, q, r);
    }
  }
  if (closed == 0) return;

  float total = 0, lit = 0;
  vec3 reflected = vec3(0);
  int last = e.items.y + e.items.z;
  for (int i = e.items.y; i < last; ++i) {
    AreaSample q = area_samples[i];
    vec3 d = q.place.xyz - s.position;
    float d2 = max(dot(d, d), 1e-12);
    vec3 wi = d * inversesqrt(d2);
    float emits = q.normal.xyz == vec3(0) ? 1 : e.more.y != 0 ? abs(dot(q.normal.xyz, wi)) : max(-dot(q.normal.xyz, wi), 0);
    float cosine = max(dot(s.normal, wi), 0);
    // Without a closed form nearness must not let one sample blow up
    float weight = q.place.w * e.more.z * emits * cosine / max(d2, q.place.w * e.more.z / PI);
    if (weight <= 0 || dot(s.geometric_normal, wi) <= 0) {
      total += weight;
      continue;
    }
    float v = cube_visibility(area_maps, frame.maps.y, frame.map_tiles.y, frame.map_near.y, int(q.normal.w), q.place.xyz,
                              s.position, s.geometric_normal);
    total += weight;
    lit += weight * v;
    if (v > 0) reflected += weight * v * reflect_from(bsdf, basis, wo, wi);
  }
  if (total <= 0) return;
  float scale = closed < 0 ? 1 : closed / total;
  a.sum += e.light.rgb * reflected * scale;
  a.possible += luminance(e.light.rgb) * total * scale;
  a.lit += luminance(e.light.rgb) * lit * scale;
}

// The environment: irradiance by its spherical harmonics, divided among directions with shadow maps.
void environment_light(Emitter e, Surface s, Bsdf bsdf, mat3 basis, vec3 wo, inout Arriving a) {
  float basis4[25];
  sh_basis4(s.normal, basis4);
  vec3 whole = vec3(0);
  for (int k = 0; k < 25; ++k) whole += environment_sh[k].rgb * basis4[k];
  whole = max(whole, vec3(0)) * e.light.rgb;
  vec3 total = vec3(0), reflected = vec3(0), lit = vec3(0);
  int last = e.items.y + e.items.z;
  for (int i = e.items.y; i < last; ++i) {
    AreaSample q = area_samples[i];
    vec3 wi = q.place.xyz;
    float cosine = dot(s.normal, wi);
    if (cosine <= 0) continue;
    vec3 weight = q.light.rgb * cosine;
    total += weight;
    if (dot(s.geometric_normal, wi) <= 0) continue;
    float v = parallel_visibility(sun_maps[int(q.normal.w)], s.position, s.geometric_normal);
    lit += weight * v;
    if (v > 0) reflected += weight * v * reflect_from(bsdf, basis, wo, wi);
  }
  vec3 scale = whole / max(total, vec3(1e-20));
  a.sum += reflected * scale;
  a.possible += luminance(whole);
  a.lit += luminance(lit * scale);
}

void main() {
  Surface s = read_surface(ivec2(gl_FragCoord.xy));
  if (!s.hit || s.unlit) discard;
  mat3 basis = basis_around(s.normal);
  vec3 wo = s.wo * basis;
  Bsdf bsdf = bsdf_from(s.diffuse, s.f0, s.diffuse_roughness, s.specular_roughness, wo.z);
  Arriving a = Arriving(vec3(0), 0, 0);
  for (int i = 0; i < frame.counts.x; ++i) {
    Emitter e = emitters[i];
    int kind = e.items.x;
    if (kind == POINT || kind == SPHL) {
      point_light(e, s, bsdf, basis, wo, a);
    } else if (kind == DIRECTIONAL) {
      directional_light(e, s, bsdf, basis, wo, a);
    } else if (kind == ENVIRONMENT) {
      environment_light(e, s, bsdf, basis, wo, a);
    } else {
      area_light(e, s, bsdf, basis, wo, a);
    }
  }
  color = vec4(a.sum, a.possible > 0 ? a.lit / a.possible : 0);
}
