// SPHLs' shadow maps.
layout(binding = UNIT_PROBE_MAPS) uniform sampler2DArray probe_maps;

float probe_visibility(int probe, vec3 place, vec3 x, vec3 n) {
  return cube_visibility(probe_maps, frame.maps.z, frame.map_tiles.z, frame.map_near.z, probe, place, x, n);
}
