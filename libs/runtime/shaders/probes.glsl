
// --- Probes around: moving least squares over those in sight, or by distance (probes.c, sight.c) ---------------------------------

// Whether probe and place see each other, sight beginning that lift above it; at: the probe's place and reach
bool ssphh_sees(int probe, vec4 at, vec3 x, vec3 n, float lift, bool still) {
  int texels = SSPHH_SIGHT_SIZE;
  if (texels == 0) return true;
  float size = float(texels), half_size = 0.5 * size;
  vec3 away = x - at.xyz, d = away + lift * n, size_of = abs(d);
  float height = -dot(n, away);
  if (still && height < 0.0 && height * height > 0.0025 * dot(away, away)) return false;
  int axis = size_of.x >= size_of.y && size_of.x >= size_of.z ? 0 : size_of.y >= size_of.z ? 1 : 2;
  float major = axis == 0 ? size_of.x : axis == 1 ? size_of.y : size_of.z;
  float side = (axis == 0 ? d.x : axis == 1 ? d.y : d.z) > 0.0 ? 1.0 : -1.0;
  if (!(major > 0.0)) return true;
  vec2 on = axis == 0 ? vec2(-side * d.z, -d.y) : axis == 1 ? vec2(d.x, side * d.z) : vec2(side * d.x, -d.y);
  ivec2 texel = ivec2(clamp((on / major + 1.0) * half_size, 0.0, size - 1.0));
  float asked = major;
  if (still && height > 0.0) {
    // Along the texel's ray the surface itself may stand nearer
    vec2 r = (vec2(texel) + 0.5) / half_size - 1.0;
    vec3 ray = axis == 0 ? vec3(side, -r.y, -side * r.x) : axis == 1 ? vec3(r.x, side, side * r.y) : vec3(side * r.x, -r.y, side);
    float slope = -dot(n, ray);
    if (height < asked * slope) asked = height / slope;
  }
  int face = 2 * axis + (side > 0.0 ? 0 : 1);
  uint stored = ssphh_short(SSPHH_SIGHT, ((probe * 6 + face) * texels + texel.y) * texels + texel.x);
  return stored == 0xffffu || float(stored) * (1.0 / 65535.0) * at.w * (1.0 + 1.5 / size) >= asked;
}

// Irradiance of bands 0, 1, 2, 4 of one colour of a probe
float ssphh_of_probe(int probe, int colour, vec3 n) {
  vec3 n2 = n * n;
  float flat2 = n2.x - n2.y;
  int degree = SSPHH_DEGREE;
  vec4 f = ssphh_probe_light(probe, colour, 0);
  float e = 0.282094792 * f.x;
  if (degree >= 1) e += 0.488602512 * dot(f.yzw, n.yzx);
  if (degree >= 2) {
    f = ssphh_probe_light(probe, colour, 1);
    e += 1.092548431 * (f.x * n.x * n.y + f.y * n.y * n.z + f.w * n.x * n.z) + 0.315391565 * f.z * (3.0 * n2.z - 1.0);
    f = ssphh_probe_light(probe, colour, 2);
    e += 0.546274215 * f.x * flat2;
  }
  if (degree >= 4) {
    float seven1 = 7.0 * n2.z - 1.0, seven3 = 7.0 * n2.z - 3.0;
    e += 2.503342942 * f.y * n.x * n.y * flat2 + 1.770130769 * f.z * n.y * n.z * (3.0 * n2.x - n2.y) + 0.946174696 * f.w * n.x * n.y * seven1;
    f = ssphh_probe_light(probe, colour, 3);
    e += 0.669046544 * (f.x * n.y * n.z + f.z * n.x * n.z) * seven3 + 0.105785547 * f.y * (35.0 * n2.z * n2.z - 30.0 * n2.z + 3.0) +
         0.473087348 * f.w * flat2 * seven1;
    f = ssphh_probe_light(probe, colour, 4);
    e += 1.770130769 * f.x * n.x * n.z * (n2.x - 3.0 * n2.y) + 0.625835735 * f.y * (n2.x * n2.x - 6.0 * n2.x * n2.y + n2.y * n2.y);
  }
  return max(e, 0.0);
}

vec3 ssphh_probe_place(int probe) { return ssphh_floats(SSPHH_PROBES + probe).xyz; }

// Of the angle between the normal and the way to a probe
float ssphh_cosine(vec3 at, vec3 x, vec3 n) {
  vec3 way = at - x;
  float away = length(way);
  return away > 0.0 ? dot(n, way) / away : 1.0;
}

#define SSPHH_MOST_NEAR 16
#define SSPHH_MOST_BLENDED 8

vec3 ssphh_by_probes(vec3 x, vec3 n, vec3 shading, bool still) {
  // At most 16 candidates of the place's cell, nearest first
  int probes[SSPHH_MOST_NEAR];
  float distance2[SSPHH_MOST_NEAR], weights[SSPHH_MOST_NEAR];
  float spacing = SSPHH_SPACING;
  ivec3 counts = SSPHH_PROBE_CELL_COUNTS;
  vec4 grid = SSPHH_PROBE_GRID;
  ivec3 cell = max(min(ivec3(clamp((x - grid.xyz) / grid.w, 0.0, 65536.0)), counts - 1), ivec3(0, 0, 0));
  int length_of_list = SSPHH_LIST_LENGTH, first = ((cell.z * counts.y + cell.y) * counts.x + cell.x) * length_of_list, count = 0;
  for (int i = 0; i < length_of_list; ++i) {
    int probe = int(ssphh_short(SSPHH_PROBE_CELLS, first + i));
    if (probe == 0xffff) break;
    vec3 d = ssphh_probe_place(probe) - x;
    float d2 = dot(d, d);
    if (count == SSPHH_MOST_NEAR && !(d2 < distance2[SSPHH_MOST_NEAR - 1])) continue;
    int k = count < SSPHH_MOST_NEAR ? count++ : count - 1;
    for (; k > 0; --k) {
      if (!(d2 < distance2[k - 1])) break;
      distance2[k] = distance2[k - 1];
      probes[k] = probes[k - 1];
    }
    distance2[k] = d2;
    probes[k] = probe;
  }

  // Which of them the place sees; of these, moving least squares over those within reach
  uint seen = 0u;
  float total = 0.0, reach2 = 4.0 * spacing * spacing;
  vec3 mean = vec3(0.0, 0.0, 0.0), squares = mean, products = mean;  // xx, yy, zz; yz, zx, xy
  for (int j = 0; j < count; ++j) {
    weights[j] = 0.0;
    vec4 place = ssphh_floats(SSPHH_PROBES + probes[j]);
    float away = sqrt(distance2[j]), lift = 0.01 * (spacing > 0.0 && spacing < away ? spacing : away);
    if (!ssphh_sees(probes[j], place, x, n, lift, still)) continue;
    seen |= 1u << uint(j);
    if (!(spacing > 0.0) || distance2[j] > reach2) continue;
    float t = max(0.0, 1.0 - distance2[j] / reach2), w = t * t + 1e-6;
    vec3 at = (place.xyz - x) / spacing;
    weights[j] = w;
    total += w;
    mean += w * at;
    squares += w * at * at;
    products += w * at.yzx * at.zxy;
  }
  bool by_distance = !(total > 0.0), none_seen = seen == 0u;
  if (!by_distance) {
    // Each weight counts 1 - slope . (its place - mean) times
    mean /= total;
    squares = squares / total - mean * mean + 0.05;
    products = products / total - mean.yzx * mean.zxy;
    vec3 a = vec3(squares.x, products.z, products.y), b = vec3(products.z, squares.y, products.x), c = vec3(products.y, products.x, squares.z);
    vec3 bc = cross(b, c);
    vec3 slope = vec3(dot(mean, bc), dot(a, cross(mean, c)), dot(a, cross(b, mean))) / dot(a, bc);
    total = 0.0;
    for (int k = 0; k < count; ++k) {
      if (weights[k] == 0.0) continue;
      weights[k] *= 1.0 - dot(slope, (ssphh_probe_place(probes[k]) - x) / spacing - mean);
      total += weights[k];
    }
  } else {
    // None within reach: by distance; none seen at all: those before the place
    int used = 0;
    float nearest2 = -1.0;
    for (int k = 0; k < count && used < SSPHH_MOST_BLENDED; ++k) {
      if (!none_seen && ((seen >> uint(k)) & 1u) == 0u) continue;
      if (nearest2 < 0.0) nearest2 = distance2[k];
      float wrapped = 0.5 * (1.0 + ssphh_cosine(ssphh_probe_place(probes[k]), x, n));
      weights[k] = distance2[k] > 0.0 ? nearest2 / distance2[k] * (wrapped * wrapped + 0.05) : 1.0;
      total += weights[k];
      ++used;
    }
  }
  vec3 sum = vec3(0.0, 0.0, 0.0);
  for (int m = 0; m < count; ++m) {
    if (weights[m] == 0.0) continue;
    float w = weights[m] / total;
    if (by_distance && none_seen) w *= clamp(4.0 * ssphh_cosine(ssphh_probe_place(probes[m]), x, n), 0.0, 1.0);
    sum += w * vec3(ssphh_of_probe(probes[m], 0, shading), ssphh_of_probe(probes[m], 1, shading), ssphh_of_probe(probes[m], 2, shading));
  }
  return max(sum, 0.0);
}
