/// Irradiance from the probes around: moving least squares over those in sight, as probes::WeightMethod::mls,
/// or inverse squared distances where these find nothing.

#include <math.h>
#include <string.h>

#include "state.h"

// Those of probes/lookup_constants.h
static const float mls_reach = 2, least_bump = 1e-6f, mls_ridge = 0.05f, wrapped_floor = 0.05f,
                   hidden_slope = 4, sight_lift = 0.01f;
enum { most_near = 16, most_blended = 8, most_coefficients = 24 };

typedef struct {
  float distance2;
  uint32_t probe;
} near_probe;

typedef struct {
  uint32_t probe;
  float weight;
} probe_weight;

/// Asked for a place, one after the other.
typedef struct {
  const ssphh_runtime* rt;
  unsigned flags;
  const float *x, *n;
} query;

/// At most 16 candidates of the place's cell, nearest first.
static int nearest(const query* q, near_probe near[most_near]) {
  const ssphh_cooked_header* h = q->rt->header;
  uint32_t at[3];
  for (int c = 0; c < 3; ++c) {
    const float u = (q->x[c] - h->probe_origin[c]) / h->probe_cell_size, last = (float)h->probe_cells[c] - 1;
    at[c] = (uint32_t)ssphh_runtime_clamp(u, 0, last);
  }
  const uint64_t cell = ((uint64_t)at[2] * h->probe_cells[1] + at[1]) * h->probe_cells[0] + at[0];
  const uint16_t* list = q->rt->probe_cells + cell * h->probe_list_length;
  int count = 0;
  for (uint32_t i = 0; i < h->probe_list_length && list[i] != SSPHH_COOKED_NO_PROBE; ++i) {
    const float* p = q->rt->probes[list[i]].position;
    const float d[3] = {p[0] - q->x[0], p[1] - q->x[1], p[2] - q->x[2]};
    const near_probe found = {ssphh_runtime_dot(d, d), list[i]};
    if (count == most_near && !(found.distance2 < near[count - 1].distance2)) continue;
    int k = count < most_near ? count++ : count - 1;
    for (; k > 0 && found.distance2 < near[k - 1].distance2; --k) near[k] = near[k - 1];
    near[k] = found;
  }
  return count;
}

static int sees(const query* q, const near_probe* near) {
  const float spacing = q->rt->header->probe_spacing, distance = sqrtf(near->distance2);
  const float lift = sight_lift * (spacing > 0 && spacing < distance ? spacing : distance);
  return ssphh_runtime_sees(q->rt, near->probe, q->flags, q->x, q->n, lift);
}

/// Of the angle between the normal and the way to the probe; 1 where it stands there.
static float cosine(const query* q, uint32_t probe) {
  const float* p = q->rt->probes[probe].position;
  const float d[3] = {p[0] - q->x[0], p[1] - q->x[1], p[2] - q->x[2]};
  const float length = sqrtf(ssphh_runtime_dot(d, d));
  return length > 0 ? ssphh_runtime_dot(q->n, d) / length : 1;
}

static int by_distance(const query* q, const near_probe* near, int count, probe_weight* out) {
  int used = 0, chosen[most_blended];
  for (int i = 0; i < count && used < most_blended; ++i)
    if (sees(q, &near[i])) chosen[used++] = i;
  const int none_seen = used == 0;
  for (; none_seen && used < count && used < most_blended; ++used) chosen[used] = used;
  if (used == 0) return 0;
  const float nearest2 = near[chosen[0]].distance2;
  float sum = 0;
  for (int k = 0; k < used; ++k) {
    const near_probe* p = &near[chosen[k]];
    const float wrapped = 0.5f * (1 + cosine(q, p->probe));
    const float weight = p->distance2 > 0 ? nearest2 / p->distance2 * (wrapped * wrapped + wrapped_floor) : 1;
    out[k].probe = p->probe, out[k].weight = weight;
    sum += weight;
  }
  for (int k = 0; k < used; ++k) {
    out[k].weight /= sum;
    if (none_seen) out[k].weight *= ssphh_runtime_clamp(hidden_slope * cosine(q, out[k].probe), 0, 1);
  }
  return used;
}

/// First row of the inverse of a positive definite matrix, by Cholesky's factors.
static void first_row(double m[4][4], float row[4]) {
  double l[4][4] = {{0}}, y[4], z[4];
  for (int i = 0; i < 4; ++i) {
    for (int j = 0; j <= i; ++j) {
      double sum = m[i][j];
      for (int k = 0; k < j; ++k) sum -= l[i][k] * l[j][k];
      l[i][j] = i == j ? sqrt(sum > 0 ? sum : 1e-300) : sum / l[j][j];
    }
  }
  for (int i = 0; i < 4; ++i) {
    y[i] = i == 0;
    for (int k = 0; k < i; ++k) y[i] -= l[i][k] * y[k];
    y[i] /= l[i][i];
  }
  for (int i = 3; i >= 0; --i) {
    z[i] = y[i];
    for (int k = i + 1; k < 4; ++k) z[i] -= l[k][i] * z[k];
    z[i] /= l[i][i];
    row[i] = (float)z[i];
  }
}

static int by_least_squares(const query* q, const near_probe* near, int count, probe_weight* out) {
  const float spacing = q->rt->header->probe_spacing, reach2 = mls_reach * mls_reach * spacing * spacing;
  float place[most_near][4], bump[most_near];
  double m[4][4] = {{0}}, total = 0;
  int used = 0;
  for (int i = 0; i < count && near[i].distance2 <= reach2; ++i) {
    if (!sees(q, &near[i])) continue;
    const float* p = q->rt->probes[near[i].probe].position;
    place[used][0] = 1;
    for (int c = 0; c < 3; ++c) place[used][c + 1] = (p[c] - q->x[c]) / spacing;
    const float t = ssphh_runtime_max(0, 1 - near[i].distance2 / reach2);
    bump[used] = t * t + least_bump;
    total += (double)bump[used];
    for (int a = 0; a < 4; ++a)
      for (int b = 0; b <= a; ++b)
        m[a][b] += (double)bump[used] * (double)place[used][a] * (double)place[used][b];
    out[used++].probe = near[i].probe;
  }
  if (used == 0) return 0;
  for (int c = 1; c < 4; ++c) m[c][c] += (double)mls_ridge * total;
  float row[4], sum = 0;
  first_row(m, row);
  for (int i = 0; i < used; ++i) {
    float at = 0;
    for (int c = 0; c < 4; ++c) at += row[c] * place[i][c];
    out[i].weight = bump[i] * at;
    sum += out[i].weight;
  }
  for (int i = 0; i < used; ++i) out[i].weight /= sum;
  return used;
}

/// Y of bands 0, 1, 2 and 4 (docs/conventions.md), one after the other: irradiance has no band 3. Those above
/// the degree are left as they are.
static void basis_of(uint32_t degree, const float n[3], float y[most_coefficients]) {
  const float x1 = n[0], y1 = n[1], z1 = n[2], x2 = x1 * x1, y2 = y1 * y1, z2 = z1 * z1;
  y[0] = 0.282094792f;
  if (degree < 1) return;
  y[1] = 0.488602512f * y1, y[2] = 0.488602512f * z1, y[3] = 0.488602512f * x1;
  if (degree < 2) return;
  y[4] = 1.092548431f * x1 * y1, y[5] = 1.092548431f * y1 * z1;
  y[6] = 0.315391565f * (3 * z2 - 1);
  y[7] = 1.092548431f * x1 * z1, y[8] = 0.546274215f * (x2 - y2);
  if (degree < 4) return;
  y[9] = 2.503342942f * x1 * y1 * (x2 - y2);
  y[10] = 1.770130769f * y1 * z1 * (3 * x2 - y2);
  y[11] = 0.946174696f * x1 * y1 * (7 * z2 - 1);
  y[12] = 0.669046544f * y1 * z1 * (7 * z2 - 3);
  y[13] = 0.105785547f * (35 * z2 * z2 - 30 * z2 + 3);
  y[14] = 0.669046544f * x1 * z1 * (7 * z2 - 3);
  y[15] = 0.473087348f * (x2 - y2) * (7 * z2 - 1);
  y[16] = 1.770130769f * x1 * z1 * (x2 - 3 * y2);
  y[17] = 0.625835735f * (x2 * x2 - 6 * x2 * y2 + y2 * y2);
}

enum { lanes = 8 };

/// sums += scale f y, `count` of them, which are whole vectors.
static void add_products(float sums[lanes], float scale, const float* restrict f, const float* restrict y,
                         int count) {
  for (int k = 0; k < count; k += lanes)
    for (int i = 0; i < lanes; ++i) sums[i] += scale * y[k + i] * f[k + i];
}

/// Irradiance of one probe by all groups, not negative.
static void irradiance_of(const ssphh_runtime* rt, const float* light, uint32_t probe,
                          const float y[most_coefficients], float e[3]) {
  const int stride = (int)rt->header->probe_stride;
  const uint32_t groups = rt->header->group_count;
  light += (uint64_t)probe * 3 * (uint64_t)stride;
  for (int c = 0; c < 3; ++c, light += stride) {
    float sums[lanes] = {0}, sum = 0;
    for (uint32_t g = 0; g < groups; ++g) {
      const float scale = ssphh_runtime_scale(rt, g, c);
      if (scale != 0) add_products(sums, scale, light + g * rt->group_floats, y, stride);
    }
    for (int i = 0; i < lanes; ++i) sum += sums[i];
    e[c] = ssphh_runtime_max(sum, 0);
  }
}

void ssphh_runtime_by_probes(const ssphh_runtime* rt, const float* light, unsigned flags, const float x[3],
                             const float n[3], float rgb[3]) {
  const query q = {rt, flags, x, n};
  near_probe near[most_near];
  probe_weight weights[most_near];
  const int count = nearest(&q, near);
  int used = rt->header->probe_spacing > 0 ? by_least_squares(&q, near, count, weights) : 0;
  if (used == 0) used = by_distance(&q, near, count, weights);
  float y[most_coefficients], sum[3] = {0, 0, 0}, e[3];
  memset(y, 0, sizeof y);
  basis_of(rt->header->degree, n, y);
  for (int i = 0; i < used; ++i) {
    irradiance_of(rt, light, weights[i].probe, y, e);
    for (int c = 0; c < 3; ++c) sum[c] += weights[i].weight * e[c];
  }
  for (int c = 0; c < 3; ++c) rgb[c] = ssphh_runtime_max(sum[c], 0);
}
