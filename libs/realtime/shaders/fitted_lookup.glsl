// Irradiance from fitted points, as probes::FittedLookupWeights finds it: a linear fit to the points around on the same
// surface that the pixel sees. Lists, sight and light are made by probes::FittedSurfaces and FittedLight.
layout(binding = 8) uniform usampler2D fitted_ranges;  // of each cell: first entry of its list, number of points
layout(binding = 9) uniform usampler2D fitted_lists;   // a header, then points (fitted_entry.h)
layout(binding = 10) uniform usampler2D fitted_light;  // of each point, four texels: ten halves for each colour
uniform vec4 fitted_origin;   // w: side of a cell
uniform ivec4 fitted_cells;
uniform float fitted_spacing;
const int FITTED_WIDTH_LOG2 = 11;

ivec2 fitted_place(int i) { return ivec2(i & (1 << FITTED_WIDTH_LOG2) - 1, i >> FITTED_WIDTH_LOG2); }

struct FittedPoint {
  int index;
  vec3 place;  // in cells' sides from the cell's corner
  vec3 normal;
  bool seen;
  int cover;  // probes::surface_cover
};

// `squares`: the pixel's square across each axis.
FittedPoint fitted_point(int entry, ivec3 squares) {
  uvec4 e = texelFetch(fitted_lists, fitted_place(entry), 0);
  FittedPoint p;
  p.index = int(e.x >> 10 & 0x7ffffu);
  p.cover = int(e.x >> 29);
  p.place = vec3(e.y & 1023u, e.y >> 10 & 1023u, e.y >> 20 & 1023u) * (13.0 / 1023) - 6;
  int u = int(e.x >> 5 & 31u | (e.y >> 30 & 1u) << 5) - 32, v = int(e.x & 31u | (e.y >> 31) << 5) - 32;
  int z = 31 - abs(u) - abs(v);
  ivec3 d = z >= 0 ? ivec3(u, v, z) : ivec3((31 - abs(v)) * (u >= 0 ? 1 : -1), (31 - abs(u)) * (v >= 0 ? 1 : -1), z);
  p.normal = normalize(vec3(d));
  ivec3 a = abs(d);
  int square = a.x >= a.y && a.x >= a.z ? squares.x : a.y >= a.z ? squares.y : squares.z;
  p.seen = ((square < 32 ? e.z : e.w) >> (square & 31) & 1u) != 0;
  return p;
}

// Dot product of the ten halves of one colour with `y`.
float ten_halves(uint a, uint b, uint c, uint d, uint e, vec2 y[5]) {
  return dot(unpackHalf2x16(a), y[0]) + dot(unpackHalf2x16(b), y[1]) + dot(unpackHalf2x16(c), y[2]) +
         dot(unpackHalf2x16(d), y[3]) + dot(unpackHalf2x16(e), y[4]);
}
vec3 fitted_irradiance_of(int point, vec2 y[5]) {
  ivec2 at = fitted_place(4 * point);
  uvec4 a = texelFetch(fitted_light, at, 0), b = texelFetch(fitted_light, at + ivec2(1, 0), 0),
        c = texelFetch(fitted_light, at + ivec2(2, 0), 0), d = texelFetch(fitted_light, at + ivec2(3, 0), 0);
  return vec3(ten_halves(a.x, a.y, a.z, a.w, b.x, y), ten_halves(b.y, b.z, b.w, c.x, c.y, y),
              ten_halves(c.z, c.w, d.x, d.y, d.z, y));
}

// Whether any fitted point lights the surface; then its irradiance.
bool fitted_irradiance(Surface s, out vec3 irradiance) {
  irradiance = vec3(0);
  vec3 u = (s.position - fitted_origin.xyz) / fitted_origin.w;
  ivec3 cell = ivec3(floor(u));
  bool inside = !s.moves && cell == clamp(cell, ivec3(0), fitted_cells.xyz - 1);
  cell = clamp(cell, ivec3(0), fitted_cells.xyz - 1);
  vec3 f = u - vec3(cell);
  uvec2 range = texelFetch(fitted_ranges, fitted_place((cell.z * fitted_cells.y + cell.y) * fitted_cells.x + cell.x), 0).xy;
  int first = int(range.x), count = inside ? int(range.y) : 0;

  uvec4 header = texelFetch(fitted_lists, fitted_place(first), 0);
  vec2 low = mix(unpackHalf2x16(header.x), unpackHalf2x16(header.y), f.y),
       high = mix(unpackHalf2x16(header.z), unpackHalf2x16(header.w), f.y);
  vec2 along = mix(low, high, f.z);
  float reach = mix(along.x, along.y, f.x);
  ivec3 q = clamp(ivec3(f * 8), ivec3(0), ivec3(7));
  ivec3 squares = ivec3(q.y + 8 * q.z, q.x + 8 * q.z, q.x + 8 * q.y);

  // Those that serve; software renderers leave loops early, but run both sides of every branch
  uvec2 serve = uvec2(0);
  for (int i = 0; i < count; ++i) {
    FittedPoint p = fitted_point(first + 1 + i, squares);
    vec3 d = (p.place - f) * fitted_origin.w;
    float d2 = dot(d, d);
    bool near = d2 < reach * reach && dot(p.normal, s.normal) >= FITTED_COSINE &&
                abs(dot(d, s.normal)) <= FITTED_OFF_PLANE * fitted_spacing + FITTED_OFF_PLANE_SLOPE * sqrt(d2);
    uint bit = near && p.seen ? 1u << (i & 31) : 0u;
    serve |= i < 32 ? uvec2(bit, 0) : uvec2(0, bit);
  }

  vec3 n = s.normal;
  vec2 y[5] = vec2[5](vec2(0.28209479, 0.48860251 * n.y), vec2(0.48860251 * n.z, 0.48860251 * n.x),
                      vec2(1.09254843 * n.x * n.y, 1.09254843 * n.y * n.z),
                      vec2(0.31539157 * (3 * n.z * n.z - 1), 1.09254843 * n.x * n.z),
                      vec2(0.54627422 * (n.x * n.x - n.y * n.y), 1));
  mat3 basis = basis_around(n);
  mat3 gram = mat3(0), light = mat3(0);
  uvec2 left = serve;
  while ((left.x | left.y) != 0) {
    int i = left.x != 0 ? findLSB(left.x) : 32 + findLSB(left.y);
    left = left.x != 0 ? uvec2(left.x & (left.x - 1), left.y) : uvec2(0, left.y & (left.y - 1));
    FittedPoint p = fitted_point(first + 1 + i, squares);
    vec3 d = (p.place - f) * fitted_origin.w;
    float d2 = dot(d, d), t = max(1 - d2 / (reach * reach), 1e-6);
    float open = fitted_spacing / float(1 << p.cover), q = d2 / (open * open);
    float weight = t * t * dot(p.normal, n) * (p.cover == 0 ? 1 : 1 / (1 + q * q));
    vec3 place = vec3(1, (d * basis).xy / fitted_spacing);
    gram += weight * outerProduct(place, place);
    light += outerProduct(weight * fitted_irradiance_of(p.index, y), place);
  }
  float total = gram[0].x;
  bool any = total > 0;
  mat3 m = any ? gram / total : mat3(1);
  m[1].y += FITTED_RIDGE;
  m[2].z += FITTED_RIDGE;
  vec3 row = inverse(m)[0];
  float most = 1;
  left = serve;
  while ((left.x | left.y) != 0) {
    int i = left.x != 0 ? findLSB(left.x) : 32 + findLSB(left.y);
    left = left.x != 0 ? uvec2(left.x & (left.x - 1), left.y) : uvec2(0, left.y & (left.y - 1));
    vec3 d = (fitted_point(first + 1 + i, squares).place - f) * fitted_origin.w;
    float relative = dot(row, vec3(1, (d * basis).xy / fitted_spacing));
    most = relative < FITTED_LOWEST ? min(most, (1 - FITTED_LOWEST) / (1 - relative)) : most;
  }
  vec3 share = mix(vec3(1, 0, 0), row, most);
  irradiance = max(light * share / max(dot(gram[0], share), 1e-20), 0.0);
  return any;
}
