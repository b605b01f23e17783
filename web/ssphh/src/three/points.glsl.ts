/** Irradiance from points on surfaces: what cooked/points.ts computes, in one pass over those that the place sees and one for their negative shares. */
export const pointsGlsl = /* glsl */ `
// Whether a mask's square is set
bool ssphhMasked(int mask, int square) {
  uvec4 masks = ssphhTexel(SSPHH_MASKS + (mask >> 1));
  uvec2 words = (mask & 1) == 0 ? masks.xy : masks.zw;
  return ((square < 32 ? words.x : words.y) >> uint(square & 31) & 1u) != 0u;
}

// The place's cell that holds surface, −1: none; and its squares of 8 × 8 across each axis
int ssphhCell(vec3 x, out ivec3 squares) {
  squares = ivec3(0);
  for (int g = 0; g < 2; ++g) {
    ivec3 cells = g == 0 ? SSPHH_NEAR_CELLS : SSPHH_FAR_CELLS;
    vec4 origin = g == 0 ? SSPHH_NEAR_GRID : SSPHH_FAR_GRID;
    vec3 u = (x - origin.xyz) / origin.w;
    if (any(lessThan(u, vec3(0.0))) || any(greaterThanEqual(u, vec3(cells)))) continue;
    ivec3 at = min(ivec3(u), cells - 1), bricks = (cells + 3) >> 2, in_brick = at & 3, part = at >> 2;
    uvec4 brick = ssphhTexel(SSPHH_BRICKS + (g == 0 ? 0 : SSPHH_FAR_BRICK) + (part.z * bricks.y + part.y) * bricks.x + part.x);
    int bit = in_brick.x + 4 * in_brick.y + 16 * in_brick.z;
    if (((bit < 32 ? brick.x : brick.y) >> uint(bit & 31) & 1u) == 0u) return -1;
    uint below = (1u << uint(bit & 31)) - 1u;
    int count = bit < 32 ? ssphhBits(brick.x & below) : ssphhBits(brick.x) + ssphhBits(brick.y & below);
    ivec3 q = min(ivec3((u - vec3(at)) * 8.0), ivec3(7));
    squares = ivec3(q.y + 8 * q.z, q.x + 8 * q.z, q.x + 8 * q.y);
    return int(brick.z) + count;
  }
  return -1;
}

// Share of a point before the fit; its texels are place and spacing, normal and kind
float ssphhShare(vec4 place, vec4 normal, vec3 offset, vec3 n) {
  float spacing = place.w, d2 = dot(offset, offset), s2 = spacing * spacing;
  float t = 1.0 - d2 / (9.0 * s2), facing = (dot(normal.xyz, n) - 0.7) / (1.0 - 0.7);
  float off = dot(offset, n) / (0.5 * spacing + 0.1 * sqrt(d2)), level = 1.0 - off * off;
  if (!(t > 0.0) || !(facing > 0.0) || !(level > 0.0)) return 0.0;
  t *= t;
  t *= t;
  t *= t;
  int cover = int(floatBitsToUint(normal.w) & 7u);
  float opening = float(1 << cover), q = d2 * opening * opening / s2;
  return t * facing * level * level * (cover == 0 ? 1.0 : 1.0 / (1.0 + q * q));
}

// Irradiance that a point's light gives for a normal; basis: what each three of its floats count for
vec3 ssphhOfPoint(int point, vec3 n) {
  int at = SSPHH_POINT_LIGHT + point * SSPHH_POINT_TEXELS;
  vec4 a = ssphhLightTexel(at), b = ssphhLightTexel(at + 1), c = ssphhLightTexel(at + 2);
#if SSPHH_POINT_TEXELS == 3
  return n.x * a.xyz + n.y * vec3(a.w, b.xy) + n.z * vec3(b.zw, c.x) + c.yzw;
#else
  vec4 d = ssphhLightTexel(at + 3), e = ssphhLightTexel(at + 4), f = ssphhLightTexel(at + 5), g = ssphhLightTexel(at + 6), h = ssphhLightTexel(at + 7);
  return 0.282094792 * a.xyz + 0.488602512 * (n.y * vec3(a.w, b.xy) + n.z * vec3(b.zw, c.x) + n.x * c.yzw) +
         1.092548431 * (n.x * n.y * d.xyz + n.y * n.z * vec3(d.w, e.xy) + n.x * n.z * f.yzw) +
         0.315391565 * (3.0 * n.z * n.z - 1.0) * vec3(e.zw, f.x) + 0.546274215 * (n.x * n.x - n.y * n.y) * g.xyz + vec3(g.w, h.xy);
#endif
}

bool ssphhByPoints(vec3 x, vec3 n, vec3 shading, out vec3 irradiance) {
  irradiance = vec3(0.0);
  ivec3 squares;
  int cell = ssphhCell(x, squares);
  if (cell < 0) return false;
  int first = int(ssphhWord(SSPHH_CELLS, 2 * cell)), mask = int(ssphhWord(SSPHH_CELLS, 2 * cell + 1)), end = int(ssphhWord(SSPHH_CELLS, 2 * cell + 2));
  float side = n.z < 0.0 ? -1.0 : 1.0, a = -1.0 / (side + n.z), b = n.x * n.y * a;
  vec3 along = vec3(1.0 + side * n.x * n.x * a, side * b, -side * n.x), across = vec3(b, side + n.y * n.y * a, -n.y);
  mat3 gram = mat3(0.0), light = mat3(0.0);
  float spacings = 0.0;
  uvec3 serve = uvec3(0u);
  for (int i = first; i < end; ++i) {
    uint entry = ssphhWord(SSPHH_ENTRIES, i);
    int point = int(entry & 0x7fffffffu);
    vec4 normal = ssphhFloats(SSPHH_POINTS + 2 * point + 1);
    if (entry >> 31u != 0u) {
      uint axis = floatBitsToUint(normal.w) >> 3u & 3u;
      if (!ssphhMasked(mask++, axis == 0u ? squares.x : axis == 1u ? squares.y : squares.z)) continue;
    }
    vec4 place = ssphhFloats(SSPHH_POINTS + 2 * point);
    vec3 offset = place.xyz - x;
    float w = ssphhShare(place, normal, offset, n);
    if (!(w > 0.0)) continue;
    int bit = i - first;
    serve[bit >> 5] |= 1u << uint(bit & 31);
    vec3 at = vec3(1.0, dot(offset, along) / SSPHH_NEAR_GRID.w, dot(offset, across) / SSPHH_NEAR_GRID.w);
    gram += w * outerProduct(at, at);
    light += outerProduct(w * ssphhOfPoint(point, shading), at);
    float spacing = place.w / SSPHH_NEAR_GRID.w;
    spacings += w * spacing * spacing;
  }
  float total = gram[0].x;
  if (!(total > 0.0)) return false;
  mat3 m = gram / total;
  m[1].y += 0.05 * spacings / total;
  m[2].z += 0.05 * spacings / total;
  vec3 row = inverse(m)[0];
  float negative = 0.0;
  for (int i = first; i < end; ++i) {
    int bit = i - first;
    if ((serve[bit >> 5] >> uint(bit & 31) & 1u) == 0u) continue;
    int point = int(ssphhWord(SSPHH_ENTRIES, i) & 0x7fffffffu);
    vec4 place = ssphhFloats(SSPHH_POINTS + 2 * point);
    vec3 offset = place.xyz - x;
    float relative = dot(row, vec3(1.0, dot(offset, along) / SSPHH_NEAR_GRID.w, dot(offset, across) / SSPHH_NEAR_GRID.w));
    negative += ssphhShare(place, ssphhFloats(SSPHH_POINTS + 2 * point + 1), offset, n) * max(-relative, 0.0);
  }
  float allowed = 0.25 * total, most = negative > allowed ? allowed / negative : 1.0;
  vec3 share = mix(vec3(1.0, 0.0, 0.0), row, most);
  irradiance = max(light * share / dot(gram[0], share), 0.0);
  return true;
}
`;
