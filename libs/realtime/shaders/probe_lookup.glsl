// Which probes light a point, as gi::IrradianceLookup and gi::LightLookup choose them.

const int MAX_NEAR = 16;   // candidates of a cell
const int MAX_BLEND = 8;   // probes that light a point
const int IRRADIANCE = 0, LIGHT = 1;

struct Near {
  int count;
  int probe[MAX_NEAR];
};

// Candidates of x's cell by their distance to x.
Near nearest_probes(vec3 x) {
  Near near;
  int base = candidates_at(x);
  uint key[MAX_NEAR];
  near.count = 0;
  for (int i = 0; i < MAX_NEAR; ++i) {
    int probe = i < frame.counts.z ? probe_grid[base + i] : -1;
    vec3 d = probe_places[max(probe, 0)].xyz - x;
    // Distances are positive: their bits order as integers. The place in the list fits in the last four.
    key[i] = probe >= 0 ? (floatBitsToUint(dot(d, d)) & ~15u) | uint(i) : 0xffffffffu;
    near.count += probe >= 0 ? 1 : 0;
  }
  // Bitonic sort
  for (int size = 2; size <= MAX_NEAR; size *= 2) {
    for (int stride = size / 2; stride > 0; stride /= 2) {
      for (int i = 0; i < MAX_NEAR; ++i) {
        int j = i ^ stride;
        if (j > i) {
          uint low = min(key[i], key[j]), high = max(key[i], key[j]);
          bool up = (i & size) == 0;
          key[i] = up ? low : high;
          key[j] = up ? high : low;
        }
      }
    }
  }
  for (int i = 0; i < MAX_NEAR; ++i) near.probe[i] = key[i] == 0xffffffffu ? -1 : probe_grid[base + int(key[i] & 15u)];
  return near;
}

// Off the surface by 1 % of the distance, as gi::ProbeSight starts its rays.
bool sees_probe(int probe, vec3 x, vec3 n, vec3 geometric, float distance2) {
  float offset = 0.01 * min(sqrt(distance2), frame.tone.w);
  return probe_visibility(probe, x + offset * n, geometric) > 0.5;
}

struct Blend {
  int count;
  int probe[MAX_BLEND];
  float weight[MAX_BLEND];
  bool visible;
};

// Inverse squared distance times a wrapped cosine, over the nearest that x sees; over the nearest if it sees
// none.
Blend blend_probes(vec3 x, vec3 n, vec3 geometric) {
  Near near = nearest_probes(x);
  Blend b;
  b.count = 0;
  float total = 0, nearest2 = 0;
  for (int pass = 0; pass < 2 && b.count == 0; ++pass) {
    for (int i = 0; i < MAX_NEAR; ++i) {
      int probe = near.probe[i];
      if (probe < 0 || b.count == MAX_BLEND) break;
      vec3 d = probe_places[probe].xyz - x;
      float d2 = dot(d, d);
      if (pass == 0 && !sees_probe(probe, x, n, geometric, d2)) continue;
      if (b.count == 0) nearest2 = d2;
      float wrapped = 0.5 * (1 + dot(n, d) * inversesqrt(max(d2, 1e-20)));
      float weight = d2 > 0 ? nearest2 / d2 * (wrapped * wrapped + 0.05) : 1;
      b.probe[b.count] = probe;
      b.weight[b.count] = weight;
      total += weight;
      ++b.count;
    }
    b.visible = pass == 0;
  }
  for (int i = 0; i < MAX_BLEND; ++i) {
    b.weight[i] = i < b.count ? b.weight[i] / total : 0;
    if (i >= b.count) b.probe[i] = 0;
  }
  return b;
}
