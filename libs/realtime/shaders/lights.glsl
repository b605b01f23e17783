#include "shadow.glsl"

// One emitter of the scene; mirrors GpuEmitter, GpuAreaSample in gpu_types.h. Passes light the scene by one
// emitter each.

struct AreaSample {
  vec4 place;   // position, or direction toward it (environment, disc); w: share of the area or light
  vec4 normal;  // where it shines to, 0: everywhere; w: its map
  vec4 light;   // radiance times solid angle (environment)
};
layout(std140, binding = BINDING_EMITTER_BLOCK) uniform EmitterBlock {
  vec4 place;  // position, or direction toward it; w: radius of a sphere or SPHL, of a sun's disc in radians
  vec4 light;  // as scene::Light: intensity, irradiance or radiance; w: range, 0 none
  vec4 cone;   // a spot's axis; w: scale, 0 none
  vec4 more;   // cone offset, or sine of the radius of a disc's parts; both sides emit (mesh); area [m2]
  ivec4 items; // kind; map or first map; samples; probe of an SPHL, or log2 of tiles in a row (bounds of a disc's maps)
  // Triangles with a closed form, or levels of the bounds of a disc's maps; 1 + layer of a lamp's profile, 0 none; texels of
  // a parallel map, log2 of such in a row
  ivec4 count;
  AreaSample samples[MAX_SAMPLES];  // places of the first three: axes of a lobe or profile
  // Of triangles; coefficients of an SPHL's light; cascades of a disc's parts: centre across the light [m], 1 / half
  // width, tile
  vec4 corners[MAX_CORNERS];
} emitter;

struct SunMap {
  vec4 origin;   // w: 1 / depth range
  vec4 right;    // w: 1 / half width
  vec4 up;       // w: 1 / half height
  vec4 forward;  // away from the light; w: tile
};
layout(std140, binding = BINDING_DISTANT_BLOCK) uniform DistantBlock {
  SunMap sun_maps[MAX_PARALLEL_MAPS];
  vec4 environment_sh[25];
};

layout(binding = UNIT_LIGHT_MAPS) uniform sampler2DArray light_maps;
layout(binding = UNIT_AREA_MAPS) uniform sampler2DArray area_maps;
layout(binding = UNIT_PARALLEL_MAPS) uniform sampler2DArray parallel_maps;

// What the cone and the range leave (KHR_lights_punctual).
float falloff(vec3 wi, float distance2) {
  float f = 1;
  if (emitter.cone.w > 0) {
    f = clamp(-dot(emitter.cone.xyz, wi) * emitter.cone.w + emitter.more.x, 0.0, 1.0);
    f *= f;
  }
  if (emitter.light.w > 0) {
    float q = distance2 / (emitter.light.w * emitter.light.w);
    f *= clamp(1 - q * q, 0.0, 1.0);
  }
  return f;
}

#ifdef POINT
layout(binding = UNIT_LAMP_PROFILES) uniform sampler2DArray lamp_profiles;
// Share of the lamp's intensity that its photometric profile sends away from it: evenly by the angle from the pole and
// the one about it, from edge texel to edge texel.
float profile_share(vec3 away) {
  if (emitter.count.y == 0) return 1;
  vec3 d = vec3(dot(emitter.samples[0].place.xyz, away), dot(emitter.samples[1].place.xyz, away),
                dot(emitter.samples[2].place.xyz, away));
  vec2 angles = vec2(atan(length(d.xy), d.z) / PI, fract(atan(d.y, d.x) / (2 * PI)));
  vec2 size = vec2(textureSize(lamp_profiles, 0).xy);
  return texture(lamp_profiles, vec3((angles * (size - 1) + 0.5) / size, emitter.count.y - 1)).r;
}
#endif

// Between -1 and 1 across the map.
vec2 place_on(SunMap map, vec3 x) {
  vec3 d = x - map.origin.xyz;
  return vec2(dot(d, map.right.xyz) * map.right.w, dot(d, map.up.xyz) * map.up.w);
}

// Texels by which a receiver is lifted along its normal where light grazes it: the plane of a wall that the light
// runs along rises within a texel by more than what stands before it, so nothing in the wall's own texels tells. Only
// what is lit both so and where it stands is lit: a lifted place may reach out of an edge's shadow.
const float GRAZING_LIFT = 1.5;
float grazing_lift(float facing, float texel) { return GRAZING_LIFT * texel * (1 - facing) * (1 - facing); }
// What may stand before a receiver and not block [m]: round things that it touches rise within a texel, too, and depths
// are rounded to some 2^-22 of their `range`.
float shadow_margin(float facing, float texel, float range) { return mix(0.25, 1.5, facing) * texel + 2.5e-7 * range; }

float parallel_visibility(SunMap map, vec3 x, vec3 n) {
  float inner = float(emitter.count.z) - 2;
  float width = 2 / (inner * map.right.w), facing = max(-dot(n, map.forward.xyz), 1e-3);
  float lift = grazing_lift(facing, width);
  vec2 across = place_on(map, x);
  if (any(greaterThan(abs(across), vec2(1)))) return 1;
  float here = 1 - dot(x - map.origin.xyz, map.forward.xyz) * map.origin.w;
  // dz along the map's axes on the receiver's plane, in metres, then in depth per texel
  vec2 slope = -vec2(dot(n, map.right.xyz), dot(n, map.up.xyz)) / facing * (width * map.origin.w);
  vec2 texel = 0.5 * across * inner + 0.5 * float(emitter.count.z);
  vec2 aside = lift / width * vec2(dot(n, map.right.xyz), dot(n, map.up.xyz));
  float above = here + lift * facing * map.origin.w, plane = above - lift / facing * map.origin.w;
  float margin = shadow_margin(facing, width, 1 / map.origin.w) * map.origin.w;
  int tile = int(map.forward.w);
  return min(compare_tile(parallel_maps, emitter.count.z, emitter.count.w, tile, texel, here, here, slope, margin),
             compare_tile(parallel_maps, emitter.count.z, emitter.count.w, tile, texel + aside, above, plane, slope, margin));
}

// What glass leaves of light on its way to x.
#ifdef GLASS
layout(binding = UNIT_LIGHT_GLASS) uniform sampler2DArray light_glass;
layout(binding = UNIT_AREA_GLASS) uniform sampler2DArray area_glass;
layout(binding = UNIT_PARALLEL_GLASS) uniform sampler2DArray parallel_glass;
vec3 lamp_filter(int slot, vec3 light, vec3 x) {
  return cube_filter(light_glass, frame.maps.x, frame.map_tiles.x, slot, light, x);
}
vec3 area_filter(int slot, vec3 light, vec3 x) {
  return cube_filter(area_glass, frame.maps.y, frame.map_tiles.y, slot, light, x);
}
vec3 parallel_filter(SunMap map, vec3 x) {
  vec2 plane = place_on(map, x);
  if (any(greaterThan(abs(plane), vec2(1)))) return vec3(1);
  float size = float(emitter.count.z);
  return tile_filter(parallel_glass, emitter.count.z, emitter.count.w, int(map.forward.w),
                     0.5 * plane * (size - 2) + 0.5 * size);
}
#else
vec3 lamp_filter(int slot, vec3 light, vec3 x) { return vec3(1); }
vec3 area_filter(int slot, vec3 light, vec3 x) { return vec3(1); }
vec3 parallel_filter(SunMap map, vec3 x) { return vec3(1); }
#endif

// The finest cascade of a sun that holds x, from its first map on.
int cascade_of(int first, vec3 x) {
  int map = first, last = first + SUN_CASCADES - 1;
  for (; map < last; ++map) {
    if (all(lessThan(abs(place_on(sun_maps[map], x)), vec2(0.98)))) break;
  }
  return map;
}

// Irradiance / radiance of a triangle above the horizon of n at the origin (Lambert's formula).
float triangle_irradiance(vec3 n, vec3 a, vec3 b, vec3 c) {
  // Cut off below the horizon: at most four corners are left
  vec3 corners[3] = vec3[3](a, b, c);
  vec3 first = vec3(0), last = vec3(0);
  float sum = 0;
  bool any = false;
  for (int i = 0; i < 3; ++i) {
    vec3 p = corners[i], q = corners[i == 2 ? 0 : i + 1];
    float hp = dot(n, p), hq = dot(n, q);
    vec3 from = p, to = q;
    if (hp < 0 && hq < 0) continue;
    if (hp < 0) from = p + (q - p) * (hp / (hp - hq));
    if (hq < 0) to = p + (q - p) * (hp / (hp - hq));
    vec3 u = normalize(from), v = normalize(to);
    if (any) {
      vec3 w = normalize(last), s = cross(w, u);
      float l = length(s);
      if (l > 1e-7) sum += atan(l, dot(w, u)) * dot(n, s) / l;
    } else {
      first = u;
      any = true;
    }
    vec3 s = cross(u, v);
    float l = length(s);
    if (l > 1e-7) sum += atan(l, dot(u, v)) * dot(n, s) / l;
    last = v;
  }
  if (any) {
    vec3 s = cross(last, first);
    float l = length(s);
    if (l > 1e-7) sum += atan(l, dot(last, first)) * dot(n, s) / l;
  }
  return max(0.5 * sum, 0.0);
}

// The same of a sphere of sin(radius) = sin_r whose centre stands in direction `w` (Snyder, Area Light Sources
// for Real-Time Graphics, 1996).
float sphere_irradiance(float cosine, float sin2) {
  float c = clamp(cosine, -0.9999, 0.9999);
  if (c * c > sin2) return PI * sin2 * max(c, 0.0);
  float s = sqrt(1 - c * c), x = sqrt(1 / sin2 - 1);
  float y = -x * c / s, r = s * sqrt(max(1 - y * y, 0.0));
  return max((c * acos(clamp(y, -1.0, 1.0)) - x * r) * sin2 + atan(r, x), 0.0);
}
