// SPHLs as surfaces look them up: which stand around a point, which of them it sees, and their light.
#include "probe_data.glsl"

// Octahedral tiles: irradiance of a probe by normal; radiance by mirror direction, one tile per roughness.
layout(binding = 12) uniform sampler2DArray irradiance_tiles;
layout(binding = 13) uniform sampler2DArray radiance_tiles;

uniform ivec4 irradiance_layout;  // texels of a tile without its border, tiles along a side
uniform ivec4 radiance_layout;    // likewise; z: tiles of a probe
const int RADIANCE_LEVELS = 6;
uniform float level_roughness[RADIANCE_LEVELS];

const int MAX_NEAR = 16;   // candidates of a cell
const int MAX_BLEND = 8;   // probes that light a point

// First entry of the list of candidates around x, nearest to the cell's middle first.
int candidates_at(vec3 x) {
  ivec3 cell = ivec3(floor((x - frame.grid_origin.xyz) / frame.grid_origin.w));
  cell = clamp(cell, ivec3(0), frame.grid_size.xyz - 1);
  return ((cell.z * frame.grid_size.y + cell.y) * frame.grid_size.x + cell.x) * MAX_NEAR;
}

vec3 sample_tile(sampler2DArray tiles, ivec2 shape, int tile, vec3 d) {
  int side = shape.x + 2, per_layer = shape.y * shape.y;
  int layer = tile / per_layer, rest = tile - layer * per_layer;
  vec2 corner = vec2(rest % shape.y, rest / shape.y) * float(side);
  vec2 place = corner + 1 + (0.5 + 0.5 * oct_encode(d)) * float(shape.x);
  return textureLod(tiles, vec3(place / float(side * shape.y), layer), 0).rgb;
}

vec3 irradiance_of(int probe, vec3 n) { return sample_tile(irradiance_tiles, irradiance_layout.xy, probe, n); }

vec3 radiance_of(int probe, vec3 d, float roughness) {
  // The two levels around the roughness
  int level = 0;
  for (int i = 1; i + 1 < RADIANCE_LEVELS; ++i) level = roughness >= level_roughness[i] ? i : level;
  float low = level_roughness[level], high = level_roughness[level + 1];
  float f = clamp((roughness - low) / (high - low), 0, 1);
  int levels = radiance_layout.z, tile = probe * levels + min(level, levels - 1);
  return mix(sample_tile(radiance_tiles, radiance_layout.xy, tile, d),
             sample_tile(radiance_tiles, radiance_layout.xy, tile + min(1, levels - 1), d), f);
}

// From off the surface by 1 % of the distance, as gi::ProbeSight starts its rays; one texel decides.
bool sees_probe(vec3 probe_place, int probe, vec3 x, vec3 n, vec3 geometric, float distance) {
  vec3 from = x + 0.01 * min(distance, frame.tone.w) * n;
  return cube_sight(probe_maps, frame.maps.z, frame.map_tiles.z, frame.map_near.z, probe, probe_place, from, geometric);
}
