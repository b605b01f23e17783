/** Irradiance from the probes around, those in sight: what cooked/probes.ts and cooked/sight.ts compute. */
export const probesGlsl = /* glsl */ `
// Whether probe and place see each other, sight beginning \`lift\` above it; at: the probe's place and reach
bool ssphhSees(int probe, vec4 at, vec3 x, vec3 n, float lift) {
#if SSPHH_SIGHT_SIZE == 0
  return true;
#else
  const float size = float(SSPHH_SIGHT_SIZE), half_size = 0.5 * size;
  vec3 away = x - at.xyz, d = away + lift * n, size_of = abs(d);
  float height = -dot(n, away);
  if (SSPHH_STILL && height < 0.0 && height * height > 0.0625 * dot(away, away)) return false;
  int axis = size_of.x >= size_of.y && size_of.x >= size_of.z ? 0 : size_of.y >= size_of.z ? 1 : 2;
  float major = size_of[axis], side = d[axis] > 0.0 ? 1.0 : -1.0;
  if (!(major > 0.0)) return true;
  vec2 on = axis == 0 ? vec2(-side * d.z, -d.y) : axis == 1 ? vec2(d.x, side * d.z) : vec2(side * d.x, -d.y);
  ivec2 texel = ivec2(clamp((on / major + 1.0) * half_size, 0.0, size - 1.0));
  float asked = major;
  if (SSPHH_STILL && height > 0.0) {
    // Along the texel's ray the surface itself may stand nearer
    vec2 r = (vec2(texel) + 0.5) / half_size - 1.0;
    vec3 ray = axis == 0 ? vec3(side, -r.y, -side * r.x) : axis == 1 ? vec3(r.x, side, side * r.y) : vec3(side * r.x, -r.y, side);
    float slope = -dot(n, ray);
    if (height < asked * slope) asked = height / slope;
  }
  int face = 2 * axis + (side > 0.0 ? 0 : 1);
  uint stored = ssphhShort(SSPHH_SIGHT, ((probe * 6 + face) * SSPHH_SIGHT_SIZE + texel.y) * SSPHH_SIGHT_SIZE + texel.x);
  return stored == 0xffffu || float(stored) * (1.0 / 65535.0) * at.w * (1.0 + 1.5 / size) >= asked;
#endif
}

void ssphhHarmonics(vec3 n, out vec4 y[6]) {
  vec3 n2 = n * n;
  float seven1 = 7.0 * n2.z - 1.0, seven3 = 7.0 * n2.z - 3.0, flat2 = n2.x - n2.y;
  y[0] = vec4(0.282094792, SSPHH_DEGREE > 0 ? 0.488602512 * n.yzx : vec3(0.0));
  y[1] = SSPHH_DEGREE > 1 ? vec4(1.092548431 * n.x * n.y, 1.092548431 * n.y * n.z, 0.315391565 * (3.0 * n2.z - 1.0), 1.092548431 * n.x * n.z) : vec4(0.0);
  y[2] = vec4(SSPHH_DEGREE > 1 ? 0.546274215 * flat2 : 0.0, SSPHH_DEGREE > 3 ? vec3(2.503342942 * n.x * n.y * flat2, 1.770130769 * n.y * n.z * (3.0 * n2.x - n2.y),
    0.946174696 * n.x * n.y * seven1) : vec3(0.0));
  y[3] = SSPHH_DEGREE > 3 ? vec4(0.669046544 * n.y * n.z * seven3, 0.105785547 * (35.0 * n2.z * n2.z - 30.0 * n2.z + 3.0), 0.669046544 * n.x * n.z * seven3,
    0.473087348 * flat2 * seven1) : vec4(0.0);
  y[4] = SSPHH_DEGREE > 3 ? vec4(1.770130769 * n.x * n.z * (n2.x - 3.0 * n2.y), 0.625835735 * (n2.x * n2.x - 6.0 * n2.x * n2.y + n2.y * n2.y), 0.0, 0.0) : vec4(0.0);
  y[5] = vec4(0.0);
}

vec3 ssphhOfProbe(int probe, vec4 y[6]) {
  vec3 e = vec3(0.0);
  int at = probe * 3 * SSPHH_PROBE_TEXELS;
  for (int c = 0; c < 3; ++c)
    for (int k = 0; k < SSPHH_PROBE_TEXELS; ++k) e[c] += dot(ssphhLightTexel(at++), y[k]);
  return max(e, 0.0);
}

// Of the angle between the normal and the way to a probe
float ssphhCosine(vec3 at, vec3 x, vec3 n) {
  vec3 way = at - x;
  float far = length(way);
  return far > 0.0 ? dot(n, way) / far : 1.0;
}

vec3 ssphhByProbes(vec3 x, vec3 n, vec3 shading) {
  const int most_near = 16, most_blended = 8;
  int near[most_near];
  float distance2[most_near], weights[most_near];
  ivec3 cell = ivec3(clamp((x - SSPHH_PROBE_GRID.xyz) / SSPHH_PROBE_GRID.w, vec3(0.0), vec3(SSPHH_PROBE_CELL_COUNTS - 1)));
  int first = ((cell.z * SSPHH_PROBE_CELL_COUNTS.y + cell.y) * SSPHH_PROBE_CELL_COUNTS.x + cell.x) * SSPHH_LIST_LENGTH, count = 0;
  for (int i = 0; i < SSPHH_LIST_LENGTH; ++i) {
    int probe = int(ssphhShort(SSPHH_PROBE_CELLS, first + i));
    if (probe == 0xffff) break;
    vec3 d = ssphhFloats(SSPHH_PROBES + probe).xyz - x;
    float d2 = dot(d, d);
    if (count == most_near && !(d2 < distance2[count - 1])) continue;
    int k = count < most_near ? count++ : count - 1;
    for (; k > 0 && d2 < distance2[k - 1]; --k) {
      distance2[k] = distance2[k - 1];
      near[k] = near[k - 1];
    }
    distance2[k] = d2;
    near[k] = probe;
  }

  // Which of them the place sees
  uint seen = 0u;
  for (int i = 0; i < count; ++i) {
    float far = sqrt(distance2[i]);
    float lift = 0.01 * (SSPHH_SPACING > 0.0 && SSPHH_SPACING < far ? SSPHH_SPACING : far);
    if (ssphhSees(near[i], ssphhFloats(SSPHH_PROBES + near[i]), x, n, lift)) seen |= 1u << uint(i);
  }
  float total = 0.0;
  for (int i = 0; i < most_near; ++i) weights[i] = 0.0;

  // Moving least squares
  const float reach2 = 4.0 * SSPHH_SPACING * SSPHH_SPACING;
  if (SSPHH_SPACING > 0.0) {
    mat4 m = mat4(0.0);
    for (int i = 0; i < count && distance2[i] <= reach2; ++i) {
      if ((seen >> uint(i) & 1u) == 0u) continue;
      vec4 at = vec4(1.0, (ssphhFloats(SSPHH_PROBES + near[i]).xyz - x) / SSPHH_SPACING);
      float t = max(0.0, 1.0 - distance2[i] / reach2);
      weights[i] = t * t + 1e-6;
      total += weights[i];
      m += weights[i] * outerProduct(at, at);
    }
    if (total > 0.0) {
      m /= total;
      m[1].y += 0.05;
      m[2].z += 0.05;
      m[3].w += 0.05;
      vec4 row = inverse(m)[0];
      total = 0.0;
      for (int i = 0; i < count; ++i) {
        weights[i] *= dot(row, vec4(1.0, (ssphhFloats(SSPHH_PROBES + near[i]).xyz - x) / SSPHH_SPACING));
        total += weights[i];
      }
    }
  }

  // None of them within reach: by distance; none seen at all: those before the place
  bool by_distance = total == 0.0, none_seen = seen == 0u;
  if (by_distance) {
    int used = 0;
    float nearest2 = -1.0;
    for (int i = 0; i < count && used < most_blended; ++i) {
      if (!none_seen && (seen >> uint(i) & 1u) == 0u) continue;
      if (nearest2 < 0.0) nearest2 = distance2[i];
      float wrapped = 0.5 * (1.0 + ssphhCosine(ssphhFloats(SSPHH_PROBES + near[i]).xyz, x, n));
      weights[i] = distance2[i] > 0.0 ? nearest2 / distance2[i] * (wrapped * wrapped + 0.05) : 1.0;
      total += weights[i];
      ++used;
    }
  }
  vec4 y[6];
  ssphhHarmonics(shading, y);
  vec3 sum = vec3(0.0);
  for (int i = 0; i < count; ++i) {
    if (weights[i] == 0.0) continue;
    float w = weights[i] / total;
    if (by_distance && none_seen) w *= clamp(4.0 * ssphhCosine(ssphhFloats(SSPHH_PROBES + near[i]).xyz, x, n), 0.0, 1.0);
    sum += w * ssphhOfProbe(near[i], y);
  }
  return max(sum, 0.0);
}
`;
