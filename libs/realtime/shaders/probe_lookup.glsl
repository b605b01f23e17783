// Light of SPHLs as surfaces look it up.
#include "probe_places.glsl"

// Octahedral tiles: irradiance of a probe by normal; radiance by mirror direction, one tile per roughness.
layout(binding = UNIT_IRRADIANCE_TILES) uniform sampler2DArray irradiance_tiles;
layout(binding = UNIT_RADIANCE_TILES) uniform sampler2DArray radiance_tiles;

uniform ivec4 irradiance_layout;  // texels of a tile without its border, log2 of tiles in a row; z: from a probe's tile to
                                  // that of what more lights things that move, 0: nothing
uniform ivec4 radiance_layout;    // likewise; z: tiles of a probe
uniform float level_roughness[RADIANCE_LEVELS];

// Texel of a direction in a tile of `size`.
vec2 in_tile(vec3 d, int size) { return 1 + (0.5 + 0.5 * oct_encode(d)) * float(size); }

vec3 sample_tile(sampler2DArray tiles, ivec2 shape, int tile, vec2 texel) {
  ivec3 place = tile_place(tile, shape.y);
  vec2 at = (vec2(place.xy * (shape.x + 2)) + texel) / vec2(textureSize(tiles, 0).xy);
  return textureLod(tiles, vec3(at, place.z), 0).rgb;
}

vec2 irradiance_at(vec3 n) { return in_tile(n, irradiance_layout.x); }
vec3 irradiance_of(int probe, vec2 at) { return sample_tile(irradiance_tiles, irradiance_layout.xy, probe, at); }
// With what more lights things that move, and less of it what stands still.
vec3 irradiance_of(int probe, vec2 at, bool moves) {
  vec3 e = irradiance_of(probe, at);
  if (irradiance_layout.z != 0) e += (moves ? 1 : STILL_SHARE_OF_SKY) * irradiance_of(probe + irradiance_layout.z, at);
  return e;
}

// Where a probe's tiles hold radiance by direction and roughness: the two levels around it, or the one that it is.
struct RadiancePlace {
  vec2 texel;
  int low, high;
  float share;
};
RadiancePlace radiance_at(vec3 d, float roughness) {
  int level = 0;
  for (int i = 1; i + 1 < RADIANCE_LEVELS; ++i) level = roughness >= level_roughness[i] ? i : level;
  float low = level_roughness[level], high = level_roughness[level + 1];
  float share = (roughness - low) / (high - low);
  ivec2 levels = level + ivec2(share == 1 ? 1 : 0, share == 0 ? 0 : 1);
  levels = min(levels, radiance_layout.z - 1);
  return RadiancePlace(in_tile(d, radiance_layout.x), levels.x, levels.y, levels.x == levels.y ? 0 : share);
}
vec3 radiance_of(int probe, RadiancePlace at) {
  vec3 sum = vec3(0);
  for (int level = at.low; level <= at.high; ++level) {
    float weight = level == at.low ? 1 - at.share : at.share;
    sum += weight * sample_tile(radiance_tiles, radiance_layout.xy, probe * radiance_layout.z + level, at.texel);
  }
  return sum;
}
