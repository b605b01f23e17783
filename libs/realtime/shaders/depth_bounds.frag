#version 450 core
// Greatest and least depth in squares of 2 x 2 texels of a tile: of the map itself (FIRST) or of the level before.
#ifdef FIRST
layout(binding = UNIT_PARALLEL_MAPS) uniform sampler2DArray depths;
#else
layout(binding = UNIT_DEPTH_BOUNDS) uniform sampler2DArray depths;
#endif
uniform ivec4 source;  // the tile's corner, layer and level
uniform ivec4 target;  // corner
uniform int last;      // texel of the tile
layout(location = 0) out vec2 bounds;

vec2 read(ivec2 at) {
  vec4 texel = texelFetch(depths, ivec3(source.xy + min(at, ivec2(last)), source.z), source.w);
#ifdef FIRST
  return texel.xx;
#else
  return texel.xy;
#endif
}

void main() {
  ivec2 at = 2 * (ivec2(gl_FragCoord.xy) - target.xy);
  vec2 a = read(at), b = read(at + ivec2(1, 0)), c = read(at + ivec2(0, 1)), d = read(at + 1);
  bounds = vec2(max(max(a.x, b.x), max(c.x, d.x)), min(min(a.y, b.y), min(c.y, d.y)));
}
