// Irradiance from points on surfaces, as probes::SurfaceInterpolation finds it: a linear fit to those around on the same
// surface that the pixel sees. Lists and sight are made by probes::prepare_surfaces.
layout(binding = UNIT_FITTED_RANGES) uniform usampler2D fitted_ranges;  // of each cell: first entry of its list, number of points
layout(binding = UNIT_FITTED_LISTS) uniform usampler2D fitted_lists;  // points (surface_entry.h)
layout(binding = UNIT_FITTED_LIGHT) uniform usampler2D fitted_light;  // of each point, four texels: ten halves for each colour
layout(binding = UNIT_FITTED_POINTS) uniform usampler2D fitted_points;  // of each, its place and its normal
// Of the grid where points are dense and of that of all the rest: origin, w: side of a cell; cells, w: first range
uniform vec4 fitted_origin, fitted_far_origin;
uniform ivec4 fitted_cells, fitted_far_cells;
const int FITTED_STEPS_ASIDE = 3;

ivec2 fitted_place(int i) { return ivec2(i & (1 << LIST_WIDTH_LOG2) - 1, i >> LIST_WIDTH_LOG2); }

uvec4 fitted_entry(int i) { return texelFetch(fitted_lists, fitted_place(i), 0); }
int fitted_index(uvec4 entry) { return int(entry.x & 0x7ffffu); }

// `parts`: the pixel's part of the cell by each cut.
bool fitted_seen(uvec4 entry, ivec4 parts) {
  int part = parts[entry.x >> 22];
  return ((part < 32 ? entry.y : entry.z) >> (part & 31) & 1u) != 0;
}

// Whether a place is in the grid where points are dense.
bool fitted_near(vec3 x) {
  vec3 u = (x - fitted_origin.xyz) / fitted_origin.w;
  return u == clamp(u, vec3(0), vec3(fitted_cells.xyz)) && all(lessThan(u, vec3(fitted_cells.xyz)));
}

// From the pixel to a point.
vec3 fitted_offset(uvec4 place, Surface s) { return uintBitsToFloat(place.xyz) - s.position; }

// probes::share_by_distance, share_by_surface and cover_factor.
float fitted_weight(uvec4 entry, uvec4 place, Surface s) {
  vec3 offset = fitted_offset(place, s);
  float spacing = uintBitsToFloat(entry.w), d2 = dot(offset, offset), s2 = spacing * spacing;
  float t = max(1 - d2 / (FITTED_REACH * FITTED_REACH * s2), 0.0);
  t *= t;
  t *= t;
  float cosine = dot(oct_decode(unpackSnorm2x16(place.w)), s.normal);
  float facing = max((cosine - FITTED_COSINE) / (1 - FITTED_COSINE), 0.0);
  float off = dot(offset, s.normal) / (FITTED_OFF_PLANE * spacing + FITTED_OFF_PLANE_SLOPE * sqrt(d2));
  float level = max(1 - off * off, 0.0);
  int cover = int(entry.x >> 19 & 7u);
  float open = float(1 << cover), q = d2 * open * open / s2;
  return t * t / spacing * facing * level * level * (cover == 0 ? 1 : 1 / (1 + q * q));
}

// probes::share_beside_finer.
float fitted_share_beside_finer(uvec4 place, Surface s, float mean) {
  vec3 offset = fitted_offset(place, s);
  float q = dot(offset, offset) / (FITTED_COARSER * FITTED_COARSER * mean * mean);
  return 1 / (1 + q * q);
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

// Takes the lowest bit out.
int fitted_next(inout uvec3 left) {
  int word = left.x != 0 ? 0 : left.y != 0 ? 1 : 2;
  int i = 32 * word + findLSB(left[word]);
  left[word] &= left[word] - 1;
  return i;
}

// The list of the cell around a place, and which of its points are seen from the part of the cell there.
struct FittedList {
  int first;
  uvec3 seen;
};
FittedList fitted_list(vec3 x, bool still) {
  bool near = fitted_near(x);
  vec4 origin = near ? fitted_origin : fitted_far_origin;
  ivec4 cells = near ? fitted_cells : fitted_far_cells;
  vec3 u = (x - origin.xyz) / origin.w;
  ivec3 cell = ivec3(floor(u));
  bool inside = still && cell == clamp(cell, ivec3(0), cells.xyz - 1);
  cell = clamp(cell, ivec3(0), max(cells.xyz - 1, 0));
  vec3 f = u - vec3(cell);
  uvec2 range = texelFetch(fitted_ranges, fitted_place(cells.w + (cell.z * cells.y + cell.y) * cells.x + cell.x), 0).xy;
  int count = inside ? int(range.y) : 0;

  ivec3 q = clamp(ivec3(f * 8), ivec3(0), ivec3(7));
  ivec3 h = q / 2;
  ivec4 parts = ivec4(q.y + 8 * q.z, q.x + 8 * q.z, q.x + 8 * q.y, h.x + 4 * h.y + 16 * h.z);

  // Software renderers leave loops early, but run both sides of every branch
  FittedList list = FittedList(int(range.x), uvec3(0));
  for (int i = 0; i < count; ++i) {
    uint bit = fitted_seen(fitted_entry(list.first + i), parts) ? 1u << (i & 31) : 0u;
    list.seen |= i < 32 ? uvec3(bit, 0, 0) : i < 64 ? uvec3(0, bit, 0) : uvec3(0, 0, bit);
  }
  return list;
}

void fitted_harmonics(vec3 n, out vec2 y[5]) {
  y = vec2[5](vec2(0.28209479, 0.48860251 * n.y), vec2(0.48860251 * n.z, 0.48860251 * n.x),
              vec2(1.09254843 * n.x * n.y, 1.09254843 * n.y * n.z),
              vec2(0.31539157 * (3 * n.z * n.z - 1), 1.09254843 * n.x * n.z),
              vec2(0.54627422 * (n.x * n.x - n.y * n.y), 1));
}

// A thin door that divides a part of a cell hides each point from some of it, so that none may serve there. Then the mean of
// what serves parts toward the viewer along the surface: on the viewer's side of the door.
bool fitted_aside(Surface s, bool wanted, vec2 y[5], out vec3 irradiance) {
  float part = (fitted_near(s.position) ? fitted_origin.w : fitted_far_origin.w) / 8, total = 0;
  vec3 toward = s.wo - dot(s.wo, s.geometric_normal) * s.geometric_normal;
  toward *= part / max(length(toward), 1e-6);
  irradiance = vec3(0);
  for (int step = 1; step <= FITTED_STEPS_ASIDE; ++step) {
    FittedList list = fitted_list(s.position + float(step) * toward, wanted);
    while ((list.seen.x | list.seen.y | list.seen.z) != 0) {
      uvec4 entry = fitted_entry(list.first + fitted_next(list.seen)),
            place = texelFetch(fitted_points, fitted_place(fitted_index(entry)), 0);
      float weight = fitted_weight(entry, place, s);
      irradiance += weight * fitted_irradiance_of(fitted_index(entry), y);
      total += weight;
    }
  }
  irradiance = max(irradiance / max(total, 1e-20), 0.0);
  return total > 0;
}

// Whether any point lights the surface; then its irradiance.
bool fitted_irradiance(Surface s, out vec3 irradiance) {
  irradiance = vec3(0);
  FittedList list = fitted_list(s.position, !s.moves);
  vec2 y[5];
  fitted_harmonics(s.normal, y);
  mat3 basis = basis_around(s.normal);
  uvec3 left = list.seen, serve = uvec3(0);
  float counted = 0, per_spacing = 0;
  while ((left.x | left.y | left.z) != 0) {
    int i = fitted_next(left);
    uvec4 entry = fitted_entry(list.first + i), place = texelFetch(fitted_points, fitted_place(fitted_index(entry)), 0);
    float weight = fitted_weight(entry, place, s);
    uint bit = weight > 0 ? 1u << (i & 31) : 0u;
    serve |= i < 32 ? uvec3(bit, 0, 0) : i < 64 ? uvec3(0, bit, 0) : uvec3(0, 0, bit);
    counted += weight;
    per_spacing += weight / uintBitsToFloat(entry.w);
  }
  float mean = per_spacing > 0 ? counted / per_spacing : 1;
  mat3 gram = mat3(0), light = mat3(0);
  float square = 0, unit = fitted_origin.w;
  left = serve;
  while ((left.x | left.y | left.z) != 0) {
    uvec4 entry = fitted_entry(list.first + fitted_next(left)),
          place = texelFetch(fitted_points, fitted_place(fitted_index(entry)), 0);
    float weight = fitted_weight(entry, place, s) * fitted_share_beside_finer(place, s, mean);
    vec3 at = vec3(1, (fitted_offset(place, s) * basis).xy / unit);
    gram += weight * outerProduct(at, at);
    light += outerProduct(weight * fitted_irradiance_of(fitted_index(entry), y), at);
    float spacing = uintBitsToFloat(entry.w) / unit;
    square += weight * spacing * spacing;
  }
  float total = gram[0].x;
  bool any = total > 0;
  mat3 m = any ? gram / total : mat3(1);
  float ridge = any ? FITTED_RIDGE * square / total : 0;
  m[1].y += ridge;
  m[2].z += ridge;
  vec3 row = inverse(m)[0];
  float negative = 0;
  left = serve;
  while ((left.x | left.y | left.z) != 0) {
    uvec4 entry = fitted_entry(list.first + fitted_next(left)),
          place = texelFetch(fitted_points, fitted_place(fitted_index(entry)), 0);
    float relative = dot(row, vec3(1, (fitted_offset(place, s) * basis).xy / unit));
    negative += fitted_weight(entry, place, s) * fitted_share_beside_finer(place, s, mean) * max(-relative, 0.0);
  }
  float most = min(1.0, FITTED_NEGATIVE * total / max(negative, 1e-20));
  vec3 share = mix(vec3(1, 0, 0), row, most);
  irradiance = max(light * share / max(dot(gram[0], share), 1e-20), 0.0);
  vec3 aside;
  bool any_aside = fitted_aside(s, !any && !s.moves, y, aside);
  irradiance = any ? irradiance : aside;
  return any || any_aside;
}
