// SPHLs: places, light and which of them stand around a point.
layout(std430, binding = 0) readonly buffer ProbePlaces { vec4 probe_places[]; };
layout(std430, binding = 6) readonly buffer ProbeGrid { int probe_grid[]; };
layout(binding = 7) uniform sampler2DArray probe_maps;

float probe_visibility(int probe, vec3 x, vec3 n) {
  return cube_visibility(probe_maps, frame.maps.z, frame.map_tiles.z, frame.map_near.z, probe, probe_places[probe].xyz,
                         x, n);
}
