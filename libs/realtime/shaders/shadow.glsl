// Shadow maps: tiles of depth arrays. Depth is near / z (cube faces) or 1 - z / range (parallel), both linear
// on the map, so the plane of the receiving surface is known at every texel: no acne, and no bias that grows
// with the slope.

// Face and place of a direction: xy -1..1 right and up, z the coordinate along the face's axis.
int cube_face(vec3 d, out vec3 place) {
  vec3 a = abs(d);
  if (a.x >= a.y && a.x >= a.z) {
    place = d.x > 0 ? vec3(-d.z, d.y, a.x) : vec3(d.z, d.y, a.x);
    return d.x > 0 ? 0 : 1;
  }
  if (a.y >= a.z) {
    place = d.y > 0 ? vec3(d.x, -d.z, a.y) : vec3(d.x, d.z, a.y);
    return d.y > 0 ? 2 : 3;
  }
  place = d.z > 0 ? vec3(d.x, d.y, a.z) : vec3(-d.x, d.y, a.z);
  return d.z > 0 ? 4 : 5;
}
// A vector in the face's axes: right, up, forward.
vec3 in_face(int face, vec3 v) {
  if (face == 0) return vec3(-v.z, v.y, v.x);
  if (face == 1) return vec3(v.z, v.y, -v.x);
  if (face == 2) return vec3(v.x, -v.z, v.y);
  if (face == 3) return vec3(v.x, v.z, -v.y);
  if (face == 4) return vec3(v.x, v.y, v.z);
  return vec3(-v.x, v.y, -v.z);
}

// Share of light in the 2 x 2 texels around `texel` (in the tile) of tile `tile`. `here` is the receiver's own
// depth value, its plane stands at `plane_here` there and changes by `slope` per texel; what is nearer than both by
// `margin` blocks.
float compare_tile(sampler2DArray maps, int size, int columns_log2, int tile, vec2 texel, float here, float plane_here,
                   vec2 slope, float margin) {
  ivec3 place = tile_place(tile, columns_log2);
  vec2 corner = vec2(place.xy * size);
  vec2 at = clamp(texel, vec2(1), vec2(size - 1));
  vec2 low = floor(at - 0.5), f = at - 0.5 - low;
  vec4 stored = textureGather(maps, vec3((corner + low + 1) / vec2(textureSize(maps, 0).xy), place.z));
  vec2 from = low + 0.5 - texel;
  vec4 plane = plane_here + vec4(dot(slope, from + vec2(0, 1)), dot(slope, from + vec2(1, 1)),
                           dot(slope, from + vec2(1, 0)), dot(slope, from));
  vec4 lit = vec4(lessThanEqual(stored, max(plane, vec4(here)) + margin));
  return mix(mix(lit.w, lit.z, f.x), mix(lit.x, lit.y, f.x), f.y);
}

// Share of the light at `light` that arrives at x, whose surface has the normal n. `size` is the texels of a
// face, two of which are border.
float cube_visibility(sampler2DArray maps, int size, int columns_log2, float near, int slot, vec3 light, vec3 x,
                      vec3 n) {
  vec3 d = x - light, place;
  int face = cube_face(d, place);
  float inner = float(size - 2);
  vec2 texel = 0.5 * (place.xy / place.z) * inner + 0.5 * float(size);
  float here = near / place.z;
  vec3 local = in_face(face, n);
  float across = min(-abs(dot(n, d)), -1e-3 * place.z);
  vec2 slope = (dot(n, d) <= 0 ? 1 : -1) * near * local.xy / across * (2 / inner);
  return compare_tile(maps, size, columns_log2, slot * 6 + face, texel, here, here, slope, here * 1.5 / inner);
}

// What glass leaves of the light on its way to a place in a tile, and to x.
vec3 tile_filter(sampler2DArray glass, int size, int columns_log2, int tile, vec2 texel) {
  ivec3 place = tile_place(tile, columns_log2);
  vec2 at = vec2(place.xy * size) + clamp(texel, vec2(1), vec2(size - 1));
  return textureLod(glass, vec3(at / vec2(textureSize(glass, 0).xy), place.z), 0).rgb;
}
vec3 cube_filter(sampler2DArray glass, int size, int columns_log2, int slot, vec3 light, vec3 x) {
  vec3 place;
  int face = cube_face(x - light, place);
  vec2 texel = 0.5 * (place.xy / place.z) * float(size - 2) + 0.5 * float(size);
  return tile_filter(glass, size, columns_log2, slot * 6 + face, texel);
}

// The same for one texel alone: whether the light is seen from `lift` above x. In the texel's middle only x's own surface
// may stand nearer than what is asked about; a plane through the lifted place would come as near as one likes to a light
// at its height, and let that through walls. Without branches, of which software renderers run both sides.
bool cube_sight(sampler2DArray maps, int size, int columns_log2, float near, int slot, vec3 light, vec3 x, vec3 lift,
                vec3 n) {
  vec3 d = x + lift - light, a = abs(d);
  bool along_x = a.x >= a.y && a.x >= a.z, along_y = !along_x && a.y >= a.z;
  float major = along_x ? d.x : along_y ? d.y : d.z, turn = major < 0 ? -1 : 1;
  float inverse_z = 1 / abs(major);
  // Right and up of the face
  vec2 place = vec2(along_x ? -turn * d.z : along_y ? d.x : turn * d.x, along_y ? -turn * d.z : d.y) * inverse_z;
  vec2 local = vec2(along_x ? -turn * n.z : along_y ? n.x : turn * n.x, along_y ? -turn * n.z : n.y);
  int face = (along_x ? 0 : along_y ? 2 : 4) + (major < 0 ? 1 : 0);
  float inner = float(size - 2), here = near * inverse_z;
  vec2 texel = 0.5 * place * inner + 0.5 * float(size);
  // A light below the surface has it in the way, if it reaches so far
  float height = dot(n, light - x), aside = dot(local, floor(texel) + 0.5 - texel) * (near * 2 / inner);
  float plane = height > 0 ? -(here * dot(n, d) + aside) / max(height, 1e-3 * abs(major)) : here;
  ivec3 tile = tile_place(slot * 6 + face, columns_log2);
  float stored = texelFetch(maps, ivec3(tile.xy * size + ivec2(texel), tile.z), 0).x;
  return stored <= max(plane, here) * (1 + 1.5 / inner);
}
