
// --- Points of surfaces: a linear fit to those around that the place sees (points.c) --------------------------------------------

// Whether the bit of a part of the cell is set
bool ssphh_masked(int mask, int part) {
  uvec4 masks = SSPHH_TEXEL(SSPHH_MASKS + (mask >> 1));
  uint low = (mask & 1) == 0 ? masks.x : masks.z, high = (mask & 1) == 0 ? masks.y : masks.w;
  return (((part < 32 ? low : high) >> uint(part & 31)) & 1u) != 0u;
}

// The place's cell that holds surface, -1: none; and its part of the cell by each cut
int ssphh_cell(vec3 x, out ivec4 parts) {
  parts = ivec4(0, 0, 0, 0);
  for (int g = 0; g < 2; ++g) {
    ivec3 cells = g == 0 ? SSPHH_NEAR_CELLS : SSPHH_FAR_CELLS;
    vec4 grid = g == 0 ? SSPHH_NEAR_GRID : SSPHH_FAR_GRID;
    vec3 u = (x - grid.xyz) / grid.w, last = vec3(cells);
    if (!(u.x >= 0.0 && u.y >= 0.0 && u.z >= 0.0 && u.x < last.x && u.y < last.y && u.z < last.z)) continue;
    ivec3 at = min(ivec3(u), cells - 1), bricks = (cells + 3) >> 2, part = at >> 2, in_brick = at & 3;
    uvec4 brick = SSPHH_TEXEL(SSPHH_BRICKS + (g == 0 ? 0 : SSPHH_FAR_BRICK) + (part.z * bricks.y + part.y) * bricks.x + part.x);
    int bit = in_brick.x + 4 * in_brick.y + 16 * in_brick.z;
    if ((((bit < 32 ? brick.x : brick.y) >> uint(bit & 31)) & 1u) == 0u) return -1;
    uint below = (1u << uint(bit & 31)) - 1u;
    int count = bit < 32 ? ssphh_bits(brick.x & below) : ssphh_bits(brick.x) + ssphh_bits(brick.y & below);
    ivec3 q = min(ivec3((u - vec3(at)) * 8.0), ivec3(7, 7, 7));
    parts = ivec4(q.y + 8 * q.z, q.x + 8 * q.z, q.x + 8 * q.y, (q.x >> 1) + 4 * (q.y >> 1) + 16 * (q.z >> 1));
    return int(brick.z) + count;
  }
  return -1;
}

bool ssphh_has_mask(uint entry) { return (entry >> 31u) != 0u; }
int ssphh_point_of(uint entry) { return int(entry & 0x1fffffffu); }

// Weight of a point before the fit, 0: it lights nothing here; mask: of the next entry that has one; offset: to the point
float ssphh_point_weight(uint entry, vec3 n, vec3 x, ivec4 parts, inout int mask, out vec3 offset, out float spacing) {
  int point_index = ssphh_point_of(entry);
  vec4 place = ssphh_floats(SSPHH_POINTS + 2 * point_index), normal = ssphh_floats(SSPHH_POINTS + 2 * point_index + 1);
  uint cover = floatBitsToUint(normal.w), cut = (entry >> 29u) & 3u;
  int part = cut == 0u ? parts.x : cut == 1u ? parts.y : cut == 2u ? parts.z : parts.w;
  offset = place.xyz - x;
  spacing = place.w;
  if (ssphh_has_mask(entry)) {
    ++mask;
    if (!ssphh_masked(mask - 1, part)) return 0.0;
  }
  float d2 = dot(offset, offset), s2 = spacing * spacing;
  float t = 1.0 - d2 / (9.0 * s2), facing = (dot(normal.xyz, n) - 0.7) / (1.0 - 0.7);
  float off = dot(offset, n) / (0.5 * spacing + 0.1 * sqrt(d2)), level = 1.0 - off * off;
  if (!(t > 0.0) || !(facing > 0.0) || !(level > 0.0)) return 0.0;
  t *= t;
  t *= t;
  t *= t;
  float opening = float(1u << cover), q = d2 * opening * opening / s2;
  return t / spacing * facing * level * level * (cover == 0u ? 1.0 : 1.0 / (1.0 + q * q));
}

// What a point keeps of its weight where those that count stand nearer to each other, spacing: a far one of a plain, with its long
// lever, would tilt the fit of a room
float ssphh_beside_finer(vec3 offset, float spacing) {
  float q = dot(offset, offset) / (6.25 * spacing * spacing);
  return 1.0 / (1.0 + q * q);
}

// Irradiance that a point's light gives for a normal
vec3 ssphh_of_point(int point_index, vec3 n) {
  vec4 a = ssphh_point_light(point_index, 0), b = ssphh_point_light(point_index, 1), c = ssphh_point_light(point_index, 2);
  if (SSPHH_POINT_TEXELS == 3) return n.x * a.xyz + n.y * vec3(a.w, b.xy) + n.z * vec3(b.zw, c.x) + c.yzw;
  vec4 d = ssphh_point_light(point_index, 3), e = ssphh_point_light(point_index, 4), f = ssphh_point_light(point_index, 5);
  vec4 g = ssphh_point_light(point_index, 6), h = ssphh_point_light(point_index, 7);
  return 0.282094792 * a.xyz + 0.488602512 * (n.y * vec3(a.w, b.xy) + n.z * vec3(b.zw, c.x) + n.x * c.yzw) +
         1.092548431 * (n.x * n.y * d.xyz + n.y * n.z * vec3(d.w, e.xy) + n.x * n.z * f.yzw) +
         0.315391565 * (3.0 * n.z * n.z - 1.0) * vec3(e.zw, f.x) + 0.546274215 * (n.x * n.x - n.y * n.y) * g.xyz + vec3(g.w, h.xy);
}

// Whether any point lights the place; then its irradiance. Weights are by the normal n of the surface, light by the shading normal.
bool ssphh_by_points(vec3 x, vec3 n, vec3 shading, out vec3 irradiance) {
  irradiance = vec3(0.0, 0.0, 0.0);
  ivec4 parts;
  int cell = ssphh_cell(x, parts);
  if (cell < 0) return false;
  int first = int(ssphh_word(SSPHH_CELLS, 2 * cell)), first_mask = int(ssphh_word(SSPHH_CELLS, 2 * cell + 1));
  int end = int(ssphh_word(SSPHH_CELLS, 2 * cell + 2));
  float side = n.z < 0.0 ? -1.0 : 1.0, a = -1.0 / (side + n.z), b = n.x * n.y * a, unit = 1.0 / SSPHH_NEAR_GRID.w;
  vec3 along = vec3(1.0 + side * n.x * n.x * a, side * b, -side * n.x), across = vec3(b, side + n.y * n.y * a, -n.y);

  int mask = first_mask;
  float counted = 0.0, per_spacing = 0.0;
  for (int k = first; k < end; ++k) {
    uint entry = ssphh_word(SSPHH_ENTRIES, k);
    vec3 offset;
    float spacing;
    float w = ssphh_point_weight(entry, n, x, parts, mask, offset, spacing);
    if (!(w > 0.0)) continue;
    counted += w;
    per_spacing += w / spacing;
  }
  if (!(counted > 0.0)) return false;
  float usual = counted / per_spacing;

  // Weighted sums over the points: 1, place in the tangent plane, its products, spacing, light, light times place. Places are
  // from the first point, where rounding has the least to cancel.
  float total = 0.0, ridge = 0.0;
  vec2 origin = vec2(0.0, 0.0), mean = origin;
  vec3 products = irradiance, light = irradiance, light_along = irradiance, light_across = irradiance;
  mask = first_mask;
  for (int i = first; i < end; ++i) {
    uint entry = ssphh_word(SSPHH_ENTRIES, i);
    vec3 offset;
    float spacing;
    float w = ssphh_point_weight(entry, n, x, parts, mask, offset, spacing);
    if (!(w > 0.0)) continue;
    w *= ssphh_beside_finer(offset, usual);
    vec2 at = vec2(dot(offset, along), dot(offset, across)) * unit;
    if (total == 0.0) origin = at;
    at -= origin;
    vec3 e = w * ssphh_of_point(ssphh_point_of(entry), shading);
    spacing *= unit;
    total += w;
    mean += w * at;
    products += w * vec3(at.x * at.x, at.x * at.y, at.y * at.y);
    ridge += w * spacing * spacing;
    light += e;
    light_along += at.x * e;
    light_across += at.y * e;
  }

  // Each weight counts 1 - slope . (its place - mean) times
  mean /= total;
  ridge *= 0.05 / total;
  float xx = products.x / total - mean.x * mean.x + ridge, xy = products.y / total - mean.x * mean.y;
  float yy = products.z / total - mean.y * mean.y + ridge;
  vec2 from_here = mean + origin;
  vec2 slope = vec2(from_here.x * yy - from_here.y * xy, from_here.y * xx - from_here.x * xy) / (xx * yy - xy * xy);
  float negative = 0.0;
  mask = first_mask;
  for (int j = first; j < end; ++j) {
    uint entry = ssphh_word(SSPHH_ENTRIES, j);
    vec3 offset;
    float spacing;
    float w = ssphh_point_weight(entry, n, x, parts, mask, offset, spacing);
    w *= ssphh_beside_finer(offset, usual);
    negative += w * max(dot(slope, vec2(dot(offset, along), dot(offset, across)) * unit - from_here) - 1.0, 0.0);
  }
  float allowed = 0.25 * total;
  if (negative > allowed) slope *= allowed / negative;
  irradiance = max((light - slope.x * (light_along - mean.x * light) - slope.y * (light_across - mean.y * light)) / total, 0.0);
  return true;
}
