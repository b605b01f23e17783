// Which SPHLs stand around a point, and which of them it sees. Constants in capitals that stand in no shader are those of
// probes/lookup_constants.h.
#include "probe_data.glsl"

// CandidateGrid's lists, CELLS_WIDTH entries in a row: position; w: probe, -1 where a list ends.
layout(binding = UNIT_PROBE_CELLS) uniform sampler2D probe_cells;

// First entry of the list of candidates around x, nearest to the cell's middle first; frame.grid_size.w entries.
int candidates_at(vec3 x) {
  ivec3 cell = ivec3(floor((x - frame.grid_origin.xyz) / frame.grid_origin.w));
  cell = clamp(cell, ivec3(0), frame.grid_size.xyz - 1);
  return ((cell.z * frame.grid_size.y + cell.y) * frame.grid_size.x + cell.x) * frame.grid_size.w;
}
vec4 candidate(int entry) {
  return texelFetch(probe_cells, ivec2(entry & (1 << LIST_WIDTH_LOG2) - 1, entry >> LIST_WIDTH_LOG2), 0);
}

// Whether a probe in direction d is worth a look: from below the tangent plane light reaches what stands still over no
// edge, and what moves only over one that is nearer than 4 % of the distance, for sight begins 1 % of it off the surface.
bool maybe_above(vec3 d, float d2, Surface s) {
  float height = dot(d, s.geometric_normal), below = s.moves ? 0.25 : SIGHT_BELOW;
  return height >= 0 || height * height <= below * below * d2;
}

// From off the surface as probes::ProbeSight starts its rays; one texel decides.
bool sees_probe(vec3 probe_place, int probe, vec3 x, vec3 n, vec3 geometric, float distance) {
  vec3 lift = SIGHT_LIFT * min(distance, frame.tone.w) * n;
  return cube_sight(probe_maps, frame.maps.z, frame.map_tiles.z, frame.map_near.z, probe, probe_place, x, lift, geometric);
}
